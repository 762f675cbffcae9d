// Which nodes share a cell: the pattern of every matrix of a body, by node.
#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace dygita {

struct NodePattern {
  std::vector<int> starts;      // n_nodes + 1
  std::vector<int> neighbours;  // of node a: neighbours[starts[a] .. starts[a + 1]), increasing, a itself included

  int n_nodes() const { return static_cast<int>(starts.size()) - 1; }
};

// Throws InputError when the 3x3 blocks of the pattern have more entries than an int counts.
NodePattern node_pattern(const Mesh& mesh);

// Zero matrix (3n x 3n) with a 3x3 block for each pair of the pattern; columns increasing in each row.
SparseMatrix block_matrix(const NodePattern& pattern);

}  // namespace dygita
