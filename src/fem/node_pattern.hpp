// Which nodes share a cell: the pattern of every matrix of a body, by node.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/mesh.hpp"

namespace dygita {

struct NodePattern {
  std::vector<int> starts;      // n_nodes + 1
  std::vector<int> neighbours;  // of node a: neighbours[starts[a] .. starts[a + 1]), increasing, a itself included

  int n_nodes() const { return static_cast<int>(starts.size()) - 1; }
};

// Where the nodes of a cell stand among the neighbours of each other: of block k, cell i of n nodes, local node b among
// those of local node a at of_block[k][(i n + a) n + b].
struct CellSlots {
  std::vector<std::vector<std::uint16_t>> of_block;
};

// Throws InputError when the 3x3 blocks of the pattern have more entries than an int counts, or a node more neighbours
// than a slot. slots: filled where asked for.
NodePattern node_pattern(const Mesh& mesh, CellSlots* slots = nullptr);

// Matrix (3n x 3n) with a 3x3 block for each pair of the pattern; columns increasing in each row; values not set.
// memory: of a matrix that is done with, and empty afterwards.
SparseMatrix block_matrix(const NodePattern& pattern, SparseMatrix* memory = nullptr);

}  // namespace dygita
