#include "marching/follow.hpp"

#include <spdlog/fmt/fmt.h>

#include "base/error.hpp"

namespace dygita {

TrailEntry Follow::take_entry() {
  TrailEntry entry = step_.files.trail->take();
  if (entry.q.size() != step_.model.n_q() ||
      (entry.uncorrected.size() > 0 && entry.uncorrected.size() != step_.model.n_q()))
    throw InputError(fmt::format("step '{}': the checkpoint is of another problem: {} interface unknowns, not {}",
                                 step_.model.step->name, entry.q.size(), step_.model.n_q()));
  entry.q = step_.model.near.part(entry.q);
  if (entry.uncorrected.size() > 0) entry.uncorrected = step_.model.near.part(entry.uncorrected);
  return entry;
}

void Follow::leave(const Best& best, bool is_solved) {
  TrailEntry entry;
  entry.runs = step_.model.near.kept_runs();
  entry.q = step_.model.near.kept_part(step_.at.q);
  if (step_.at.uncorrected.size() > 0) entry.uncorrected = step_.model.near.kept_part(step_.at.uncorrected);
  if (step_.local.has_preloads()) entry.shortening = step_.local.preload_figures().shortening;
  entry.moved.assign(step_.model.pieces.size(), 0);
  for (const int i : step_.model.here) entry.moved[static_cast<size_t>(i)] = step_.model.pieces[i]->is_moved();
  entry.eta = best.outcome.eta;
  entry.size = best.outcome.size;
  entry.force_size = best.outcome.force_size;
  entry.iterations = best.iterations;
  entry.is_solved = is_solved;
  entry.is_assembled = step_.settings.is_assembled;
  if (best.outcome.eta > step_.settings.tolerance) entry.missed = best.missed;
  step_.files.trail->leave(entry);
}

Best Follow::solve(int increment, const Goal& goal, bool is_led) {
  if (is_led) return go_over(increment, goal);
  const Best best = iteration_.answer(increment, goal);
  if (leaves()) leave(best, best.outcome.eta <= goal.tolerance);
  return best;
}

Best Follow::go_over(int increment, const Goal& goal) {
  const TrailEntry entry = take_entry();
  if (step_.settings.is_assembled || entry.is_assembled) return go_over_again(entry, increment, goal);
  Best best{entry.q, {entry.eta, entry.size, entry.force_size}, entry.iterations, entry.missed.value_or(Missed{})};
  Iterate& at = step_.at;
  Stages& stages = iteration_.stages();
  Anderson& anderson = iteration_.constant().acceleration();
  anderson.begin();
  // The first iterates of the last increments are remembered when the trail ends.
  if (entry.iterations > 1 && step_.files.trail->n_left() < anderson.n_problems()) {
    stages.linear_stage(at.q, at.velocity);
    stages.local_stage(at.velocity, at.q, at.image);
    iteration_.after_local_stage();
    anderson.replay(step_.own(at.q), step_.own(at.image));
  }
  for (size_t i = 0; i < step_.model.pieces.size() && i < entry.moved.size(); ++i)
    if (entry.moved[i]) step_.model.pieces[i]->wake();
  const bool is_corrected = entry.uncorrected.size() > 0;
  at.q = is_corrected ? entry.uncorrected : entry.q;
  stages.linear_stage(at.q, at.velocity);
  if (is_corrected) iteration_.correct();
  if (step_.local.has_preloads()) step_.local.prescribe_shortenings(entry.shortening);
  at.sums = stages.local_stage(at.velocity, at.q, at.image);
  if (step_.local.has_preloads()) step_.local.prescribe_shortenings({});
  anderson.end(step_.own(at.q), step_.own(at.image), entry.is_solved);
  const int n_own = step_.model.near.n_own();
  const bool is_same = (at.q.head(n_own).array() == entry.q.head(n_own).array()).all() &&
                       (!entry.is_solved || step_.indicator.measure(at.sums).eta == entry.eta);
  if (ranks::any(!is_same)) step_.files.trail->note_difference();
  // The pieces do not have the last correction yet.
  if (is_corrected) stages.linear_stage(at.q, at.velocity);
  step_.indicator.accept(best.outcome);
  return best;
}

// With all pieces in one system: few increments, and each the same again. Where one side iterated them, several ranks
// having no such system, they are so to the tolerance.
Best Follow::go_over_again(const TrailEntry& entry, int increment, const Goal& goal) {
  const Best best = iteration_.answer(increment, goal);
  const int n_own = step_.model.near.n_own();
  if (ranks::any((step_.at.q.head(n_own).array() != entry.q.head(n_own).array()).any()))
    step_.files.trail->note_difference();
  return best;
}

void Follow::leave_window(const std::vector<Vec>& q, int iterations, double eta, const std::optional<Missed>& missed) {
  for (const Vec& of_step : q) {
    TrailEntry entry;
    entry.runs = step_.model.near.kept_runs();
    entry.q = step_.model.near.kept_part(of_step);
    entry.eta = eta;
    entry.iterations = iterations;
    if (&of_step == &q.front()) entry.missed = missed;
    step_.files.trail->leave(entry);
  }
}

}  // namespace dygita
