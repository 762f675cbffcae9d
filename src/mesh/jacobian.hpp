// Jacobians of the cells' geometric maps: enough to check a mesh and to measure it.
#pragma once

#include "mesh/mesh.hpp"

namespace dygita {

// Determinant of d x / d xi at `xi` (positive in a cell of right orientation) for the cell's nodes `x` (3 x n, m).
double jacobian(CellType type, const Points& x, const Vec3& xi);

// The smallest over the nodes of the reference cell and its quadrature points.
double smallest_jacobian(CellType type, const Points& x);

// d x / d xi and its determinants at each node of the reference cell, then at each quadrature point.
std::vector<Mat3> sampled_maps(CellType type, const Points& x);
Vec sampled_jacobians(CellType type, const Points& x);

// Signed volume (m^3) of the cell with nodes `x` (3 x n, m).
double cell_volume(CellType type, const Points& x);

// Coordinates of the nodes of cell `i_cell` (3 x n, m).
Points cell_nodes(const Points& nodes, const CellBlock& block, int i_cell);

}  // namespace dygita
