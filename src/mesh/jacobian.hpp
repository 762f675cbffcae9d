// Jacobians of the cells' geometric maps: enough to check a mesh and to measure it.
#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace dygita {

// A point of the reference cell and its weight in the cell's quadrature.
struct ReferencePoint {
  Vec3 position;
  double weight;
};

// Quadrature exact for the volume of any cell of this type: 2x2x2 points (hex8), 3x2 (prism6), 1 (tet4).
const std::vector<ReferencePoint>& volume_quadrature(CellType type);

// Corners of the reference cell, in node order: cube [-1, 1]^3, prism of the unit triangle over [-1, 1], unit
// tetrahedron.
const std::vector<Vec3>& reference_corners(CellType type);

// Determinant of d x / d xi at `xi` (positive in a cell of right orientation) for the cell's nodes `x` (3 x n, m).
double jacobian(CellType type, const Points& x, const Vec3& xi);

// Signed volume (m^3) of the cell with nodes `x` (3 x n, m).
double cell_volume(CellType type, const Points& x);

// Coordinates of the nodes of cell `i_cell` (3 x n, m).
Points cell_nodes(const Points& nodes, const CellBlock& block, int i_cell);

}  // namespace dygita
