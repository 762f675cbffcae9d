// How far cells turn: what a theory of small displacements must keep small.
#pragma once

#include "mesh/mesh.hpp"

namespace dygita {

struct CellRotation {
  double angle = 0.0;         // rad, arc tangent of the rotation vector that the displacements have linearised
  Vec3 place = Vec3::Zero();  // m, middle of the cell in the mesh
};

// The cell that turns most: of 1/2 curl u, its mean over the cell; a body without cells as a whole. displacement:
// 3 x n_nodes, m.
CellRotation largest_rotation(const Mesh& mesh, const Points& displacement);

// m, length of the shortest edge of the box around a cell, of all cells; 0 where there are none.
double smallest_cell(const Mesh& mesh);

}  // namespace dygita
