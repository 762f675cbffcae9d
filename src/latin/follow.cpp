// Increments that were computed before are gone over again: from what their iterations left behind everything else
// follows, bit for bit (manual, "The checkpoint").
#include <spdlog/fmt/fmt.h>

#include "latin/step_run.hpp"

namespace dygita {

TrailEntry StepRun::take_entry() {
  TrailEntry entry = files_.trail->take();
  if (entry.q.size() != model_.n_q() || (entry.uncorrected.size() > 0 && entry.uncorrected.size() != model_.n_q()))
    throw InputError(fmt::format("step '{}': the checkpoint is of another problem: {} interface unknowns, not {}",
                                 model_.step->name, entry.q.size(), model_.n_q()));
  entry.q = model_.near.part(entry.q);
  if (entry.uncorrected.size() > 0) entry.uncorrected = model_.near.part(entry.uncorrected);
  return entry;
}

void StepRun::leave(const Best& best, bool is_solved) {
  TrailEntry entry;
  entry.runs = model_.near.kept_runs();
  entry.q = model_.near.kept_part(at_.q);
  if (at_.uncorrected.size() > 0) entry.uncorrected = model_.near.kept_part(at_.uncorrected);
  if (local_.has_preloads()) entry.shortening = local_.preload_figures().shortening;
  entry.moved.assign(model_.pieces.size(), 0);
  for (const int i : model_.here) entry.moved[static_cast<size_t>(i)] = model_.pieces[i]->is_moved();
  entry.eta = best.outcome.eta;
  entry.size = best.outcome.size;
  entry.force_size = best.outcome.force_size;
  entry.iterations = best.iterations;
  entry.is_solved = is_solved;
  entry.is_assembled = assembled_.has_value();
  if (best.outcome.eta > settings_.tolerance) entry.missed = best.missed;
  files_.trail->leave(entry);
}

StepRun::Best StepRun::follow(int increment, const Goal& goal) {
  const TrailEntry entry = take_entry();
  if (assembled_ || entry.is_assembled) return go_over_again(entry, increment, goal);
  Best best{entry.q, {entry.eta, entry.size, entry.force_size}, entry.iterations, entry.missed.value_or(Missed{})};
  anderson_.begin();
  // The first iterates of the last increments are remembered when the trail ends.
  if (entry.iterations > 1 && files_.trail->n_left() < anderson_.n_problems()) {
    linear_stage(at_.q, at_.velocity);
    local_stage(at_.velocity, at_.q, at_.image);
    inner_iterations();
    anderson_.hear(own(at_.q), own(at_.image));
  }
  for (size_t i = 0; i < model_.pieces.size() && i < entry.moved.size(); ++i)
    if (entry.moved[i]) model_.pieces[i]->wake();
  const bool is_corrected = entry.uncorrected.size() > 0;
  at_.q = is_corrected ? entry.uncorrected : entry.q;
  linear_stage(at_.q, at_.velocity);
  if (is_corrected) coarse_correction(at_.q, at_.velocity);
  if (local_.has_preloads()) local_.prescribe_shortenings(entry.shortening);
  at_.sums = local_stage(at_.velocity, at_.q, at_.image);
  if (local_.has_preloads()) local_.prescribe_shortenings({});
  anderson_.end(own(at_.q), own(at_.image), entry.is_solved);
  const int n_own = model_.near.n_own();
  const bool is_same = (at_.q.head(n_own).array() == entry.q.head(n_own).array()).all() &&
                       (!entry.is_solved || indicator_.measure(at_.sums).eta == entry.eta);
  if (ranks::any(!is_same)) files_.trail->note_difference();
  // The pieces have not heard of the last correction.
  if (is_corrected) linear_stage(at_.q, at_.velocity);
  indicator_.accept(best.outcome);
  return best;
}

// With all pieces in one system: few increments, and each the same again. Where one side iterated them, several ranks
// having no such system, they are so to the tolerance.
StepRun::Best StepRun::go_over_again(const TrailEntry& entry, int increment, const Goal& goal) {
  const Best best = answer(increment, goal, true);
  const int n_own = model_.near.n_own();
  if (ranks::any((at_.q.head(n_own).array() != entry.q.head(n_own).array()).any())) files_.trail->note_difference();
  return best;
}

void StepRun::leave_window(const std::vector<Vec>& q, int iterations, double eta, const std::optional<Missed>& missed) {
  for (const Vec& of_step : q) {
    TrailEntry entry;
    entry.runs = model_.near.kept_runs();
    entry.q = model_.near.kept_part(of_step);
    entry.eta = eta;
    entry.iterations = iterations;
    if (&of_step == &q.front()) entry.missed = missed;
    files_.trail->leave(entry);
  }
}

void StepRun::replay_window(int first, int last) {
  for (int i = first; i < last; ++i) {
    const TrailEntry entry = take_entry();
    if (entry.missed) note_missed(*entry.missed);
    replay(i, entry.q, i == first, entry.iterations, entry.eta);
  }
}

}  // namespace dygita
