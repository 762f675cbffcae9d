#include "fem/mass_edges.hpp"

#include "numerics/panel_choice.hpp"

namespace dygita {

MassEdges::MassEdges(const Mesh& mesh, const Elastic& material, const WaveTuning& tuning,
                     const std::vector<char>& keeps_lumped) {
  const SparseMatrix mass = tuned_mass(mesh, material, tuning, keeps_lumped);
  starts_.push_back(0);
  for (int a = 0; a < mass.outerSize(); ++a) {
    for (SparseMatrix::InnerIterator entry(mass, a); entry; ++entry) {
      if (entry.index() <= a || entry.value() == 0.0) continue;
      others_.push_back(static_cast<int>(entry.index()));
      values_.push_back(static_cast<float>(entry.value()));
    }
    starts_.push_back(static_cast<int>(others_.size()));
  }
}

void MassEdges::add_product(const double* x, double* y) const {
  if (empty()) return;
  panel_kernels().add_scalar_edge_product(
      {starts_.data(), others_.data(), values_.data(), static_cast<int>(starts_.size()) - 1}, x, y);
}

}  // namespace dygita
