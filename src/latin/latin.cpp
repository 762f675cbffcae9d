// The dynamic LATIN method, readable top to bottom (manual, chapter "Method").
//
// The only unknown that is iterated is q = F_hat + k W_hat on the interfaces. The linear stage answers with V, F = q -
// k V of each piece; the local stage answers with F_hat, W_hat of each interface point; they agree when the step is
// solved.
#include <algorithm>

#include "base/progress.hpp"
#include "latin/step_run.hpp"

namespace dygita {

// Linear stage: velocities at the interfaces for data q, every piece by itself.
void StepRun::linear_stage(const Vec& q, Vec& velocity, bool is_told) {
  const Stopwatch watch(books_.seconds.interface);
  if (assembled_) return assembled_->linear_stage(q, velocity);
  const auto answer = [&](Piece& piece, int i) {
    piece.interface_velocity(q.segment(model_.near.start(i), piece.n_rows()),
                             velocity.segment(model_.near.start(i), piece.n_rows()));
  };
  for_each_piece(iterating_.border, answer);
  if (is_told) model_.near.begin({q.data(), velocity.data()});
  for_each_piece(iterating_.interior, answer);
}

// Local stage: the law at every interface point, with what other ranks have at theirs; image = F_hat + k W_hat.
IndicatorSums StepRun::local_stage(Vec& velocity, Vec& q, Vec& image, bool is_told, Anderson* also) {
  const Stopwatch watch(books_.seconds.local);
  if (!is_told) model_.near.begin({q.data(), velocity.data()});
  local_.run_inner(velocity, q, image);
  model_.near.end({q.data(), velocity.data()});
  local_.run_outer(velocity, q, image);
  if (!also) return local_.measure(velocity, q, image);
  const InterfaceSums::ToCome first = also->first_sums(own(q), own(image));
  return local_.measure(velocity, q, image, first, [&](const double* sums) { also->tell_first_sums(sums, first.n); });
}

// Balance of tied substructures against their rigid motions; velocities stay the answer to q.
void StepRun::coarse_correction(Vec& q, Vec& velocity) {
  if (coarse_.is_empty()) return;
  const Stopwatch watch(books_.seconds.interface);
  if (files_.trail) at_.uncorrected = q;
  coarse_.correct(q, velocity);
}

// Both stages in turn from the fields at hand on, the pieces by their rough operators: the image then knows what came
// back from the neighbourhood of each point. Fields and indicator stay those of the last iteration.
void StepRun::inner_iterations() {
  for (int n = 0; n < n_inner_; ++n) {
    {
      const Stopwatch watch(books_.seconds.interface);
      at_.inner_velocity.resize(at_.velocity.size());
      for_each_piece([&](Piece& piece, int i) {
        const int first = model_.near.start(i), n_rows = piece.n_rows();
        auto velocity = at_.inner_velocity.segment(first, n_rows);
        piece.rough_change(at_.image.segment(first, n_rows) - at_.q.segment(first, n_rows), velocity);
        velocity += at_.velocity.segment(first, n_rows);
      });
    }
    const Stopwatch watch(books_.seconds.local);
    model_.near.exchange({at_.inner_velocity.data()});
    local_.answer(at_.inner_velocity, at_.image, at_.inner_image);
    at_.image.swap(at_.inner_image);
  }
}

// Both stages in turn, until the goal is reached.
void StepRun::iterate(int increment, const Goal& goal, Best& best) {
  if (assembled_ && !goes_part_by_part_) return iterate_assembled(increment, goal, best);
  anderson_.begin();
  at_.uncorrected.resize(0);
  best.outcome = {};
  Persistence persistence(goal.limit);
  // Inner iterations change the image that the acceleration takes sums of.
  Anderson* const also = model_.near.is_all() || n_inner_ > 0 ? nullptr : &anderson_;
  for (int i = 0;; ++i) {
    heed_interrupt(i, 64);
    const bool is_corrected = i > 0 && !coarse_.is_empty();  // what is in balance to the tolerance is left as it is
    linear_stage(at_.q, at_.velocity, !is_corrected);
    if (is_corrected) coarse_correction(at_.q, at_.velocity);
    at_.sums = local_stage(at_.velocity, at_.q, at_.image, !is_corrected, also);
    const Outcome outcome = indicator_.measure(at_.sums);
    ++best.iterations;
    check_finite(outcome, increment);
    if (outcome.eta < best.outcome.eta) {
      best.outcome = outcome;
      best.q = at_.q;
    }
    tell_iteration(best);
    const bool is_lost = goal.furthest > 0.0 && model_.n_q() > 0 && !(largest_velocity() <= goal.furthest);
    if (outcome.eta <= goal.tolerance || is_lost || persistence.ends(i + 1, best.outcome.eta)) {
      best.missed = persistence.missed(increment, settings_.tolerance);
      return;
    }
    inner_iterations();
    const Stopwatch watch(books_.seconds.accelerate);
    anderson_.advance(own(at_.q), own(at_.image));
  }
}

// The same where all pieces are in one system: V and F are in balance after every iteration but the first.
void StepRun::iterate_assembled(int increment, const Goal& goal, Best& best, bool leaves) {
  constexpr double nearly = 1e-6;  // of the indicator: rounding of what loose parts are carried along ends it there
  struct Carried {
    Vec velocity, q;
    Outcome outcome;
  };
  std::optional<Carried> carried;  // a solution with loose parts carried along
  bool has_left = !leaves;
  best.outcome = {};
  if (at_.velocity.size() != at_.q.size()) at_.velocity = Vec::Zero(at_.q.size());
  assembled_->begin(goal.tolerance);
  bool is_balanced = is_answered_;  // V is the answer to q
  is_answered_ = false;
  if (at_.q.size() == 0) {
    assembled_->linear_stage(at_.q, at_.velocity);
    is_balanced = true;
  }
  Persistence persistence(goal.limit);
  for (int i = 0;; ++i) {
    heed_interrupt(i, 8);
    at_.sums = local_stage(at_.velocity, at_.q, at_.image);
    Outcome outcome = indicator_.measure(at_.sums);
    ++best.iterations;
    check_finite(outcome, increment);
    outcome.eta = std::max(outcome.eta, is_balanced ? assembled_->imbalance() : 1.0);
    is_balanced = true;
    if (outcome.eta < best.outcome.eta) {
      best.outcome = outcome;
      best.q = at_.q;
    }
    tell_iteration(best);
    if (!has_left && outcome.eta <= std::max(goal.tolerance, nearly)) {
      has_left = true;
      Carried now{at_.velocity, at_.q, outcome};
      if (leave_loose_parts()) {
        if (outcome.eta <= goal.tolerance) carried = std::move(now);
        best.outcome = {};
        continue;
      }
    }
    const bool is_lost = goal.furthest > 0.0 && model_.n_q() > 0 && !(largest_velocity() <= goal.furthest);
    const bool is_solved = outcome.eta <= goal.tolerance;
    if (is_solved || is_lost || persistence.ends(i + 1, best.outcome.eta)) {
      best.missed = persistence.missed(increment, settings_.tolerance);
      if (is_solved || !carried) return;
      at_.velocity = carried->velocity;
      best.q = at_.q = carried->q;
      best.outcome = carried->outcome;
      at_.sums = local_stage(at_.velocity, at_.q, at_.image);
      return;
    }
    const Stopwatch watch(books_.seconds.interface);
    assembled_->advance(outcome, at_.velocity, at_.q);
  }
}

// Right-hand sides of an increment, and all that it changes on the interfaces before any iteration.
void StepRun::begin_increment(int increment, bool starts_window) {
  const std::vector<double> motions = begin_pieces(increment);
  const Stopwatch watch(books_.seconds.forward);
  local_.begin(increment, motions, starts_window);
  if (model_.scheme.is_static) indicator_.start_displaced(local_.displacement_size());
}

// Returns the velocities of motions at its end.
std::vector<double> StepRun::begin_pieces(int increment) {
  const Stopwatch watch(books_.seconds.forward);
  const std::vector<double> motions = model_.motion_velocities(increment);
  model_.loads->evaluate(increment);
  const double quiet = indicator_.quiet(settings_.more_iterations > 0 ? settings_.round_off : settings_.tolerance);
  for_each_group([&](const std::vector<Piece*>& group, const std::vector<int>& members) {
    for (const int i : members) model_.pieces[i]->begin(model_.piece_force(i, files_.state), motions, quiet);
    group.front()->forward(group);
  });
  return motions;
}

// Interiors of an increment for data q.
void StepRun::finish_increment(const Vec& q) {
  const Stopwatch watch(books_.seconds.backward);
  if (assembled_) assembled_->finish(at_.velocity, q);
  for_each_group([&](const std::vector<Piece*>& group, const std::vector<int>& members) {
    group.front()->backward(group);
    for (const int i : members) {
      Piece& piece = *model_.pieces[i];
      const Points held = piece.has_motions() ? local_.held_force(i) : Points();
      books_.energy[i] =
          piece.finish(q.segment(model_.near.start(i), piece.n_rows()), piece.has_motions() ? &held : nullptr);
    }
  });
}

// Iterates, and leaves pieces and laws with the answer: the last one, or the best where none is good enough.
StepRun::Best StepRun::answer(int increment, const Goal& goal, bool goes_over_again) {
  Best best{at_.q, {}};
  Fields start;
  if (model_.scheme.is_static) start = {at_.q, at_.velocity};
  BoltStart bolts;
  if (local_.has_preloads()) bolts = {at_.q, local_.preload_figures().shortening};
  const bool has_other_way = start.q.size() > 0 && can_go_in_one() && goal.limit.most > goal.limit.least;
  iterate(increment, has_other_way ? Goal{goal.tolerance, {goal.limit.least, goal.limit.least}, goal.furthest} : goal,
          best);
  // So many more iterations on what was solved before: where increments before it are others now, that may be too few.
  if (settings_.more_iterations > 0 && best.outcome.eta > settings_.tolerance) {
    at_.q = best.q;
    iterate(increment, {settings_.tolerance, settings_.limit, goal.furthest}, best);
  }
  if (has_other_way && best.outcome.eta > settings_.tolerance) iterate_in_one(increment, goal, start, best);
  if (best.outcome.eta > settings_.tolerance && local_.has_preloads()) seat_bolts(increment, bolts, best);
  if (start.q.size() > 0) iterate_again(increment, goal, start.q, best);
  rest_loose_parts(increment, goal, best);
  const bool is_solved = best.outcome.eta <= goal.tolerance;
  anderson_.end(own(at_.q), own(at_.image), is_solved);
  if (is_solved) {
    // The pieces have not heard of the last correction.
    if (best.iterations > 1 && !coarse_.is_empty()) linear_stage(at_.q, at_.velocity);
  } else {  // not there: the best there was is what is shown
    at_.q = best.q;
    at_.uncorrected.resize(0);
    linear_stage(at_.q, at_.velocity, true);
    at_.sums = local_stage(at_.velocity, at_.q, at_.image, true);
  }
  indicator_.accept(best.outcome);
  if (files_.trail && !goes_over_again) leave(best, is_solved);
  return best;
}

// One time step: forward once, iterate on the interfaces alone, backward once.
void StepRun::solve_increment(int increment) {
  told_.clear();
  if (increment > 0) stop_loose_parts();
  begin_increment(increment, true);
  const bool has_start = (!assembled_ || files_.start_from) && predict(increment, at_.q);
  if (assembled_ && has_start) {
    linear_stage(at_.q, at_.velocity);
    is_answered_ = true;
  }
  const Goal goal = goal_of(has_start);
  const Best best = leads(1) ? follow(increment, goal) : answer(increment, goal);
  finish_increment(at_.q);
  model_.mean.take_off(model_.pieces, model_.here);
  if (best.outcome.eta > settings_.tolerance) note_missed(best.missed);
  accept_increment(increment, best.iterations, best.outcome.eta);
}

void StepRun::run() {
  progress_.emplace(model_.step->name, model_.step->n_increments());
  if (assembled_) watch(*assembled_);
  run_increments();
  progress_.reset();
}

void StepRun::run_increments() {
  const int n = model_.step->n_increments();
  files_.kept.begin_step(model_.near.kept_runs());
  files_.observer.begin_step(instant(-1, 0, 0.0));
  for (int i = 0; i < n && !ranks::any(interrupt_requested()); i += settings_.window) {
    const int last = std::min(i + settings_.window, n);
    try {
      if (model_.has_explicit())
        solve_interval(i);
      else if (settings_.window == 1)
        solve_increment(i);
      else
        solve_window(i, last);
    } catch (const LeftUnsolved&) {
      is_left_unsolved_ = true;
      return;
    }
    progress_->update(last, describe_progress());
  }
  if (distant_) distant_->complete_all();
  if (assembled_) share_first(files_.state);
}

}  // namespace dygita
