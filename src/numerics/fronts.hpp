// Cholesky factorisation by fronts: dense blocks, one a supernode, each of which takes its share of what remains of the
// matrix from those below it in the elimination tree (Duff and Reid 1983; Liu 1992).
#pragma once

#include <functional>
#include <vector>

#include "numerics/dense_blocks.hpp"
#include "numerics/packed_factor.hpp"
#include "numerics/types.hpp"

namespace dygita {

// What eliminating the interior leaves.
struct Eliminated {
  Mat schur;              // on the unknowns after the interior, in factor order; lower triangle
  int not_positive = -1;  // position of the first pivot that is not positive, or -1; then schur is of no use
};

// Is given each supernode of L once, never two at a time, with its place in one order for any number of threads, in
// which each follows those below it in the tree; its values are valid during the call.
using KeepSupernode = std::function<void(const SupernodeView&, int place)>;

// Eliminates the first n_interior unknowns of `matrix` (symmetric, both triangles stored) taken in `order`.
// supernodes: columns before n_interior and the rows below them, as an ordering in which rows are increasing gives
// them; their values are not read. Threads take subtrees, and share the large fronts above them; which operations go
// into an entry, and in which order, depends only on the sparsity pattern.
Eliminated eliminate(const SparseMatrix& matrix, const std::vector<int>& order, int n_interior,
                     const std::vector<SupernodeView>& supernodes, const KeepSupernode& keep, const Watch& watch = {});

// Bytes that one thread works in while all unknowns are eliminated: the largest columns at hand, and what waits.
double bytes_of_fronts(const std::vector<SupernodeView>& supernodes, int n);

}  // namespace dygita
