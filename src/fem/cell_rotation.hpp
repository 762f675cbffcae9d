// How far cells turn and stretch: what a theory of small displacements must keep small.
#pragma once

#include "mesh/mesh.hpp"

namespace dygita {

// The largest of all cells, and where.
struct CellExtreme {
  double value = 0.0;
  Vec3 place = Vec3::Zero();  // m, middle of the cell in the mesh
};

struct CellDeformation {
  CellExtreme rotation;  // rad, arc tangent of the rotation vector that the displacements have linearised
  CellExtreme strain;    // magnitude of the principal strain that is farthest from zero
};

// Of the mean over a cell of the gradient of u; of a body without cells the rotation of its places as a whole.
// displacement: 3 x n_nodes, m. least: m, cells whose nodes all move within so much of each other are left out.
CellDeformation largest_deformation(const Mesh& mesh, const Points& displacement, double least = 0.0);

// m: the gradient in a cell is no more than what the displacements of its nodes differ by, over this length; of all
// cells, 0 where there are none. With u = sum N_a u_a: |grad u| <= sum |grad N_a| max |u_a - u_b|.
double gradient_length(const Mesh& mesh);

}  // namespace dygita
