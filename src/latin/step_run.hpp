// One step while it runs: what the stages of latin.cpp work on. The method is in latin.cpp, the bookkeeping in
// step_run.cpp.
#pragma once

#include <chrono>

#include "base/parallel.hpp"
#include "latin/anderson.hpp"
#include "latin/coarse_correction.hpp"
#include "latin/indicator.hpp"
#include "latin/latin.hpp"
#include "latin/local_stage.hpp"
#include "latin/warm_start.hpp"

namespace dygita {

class StepRun {
 public:
  StepRun(const Problem& problem, StepModel& model, State& state, Observer& observer, const InterfaceFields* start_from,
          InterfaceFields& kept);

  void run();
  // Writes displacements, velocities and what loads had reached into the state: the next step starts from it.
  void leave_state();
  const StepFigures& figures() const { return figures_; }
  void add_to(SolverFigures& figures) const;

 private:
  // What the iteration of an increment is to reach, and with how many iterations at most.
  struct Goal {
    double tolerance;
    int most;
  };

  // The stages (latin.cpp).
  void linear_stage();
  void coarse_correction();
  IndicatorSums local_stage();
  void begin_increment(int increment, bool starts_window);
  void finish_increment();
  Outcome iterate(int increment, const Goal& goal, Vec& q_best, int& n);
  void solve_increment(int increment);
  void solve_window(int first, int last);
  void replay(int increment, const Vec& q, bool starts_window, int iterations, double eta);

  // Preloads whose joint stands open (seat_bolts.cpp).
  Outcome seat_bolts(int increment, Vec& q_best, int& n);
  void keep_start();
  bool is_lost() const;

  // Bookkeeping (step_run.cpp).
  struct Start {
    std::vector<Piece::Snapshot> pieces;
    LocalStage local;
  };
  Goal goal_of(bool has_start) const;
  double round_off() const;
  Start remember() const;
  void go_back(const Start& start);
  void accept_increment(int increment, int iterations, double eta);
  bool has_flown_off() const;
  double assembly_size() const;
  void check_finite(const Outcome& outcome, int increment) const;
  std::string describe_progress() const;
  Instant instant(int increment, int iterations, double eta) const;
  template <class Function>
  void for_each_piece(Function&& f) {
    parallel_for(static_cast<int>(model_.pieces.size()), [&](int i) { f(*model_.pieces[i], i); });
  }

  // f on every group of pieces that share a factor.
  template <class Function>
  void for_each_group(Function&& f) {
    parallel_for(static_cast<int>(model_.equal.size()), [&](int i) { f(model_.equal[i]); });
  }
  std::vector<Piece*> group(const std::vector<int>& members) {
    std::vector<Piece*> pieces;
    for (const int i : members) pieces.push_back(model_.pieces[i].get());
    return pieces;
  }

  const Problem& problem_;
  StepModel& model_;
  State& state_;
  Observer& observer_;
  const InterfaceFields* start_from_;
  InterfaceFields& kept_;
  int i_step_ = 0, window_ = 1, max_iterations_ = 200, window_depth_ = 0;
  bool is_going_on_ = false;  // more iterations from kept fields, whatever the tolerance
  double tolerance_ = 1e-6, window_relaxation_ = 0.8;
  Vec weight_, q_, velocity_, image_;
  LocalStage local_;
  CoarseCorrection coarse_;
  WarmStart warm_start_;
  Anderson anderson_;
  Indicator indicator_;
  Vec q_start_, shortenings_start_;  // of the increment, where there are preloads
  double extent_ = 0.0;              // m, of the assembly, where there are preloads
  IndicatorSums sums_;               // of the last local stage
  std::vector<double> motions_;
  std::vector<IncrementEnergy> energy_;
  StepFigures figures_;
  // Wall time by phase of the step.
  class Stopwatch {
   public:
    explicit Stopwatch(double& sum) : sum_(sum), start_(std::chrono::steady_clock::now()) {}
    ~Stopwatch() { sum_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

   private:
    double& sum_;
    std::chrono::steady_clock::time_point start_;
  };
  struct {
    double forward = 0.0, interface = 0.0, local = 0.0, accelerate = 0.0, backward = 0.0, accept = 0.0, output = 0.0;
  } seconds_;
};

}  // namespace dygita
