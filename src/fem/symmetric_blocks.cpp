#include "fem/symmetric_blocks.hpp"

#include "base/error.hpp"

namespace dygita {

SymmetricBlocks::SymmetricBlocks(const SparseMatrix& stiffness) {
  const int n = static_cast<int>(stiffness.rows()) / 3;
  starts_.push_back(0);
  for (int a = 0; a < n; ++a) {
    const int begin = stiffness.outerIndexPtr()[3 * a], count = stiffness.outerIndexPtr()[3 * a + 1] - begin;
    for (int e = 0; e < count; e += 3) {
      const int b = stiffness.innerIndexPtr()[begin + e] / 3;
      if (b < a) continue;
      nodes_.push_back(b);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) values_.push_back(stiffness.valuePtr()[begin + i * count + e + j]);
    }
    if (nodes_.size() == static_cast<size_t>(starts_.back())) {  // no cell of these there
      nodes_.push_back(a);
      values_.insert(values_.end(), 9, 0.0);
    }
    CHECK(nodes_[starts_.back()] == a, "a row has its diagonal block");
    starts_.push_back(static_cast<int>(nodes_.size()));
  }
}

void SymmetricBlocks::add_product(const double* x, double* y) const {
  const double* k = values_.data();
  for (size_t a = 0; a + 1 < starts_.size(); ++a) {
    const double x0 = x[3 * a], x1 = x[3 * a + 1], x2 = x[3 * a + 2];
    double y0 = k[0] * x0 + k[1] * x1 + k[2] * x2;
    double y1 = k[3] * x0 + k[4] * x1 + k[5] * x2;
    double y2 = k[6] * x0 + k[7] * x1 + k[8] * x2;
    k += 9;
    for (int e = starts_[a] + 1; e < starts_[a + 1]; ++e, k += 9) {
      const double* z = x + 3 * static_cast<size_t>(nodes_[e]);
      double* w = y + 3 * static_cast<size_t>(nodes_[e]);
      y0 += k[0] * z[0] + k[1] * z[1] + k[2] * z[2];
      y1 += k[3] * z[0] + k[4] * z[1] + k[5] * z[2];
      y2 += k[6] * z[0] + k[7] * z[1] + k[8] * z[2];
      w[0] += k[0] * x0 + k[3] * x1 + k[6] * x2;
      w[1] += k[1] * x0 + k[4] * x1 + k[7] * x2;
      w[2] += k[2] * x0 + k[5] * x1 + k[8] * x2;
    }
    y[3 * a] += y0;
    y[3 * a + 1] += y1;
    y[3 * a + 2] += y2;
  }
}

}  // namespace dygita
