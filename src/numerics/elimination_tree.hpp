// In which order a sparse factorisation takes its supernodes, and what of it threads take side by side.
#pragma once

#include <functional>
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

// Memory for some supernodes, one after the other (doubles). What a supernode leaves waits on a stack until its parent
// takes it; the parent's own is made above its children's, or where that of the last child lies.
struct RoomForFronts {
  size_t columns = 0, waiting = 0;
  std::vector<char> is_own, is_over_child;  // of all supernodes: one of these; made where that of its last child lies

  // places: in the tree's order. update_size: of what a supernode leaves to its parent, doubles.
  RoomForFronts(const EliminationTree& tree, const std::vector<SupernodeView>& supernodes,
                const std::vector<int>& places, const std::function<size_t(int)>& update_size);
};

// A subtree that one thread takes: its places in the tree's order follow each other, the root's is the last.
struct TreeBranch {
  int root, first, end;
  double operations;
};

// The largest first; none of it has much of all operations, and none is a tree. Empty where waking threads would take
// longer. They depend only on the sparsity pattern.
std::vector<TreeBranch> branches_of(const EliminationTree& tree, const std::vector<SupernodeView>& supernodes);

}  // namespace dygita
