#include "marching/step_books.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/log.hpp"
#include "partition/all_pieces.hpp"
#include "step/finite_energies.hpp"
#include "step/step_ends.hpp"

namespace dygita {

StepBooks::StepBooks(StepData& step) : step_(step), start_time_(step.files.state.time) {
  figures_.substeps = step.model.n_substeps();
  if (!ranks::is_alone() && !step.model.is_assembled) distant_.emplace(step.model, step.files.state);
}

// Outputs begin at the step's start.
void StepBooks::begin_step() {
  step_.files.kept.begin_step(step_.model.near.kept_runs());
  step_.files.observer.begin_step(instant(-1, 0, 0.0));
}

void StepBooks::end_step() {
  if (distant_) distant_->complete_all();
}

void StepBooks::accept_increment(int increment, int iterations, double eta) {
  {
    const Stopwatch watch(step_.seconds.accept);
    step_.of_points.assign(step_.model.pieces.size(), {});
    step_.local.accept(step_.files.state, step_.of_points);
  }
  keep(step_.at.q);
  accept_interval(increment, iterations, eta, step_.model.scheme.dt * step_.at.sums.force_distance);
}

void StepBooks::accept_interval(int increment, int iterations, double eta, double interface_energy) {
  State& state = step_.files.state;
  if (distant_) distant_->forget();
  if (!step_.model.scheme.is_static) state.time = start_time_ + (increment + 1) * step_.model.step->dt;
  Energies& energies = state.energies;
  const std::vector<IncrementEnergy> of_pieces = all_energies();
  book_increment(of_pieces, energies);
  if (!std::isfinite(energies.balance())) complete_energies(step_.energy);  // to tell where
  check_energies(step_.model, state, step_.energy, increment);
  if (has_flown_off()) eta = std::numeric_limits<double>::infinity();
  step_.indicator.raise_floor(energies.held() + std::abs(energies.loads), step_.model.scheme.dt);
  StepFigures& figures = figures_;
  ++figures.increments;
  figures.iterations += iterations;
  figures.worst_indicator = std::max(figures.worst_indicator, eta);
  if (eta > step_.settings.tolerance) ++figures.not_converged;
  const Stopwatch watch(step_.seconds.output);
  Instant shown = instant(increment, iterations, eta);
  shown.interface_energy = interface_energy;
  std::vector<double> work_left;
  if (!step_.model.scheme.is_static) {
    const std::vector<double> own = step_.local.take_work_left();
    work_left = of_all_pieces(*step_.model.cut, 1, [&](int i, double* to) { *to = own[static_cast<size_t>(i)]; });
    shown.energies = &of_pieces, shown.work_left = &work_left;
  }
  step_.files.observer.accept(shown);
}

// Of all pieces, with those of the points that are booked with each.
std::vector<IncrementEnergy> StepBooks::all_energies() const {
  std::vector<IncrementEnergy> all = step_.energy;
  for (size_t i = 0; i < step_.of_points.size(); ++i) {
    const IncrementEnergy& points = step_.of_points[i];
    all[i].loads += points.loads;
    all[i].friction += points.friction;
    all[i].plastic += points.plastic;
    all[i].damping += points.damping;
    all[i].scheme += points.scheme;
    all[i].stored += points.stored;
  }
  complete_energies(all);
  return all;
}

// Those of pieces elsewhere.
void StepBooks::complete_energies(std::vector<IncrementEnergy>& energies) const {
  if (ranks::is_alone()) return;
  constexpr int n = 8;
  const std::vector<double> all = of_all_pieces(*step_.model.cut, n, [&](int i, double* to) {
    const IncrementEnergy& e = energies[i];
    const double own[n] = {e.loads, e.friction, e.plastic, e.damping, e.scheme, e.kinetic, e.strain, e.stored};
    std::copy_n(own, n, to);
  });
  for (size_t i = 0; i < energies.size(); ++i) {
    const double* e = all.data() + n * i;
    energies[i] = {e[0], e[1], e[2], e[3], e[4], e[5], e[6], e[7]};
  }
}

// Those first and last tell enough of a step that misses everywhere.
void StepBooks::note_missed(const Missed& missed) {
  std::vector<Missed>& all = figures_.missed;
  if (missed.indicator <= step_.settings.tolerance) return;
  if (all.size() < 1000) all.push_back(missed);
}

// Each rank those of its pieces.
void StepBooks::keep(const Vec& q) { step_.files.kept.append(step_.model.near.kept_part(q)); }

// A static increment that moves bodies by many times the assembly's size has found no equilibrium, whatever the
// indicator says.
bool StepBooks::has_flown_off() const {
  if (!step_.model.scheme.is_static || step_.model.n_q() == 0) return false;
  const double moved = step_.largest_velocity(), size = step_.settings.assembly_size;
  if (moved <= too_far * size) return false;
  warn(fmt::format(
      "static step '{}': an increment moves a substructure by {:.3g} m, {:.0f} times the size of the assembly{}: it is "
      "unconstrained, springs are too soft for the load that they hold, a limit load is exceeded, or the iteration "
      "failed to converge",
      step_.model.step->name, moved, moved / size, step_.place_of_divergence()));
  return true;
}

std::string StepBooks::describe_progress() const {
  const StepFigures& figures = figures_;
  const double mean = figures.increments ? static_cast<double>(figures.iterations) / figures.increments : 0.0;
  return step_.model.scheme.is_static
             ? fmt::format("{} iterations", figures.iterations)
             : fmt::format("t = {:.4g} us, {:.1f} iterations per step", step_.files.state.time * 1e6, mean);
}

Instant StepBooks::instant(int increment, int iterations, double eta) const {
  Instant now{step_.model,
              step_.files.state,
              step_.settings.i_step,
              increment,
              iterations,
              eta,
              eta <= step_.settings.tolerance};
  if (distant_) now.distant = &*distant_;
  return now;
}

void StepBooks::add_to(SolverFigures& figures, double system_bytes, double gap_difference) const {
  figures.n_dofs = 0;
  for (const SubstructurePtr& part : step_.model.problem->substructures) figures.n_dofs += 3 * part->mesh->n_nodes();
  enum { bytes, solved, spared, in_full, equal };
  std::vector<double> sums(5, 0.0);
  for (size_t i = 0; i < step_.model.pieces.size(); ++i) {
    if (!step_.model.cut->is_here(static_cast<int>(i))) continue;
    const Piece& piece = *step_.model.pieces[i];
    const PieceFigures of_piece = piece.figures();
    sums[bytes] += of_piece.bytes;
    sums[solved] += static_cast<double>(of_piece.n_solved);
    sums[spared] += static_cast<double>(of_piece.n_spared);
    sums[in_full] += of_piece.is_mostly_interface;
    sums[equal] += piece.shares_operator();
  }
  sums[bytes] += system_bytes;
  sums = ranks::sums(sums);
  figures.factor_bytes = std::max(figures.factor_bytes, sums[bytes]);
  figures.n_solved += static_cast<long>(sums[solved]);
  figures.n_spared += static_cast<long>(sums[spared]);
  figures.n_in_full += static_cast<int>(sums[in_full]);
  figures.n_equal += static_cast<int>(sums[equal]);
  figures.n_interface_unknowns = step_.model.n_q();
  figures.gap_difference =
      std::max(figures.gap_difference, ranks::largest(std::max(step_.local.gap_difference(), gap_difference)));
  const std::vector<double>& piece_seconds = step_.loops.seconds();
  figures.sharing.pieces.resize(piece_seconds.size());
  for (size_t i = 0; i < piece_seconds.size(); ++i) figures.sharing.pieces[i].seconds += piece_seconds[i];
  const Seconds& seconds = step_.seconds;
  figures.seconds["forward"] += seconds.forward;
  figures.seconds["interface operator"] += seconds.interface;
  figures.seconds["local stage"] += seconds.local;
  figures.seconds["acceleration"] += seconds.accelerate;
  figures.seconds["backward"] += seconds.backward;
  figures.seconds["laws and energies"] += seconds.accept;
  figures.seconds["output"] += seconds.output;
}

}  // namespace dygita
