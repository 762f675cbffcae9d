// What of the error estimates is the mesh's (manual, eq. Q5, Q6, Q13, Q14).
#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel_by_cost.hpp"
#include "estimates/error_estimator.hpp"
#include "fem/mass.hpp"
#include "fem/rigid_motion.hpp"
#include "fem/stress_error.hpp"
#include "watch/free_facets.hpp"
#include "watch/growth.hpp"

namespace dygita {

namespace {

// Of the views of all parts, side by side: fields by cell, and their sums over the cells of each piece of the cut, one
// after the other; collective.
template <class Fields>
std::vector<double> sums_of_pieces(const Cut& cut, const PartViews& views, int n_parts, int n_fields, Fields&& fields) {
  std::vector<double> own(static_cast<size_t>(n_fields * cut.n_pieces()), 0.0), cost;
  for (int part = 0; part < n_parts; ++part)
    cost.push_back(views.of(part).is_empty() ? 0.0 : views.of(part).mesh().n_cells());
  parallel_by_cost(cost, [&](int part) {
    const PartView& view = views.of(part);
    if (view.is_empty()) return;
    const std::vector<std::vector<Vec>> of_cells = fields(part, view.mesh());
    for (int f = 0; f < n_fields; ++f) {
      const std::vector<double> of_pieces = view.sums(of_cells[static_cast<size_t>(f)]);
      for (size_t k = 0; k < of_pieces.size(); ++k)
        own[static_cast<size_t>(n_fields * view.pieces()[k] + f)] = of_pieces[k];
    }
  });
  return of_all_pieces(cut, n_fields, [&](int i, double* to) { std::copy_n(own.data() + n_fields * i, n_fields, to); });
}

}  // namespace

// Velocities are means over the increment: what turns by more than it can follow swings no faster in it.
ErrorEstimator::StrainEnergies ErrorEstimator::strain_energies(const Instant& instant) const {
  const Cut& cut = *instant.model.cut;
  std::vector<int> here;
  for (int i = 0; i < cut.n_pieces(); ++i)
    if (cut.is_here(i)) here.push_back(i);
  std::vector<std::array<double, 2>> own(here.size());
  parallel_for(static_cast<int>(here.size()), [&](int i) {
    const auto k = static_cast<size_t>(i);
    const Piece& piece = *instant.model.pieces[static_cast<size_t>(here[k])];
    const Mesh& mesh = *instant.model.problem->substructures[static_cast<size_t>(cut.piece(here[k]).part)]->mesh;
    // What it turns by bends no cell and leaves rounding; matrices from a file may know better.
    const auto energy = [&](Points x) {
      if (mesh.has_cells()) x = without_rigid_motion(std::move(x), cut.on_piece(here[k], mesh.nodes));
      return 0.5 * x.reshaped().dot(piece.quick_elastic_force(x).reshaped());
    };
    Points u = strained_piece(instant, here[k]);
    if (!start_.empty()) u -= pieces_[k].start;
    own[k] = {energy(u), instant.is_static() ? 0.0 : energy((u - pieces_[k].before) / dt_)};
  });
  size_t next = 0;
  const std::vector<double> all =
      of_all_pieces(cut, 2, [&](int, double* to) { std::copy_n(own[next++].data(), 2, to); });
  StrainEnergies energies{0.0, 0.0, std::vector<double>(volume_.size(), 0.0)};
  for (int i = 0; i < cut.n_pieces(); ++i) {
    const auto k = static_cast<size_t>(2 * i);
    energies.of_motion += all[k];
    energies.of_velocities += all[k + 1];
    energies.of_parts[static_cast<size_t>(cut.piece(i).part)] += all[k];
  }
  return energies;
}

// strain: J, of the same displacements.
ErrorEstimator::StressEnergies ErrorEstimator::stress_energies(const Instant& instant, double strain) {
  const Cut& cut = *instant.model.cut;
  const Problem& problem = *instant.model.problem;
  views_->take(instant);
  const std::vector<double> errors =
      sums_of_pieces(cut, *views_, static_cast<int>(volume_.size()), 2, [&](int part, const Mesh& mesh) {
        const auto i = static_cast<size_t>(part);
        Points u = without_growth(views_->field(part), growth_at(instant, part), mesh.nodes);
        if (!start_.empty()) u -= start_[i];
        StressError error = stress_error(mesh, problem.substructures[i]->material, u, free_[i]);
        return std::vector{std::move(error.of_cells), std::move(error.at_surface)};
      });
  StressEnergies energies{0.0, 0.0, strain};
  for (size_t i = 0; i < errors.size(); i += 2) {
    energies.within += errors[i];
    energies.at_surface += errors[i + 1];
  }
  return energies;
}

// J, of substructures whose mass is lumped: what they move with beyond the energy of the material.
double ErrorEstimator::lumping_energy(const Instant& instant) {
  const Problem& problem = *instant.model.problem;
  if (instant.model.is_tuned()) return 0.0;
  views_->take(instant, NodalField::velocity);
  const std::vector<double> energies =
      sums_of_pieces(*instant.model.cut, *views_, static_cast<int>(volume_.size()), 1, [&](int part, const Mesh& mesh) {
        return std::vector<std::vector<Vec>>{lumping_energies(
            mesh, problem.substructures[static_cast<size_t>(part)]->material.density, views_->field(part))};
      });
  const std::vector<Integration::Part>& parts = instant.model.integration.parts;
  double sum = 0.0;
  for (size_t i = 0; i < energies.size(); ++i) {
    const int part = instant.model.cut->piece(static_cast<int>(i)).part;
    const bool is_tuned =
        instant.model.integration.is_explicit_piece(static_cast<int>(i)) && parts[static_cast<size_t>(part)].is_tuned;
    if (!is_tuned) sum += energies[i];
  }
  return sum;
}

void ErrorEstimator::find_free_surfaces(const Instant& start) {
  const Problem& problem = *start.model.problem;
  views_->prepare(start.model.cut);
  boundary_.resize(problem.substructures.size());
  free_.assign(problem.substructures.size(), {});
  parallel_for(static_cast<int>(boundary_.size()), [&](int part) {
    const auto i = static_cast<size_t>(part);
    const PartView& view = views_->of(part);
    const Mesh& whole = *problem.substructures[i]->mesh;
    if (view.is_empty() || !whole.has_cells()) return;
    if (boundary_[i].empty()) boundary_[i] = boundary_facets(whole);
    free_[i] = free_cells(view.mesh(), free_facets(start.model, part, boundary_[i]), view.all_nodes());
  });
}

// Rayleigh's quotient again: of its strain energy the share of the stress error is too much, of its kinetic energy what
// lumped masses have beside the material. In waves, and in bars that bend, the two make half of the former together,
// and go with the square of the frequency; in a bar that twists they are the same at all frequencies.
ErrorEstimator::FrequencyShares ErrorEstimator::frequency_shares() const {
  constexpr double most = 0.75;  // of the energy; with more there is nothing to tell
  const double held = sums_.strain + sprung_sum_;
  const double dispersion = 0.5 * sums_.within / held;
  const double stiff = std::min(most, sums_.error() / held);
  // Of what spins, flies or slides as a whole the masses have no frequency to change, and what a load holds strained
  // has little motion: the shares are of the same motion where both energies are alike, to three times what is let go
  // has.
  const double stored = strained_ + sprung_;
  const bool swings = std::max(moving_, stored) < 4.0 * std::min(moving_, stored);
  const double heavy = swings && kinetic_sum_ > 0.0 ? std::min(most, lumping_sum_ / kinetic_sum_) : 0.0;
  const double all = std::max(0.5 * sums_.error() / held, std::abs(std::sqrt((1.0 - heavy) / (1.0 - stiff)) - 1.0));
  return {dispersion, all - dispersion};
}

}  // namespace dygita
