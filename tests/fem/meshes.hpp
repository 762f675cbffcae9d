// Small meshes and a small solver for the tests of elements.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <map>
#include <set>

#include "fem/assembly.hpp"
#include "mesh/box.hpp"

namespace dygita::test {

// All of the table.
inline const std::vector<CellType> cell_types = [] {
  std::vector<CellType> types;
  for (const CellShape& cell : cell_shapes) types.push_back(cell.type);
  return types;
}();

Elastic material_of(double young, double poisson, double density = 1.0);

// The hexahedron of nodes `hex`, or the two prisms that fill it.
std::vector<int> split(CellType type, const int* hex);

// A box of one cell type.
Mesh box_of(CellType type, const Vec3& size, const std::array<int, 3>& cells);

// A box of hexahedra where x is under the middle, of prisms beyond.
Mesh mixed_box(const Vec3& size, const std::array<int, 3>& cells);

bool is_on_boundary(const Vec3& x, const Vec3& size);

// Moves the inner nodes of a box by up to `amplitude` (m) along each axis.
void distort(Mesh& mesh, const Vec3& size, double amplitude);

// Coordinates of the nodes of a cell.
// All three cell types, none of them regular, in 1 x 1.2 x 0.9.
Mesh distorted_mixed_box();

CellNodes nodes_of_cell(const Mesh& mesh, const CellBlock& block, int i_cell);

Vec flat(const Points& field);

// Displacement (3 x n) under nodal forces (3 x n) with prescribed values by dof.
Points solve(const SparseMatrix& stiffness, const Points& forces, const std::map<int, double>& prescribed);

// Nodal forces (3 x n) of a unit pressure on the quadrangles for whose centre `is_loaded` is true, against the outward
// normal.
Points pressure_forces(const Mesh& mesh, const std::function<bool(const Vec3&)>& is_loaded);

}  // namespace dygita::test
