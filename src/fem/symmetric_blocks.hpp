// A stiffness matrix by 3x3 blocks of its upper triangle: half the memory of the matrix, which is what bounds a
// product.
#pragma once

#include <vector>

#include "numerics/types.hpp"

namespace dygita {

class SymmetricBlocks {
 public:
  // stiffness: symmetric, 3n x 3n, with the 3x3 block pattern of `assemble`.
  explicit SymmetricBlocks(const SparseMatrix& stiffness);

  // y += K x, both 3n long.
  void add_product(const double* x, double* y) const;
  int n_dofs() const { return 3 * (static_cast<int>(starts_.size()) - 1); }
  double bytes() const {
    return 4.0 * static_cast<double>(starts_.size() + nodes_.size()) + 8.0 * static_cast<double>(values_.size());
  }

 private:
  std::vector<int> starts_, nodes_;  // of row a: itself first, then the nodes after it
  std::vector<double> values_;       // row after row, 9 a block
};

}  // namespace dygita
