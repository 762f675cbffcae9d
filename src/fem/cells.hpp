// The element kernels, one struct a cell type, all sizes known to the compiler: what element.hpp and assembly.hpp call.
#pragma once

#include "base/error.hpp"
#include "fem/shape.hpp"
#include "material/elastic.hpp"

namespace dygita {

template <int n>
using CornerStress = Eigen::Matrix<double, 6, n>;  // Pa, one column per node: xx yy zz xy yz zx

// Trilinear hexahedron with 12 enhanced strain modes condensed in the cell: the 9 of Taylor, Beresford and Wilson
// (Int. J. Numer. Methods Eng. 10, 1976), which cure bending and pass the patch test on distorted cells, and the 3
// volumetric ones of Simo, Armero and Taylor (Comput. Methods Appl. Mech. Eng. 110, 1993), which cure
// incompressibility. 2x2x2 Gauss points.
struct Hex8 {
  static constexpr int n_nodes = 8;
  static const ShapeTable<8, 8>& shapes() { return hex8_shapes(); }
  static Stiffness<8> stiffness(const Nodes<8>& x, const Elastic& material);
  static CornerStress<8> stress(const Nodes<8>& x, const Elastic& material, const Nodes<8>& displacement);
};

// Prism, plain displacement formulation, 3 x 2 points.
struct Prism6 {
  static constexpr int n_nodes = 6;
  static const ShapeTable<6, 6>& shapes() { return prism6_shapes(); }
  static Stiffness<6> stiffness(const Nodes<6>& x, const Elastic& material);
  static CornerStress<6> stress(const Nodes<6>& x, const Elastic& material, const Nodes<6>& displacement);
};

// Tetrahedron of constant strain.
struct Tet4 {
  static constexpr int n_nodes = 4;
  static const ShapeTable<4, 1>& shapes() { return tet4_shapes(); }
  static Stiffness<4> stiffness(const Nodes<4>& x, const Elastic& material);
  static CornerStress<4> stress(const Nodes<4>& x, const Elastic& material, const Nodes<4>& displacement);
};

// Volume of each node: integral of its shape function (the row sums of the consistent mass), so that the total and the
// centre of mass are exact; positive where the Jacobian is.
template <class Cell>
Eigen::Matrix<double, Cell::n_nodes, 1> node_volumes(const Nodes<Cell::n_nodes>& x) {
  const auto& shapes = Cell::shapes();
  Eigen::Matrix<double, Cell::n_nodes, 1> volumes = Eigen::Matrix<double, Cell::n_nodes, 1>::Zero();
  for (int i = 0; i < shapes.n_points; ++i) {
    const double jacobian = (x * shapes.slopes[i]).eval().determinant();
    volumes += jacobian * shapes.weights[i] * shapes.values.col(i);
  }
  return volumes;
}

// Calls `kernel` with the struct of this cell type.
template <class Kernel>
decltype(auto) with_cell(CellType type, Kernel&& kernel) {
  switch (type) {
    case CellType::hex8:
      return kernel(Hex8{});
    case CellType::prism6:
      return kernel(Prism6{});
    case CellType::tet4:
      break;
  }
  return kernel(Tet4{});
}

// Stress (Pa) of a displacement gradient d u_p / d x_q.
inline Eigen::Matrix<double, 6, 1> stress_of_gradient(const Elastic& material, const Mat3& gradient) {
  const double mu = material.shear_modulus();
  const double pressure = (material.p_wave_modulus() - 2 * mu) * gradient.trace();
  const Mat3 stress = mu * (gradient + gradient.transpose()) + pressure * Mat3::Identity();
  return {stress(0, 0), stress(1, 1), stress(2, 2), stress(0, 1), stress(1, 2), stress(2, 0)};
}

// Programmer's contract of the kernels: the cell passed check_mesh.
inline void check_point_volume(double volume) {
  CHECK(volume > 0, "an inverted cell reached the element kernels unchecked");
}

}  // namespace dygita
