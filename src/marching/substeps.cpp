// Steps with explicit pieces: the time step of the deck is made of increments that they are stable with, each solved as
// any other. Where a point connects explicit pieces alone nothing is iterated.
#include <algorithm>
#include <chrono>
#include <cmath>

#include "fem/mass.hpp"
#include "marching/cut_pulls.hpp"
#include "marching/direct_points.hpp"
#include "marching/increments.hpp"

namespace dygita {

namespace {

class Substeps final : public Increments {
 public:
  Substeps(Iteration& iteration, StepBooks& books);
  void solve(int increment, int last) override;
  double gap_difference() const override { return direct_.gap_difference(); }

 private:
  void run_through(int increment);
  void begin_substep(int increment, int substep);
  template <class First>
  void share_pulls(First&& first);
  void begin_explicit(int i, const std::vector<double>& motions);
  Best solve_substep(int increment, int substep, bool is_led);
  void finish_piece(Piece& piece, int i);
  void book_stored_energy(int i);
  void finish_substep(int substep);
  void add_forces();
  void show_mean_forces();

  Iteration& iteration_;
  StepData& step_;
  StepBooks& books_;
  Follow follow_;
  DirectPoints direct_;
  CutPulls pulls_;
  std::vector<ExplicitPiece*> explicit_;  // null: implicit
  PieceLoops::InTurn sending_;
  bool is_all_direct_;                    // of the pieces here and all points: nothing is iterated
  std::vector<std::vector<Vec3>> force_;  // N, of the surfaces' points, summed over the substeps of a time step
};

// Which substructures are explicit, and how.
void describe(const StepModel& model, StepFigures& figures) {
  for (size_t i = 0; i < model.integration.parts.size(); ++i) {
    const Integration::Part& part = model.integration.parts[i];
    if (!part.is_explicit) continue;
    const Substructure& body = *model.problem->substructures[i];
    figures.explicit_parts.push_back(body.name);
    if (has_consistent_mass(*body.mesh)) figures.diagonal_parts.push_back(body.name);
    if (part.is_tuned) figures.tuned_parts.push_back(body.name);
    if (model.problem->mass().is_chosen) figures.phases.emplace_back(body.name, part.phase);
    figures.stable_step = figures.stable_step > 0.0 ? std::min(figures.stable_step, part.longest) : part.longest;
  }
}

Substeps::Substeps(Iteration& iteration, StepBooks& books)
    : iteration_(iteration),
      step_(iteration.step()),
      books_(books),
      follow_(iteration),
      direct_(step_.model, step_.files.state),
      pulls_(step_.model),
      sending_(step_.loops.in_turn(direct_.border_pieces())) {
  const StepModel& model = step_.model;
  for (const auto& piece : model.pieces) explicit_.push_back(piece->as_explicit());
  is_all_direct_ = model.n_q() == 0 && !model.problem->solver.plain &&
                   std::all_of(model.here.begin(), model.here.end(), [&](int i) { return explicit_[i] != nullptr; });
  describe(model, books.figures());
  step_.loops.threads = ThreadChoice::measured();
}

// Pieces that a cut leaves with a common mass are pulled at before any of them moves. first: what else comes before.
template <class First>
void Substeps::share_pulls(First&& first) {
  if (pulls_.is_empty()) return;
  step_.loops.for_each([&](Piece&, int i) {
    if (pulls_.has(i)) first(*explicit_[i], i);
  });
  pulls_.share(step_.loops.threads.threads());
}

void Substeps::begin_explicit(int i, const std::vector<double>& motions) {
  if (pulls_.has(i))
    explicit_[i]->begin_motion(motions);
  else
    explicit_[i]->begin(step_.model.loads->values(), motions);
}

void Substeps::begin_substep(int increment, int substep) {
  const Stopwatch watch(step_.seconds.forward);
  const std::vector<double> motions = step_.model.motion_velocities(substep);
  step_.model.loads->evaluate_mean(substep * step_.model.scheme.dt, (substep + 1) * step_.model.scheme.dt);
  const double quiet = step_.indicator.quiet(step_.settings.tolerance);
  share_pulls([&](ExplicitPiece& piece, int) { piece.begin_pull(step_.model.loads->values()); });
  const auto begin = [&](Piece& piece, int i) {
    if (explicit_[i])
      begin_explicit(i, motions);
    else
      piece.begin(step_.model.piece_force(i, step_.files.state), motions, quiet);
  };
  step_.loops.for_each(sending_.border, begin);
  direct_.tell();
  step_.loops.for_each(sending_.interior, begin);
  // Implicit pieces are solved for though no interface asks them.
  step_.loops.for_each_group(
      [&](const std::vector<Piece*>& group, const std::vector<int>&) { group.front()->forward(group); });
  if (step_.model.n_q() > 0) step_.local.begin(increment, motions, true);
  const Stopwatch laws(step_.seconds.local);
  direct_.solve(motions, step_.loops.threads.threads());
}

// A time step in which nothing is iterated: a piece ends one increment and begins the next, and does what else there is
// to it, before the threads meet.
void Substeps::run_through(int increment) {
  const int n = step_.model.n_substeps();
  for (int i = 0; i <= n; ++i) {
    const bool begins = i < n;
    const int substep = increment * n + i;
    const std::vector<double> motions = begins ? step_.model.motion_velocities(substep) : std::vector<double>();
    if (begins)
      step_.model.loads->evaluate_mean(substep * step_.model.scheme.dt, (substep + 1) * step_.model.scheme.dt);
    {
      const Stopwatch watch(step_.seconds.forward);
      const auto end_last = [&](Piece& piece, int at) {
        if (i == 0) piece.begin_interval();
        if (i > 0) finish_piece(piece, at);
      };
      if (begins)
        share_pulls([&](ExplicitPiece& piece, int at) {
          end_last(piece, at);
          piece.begin_pull(step_.model.loads->values());
        });
      const auto pass = [&](Piece& piece, int at) {
        if (!begins || !pulls_.has(at)) end_last(piece, at);
        if (begins)
          begin_explicit(at, motions);
        else
          book_stored_energy(at);
      };
      step_.loops.for_each(sending_.border, pass);
      if (begins) direct_.tell();
      step_.loops.for_each(sending_.interior, pass);
    }
    if (!begins) break;
    const Stopwatch laws(step_.seconds.local);
    direct_.solve(motions, step_.loops.threads.threads());
  }
  books_.keep(step_.at.q);
}

Best Substeps::solve_substep(int increment, int substep, bool is_led) {
  begin_substep(increment, substep);
  Best best{step_.at.q, {0.0}};
  best.iterations = 1;
  if (step_.model.n_q() > 0) {
    const Goal goal = step_.goal(iteration_.predict(substep));
    best = follow_.solve(increment, goal, is_led);
  }
  finish_substep(substep);
  return best;
}

void Substeps::finish_piece(Piece& piece, int i) {
  // Explicit pieces have received the direct points' force from these.
  const bool needs_force = piece.has_motions() && (step_.model.n_q() > 0 || !explicit_[i]);
  const Points held = needs_force ? step_.local.held_force(i) : Points();
  const IncrementEnergy energy =
      piece.finish(step_.at.q.segment(step_.model.near.start(i), piece.n_rows()), needs_force ? &held : nullptr);
  IncrementEnergy& sum = step_.energy[i];
  sum.loads += energy.loads;
  sum.damping += energy.damping;
  sum.scheme += energy.scheme;
  sum.kinetic = energy.kinetic;
  sum.strain = energy.strain;
}

void Substeps::book_stored_energy(int i) {
  const IncrementEnergy stored = explicit_[i]->stored_energy();
  step_.energy[i].kinetic = stored.kinetic;
  step_.energy[i].strain = stored.strain;
}

void Substeps::finish_substep(int substep) {
  {
    const Stopwatch watch(step_.seconds.backward);
    step_.loops.for_each_group(
        [&](const std::vector<Piece*>& group, const std::vector<int>&) { group.front()->backward(group); });
    step_.loops.for_each([&](Piece& piece, int i) { finish_piece(piece, i); });
  }
  const Stopwatch watch(step_.seconds.accept);
  if (step_.model.n_q() > 0) {
    step_.local.accept(step_.files.state, step_.of_points);
    add_forces();
    books_.keep(step_.at.q);
  } else if ((substep + 1) % step_.model.n_substeps() == 0) {
    books_.keep(step_.at.q);
  }
}

// Forces that outputs show are means over the time step of the deck.
void Substeps::add_forces() {
  if (step_.model.n_substeps() == 1) return;
  const std::vector<SurfaceState>& surfaces = step_.files.state.surfaces;
  force_.resize(surfaces.size());
  for (size_t s = 0; s < surfaces.size(); ++s) {
    force_[s].resize(surfaces[s].points.size(), Vec3::Zero());
    for (size_t i = 0; i < surfaces[s].points.size(); ++i) force_[s][i] += surfaces[s].points[i].force;
  }
}

void Substeps::show_mean_forces() {
  for (size_t s = 0; s < force_.size(); ++s)
    for (size_t i = 0; i < force_[s].size(); ++i) {
      step_.files.state.surfaces[s].points[i].force = force_[s][i] / step_.model.n_substeps();
      force_[s][i].setZero();
    }
}

void Substeps::solve(int increment, int /*last*/) {
  if (!is_all_direct_)
    step_.loops.for_each([&](Piece& piece, int) {
      if (piece.is_explicit() || step_.model.n_substeps() > 1) piece.begin_interval();
    });
  direct_.begin_interval(increment);
  step_.energy.assign(step_.model.pieces.size(), {});
  step_.of_points.assign(step_.model.pieces.size(), {});
  const int n = step_.model.n_substeps();
  int iterations = 0;
  double eta = 0.0, interface_energy = 0.0;
  const auto begun = std::chrono::steady_clock::now();
  if (is_all_direct_) {
    run_through(increment);
    iterations = n;
  } else {
    const bool is_led = step_.model.n_q() > 0 && follow_.leads(n);
    for (int i = 0; i < n; ++i) {
      const Best best = solve_substep(increment, increment * n + i, is_led);
      iterations += best.iterations;
      if (best.outcome.eta > step_.settings.tolerance) books_.note_missed(best.missed);
      eta = std::max(eta, best.outcome.eta);
      interface_energy += step_.model.scheme.dt * step_.at.sums.force_distance;
    }
  }
  step_.loops.threads.note(std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count());
  if (const double change = direct_.take_change(); change > step_.settings.tolerance) {
    eta = std::max(eta, change);
    books_.note_missed({increment, iterations, change, step_.settings.tolerance, false, {}});
  }
  {
    const Stopwatch watch(step_.seconds.accept);
    if (!is_all_direct_)
      step_.loops.for_each([&](Piece&, int i) {
        if (explicit_[i]) book_stored_energy(i);
      });
    show_mean_forces();
    direct_.show(step_.files.state, step_.energy, step_.loops.threads.threads());
  }
  books_.accept_interval(increment, iterations, eta, interface_energy);
}

}  // namespace

std::unique_ptr<Increments> substeps(Iteration& iteration, StepBooks& books) {
  return std::make_unique<Substeps>(iteration, books);
}

}  // namespace dygita
