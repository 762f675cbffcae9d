// Where a static increment does not converge as the step is solved: in one system what the parts one by one have not
// found, part by part what one system has not (manual, "Stagnation").
#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "base/error.hpp"
#include "base/log.hpp"
#include "latin/iteration.hpp"

namespace dygita {

namespace {

// A few more iterations on what was solved before: where increments before it are others now, that may be too few.
class InFull final : public Strategy {
 public:
  explicit InFull(Iteration& iteration) : iteration_(iteration), step_(iteration.step()) {}
  void rescue(int increment, const Goal& goal, Best& best) override {
    if (best.outcome.eta <= step_.settings.tolerance) return;
    step_.at.q = best.q;
    iteration_.run(increment, {step_.settings.tolerance, step_.settings.limit, goal.furthest}, best);
  }

 private:
  Iteration& iteration_;
  StepData& step_;
};

// What it finds in one system is the pieces' own answer to the same data. Where that is not enough, they go on from
// what is best.
class InOneSystem final : public Strategy {
 public:
  explicit InOneSystem(Iteration& iteration) : iteration_(iteration), step_(iteration.step()) {}
  Goal begin(const Goal& goal) override;
  void rescue(int increment, const Goal& goal, Best& best) override;

 private:
  void begin_pieces(int increment);
  Best iterate(int increment, const Goal& goal);

  Iteration& iteration_;
  StepData& step_;
  Vec q_, velocity_;  // where the increment began
  bool is_allowed_ = false;
  Pieces pieces_;  // once an increment has asked for them
  std::optional<TangentIteration> system_;
  std::optional<TangentDirections> directions_;
};

Goal InOneSystem::begin(const Goal& goal) {
  q_ = step_.at.q;
  velocity_ = step_.at.velocity;
  is_allowed_ = goal.limit.most > goal.limit.least;
  if (!is_allowed_) return goal;
  return {goal.tolerance, {goal.limit.least, goal.limit.least}, goal.furthest};
}

// As they are at the start of an increment.
void InOneSystem::begin_pieces(int increment) {
  StepModel& model = step_.model;
  if (!directions_) {
    pieces_ = step_.files.pieces_in_one(model);
    model.pieces.swap(pieces_);
    system_.emplace(model, step_.local, step_.local.k(), step_.settings.assembly_size);
    iteration_.told().watch(*system_);
    model.pieces.swap(pieces_);
    directions_.emplace(step_, iteration_.stages(), *system_, iteration_.loose_parts());
  }
  const std::vector<double> motions = model.motion_velocities(increment);
  for (size_t i = 0; i < pieces_.size(); ++i) {
    const Points displacement = model.pieces[i]->displacement(), nothing = Points::Zero(3, displacement.cols());
    const Points force = model.piece_force(static_cast<int>(i), step_.files.state);
    pieces_[i]->set_state(displacement, nothing, force, nothing);
    pieces_[i]->begin(force, motions, 0.0);
  }
}

Best InOneSystem::iterate(int increment, const Goal& goal) {
  constexpr IterationLimit few{50, 200};  // each costs a factor
  Best found{q_, {}};
  step_.at.q = q_;
  step_.at.velocity = velocity_;
  try {
    begin_pieces(increment);
    iteration_.run(*directions_, increment, {goal.tolerance, few, goal.furthest}, found);
    if (goal.furthest > 0.0 && !(step_.largest_velocity() <= goal.furthest)) found.outcome = {};
  } catch (const NumericalError&) {  // too large, or diverged: the pieces' own way is as good as it was
    found.outcome = {};
  }
  step_.local.limit_friction({});
  return found;
}

void InOneSystem::rescue(int increment, const Goal& goal, Best& best) {
  const double tolerance = step_.settings.tolerance;
  if (!is_allowed_ || best.outcome.eta <= tolerance) return;
  const int n_before = best.iterations;
  Best found = iterate(increment, goal);
  best.iterations += found.iterations;
  const bool is_found = found.outcome.eta <= tolerance;
  if (is_found) {
    say(fmt::format("static step '{}', increment {}: {} iterations part by part did not converge, {} in one system did",
                    step_.model.step->name, increment + 1, n_before, found.iterations));
    step_.at.uncorrected.resize(0);
    iteration_.stages().answer();
    found.outcome = step_.indicator.measure(step_.at.sums);
  }
  if (found.outcome.eta < best.outcome.eta) {
    best.outcome = found.outcome;
    best.q = is_found ? step_.at.q : found.q;
    best.missed = found.missed;
  }
  if (best.outcome.eta <= tolerance) return;
  step_.at.q = best.q;
  Best more{best.q, {}, best.iterations};
  iteration_.run(increment, goal, more);
  best.iterations = more.iterations;
  if (more.outcome.eta < best.outcome.eta) best = std::move(more);
}

// Parts that contact alone holds, and that an iteration has let off, come back by the same small way each time, which
// gives the acceleration no information: it makes them diverge. Newton's method in one system may go round in circles
// where all points slide back at once. Where either has diverged, once more from the start: part by part, and without
// acceleration. Where one system stagnates short of the tolerance, the parts one by one go on.
class PartByPart final : public Strategy {
 public:
  explicit PartByPart(Iteration& iteration) : iteration_(iteration), step_(iteration.step()) {}
  Goal begin(const Goal& goal) override {
    start_ = step_.at.q;
    return goal;
  }
  void rescue(int increment, const Goal& goal, Best& best) override;

 private:
  Iteration& iteration_;
  StepData& step_;
  Vec start_;
};

void PartByPart::rescue(int increment, const Goal& goal, Best& best) {
  constexpr double diverged = 1e-5;  // of the indicator
  constexpr IterationLimit part_by_part{400, 5000};
  if (start_.size() == 0) return;
  const bool is_in_one = step_.settings.is_assembled;
  const double tolerance = step_.settings.tolerance;
  Anderson& anderson = iteration_.constant().acceleration();
  for (const bool accelerates : {true, false}) {
    if (accelerates ? !(is_in_one && anderson.accelerates()) : !(is_in_one || anderson.accelerates())) continue;
    const bool has_diverged = best.outcome.eta > std::max(diverged, tolerance);
    if (!has_diverged && !(accelerates && best.outcome.eta > tolerance)) return;
    step_.local.limit_friction({});
    step_.at.q = has_diverged ? start_ : best.q;
    Best again{step_.at.q, {}, best.iterations};
    anderson.pause(!accelerates);
    iteration_.run(iteration_.constant(), increment, {goal.tolerance, part_by_part, goal.furthest}, again);
    anderson.pause(false);
    best.iterations = again.iterations;
    if (again.outcome.eta < best.outcome.eta) best = std::move(again);
  }
}

// As many iterations as the deck allows have been.
bool may_go_on(const StepData& step) { return step.settings.limit.most > step.settings.limit.least; }

}  // namespace

std::unique_ptr<Strategy> iterate_in_full(Iteration& iteration) {
  return iteration.step().settings.more_iterations > 0 ? std::make_unique<InFull>(iteration) : nullptr;
}

std::unique_ptr<Strategy> iterate_in_one_system(Iteration& iteration) {
  const StepData& step = iteration.step();
  const bool can = step.files.pieces_in_one && step.model.n_q() > 0 && may_go_on(step);
  return can ? std::make_unique<InOneSystem>(iteration) : nullptr;
}

std::unique_ptr<Strategy> iterate_part_by_part(Iteration& iteration) {
  const StepData& step = iteration.step();
  return step.model.scheme.is_static && may_go_on(step) ? std::make_unique<PartByPart>(iteration) : nullptr;
}

}  // namespace dygita
