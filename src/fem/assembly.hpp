// Matrices and fields of one body, by node: dof = 3 node + axis.
#pragma once

#include "fem/element.hpp"

namespace dygita {

struct BodyMatrices {
  SparseMatrix stiffness;  // 3n x 3n, N/m, both triangles, before any support
  Vec mass;                // n, kg, lumped
  double
      max_frequency;  // bound (rad/s) on the highest element frequency: critical step of central differences is 2 / it
};

// Assembles by node pattern and 3x3 blocks, no triplets.
BodyMatrices assemble(const Mesh& mesh, const Elastic& material);

// Stress (Pa) at nodes, mean of the adjacent cells' corner values. displacement: 3 x n_nodes.
Tensors nodal_stress(const Mesh& mesh, const Elastic& material, const Points& displacement);

// von Mises stress (Pa) of each column.
Vec von_mises(const Tensors& stress);

// Volume (m^3) of each node: sum of its lumped shares.
Vec nodal_volumes(const Mesh& mesh);

}  // namespace dygita
