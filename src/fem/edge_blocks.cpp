#include "fem/edge_blocks.hpp"

#include "numerics/panel_choice.hpp"

namespace dygita {

EdgeBlocks::EdgeBlocks(const SparseMatrix& stiffness) {
  const int n = static_cast<int>(stiffness.rows()) / 3;
  const size_t n_edges = (static_cast<size_t>(stiffness.nonZeros()) / 9 - static_cast<size_t>(n)) / 2;
  starts_.reserve(static_cast<size_t>(n) + 1);
  others_.reserve(n_edges);
  blocks_.reserve(9 * n_edges + 2);
  starts_.push_back(0);
  for (int a = 0; a < n; ++a) {
    const int begin = stiffness.outerIndexPtr()[3 * a], count = stiffness.outerIndexPtr()[3 * a + 1] - begin;
    for (int e = 0; e < count; e += 3) {
      const int b = stiffness.innerIndexPtr()[begin + e] / 3;
      if (b <= a) continue;
      others_.push_back(b);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          blocks_.push_back(static_cast<float>(stiffness.valuePtr()[begin + i * count + e + j]));
    }
    starts_.push_back(static_cast<int>(others_.size()));
  }
  blocks_.insert(blocks_.end(), 2, 0.0F);
}

void EdgeBlocks::add_product(const double* x, double* y) const {
  panel_kernels().add_edge_product({starts_.data(), others_.data(), blocks_.data(), n_nodes()}, x, y);
}

}  // namespace dygita
