// Displacement elements as they come from their shape functions: the kernels of every type that has none of its own.
#pragma once

#include "fem/cells.hpp"

namespace dygita {

// Strains of unit displacements along the axes of a node, from the gradient of its shape function.
inline Eigen::Matrix<double, 6, 3> strain_of_node(const Vec3& g) {
  Eigen::Matrix<double, 6, 3> b = Eigen::Matrix<double, 6, 3>::Zero();
  b(0, 0) = b(3, 1) = b(5, 2) = g[0];
  b(1, 1) = b(3, 0) = b(4, 2) = g[1];
  b(2, 2) = b(4, 1) = b(5, 0) = g[2];
  return b;
}

// K = sum over points of volume B^T D B, for any D (manual, eq. Y6).
template <int n, int g>
Stiffness<n> stiffness_of_points(const ShapeTable<n, g>& shapes, const Nodes<n>& x, const Mat6& d) {
  Stiffness<n> stiffness = Stiffness<n>::Zero();
  for (int i = 0; i < g; ++i) {
    const PointInCell<n> point = point_in_cell(shapes, x, i);
    check_point_volume(point.volume);
    Eigen::Matrix<double, 6, 3 * n> b;
    for (int a = 0; a < n; ++a) b.template middleCols<3>(3 * a) = strain_of_node(point.gradient.row(a));
    const Eigen::Matrix<double, 6, 3 * n> stress = point.volume * d * b;
    stiffness.noalias() += b.transpose() * stress;
  }
  stiffness.template triangularView<Eigen::StrictlyLower>() = stiffness.transpose();
  return stiffness;
}

// K_ab = sum over points of volume (lambda g_a g_b^T + mu g_b g_a^T + mu (g_a . g_b) I), g_a the gradient of N_a.
template <CellType cell_type>
Stiffness<Cell<cell_type>::n> Cell<cell_type>::stiffness(const Nodes<n>& x, const ElasticTensor& tensor) {
  const auto& shapes = Cell::shapes();
  if (!tensor.is_isotropic()) return stiffness_of_points(shapes, x, tensor.stiffness());
  const double mu = tensor.mu(), lambda = tensor.lambda();
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
CornerStress<Cell<cell_type>::n> Cell<cell_type>::stress(const Nodes<n>& x, const ElasticTensor& tensor,
                                                         const Nodes<n>& displacement) {
  const auto& shapes = Cell::recovery_shapes();
  Eigen::Matrix<double, 6, Cell::n_recovery_points> at_points;
  for (int i = 0; i < shapes.n_points; ++i)
    at_points.col(i) = tensor.stress(displacement.lazyProduct(point_in_cell(shapes, x, i).gradient));
  return at_points.lazyProduct(Cell::to_nodes());
}

template <CellType cell_type>
MassMatrix<Cell<cell_type>::n> Cell<cell_type>::tuned_mass(const Nodes<n>& x, double density,
                                                           const WaveTuning& tuning) {
  const MassMatrix<n> mass = consistent_mass<Cell>(x, density);
  if constexpr (Cell::row.inertia == Inertia::consistent) return mass;  // nothing is undone by a share of it
  const double volume = mass.sum() / density;
  return tuning.share(std::cbrt(volume * Cell::row.cells_per_brick)) * mass;
}

}  // namespace dygita
