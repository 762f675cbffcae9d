// Matrices and fields of one body, by node: dof = 3 node + axis.
#pragma once

#include "fem/element.hpp"

namespace dygita {

struct BodyMatrices {
  SparseMatrix stiffness;  // 3n x 3n, N/m, both triangles, before any support
  Vec mass;                // n, kg, lumped, positive where the node is of cells
};

// Assembles by node pattern and 3x3 blocks, no triplets; columns increasing in each row; the same to the bit for any
// number of threads. memory: of a matrix that is done with, and empty afterwards: new pages take their time. Of a body
// without cells its own stiffness, and masses that stand for its mass matrix.
// Throws InputError when the matrix would have more than 2^31 entries.
BodyMatrices assemble(const Mesh& mesh, const Elastic& material, SparseMatrix* memory = nullptr);

// rad/s: at least the highest frequency of the elements, at most 1.2 times it; 2 / it is a safe step of central
// differences.
double max_frequency(const Mesh& mesh, const Elastic& material);

// Stress (Pa) at nodes, mean of the adjacent cells' corner values, of a layup in the ply there. displacement: 3 x
// n_nodes.
Tensors nodal_stress(const Mesh& mesh, const Elastic& material, const Points& displacement);

// von Mises stress (Pa) of each column.
Vec von_mises(const Tensors& stress);

// Volume (m^3) of each node: sum of its lumped shares, positive.
Vec nodal_volumes(const Mesh& mesh);

// Integral of each node's shape function (m^3), not positive everywhere: times density what a uniform acceleration or a
// mean velocity has to be weighted by.
Vec nodal_integrals(const Mesh& mesh);

}  // namespace dygita
