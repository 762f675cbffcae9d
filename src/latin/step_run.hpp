// One step while it runs. The method is in latin.cpp, windows of several time steps in window.cpp, preloads whose joint
// stands open in seat_bolts.cpp, the bookkeeping in step_run.cpp.
#pragma once

#include <chrono>
#include <functional>

#include "base/parallel.hpp"
#include "base/progress.hpp"
#include "base/thread_choice.hpp"
#include "latin/anderson.hpp"
#include "latin/coarse_correction.hpp"
#include "latin/cut_pulls.hpp"
#include "latin/direct_points.hpp"
#include "latin/indicator.hpp"
#include "latin/latin.hpp"
#include "latin/local_stage.hpp"
#include "latin/piece_clock.hpp"
#include "latin/step_settings.hpp"
#include "latin/tangent_iteration.hpp"
#include "latin/warm_start.hpp"
#include "step/distant_points.hpp"
#include "step/loose_motions.hpp"
#include "step/make_pieces.hpp"
#include "step/trail.hpp"

namespace dygita {

// What is iterated: data go from left to right, and from the image back to q. Of the near unknowns; those of pieces
// elsewhere are what the last local stage has heard of them.
struct Iterate {
  Vec q;                                // of the linear stage: F_hat + k W_hat, N
  Vec velocity;                         // V, its answer, m/s
  Vec image;                            // F_hat + k W_hat of what the local stage answers to both, N
  IndicatorSums sums;                   // the distance between both answers
  Vec inner_velocity{}, inner_image{};  // of inner iterations
  Vec uncorrected{};  // q before the last coarse correction; empty: there was none. Only where a trail is left
};

// What a run reads and writes besides its own step.
struct RunFiles {
  State& state;
  Observer& observer;
  const InterfaceFields* start_from;  // of another case, or null
  InterfaceFields& kept;
  Trail* trail;  // null: none
  // Of a static step that is solved piece by piece, its pieces for one system; empty: it is not to change its way.
  std::function<Pieces(const StepModel&)> pieces_in_one = nullptr;
};

struct LeftUnsolved : std::exception {};

class StepRun {
 public:
  // The step has been started (start_step) and its pieces have search directions k (of the assembled q).
  StepRun(const StepSettings& settings, StepModel& model, const Vec& k, const RunFiles& files);

  void run();
  const StepFigures& figures() const { return books_.figures; }
  void add_to(SolverFigures& figures) const;
  // Has the user stopped it within an increment, which then does not count?
  bool is_left_unsolved() const { return is_left_unsolved_; }

 private:
  // What an iteration is to reach, with how many rounds at most, and velocities beyond which it is lost (0: none).
  struct Goal {
    double tolerance;
    IterationLimit limit;
    double furthest;
  };
  // What iterations have come to: the data that came closest, how close, after how many in all.
  struct Best {
    Vec q;
    Outcome outcome;
    int iterations = 0;
    Missed missed{};  // where the goal was not reached
  };
  // Where an increment begins.
  struct Fields {
    Vec q, velocity;
  };
  // Where preloaded bolts begin one.
  struct BoltStart {
    Vec q, shortening;
  };

  // The stages (latin.cpp): q gives velocity; velocity and q give the image and its distance. Neighbours are told both
  // in between: as soon as the pieces whose data they receive have answered, where is_told. also: an acceleration whose
  // first sums come with the distance.
  void linear_stage(const Vec& q, Vec& velocity, bool is_told = false);
  IndicatorSums local_stage(Vec& velocity, Vec& q, Vec& image, bool is_told = false, Anderson* also = nullptr);
  void coarse_correction(Vec& q, Vec& velocity);
  void inner_iterations();
  void iterate(int increment, const Goal& goal, Best& best);
  // An increment may take minutes: the user who stops the run does not wait for it, and sees how far it is. Throws
  // LeftUnsolved.
  static void heed_interrupt(int iteration, int every);
  void tell_iteration(const Best& best);
  void tell(const std::string& doing);  // and what takes long at the moment
  void watch(TangentIteration& iteration);
  // The same in other ways, from where the increment began (other_way.cpp): in one system what is solved piece by
  // piece; and where what is best is no solution at all.
  bool can_go_in_one() const;
  void begin_in_one(int increment);
  void iterate_in_one(int increment, const Goal& goal, const Fields& start, Best& best);
  void iterate_again(int increment, const Goal& goal, const Vec& start, Best& best);
  // With all pieces in one system; leaves: loose parts once, near the solution.
  void iterate_assembled(int increment, const Goal& goal, Best& best, bool leaves = true);
  // Loose parts (loose_parts.cpp), where all pieces are in one system and where they are not.
  bool leave_loose_parts();
  std::vector<Vec3> loose_motions(double size) const;  // size: W, of the increment's fields
  void take_off(const std::vector<Vec3>& motions);
  void stop_loose_parts();
  void rest_loose_parts(int increment, const Goal& goal, Best& best);
  void begin_increment(int increment, bool starts_window);
  std::vector<double> begin_pieces(int increment);
  void finish_increment(const Vec& q);
  void solve_increment(int increment);
  void run_increments();
  Best answer(int increment, const Goal& goal, bool goes_over_again = false);

  // The trail (follow.cpp): an increment gone over again, up to where its interiors are finished; what an increment
  // leaves for that.
  bool leads(long n) const { return files_.trail && files_.trail->leads(n); }
  Best follow(int increment, const Goal& goal);
  Best go_over_again(const TrailEntry& entry, int increment, const Goal& goal);
  void leave(const Best& best, bool is_solved);
  void leave_window(const std::vector<Vec>& q, int iterations, double eta, const std::optional<Missed>& missed);
  void replay_window(int first, int last);
  TrailEntry take_entry();

  // Steps with explicit pieces (substeps.cpp): the time step of the deck in one or several increments.
  void solve_interval(int increment);
  void run_through(int increment);
  void begin_substep(int increment, int substep);
  template <class First>
  void share_pulls(First&& first);
  void begin_explicit(int i, const std::vector<double>& motions);
  Best solve_substep(int increment, int substep, bool is_led);
  void finish_piece(Piece& piece, int i);
  void book_stored_energy(int i);
  void finish_substep(int substep);
  void add_forces();
  void show_mean_forces();

  // Preloads whose joint stands open (seat_bolts.cpp). The search improves shortenings d (m), each bolt's in turn,
  // until forces are right to `precision`; answers them (N), `best` being the iteration at d.
  void seat_bolts(int increment, const BoltStart& start, Best& best);
  Vec search_shortenings(int increment, double tolerance, double precision, Vec& d, Best& best);

  // Windows (window.cpp).
  struct Start {
    std::vector<PieceState> pieces;
    LocalStage local;
  };
  void solve_window(int first, int last);
  void check_window(std::pair<int, int> steps, int n, const Outcome& worst, double grown, bool ends) const;
  Outcome sweep(int first, std::vector<Vec>& q, std::vector<Vec>& image);
  Outcome sweep_at_once(int first, std::vector<Vec>& q, std::vector<Vec>& image);
  bool sweeps_at_once() const;
  void replay(int increment, const Vec& q, bool starts_window, int iterations, double eta);
  Start remember() const;
  void go_back(const Start& start);

  // Bookkeeping (step_run.cpp).
  Goal goal_of(bool has_start) const;
  bool predict(int increment, Vec& q);
  // Of the pieces that are here.
  Eigen::VectorBlock<Vec> own(Vec& near) const { return near.head(model_.near.n_own()); }
  double largest_velocity() const;
  // s, at the end of a time step of the deck: sums of many short ones would be off by rounding.
  double time_of(int increment) const { return start_time_ + (increment + 1) * model_.step->dt; }
  void keep(const Vec& q);
  void accept_increment(int increment, int iterations, double eta);
  void accept_interval(int increment, int iterations, double eta, double interface_energy);
  void note_missed(const Missed& missed);
  bool has_flown_off() const;
  std::vector<IncrementEnergy> all_energies() const;
  void complete_energies(std::vector<IncrementEnergy>& energies) const;
  void check_finite(const Outcome& outcome, int increment) const;
  std::string place_of_divergence() const;
  std::string describe_progress() const;
  Instant instant(int increment, int iterations, double eta) const;

  // f on some of the pieces that are here; on all of them; on every group of pieces that are solved together.
  template <class Function>
  void for_each_piece(const std::vector<int>& pieces, Function&& f) {
    parallel_for(
        static_cast<int>(pieces.size()),
        [&](int at) {
          const PieceClock clock(books_.piece_seconds, {pieces[at]});
          f(*model_.pieces[pieces[at]], pieces[at]);
        },
        Schedule::as_free, piece_threads_.threads());
  }
  template <class Function>
  void for_each_piece(Function&& f) {
    for_each_piece(largest_first_, f);
  }
  template <class Function>
  void for_each_group(Function&& f) {
    parallel_for(static_cast<int>(model_.equal.size()), [&](int i) {
      std::vector<Piece*> group;
      for (const int member : model_.equal[i]) group.push_back(model_.pieces[member].get());
      const PieceClock clock(books_.piece_seconds, model_.equal[i]);
      f(group, model_.equal[i]);
    });
  }

  // Wall time by phase of the step, s.
  struct Seconds {
    double forward = 0.0, interface = 0.0, local = 0.0, accelerate = 0.0, backward = 0.0, accept = 0.0, output = 0.0;
  };
  struct Books {
    std::vector<IncrementEnergy> energy;     // of the increment, one a piece
    std::vector<IncrementEnergy> of_points;  // iterated ones, with the piece of their first port
    std::vector<std::vector<Vec3>> force;    // N, of the surfaces' points, summed over the substeps of a time step
    StepFigures figures;
    Seconds seconds;
    std::vector<double> piece_seconds;  // of a processor; empty: one process, whose phases tell enough
  };
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

  const StepSettings settings_;
  RunFiles files_;
  // Operators, and the laws with what they remember.
  StepModel& model_;
  const double start_time_;  // s
  Vec weight_;               // 1/sqrt(k): of the components of q in norms, of the pieces here
  CoarseCorrection coarse_;
  int n_inner_;  // iterations by the pieces' rough operators after each
  LocalStage local_;
  std::optional<TangentIteration> assembled_;  // static steps with all pieces in one system
  Pieces pieces_in_one_;                       // of others, once an increment has asked for them
  std::optional<TangentIteration> in_one_;
  std::optional<LooseMotions> loose_;  // of static steps
  bool goes_part_by_part_ = false;     // though all pieces are in one system
  bool is_left_unsolved_ = false;      // the increment at hand, since the user has stopped the run
  std::optional<Progress> progress_;   // while it runs
  std::string told_;                   // how far the increment at hand is
  bool is_answered_ = false;           // the velocities at hand are the linear stage's answer to q
  DirectPoints direct_;
  CutPulls pulls_;
  std::optional<DistantPoints> distant_;  // where there are several ranks
  std::vector<ExplicitPiece*> explicit_;  // null: implicit
  std::vector<int> largest_first_;        // pieces that are solved here
  // Of these, those that other ranks receive, and the rest: in explicit increments, and in iterations.
  struct InTurn {
    std::vector<int> border, interior;
  };
  InTurn telling_, iterating_;
  bool is_all_direct_ = false;  // of the pieces here and all points: nothing is iterated
  ThreadChoice piece_threads_;  // in loops over pieces and points in closed form
  Iterate at_;
  // Acceleration, and when to stop.
  WarmStart warm_start_;
  Anderson anderson_;
  InterfaceSums window_sums_;
  Indicator indicator_;
  Books books_;
};

}  // namespace dygita
