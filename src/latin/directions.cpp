#include "latin/directions.hpp"

#include <algorithm>

namespace dygita {

ConstantDirections::ConstantDirections(StepData& step, Stages& stages)
    : step_(step),
      stages_(stages),
      anderson_(step.settings.of_increment.depth, step.settings.of_increment.n_problems,
                step.settings.of_increment.relaxation, step.weight, InterfaceSums(step.model)),
      has_half_(ranks::any(std::any_of(step.model.here.begin(), step.model.here.end(), [&](int i) {
        return step.model.pieces[static_cast<size_t>(i)]->has_operator_in_half();
      }))) {}

void ConstantDirections::begin(double tolerance) {
  anderson_.begin();
  tolerance_ = tolerance;
  eta_before_ = 0.0;
  is_near_ = is_whole_due_ = false;
  step_.at.uncorrected.resize(0);
}

// The first two are whole: where the increment starts, and what is predicted of it.
void ConstantDirections::linear_stage(int n, bool is_sent) {
  is_in_half_ = has_half_ && n > 1 && !is_whole_due_;
  is_whole_due_ = false;
  stages_.linear_stage(step_.at.q, step_.at.velocity, is_sent, is_in_half_);
}

bool ConstantDirections::settles(const Goal& goal, const Outcome& outcome, Best& best) {
  if (!is_in_half_ || outcome.eta > goal.tolerance) return false;
  is_whole_due_ = true;
  best.outcome = {};
  return true;
}

// Whole is what comes near the tolerance, for what is left to be small, and what seems to be the last.
void ConstantDirections::advance(const Outcome& outcome) {
  constexpr double near = 100.0;
  const Stopwatch watch(step_.seconds.accelerate);
  const bool comes_near = !is_near_ && outcome.eta <= near * tolerance_;
  const double next = outcome.eta * std::min(1.0, outcome.eta / eta_before_);
  is_whole_due_ = comes_near || (eta_before_ > 0.0 && next <= tolerance_);
  is_near_ |= comes_near;
  eta_before_ = outcome.eta;
  anderson_.advance(step_.own(step_.at.q), step_.own(step_.at.image));
}

void TangentDirections::begin(double tolerance) {
  Iterate& at = step_.at;
  carried_.reset();
  has_left_ = !loose_ || loose_->is_resting();
  if (at.velocity.size() != at.q.size()) at.velocity = Vec::Zero(at.q.size());
  system_.begin(tolerance);
  is_balanced_ = at.is_answered;
  at.is_answered = false;
}

// V comes with the data, of which there may be none.
void TangentDirections::linear_stage(int n, bool /*is_sent*/) {
  if (n == 0 && step_.at.q.size() == 0) stages_.linear_stage(step_.at.q, step_.at.velocity);
  is_balanced_ |= n > 0 || step_.at.q.size() == 0;
}

bool TangentDirections::settles(const Goal& goal, const Outcome& outcome, Best& best) {
  constexpr double nearly = 1e-6;  // of the indicator: rounding of what loose parts are carried along ends it there
  if (has_left_ || outcome.eta > std::max(goal.tolerance, nearly)) return false;
  has_left_ = true;
  Carried now{step_.at.velocity, step_.at.q, outcome};
  if (!loose_->leave()) return false;
  if (outcome.eta <= goal.tolerance) carried_ = std::move(now);
  best.outcome = {};
  return true;
}

void TangentDirections::advance(const Outcome& outcome) {
  const Stopwatch watch(step_.seconds.interface);
  system_.advance(outcome, step_.at.velocity, step_.at.q);
}

void TangentDirections::end(bool is_solved, Best& best) {
  if (is_solved || !carried_) return;
  Iterate& at = step_.at;
  at.velocity = carried_->velocity;
  best.q = at.q = carried_->q;
  best.outcome = carried_->outcome;
  at.sums = stages_.local_stage(at.velocity, at.q, at.image);
}

}  // namespace dygita
