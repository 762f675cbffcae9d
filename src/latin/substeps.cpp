// Steps with explicit pieces: the time step of the deck is made of increments that they are stable with, each solved as
// any other. Where a point connects explicit pieces alone nothing is iterated.
#include <cmath>

#include "latin/step_run.hpp"
#include "step/step_ends.hpp"

namespace dygita {

// Pieces that a cut leaves with a common mass are pulled at before any of them moves. first: what else comes before.
template <class First>
void StepRun::share_pulls(First&& first) {
  if (pulls_.is_empty()) return;
  for_each_piece([&](Piece&, int i) {
    if (pulls_.has(i)) first(*explicit_[i], i);
  });
  pulls_.share(piece_threads_.threads());
}

void StepRun::begin_explicit(int i, const std::vector<double>& motions) {
  if (pulls_.has(i))
    explicit_[i]->begin_motion(motions);
  else
    explicit_[i]->begin(model_.loads->values(), motions);
}

void StepRun::begin_substep(int increment, int substep) {
  const Stopwatch watch(books_.seconds.forward);
  const std::vector<double> motions = model_.motion_velocities(substep);
  model_.loads->evaluate_mean(substep * model_.scheme.dt, (substep + 1) * model_.scheme.dt);
  const double quiet = indicator_.quiet(settings_.tolerance);
  share_pulls([&](ExplicitPiece& piece, int) { piece.begin_pull(model_.loads->values()); });
  const auto begin = [&](Piece& piece, int i) {
    if (explicit_[i])
      begin_explicit(i, motions);
    else
      piece.begin(model_.piece_force(i, files_.state), motions, quiet);
  };
  for_each_piece(telling_.border, begin);
  direct_.tell();
  for_each_piece(telling_.interior, begin);
  // Implicit pieces are solved for though no interface asks them.
  for_each_group([&](const std::vector<Piece*>& group, const std::vector<int>&) { group.front()->forward(group); });
  if (model_.n_q() > 0) local_.begin(increment, motions, true);
  const Stopwatch laws(books_.seconds.local);
  direct_.solve(motions, piece_threads_.threads());
}

// A time step in which nothing is iterated: a piece ends one increment and begins the next, and does what else there is
// to it, before the threads meet.
void StepRun::run_through(int increment) {
  const int n = model_.n_substeps();
  for (int i = 0; i <= n; ++i) {
    const bool begins = i < n;
    const int substep = increment * n + i;
    const std::vector<double> motions = begins ? model_.motion_velocities(substep) : std::vector<double>();
    if (begins) model_.loads->evaluate_mean(substep * model_.scheme.dt, (substep + 1) * model_.scheme.dt);
    {
      const Stopwatch watch(books_.seconds.forward);
      const auto end_last = [&](Piece& piece, int at) {
        if (i == 0) piece.begin_interval();
        if (i > 0) finish_piece(piece, at);
      };
      if (begins)
        share_pulls([&](ExplicitPiece& piece, int at) {
          end_last(piece, at);
          piece.begin_pull(model_.loads->values());
        });
      const auto pass = [&](Piece& piece, int at) {
        if (!begins || !pulls_.has(at)) end_last(piece, at);
        if (begins)
          begin_explicit(at, motions);
        else
          book_stored_energy(at);
      };
      for_each_piece(telling_.border, pass);
      if (begins) direct_.tell();
      for_each_piece(telling_.interior, pass);
    }
    if (!begins) break;
    const Stopwatch laws(books_.seconds.local);
    direct_.solve(motions, piece_threads_.threads());
  }
  keep(at_.q);
}

StepRun::Best StepRun::solve_substep(int increment, int substep, bool is_led) {
  begin_substep(increment, substep);
  Best best{at_.q, {0.0}};
  best.iterations = 1;
  if (model_.n_q() > 0) {
    const Goal goal = goal_of(predict(substep, at_.q));
    best = is_led ? follow(increment, goal) : answer(increment, goal);
  }
  finish_substep(substep);
  return best;
}

void StepRun::finish_piece(Piece& piece, int i) {
  // Explicit pieces have heard of the direct points' force from these.
  const bool needs_force = piece.has_motions() && (model_.n_q() > 0 || !explicit_[i]);
  const Points held = needs_force ? local_.held_force(i) : Points();
  const IncrementEnergy energy =
      piece.finish(at_.q.segment(model_.near.start(i), piece.n_rows()), needs_force ? &held : nullptr);
  IncrementEnergy& sum = books_.energy[i];
  sum.loads += energy.loads;
  sum.damping += energy.damping;
  sum.scheme += energy.scheme;
  sum.kinetic = energy.kinetic;
  sum.strain = energy.strain;
}

void StepRun::book_stored_energy(int i) {
  const IncrementEnergy stored = explicit_[i]->stored_energy();
  books_.energy[i].kinetic = stored.kinetic;
  books_.energy[i].strain = stored.strain;
}

void StepRun::finish_substep(int substep) {
  {
    const Stopwatch watch(books_.seconds.backward);
    for_each_group([&](const std::vector<Piece*>& group, const std::vector<int>&) { group.front()->backward(group); });
    for_each_piece([&](Piece& piece, int i) { finish_piece(piece, i); });
  }
  const Stopwatch watch(books_.seconds.accept);
  if (model_.n_q() > 0) {
    local_.accept(files_.state, books_.of_points);
    add_forces();
    keep(at_.q);
  } else if ((substep + 1) % model_.n_substeps() == 0) {
    keep(at_.q);
  }
}

// Forces that outputs show are means over the time step of the deck.
void StepRun::add_forces() {
  if (model_.n_substeps() == 1) return;
  const std::vector<SurfaceState>& surfaces = files_.state.surfaces;
  books_.force.resize(surfaces.size());
  for (size_t s = 0; s < surfaces.size(); ++s) {
    books_.force[s].resize(surfaces[s].points.size(), Vec3::Zero());
    for (size_t i = 0; i < surfaces[s].points.size(); ++i) books_.force[s][i] += surfaces[s].points[i].force;
  }
}

void StepRun::show_mean_forces() {
  for (size_t s = 0; s < books_.force.size(); ++s)
    for (size_t i = 0; i < books_.force[s].size(); ++i) {
      files_.state.surfaces[s].points[i].force = books_.force[s][i] / model_.n_substeps();
      books_.force[s][i].setZero();
    }
}

void StepRun::solve_interval(int increment) {
  if (!is_all_direct_)
    for_each_piece([&](Piece& piece, int) {
      if (piece.is_explicit() || model_.n_substeps() > 1) piece.begin_interval();
    });
  direct_.begin_interval(increment);
  books_.energy.assign(model_.pieces.size(), {});
  books_.of_points.assign(model_.pieces.size(), {});
  const int n = model_.n_substeps();
  int iterations = 0;
  double eta = 0.0, interface_energy = 0.0;
  const auto begun = std::chrono::steady_clock::now();
  if (is_all_direct_) {
    run_through(increment);
    iterations = n;
  } else {
    const bool is_led = model_.n_q() > 0 && leads(n);
    for (int i = 0; i < n; ++i) {
      const Best best = solve_substep(increment, increment * n + i, is_led);
      iterations += best.iterations;
      if (best.outcome.eta > settings_.tolerance) note_missed(best.missed);
      eta = std::max(eta, best.outcome.eta);
      interface_energy += model_.scheme.dt * at_.sums.force_distance;
    }
  }
  piece_threads_.note(std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count());
  if (const double change = direct_.take_change(); change > settings_.tolerance) {
    eta = std::max(eta, change);
    note_missed({increment, iterations, change, settings_.tolerance, false, {}});
  }
  {
    const Stopwatch watch(books_.seconds.accept);
    if (!is_all_direct_)
      for_each_piece([&](Piece&, int i) {
        if (explicit_[i]) book_stored_energy(i);
      });
    show_mean_forces();
    direct_.show(files_.state, books_.energy, piece_threads_.threads());
    if (distant_) distant_->forget();
  }
  files_.state.time = time_of(increment);
  accept_interval(increment, iterations, eta, interface_energy);
}

}  // namespace dygita
