// What the parts of the method share while a step runs: operators, laws, the fields that are iterated, when to stop.
#pragma once

#include <chrono>
#include <functional>

#include "latin/indicator.hpp"
#include "latin/piece_loops.hpp"
#include "latin/step_settings.hpp"
#include "step/make_pieces.hpp"
#include "step/observer.hpp"
#include "step/trail.hpp"

namespace dygita {

// What is iterated: data go from left to right, and from the image back to q. Of the near unknowns; those of pieces
// elsewhere are what the last local stage has received of them.
struct Iterate {
  Vec q;                     // of the linear stage: F_hat + k W_hat, N
  Vec velocity;              // V, its answer, m/s
  Vec image;                 // F_hat + k W_hat of what the local stage answers to both, N
  IndicatorSums sums;        // the distance between both answers
  Vec uncorrected{};         // q before the last coarse correction; empty: there was none. Only where a trail is left
  bool is_answered = false;  // before an iteration: V is the answer to q
};

class CoarseCorrection;

// What a run reads and writes besides its own step.
struct RunFiles {
  State& state;
  Observer& observer;
  const InterfaceFields* start_from;  // of another case, or null
  InterfaceFields& kept;
  Trail* trail;  // null: none
  // Of a static step that is solved piece by piece, its pieces for one system; empty: it is not to change its way.
  std::function<Pieces(const StepModel&)> pieces_in_one = nullptr;
  std::shared_ptr<const CoarseCorrection>* coarse = nullptr;  // of the step, of runs that share it; null: its own
};

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

// Wall time by phase of the step, s.
struct Seconds {
  double forward = 0.0, interface = 0.0, local = 0.0, accelerate = 0.0, backward = 0.0, accept = 0.0, output = 0.0;
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

struct StepData {
  // k: search directions of the assembled q.
  StepData(const StepSettings& of_step, StepModel& operators, const Vec& k, const RunFiles& run_files);
  StepData(const StepData&) = delete;
  StepData& operator=(const StepData&) = delete;

  // Of the pieces that are here.
  Eigen::VectorBlock<Vec> own(Vec& near) const { return near.head(model.near.n_own()); }
  // What an increment is to reach. has_start: it begins from kept fields, whose worth the first iteration only
  // measures.
  Goal goal(bool has_start) const;
  // Of the iterate at hand; collective.
  double largest_velocity() const;
  // Throws NumericalError, with the place where it diverged; collective.
  void check_finite(const Outcome& outcome, int increment) const;

  // May the sums of the acceleration be taken with the indicator's? One process has no use for it, and inner iterations
  // change the image they are of.
  bool can_share_sums() const { return !model.near.is_all() && !iterates_roughly; }

  const StepSettings settings;
  RunFiles files;
  StepModel& model;
  const bool iterates_roughly;  // inner iterations, by the pieces' rough operators after each
  Vec weight;                   // 1/sqrt(k): of the components of q in norms, of the pieces here
  LocalStage local;
  Iterate at;
  Indicator indicator;
  PieceLoops loops;
  Seconds seconds;
  // Of the increment at hand, one a piece: the piece's own, and those of its iterated points (of their first port).
  std::vector<IncrementEnergy> energy, of_points;
  // " at substructure 'rod', interface 'thread'": where a velocity is not a number, or else is largest; collective.
  std::string place_of_divergence() const;
};

// Times the assembly's size: beyond it a motion of a static increment is no equilibrium.
constexpr double too_far = 10.0;

}  // namespace dygita
