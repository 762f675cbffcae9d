// The LATIN method, readable top to bottom (manual, chapter "Method").
//
// The only unknown that is iterated is q = F_hat + k W_hat on the interfaces. The linear stage answers with V, F = q -
// k V of each piece; the local stage answers with F_hat, W_hat of each interface point; they agree when the step is
// solved.
#include <algorithm>

#include "latin/iteration.hpp"

namespace dygita {

void Iteration::run(SearchDirections& directions, int increment, const Goal& goal, Best& best) {
  Iterate& at = step_.at;
  const bool is_constant = &directions == &constant_;
  Anderson* const also = is_constant && step_.can_share_sums() ? &constant_.acceleration() : nullptr;
  directions.begin(goal.tolerance);
  Persistence persistence(goal.limit);
  best.outcome = {};
  double beginning = 0.0;  // W
  for (int n = 0;; ++n) {
    Told::heed_interrupt(n, is_constant ? 64 : 8);
    // Linear stage: every piece by itself; ties in balance.
    const bool is_corrected = is_constant && corrects(n), is_sent = is_constant && !is_corrected;
    directions.linear_stage(n, is_sent);
    if (is_corrected) correct();
    // Local stage: the law at every interface point.
    at.sums = stages_.local_stage(at.velocity, at.q, at.image, is_sent, also);
    // Indicator: how far both answers are apart.
    Outcome outcome = step_.indicator.measure(at.sums);
    step_.check_finite(outcome, increment);
    if (n == 0) beginning = outcome.size + at.sums.force_distance + at.sums.velocity_distance;
    if (!step_.model.scheme.is_static)
      outcome.eta = step_.indicator.of_runaway(at.sums, beginning, goal.tolerance).value_or(outcome.eta);
    outcome.eta = std::max(outcome.eta, directions.imbalance());
    note(outcome, best);
    told_.tell_iteration(best, directions.n_turned());
    if (directions.settles(goal, outcome, best)) continue;
    if (is_over(n, goal, persistence, best, outcome)) {
      best.missed = persistence.missed(increment, step_.settings.tolerance);
      return directions.end(outcome.eta <= goal.tolerance, best);
    }
    // Acceleration: the next data, from the image.
    if (is_constant) after_local_stage();
    directions.advance(outcome);
  }
}

Best Iteration::answer(int increment, const Goal& goal) {
  Iterate& at = step_.at;
  Best best{at.q, {}};
  Goal first = goal;
  for (const auto& strategy : strategies_) first = strategy->begin(first);
  run(increment, first, best);
  for (const auto& strategy : strategies_) strategy->rescue(increment, goal, best);
  const bool is_solved = best.outcome.eta <= goal.tolerance;
  constant_.acceleration().end(step_.own(at.q), step_.own(at.image), is_solved);
  if (!is_solved) {  // the best there was is what is shown
    at.q = best.q;
    at.uncorrected.resize(0);
    stages_.answer();
  } else if (corrects(best.iterations - 1)) {
    stages_.linear_stage(at.q, at.velocity);  // the pieces do not have the last correction yet
  }
  step_.indicator.accept(best.outcome);
  return best;
}

}  // namespace dygita
