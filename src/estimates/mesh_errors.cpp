// What of the error estimates is the mesh's (manual, eq. Q5, Q6, Q13, Q14).
#include <algorithm>
#include <cmath>

#include "base/parallel_by_cost.hpp"
#include "estimates/error_estimator.hpp"
#include "fem/mass.hpp"
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

ErrorEstimator::StressEnergies ErrorEstimator::stress_energies(const Instant& instant) {
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
  std::vector<int> here;
  for (int i = 0; i < cut.n_pieces(); ++i)
    if (cut.is_here(i)) here.push_back(i);
  std::vector<double> own_strains(here.size());
  parallel_for(static_cast<int>(here.size()), [&](int i) {
    const auto k = static_cast<size_t>(i);
    Points u = strained_piece(instant, here[k]);
    if (!start_.empty()) u -= pieces_[k].start;
    const Points force = instant.model.pieces[static_cast<size_t>(here[k])]->quick_elastic_force(u);
    own_strains[k] = 0.5 * u.reshaped().dot(force.reshaped());
  });
  size_t next = 0;
  const std::vector<double> strains = of_all_pieces(cut, 1, [&](int, double* to) { *to = own_strains[next++]; });
  StressEnergies energies;
  energies.strains.assign(volume_.size(), 0.0);
  for (size_t i = 0; i < strains.size(); ++i) {
    energies.within += errors[2 * i];
    energies.at_surface += errors[2 * i + 1];
    energies.strain += strains[i];
    energies.strains[static_cast<size_t>(cut.piece(static_cast<int>(i)).part)] += strains[i];
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
  const double dispersion = 0.5 * sums_.within / sums_.strain;
  const double stiff = std::min(most, sums_.error() / sums_.strain);
  const double heavy = kinetic_sum_ > 0.0 ? std::min(most, lumping_sum_ / kinetic_sum_) : 0.0;
  const double all =
      std::max(0.5 * sums_.error() / sums_.strain, std::abs(std::sqrt((1.0 - heavy) / (1.0 - stiff)) - 1.0));
  return {dispersion, all - dispersion};
}

}  // namespace dygita
