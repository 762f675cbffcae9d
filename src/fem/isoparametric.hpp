// Displacement elements as they come from their shape functions: the kernels of every type that has none of its own.
#pragma once

#include "fem/cells.hpp"

namespace dygita {

// K_ab = sum over points of volume (lambda g_a g_b^T + mu g_b g_a^T + mu (g_a . g_b) I), g_a the gradient of N_a.
template <CellType cell_type>
Stiffness<Cell<cell_type>::n> Cell<cell_type>::stiffness(const Nodes<n>& x, const Elastic& material) {
  const auto& shapes = Cell::shapes();
  const double mu = material.shear_modulus(), lambda = material.p_wave_modulus() - 2 * mu;
  Stiffness<n> stiffness = Stiffness<n>::Zero();
  for (int i = 0; i < shapes.n_points; ++i) {
    const PointInCell<n> point = point_in_cell(shapes, x, i);
    check_point_volume(point.volume);
    for (int b = 0; b < n; ++b)
      for (int a = 0; a <= b; ++a) {
        const Vec3 g_a = point.gradient.row(a), g_b = point.volume * point.gradient.row(b);
        Mat3 block = lambda * g_a * g_b.transpose() + mu * g_b * g_a.transpose();
        block.diagonal().array() += mu * g_a.dot(g_b);
        stiffness.template block<3, 3>(3 * a, 3 * b) += block;
      }
  }
  // Within the diagonal blocks too, so that symmetry is exact.
  stiffness.template triangularView<Eigen::StrictlyLower>() = stiffness.transpose();
  return stiffness;
}

template <CellType cell_type>
CornerStress<Cell<cell_type>::n> Cell<cell_type>::stress(const Nodes<n>& x, const Elastic& material,
                                                         const Nodes<n>& displacement) {
  const auto& shapes = Cell::recovery_shapes();
  Eigen::Matrix<double, 6, Cell::n_recovery_points> at_points;
  for (int i = 0; i < shapes.n_points; ++i)
    at_points.col(i) = stress_of_gradient(material, displacement * point_in_cell(shapes, x, i).gradient);
  return at_points * Cell::to_nodes();
}

template <CellType cell_type>
MassMatrix<Cell<cell_type>::n> Cell<cell_type>::tuned_mass(const Nodes<n>& x, const Elastic& material,
                                                           const WaveTuning& tuning) {
  const MassMatrix<n> mass = consistent_mass<Cell>(x, material.density);
  if constexpr (Cell::row.inertia == Inertia::consistent) return mass;  // nothing is undone by a share of it
  const double volume = mass.sum() / material.density;
  return tuning.share(std::cbrt(volume * Cell::row.cells_per_brick)) * mass;
}

}  // namespace dygita
