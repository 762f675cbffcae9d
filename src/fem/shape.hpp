// Shape functions sampled at quadrature points, all sizes known to the compiler.
#pragma once

#include <Eigen/LU>
#include <array>

#include "mesh/shape_functions.hpp"

namespace dygita {

template <int n>
using Nodes = Eigen::Matrix<double, 3, n>;  // m
template <int n>
using Stiffness = Eigen::Matrix<double, 3 * n, 3 * n>;  // N/m, dof = 3 node + axis

// `n` shape functions at `g` quadrature points of the reference cell.
template <int n, int g>
struct ShapeTable {
  static constexpr int n_nodes = n, n_points = g;

  Eigen::Matrix<double, 3, g> points;                 // reference coordinates
  Eigen::Matrix<double, g, 1> weights;                // sum = volume of the reference cell
  Eigen::Matrix<double, n, g> values;                 // N_a
  std::array<Eigen::Matrix<double, n, 3>, g> slopes;  // d N_a / d xi

  ShapeTable(const ShapeFunctions& functions, const QuadratureRule& rule) {
    for (int i = 0; i < g; ++i) {
      points.col(i) = vector_of(rule.points[i].at);
      weights[i] = rule.points[i].weight;
      values.col(i) = functions.values(points.col(i));
      slopes[i] = functions.slopes(points.col(i));
    }
  }
};

// A quadrature point of a cell in space.
template <int n>
struct PointInCell {
  Eigen::Matrix<double, n, 3> gradient;  // d N_a / d x, 1/m
  double volume;                         // share of the cell's volume, m^3
};

// d x_p / d xi_q at quadrature point `i`. Term by term here as in all products with shape functions: Eigen's blocked
// product, its choice at these sizes, takes longer to compile and to run.
template <int n, int g>
Mat3 jacobian_at(const ShapeTable<n, g>& shapes, const Nodes<n>& x, int i) {
  return x.lazyProduct(shapes.slopes[i]);
}

// Gradients and volume at quadrature point `i` of the cell with nodes `x`; the volume of an inverted map is negative.
template <int n, int g>
PointInCell<n> point_in_cell(const ShapeTable<n, g>& shapes, const Nodes<n>& x, int i) {
  const Mat3 jacobian = jacobian_at(shapes, x, i);
  Mat3 inverse;
  double determinant;
  bool is_invertible;
  jacobian.computeInverseAndDetWithCheck(inverse, determinant, is_invertible, 0.0);
  return {shapes.slopes[i].lazyProduct(inverse), determinant * shapes.weights[i]};
}

}  // namespace dygita
