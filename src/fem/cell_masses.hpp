// How the mass of a cell comes to its nodes.
#pragma once

#include "fem/cells.hpp"

namespace dygita {

template <class Cell>
Eigen::Matrix<double, Cell::n_nodes, 1> shape_integrals(const Nodes<Cell::n_nodes>& x) {
  const auto& shapes = [&]() -> const auto& {
    if constexpr (Cell::row.inertia == Inertia::consistent)
      return Cell::mass_shapes();  // exact in curved cells as the consistent mass is
    else
      return Cell::shapes();
  }
  ();
  Eigen::Matrix<double, Cell::n_nodes, 1> integrals = Eigen::Matrix<double, Cell::n_nodes, 1>::Zero();
  for (int i = 0; i < shapes.n_points; ++i) {
    const double jacobian = jacobian_at(shapes, x, i).determinant();
    integrals += jacobian * shapes.weights[i] * shapes.values.col(i);
  }
  return integrals;
}

template <class Cell>
MassMatrix<Cell::n_nodes> consistent_mass(const Nodes<Cell::n_nodes>& x, double density) {
  const auto& shapes = Cell::mass_shapes();
  MassMatrix<Cell::n_nodes> mass = MassMatrix<Cell::n_nodes>::Zero();
  for (int i = 0; i < shapes.n_points; ++i) {
    const double share = jacobian_at(shapes, x, i).determinant() * shapes.weights[i];
    mass += density * share * shapes.values.col(i) * shapes.values.col(i).transpose();
  }
  return mass;
}

template <class Cell>
Eigen::Matrix<double, Cell::n_nodes, 1> node_volumes(const Nodes<Cell::n_nodes>& x) {
  if constexpr (Cell::row.lumping == Lumping::row_sums) {
    return shape_integrals<Cell>(x);
  } else {
    static_assert(Cell::row.lumping == Lumping::diagonal);
    Eigen::Matrix<double, Cell::n_nodes, 1> squares = Eigen::Matrix<double, Cell::n_nodes, 1>::Zero();
    const auto& shapes = Cell::mass_shapes();
    double volume = 0.0;
    for (int i = 0; i < shapes.n_points; ++i) {
      const double share = jacobian_at(shapes, x, i).determinant() * shapes.weights[i];
      squares += share * shapes.values.col(i).cwiseAbs2();
      volume += share;
    }
    return squares * (volume / squares.sum());
  }
}

}  // namespace dygita
