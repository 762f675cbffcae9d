// Where a static increment does not converge as the step is solved: in one system what the parts one by one have not
// found, part by part what one system has not (manual, "Stagnation").
#include <spdlog/fmt/fmt.h>

#include "base/error.hpp"
#include "base/log.hpp"
#include "latin/step_run.hpp"

namespace dygita {

bool StepRun::can_go_in_one() const {
  return !assembled_ && files_.pieces_in_one && model_.n_q() > 0 && settings_.limit.most > settings_.limit.least;
}

// The pieces as they are at the start of an increment, all in one system.
void StepRun::begin_in_one(int increment) {
  if (!in_one_) {
    pieces_in_one_ = files_.pieces_in_one(model_);
    model_.pieces.swap(pieces_in_one_);
    in_one_.emplace(model_, local_, local_.k(), settings_.assembly_size);
    watch(*in_one_);
    model_.pieces.swap(pieces_in_one_);
  }
  const std::vector<double> motions = model_.motion_velocities(increment);
  for (size_t i = 0; i < pieces_in_one_.size(); ++i) {
    const Points displacement = model_.pieces[i]->displacement(), nothing = Points::Zero(3, displacement.cols());
    const Points force = model_.piece_force(static_cast<int>(i), files_.state);
    pieces_in_one_[i]->set_state(displacement, nothing, force, nothing);
    pieces_in_one_[i]->begin(force, motions, 0.0);
  }
}

// The iteration of one system from where the increment began; what it finds is the pieces' own answer to the same data.
// Where that is not enough, they go on from what is best.
void StepRun::iterate_in_one(int increment, const Goal& goal, const Fields& start, Best& best) {
  constexpr IterationLimit few{50, 200};  // each costs a factor
  const int n_before = best.iterations;
  Best found{start.q, {}};
  at_.q = start.q;
  at_.velocity = start.velocity;
  try {
    begin_in_one(increment);
    assembled_.swap(in_one_);
    iterate(increment, {goal.tolerance, few, goal.furthest}, found);
    if (goal.furthest > 0.0 && !(largest_velocity() <= goal.furthest)) found.outcome = {};
  } catch (const NumericalError&) {  // too large, or diverged: the pieces' own way is as good as it was
    found.outcome = {};
  }
  if (assembled_) assembled_.swap(in_one_);
  local_.limit_friction({});
  best.iterations += found.iterations;
  const bool is_found = found.outcome.eta <= settings_.tolerance;
  if (is_found) {
    say(fmt::format("static step '{}', increment {}: {} iterations part by part did not converge, {} in one system did",
                    model_.step->name, increment + 1, n_before, found.iterations));
    at_.uncorrected.resize(0);
    linear_stage(at_.q, at_.velocity, true);
    at_.sums = local_stage(at_.velocity, at_.q, at_.image, true);
    found.outcome = indicator_.measure(at_.sums);
  }
  if (found.outcome.eta < best.outcome.eta) {
    best.outcome = found.outcome;
    best.q = is_found ? at_.q : found.q;
    best.missed = found.missed;
  }
  if (best.outcome.eta <= settings_.tolerance) return;
  at_.q = best.q;
  Best more{best.q, {}, best.iterations};
  iterate(increment, goal, more);
  best.iterations = more.iterations;
  if (more.outcome.eta < best.outcome.eta) best = std::move(more);
}

// Parts that contact alone holds, and that an iteration has let off, come back by the same small way each time, which
// gives the acceleration no information: it makes them diverge. Newton's method in one system may go round in circles
// where all points slide back at once. Where either has diverged, once more from the start: part by part, and without
// acceleration. Where one system stagnates short of the tolerance, the parts one by one go on.
void StepRun::iterate_again(int increment, const Goal& goal, const Vec& start, Best& best) {
  constexpr double diverged = 1e-5;  // of the indicator
  constexpr IterationLimit part_by_part{400, 5000};
  if (settings_.limit.least == settings_.limit.most) return;  // as many as the deck allows have been
  for (const bool accelerates : {true, false}) {
    if (accelerates ? !(assembled_ && anderson_.accelerates()) : !(assembled_ || anderson_.accelerates())) continue;
    const bool has_diverged = best.outcome.eta > std::max(diverged, settings_.tolerance);
    if (!has_diverged && !(accelerates && best.outcome.eta > settings_.tolerance)) return;
    local_.limit_friction({});
    at_.q = has_diverged ? start : best.q;
    Best again{at_.q, {}, best.iterations};
    anderson_.pause(!accelerates);
    goes_part_by_part_ = true;
    iterate(increment, {goal.tolerance, part_by_part, goal.furthest}, again);
    goes_part_by_part_ = false;
    anderson_.pause(false);
    best.iterations = again.iterations;
    if (again.outcome.eta < best.outcome.eta) best = std::move(again);
  }
}

}  // namespace dygita
