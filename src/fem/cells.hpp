// The rows of the table of cells with their kernels, all sizes known to the compiler: what element.hpp and assembly.hpp
// call. A type without kernels of its own has those of a displacement formulation (isoparametric.hpp).
#pragma once

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "fem/shape.hpp"
#include "fem/wave_tuning.hpp"
#include "material/elastic_tensor.hpp"
#include "numerics/dense.hpp"

namespace dygita {

template <int n>
using CornerStress = Eigen::Matrix<double, 6, n>;  // Pa, one column per node: xx yy zz xy yz zx
template <int n>
using MassMatrix = Eigen::Matrix<double, n, n>;  // kg

// A row and its shape functions at the points of its rules.
template <CellType cell_type>
struct ShapedCell {
  static constexpr CellType type = cell_type;
  static constexpr const CellShape& row = cell_shape(cell_type);
  static constexpr int n_nodes = nodes_per_cell(cell_type);
  static constexpr int n_points = static_cast<int>(row.stiffness.points.size());
  static constexpr int n_mass_points = static_cast<int>(row.mass.points.size());
  static constexpr int n_recovery_points = static_cast<int>(row.at_recovery.points.size());

  static const ShapeTable<n_nodes, n_points>& shapes() {
    static const ShapeTable<n_nodes, n_points> table(shape_functions(type), row.stiffness);
    return table;
  }
  static const ShapeTable<n_nodes, n_mass_points>& mass_shapes() {
    static const ShapeTable<n_nodes, n_mass_points> table(shape_functions(type), row.mass);
    return table;
  }
  static const ShapeTable<n_nodes, n_recovery_points>& recovery_shapes() {
    static const ShapeTable<n_nodes, n_recovery_points> table(shape_functions(type), row.at_recovery);
    return table;
  }
  // A row of values at the points of recovery x this = row of values at the nodes.
  static const Eigen::Matrix<double, n_recovery_points, n_nodes>& to_nodes();
};

template <CellType cell_type>
struct Cell : ShapedCell<cell_type> {
  static constexpr int n = ShapedCell<cell_type>::n_nodes;
  static Stiffness<n> stiffness(const Nodes<n>& x, const ElasticTensor& tensor);
  static CornerStress<n> stress(const Nodes<n>& x, const ElasticTensor& tensor, const Nodes<n>& displacement);
  // Between lumped and consistent; of its diagonal nothing is read (manual, eq. S6).
  static MassMatrix<n> tuned_mass(const Nodes<n>& x, double density, const WaveTuning& tuning);
};

// Trilinear hexahedron with 12 enhanced strain modes condensed in the cell: the 9 of Taylor, Beresford and Wilson
// (Int. J. Numer. Methods Eng. 10, 1976), which cure bending and pass the patch test on distorted cells, and the 3
// volumetric ones of Simo, Armero and Taylor (Comput. Methods Appl. Mech. Eng. 110, 1993), which cure
// incompressibility. Its mass is tuned along each of its axes.
template <>
struct Cell<CellType::hex8> : ShapedCell<CellType::hex8> {
  static Stiffness<8> stiffness(const Nodes<8>& x, const ElasticTensor& tensor);
  static CornerStress<8> stress(const Nodes<8>& x, const ElasticTensor& tensor, const Nodes<8>& displacement);
  static MassMatrix<8> tuned_mass(const Nodes<8>& x, double density, const WaveTuning& tuning);
};
using Hex8 = Cell<CellType::hex8>;

template <CellType cell_type>
auto ShapedCell<cell_type>::to_nodes() -> const Eigen::Matrix<double, n_recovery_points, n_nodes>& {
  static const Eigen::Matrix<double, n_recovery_points, n_nodes> matrix = [] {
    const ShapeFunctions functions(row.recovery);
    Mat at_points(n_recovery_points, n_recovery_points);
    for (int i = 0; i < n_recovery_points; ++i)
      at_points.col(i) = functions.values(vector_of(row.at_recovery.points[i].at));
    Mat at_nodes(n_recovery_points, n_nodes);
    for (int a = 0; a < n_nodes; ++a) at_nodes.col(a) = functions.values(vector_of(row.shape.nodes[a]));
    return Mat(inverse(at_points) * at_nodes);
  }();
  return matrix;
}

// Integral of each shape function (m^3): row sums of the consistent mass of density one.
template <class Cell>
Eigen::Matrix<double, Cell::n_nodes, 1> shape_integrals(const Nodes<Cell::n_nodes>& x);

// The consistent mass of a cell.
template <class Cell>
MassMatrix<Cell::n_nodes> consistent_mass(const Nodes<Cell::n_nodes>& x, double density);

// Volume of each node, as the row lumps; positive where the Jacobian is.
template <class Cell>
Eigen::Matrix<double, Cell::n_nodes, 1> node_volumes(const Nodes<Cell::n_nodes>& x);

// Calls `kernel` with the struct of this cell type.
template <int first = 0, class Kernel>
decltype(auto) with_cell(CellType type, Kernel&& kernel) {
  if constexpr (first + 1 < n_cell_types) {
    if (static_cast<int>(type) != first) return with_cell<first + 1>(type, std::forward<Kernel>(kernel));
  }
  return kernel(Cell<static_cast<CellType>(first)>{});
}

// Programmer's contract of the kernels: the cell passed check_mesh.
inline void check_point_volume(double volume) {
  CHECK(volume > 0, "an inverted cell reached the element kernels unchecked");
}

}  // namespace dygita

#include "fem/cell_masses.hpp"
#include "fem/isoparametric.hpp"

namespace dygita {

// What a type's kernels are, `words` before each: `template` compiles them, `extern template` leaves that to another
// source: the compiler takes its time over them.
#define DYGITA_KERNELS_OF(words, type)                                                                 \
  words struct Cell<CellType::type>;                                                                   \
  words struct ShapedCell<CellType::type>;                                                             \
  words Eigen::Matrix<double, Cell<CellType::type>::n_nodes, 1> shape_integrals<Cell<CellType::type>>( \
      const Nodes<Cell<CellType::type>::n_nodes>&);                                                    \
  words Eigen::Matrix<double, Cell<CellType::type>::n_nodes, 1> node_volumes<Cell<CellType::type>>(    \
      const Nodes<Cell<CellType::type>::n_nodes>&);                                                    \
  words MassMatrix<Cell<CellType::type>::n_nodes> consistent_mass<Cell<CellType::type>>(               \
      const Nodes<Cell<CellType::type>::n_nodes>&, double);
#define DYGITA_LINEAR_KERNELS(words) \
  DYGITA_KERNELS_OF(words, tet4)     \
  DYGITA_KERNELS_OF(words, prism6)   \
  DYGITA_KERNELS_OF(words, hex8)
#define DYGITA_QUADRATIC_KERNELS(words) \
  DYGITA_KERNELS_OF(words, tet10)       \
  DYGITA_KERNELS_OF(words, hex20)       \
  DYGITA_KERNELS_OF(words, hex27)       \
  DYGITA_KERNELS_OF(words, prism15)     \
  DYGITA_KERNELS_OF(words, prism18)
DYGITA_LINEAR_KERNELS(extern template)
DYGITA_QUADRATIC_KERNELS(extern template)

}  // namespace dygita
