// Prism6 and Tet4: displacement elements as they come from their shape functions.
#include "fem/cells.hpp"

namespace dygita {

namespace {

// K_ab = sum over points of volume (lambda g_a g_b^T + mu g_b g_a^T + mu (g_a . g_b) I), g_a the gradient of N_a.
template <class Cell>
Stiffness<Cell::n_nodes> isoparametric_stiffness(const Nodes<Cell::n_nodes>& x, const Elastic& material) {
  constexpr int n = Cell::n_nodes;
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

template <class Cell>
CornerStress<Cell::n_nodes> isoparametric_stress(const Nodes<Cell::n_nodes>& x, const Elastic& material,
                                                 const Nodes<Cell::n_nodes>& displacement) {
  const auto& shapes = Cell::shapes();
  Eigen::Matrix<double, 6, std::decay_t<decltype(shapes)>::n_points> at_points;
  for (int i = 0; i < shapes.n_points; ++i)
    at_points.col(i) = stress_of_gradient(material, displacement * point_in_cell(shapes, x, i).gradient);
  return at_points * shapes.to_nodes;
}

}  // namespace

Stiffness<6> Prism6::stiffness(const Nodes<6>& x, const Elastic& material) {
  return isoparametric_stiffness<Prism6>(x, material);
}

CornerStress<6> Prism6::stress(const Nodes<6>& x, const Elastic& material, const Nodes<6>& displacement) {
  return isoparametric_stress<Prism6>(x, material, displacement);
}

Stiffness<4> Tet4::stiffness(const Nodes<4>& x, const Elastic& material) {
  return isoparametric_stiffness<Tet4>(x, material);
}

CornerStress<4> Tet4::stress(const Nodes<4>& x, const Elastic& material, const Nodes<4>& displacement) {
  return isoparametric_stress<Tet4>(x, material, displacement);
}

}  // namespace dygita
