// Parts that nothing touches at the end of a static increment have been carried along by whatever the iteration came
// through; they rest (manual, loose parts).
#include <algorithm>
#include <cmath>

#include "latin/step_run.hpp"

namespace dygita {

// Takes motions of ports off the fields at hand: the same forces.
void StepRun::take_off(const std::vector<Vec3>& motions) {
  for (size_t p = 0; p < motions.size(); ++p)
    for (int d = 0; d < 3; ++d)
      if (const int i = model_.unknown(model_.exchange.ports[p], d); i >= 0) {
        at_.velocity[i] -= motions[p][d];
        at_.q[i] -= local_.k()[i] * motions[p][d];
      }
}

// Where an increment starts nothing says that what was loose at the end of the one before continues as it went there.
void StepRun::stop_loose_parts() {
  if (!loose_ || !loose_->may_be() || at_.velocity.size() != at_.q.size()) return;
  const double least = std::pow(settings_.tolerance, 2) * indicator_.largest();
  take_off(loose_->find(
      {[&](int point) { return local_.links(point, least); },
       [&](int p, int d) { return at_.velocity[model_.unknown(model_.exchange.ports[static_cast<size_t>(p)], d)]; }}));
}

// The system knows where loose parts are by what they are near to, and carries them along with it: they rest, as far as
// nothing is in their way there. False: there are none.
bool StepRun::leave_loose_parts() {
  const auto moved = [&](int p, int d) {
    return at_.velocity[model_.unknown(model_.exchange.ports[static_cast<size_t>(p)], d)];
  };
  const std::vector<Vec3> motions = loose_->find({[&](int point) { return local_.carries(point); }, moved});
  take_off(motions);
  return !motions.empty();
}

// What loose parts are carried along in the last iteration, of each port; collective.
std::vector<Vec3> StepRun::loose_motions(double size) const {
  // What the tolerance leaves of forces holds nothing.
  const double least = std::pow(settings_.tolerance, 2) * std::max(size, indicator_.largest());
  return loose_->find(
      {[&](int point) { return local_.links(point, least); },
       [&](int p, int d) { return at_.velocity[model_.unknown(model_.exchange.ports[static_cast<size_t>(p)], d)]; },
       [&](int point) { return local_.gap(point); }});
}

// Any place at which nothing presses is in balance: loose parts are wherever the iteration has come through, and beside
// how far they have flown nothing else may count any more. They rest as far as nothing is in their way; what was to the
// tolerance beside a large motion may need more iterations without it.
void StepRun::rest_loose_parts(int increment, const Goal& goal, Best& best) {
  constexpr int most = 3;
  constexpr double nearly = 1e-6;     // of the indicator: a solution but for loose parts
  constexpr double rounding = 1e-25;  // of the size of a motion, squares both
  const double enough = std::max(goal.tolerance, settings_.tolerance);
  if (!loose_ || !loose_->may_be() || !(best.outcome.eta <= std::max(enough, nearly))) return;
  const bool was_solved = best.outcome.eta <= enough;
  if (!was_solved || best.outcome.eta > goal.tolerance) {
    at_.q = best.q;
    at_.uncorrected.resize(0);
    linear_stage(at_.q, at_.velocity, true);
    at_.sums = local_stage(at_.velocity, at_.q, at_.image, true);
  }
  const Vec carried = at_.q, velocity = at_.velocity, uncorrected = at_.uncorrected;
  const Best before = best;
  const double moved_size = at_.sums.velocity_size;
  // In one system V is at hand; pieces answer to q.
  const auto answer = [&] {
    if (!assembled_) linear_stage(at_.q, at_.velocity, true);
    at_.sums = local_stage(at_.velocity, at_.q, at_.image, true);
  };
  for (int n = 0; n < most; ++n) {
    const std::vector<Vec3> motions = loose_motions(best.outcome.size);
    if (motions.empty()) return;
    take_off(motions);
    at_.uncorrected.resize(0);
    answer();
    Outcome outcome = indicator_.measure(at_.sums);
    // In one system the same fields but for a motion: what they lack is what rounding leaves of it.
    const IndicatorSums& sums = at_.sums;
    if (assembled_ && was_solved && sums.force_distance + sums.velocity_distance <= rounding * moved_size)
      outcome.eta = std::min(outcome.eta, before.outcome.eta);
    const bool is_enough = outcome.eta <= enough;
    if (is_enough || (!was_solved && outcome.eta <= before.outcome.eta)) {
      best.outcome = outcome;
      best.q = at_.q;
    }
    if (is_enough) return;
    const Goal again{enough, settings_.limit, goal.furthest};
    is_answered_ = assembled_.has_value();
    if (assembled_)
      iterate_assembled(increment, again, best, false);
    else
      iterate(increment, again, best);
    if (best.outcome.eta <= enough) continue;
    if (!was_solved) return;
    // It was a solution as it was.
    const int iterations = best.iterations;
    best = before;
    best.iterations = iterations;
    at_.q = carried;
    at_.velocity = velocity;
    at_.uncorrected = uncorrected;
    answer();
    return;
  }
}

}  // namespace dygita
