// How good the shape of cells is.
#pragma once

#include "mesh/mesh.hpp"

namespace dygita {

// Mean ratio of a cell, the least over its nodes and quadrature points: 3 det(M)^(2/3) / |M|^2, M its Jacobian relative
// to that of the ideal cell (regular tetrahedron, cube, prism over an equilateral triangle). 1 where it is ideal, 0
// where it is flat; negative inside out. P. M. Knupp, SIAM J. Sci. Comput. 23, 2001.
double shape_of_cell(CellType type, const Points& x);

// The least of all cells of a mesh.
double worst_shape(const Mesh& mesh);

}  // namespace dygita
