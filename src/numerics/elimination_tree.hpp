// In which order a sparse factorisation takes its supernodes, and what of it threads take side by side.
#pragma once

#include <vector>

#include "numerics/packed_factor.hpp"

namespace dygita {

// Supernodes from the leaves up: each follows all of its children, the last of them at once.
struct EliminationTree {
  std::vector<int> parent;  // -1: above is what is not eliminated
  std::vector<std::vector<int>> children;
  std::vector<int> order;

  // supernodes: columns before n_interior, and the rows below them.
  EliminationTree(const std::vector<SupernodeView>& supernodes, int n_interior);
};

// A subtree that one thread takes: its places in the tree's order follow each other, the root's is the last.
struct Branch {
  int root, first, end;
  double operations;
};

// The largest first; none of it has much of all operations, and none is a tree. Empty where waking threads would take
// longer. They depend only on the sparsity pattern.
std::vector<Branch> branches_of(const EliminationTree& tree, const std::vector<SupernodeView>& supernodes);

}  // namespace dygita
