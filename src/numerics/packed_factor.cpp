#include "numerics/packed_factor.hpp"

#include <cblas.h>

#include <algorithm>

#include "base/error.hpp"

namespace dygita {

namespace {

// Errors of entries in single precision, of the size of their rows: what rounds to nothing in the tail of an operator adds up.
constexpr double single_factor = 0x1p-26, single_operator = 0x1p-30;

// Local unknowns, with room for the rows that the last tile lacks; one a thread.
double* workspace(int n) {
  thread_local std::vector<double> work;
  if (static_cast<int>(work.size()) < n + 2 * Panels::height) work.resize(n + 2 * Panels::height);
  return work.data();
}

}  // namespace

double supernode_bytes(int n_columns, int n_below) {
  double bytes = 0.0;
  for (int j = 0; j < n_columns; j += Panels::width)
    bytes += panel_bytes(n_columns + n_below - j, std::min(Panels::width, n_columns - j));
  return bytes;
}

PackedFactor::PackedFactor(Precision precision, Vec row_size) : panels_(precision), tolerance_(single_factor * std::move(row_size)) {}

void PackedFactor::add(const SupernodeView& s) {
  const int n_rows = s.n_columns + s.n_below;
  blocks_.push_back({s.first, s.n_columns, s.n_below, below_.size(), panels_.size()});
  below_.insert(below_.end(), s.below, s.below + s.n_below);
  std::vector<double> tolerance(n_rows, 0.0);
  for (int i = 0; i < n_rows && tolerance_.size() > 0; ++i)
    tolerance[i] = tolerance_[i < s.n_columns ? s.first + i : s.below[i - s.n_columns]];
  Mat panel;
  for (int j = 0; j < s.n_columns; j += Panels::width) {
    const int width = std::min(Panels::width, s.n_columns - j), height = n_rows - j;
    panel.setZero(height, width);
    for (int c = 0; c < width; ++c) {
      const double* column = s.values + static_cast<size_t>(j + c) * s.stride + j;
      panel.col(c).tail(height - c) = Eigen::Map<const Vec>(column + c, height - c);
      panel(c, c) = 1.0 / column[c];
      nonzeros_ += height - c;
    }
    panels_.add(panel.data(), height, height, width, tolerance.data() + j);
  }
}

void PackedFactor::forward_one(double* x) const {
  for (const Block& b : blocks_) {
    double* y = workspace(b.n_columns + b.n_below);
    std::copy_n(x + b.first, b.n_columns, y);
    std::fill_n(y + b.n_columns, b.n_below + Panels::height, 0.0);
    size_t panel = b.first_panel;
    for (int j = 0; j < b.n_columns; j += Panels::width) panels_.forward(panel++, y + j);
    std::copy_n(y, b.n_columns, x + b.first);
    const int* below = below_.data() + b.below;
    for (int i = 0; i < b.n_below; ++i) x[below[i]] += y[b.n_columns + i];
  }
}

void PackedFactor::backward_one(double* x) const {
  for (size_t s = blocks_.size(); s-- > 0;) {
    const Block& b = blocks_[s];
    const int n_rows = b.n_columns + b.n_below;
    double* y = workspace(n_rows);
    std::copy_n(x + b.first, b.n_columns, y);
    const int* below = below_.data() + b.below;
    for (int i = 0; i < b.n_below; ++i) y[b.n_columns + i] = x[below[i]];
    std::fill_n(y + n_rows, Panels::height, 0.0);
    const int last = (b.n_columns - 1) / Panels::width;
    for (int p = last; p >= 0; --p) panels_.backward(b.first_panel + p, y + p * Panels::width);
    std::copy_n(y, b.n_columns, x + b.first);
  }
}

void PackedFactor::unpack(const Block& b, Mat& dense) const {
  const int n_rows = b.n_columns + b.n_below;
  dense.resize(n_rows, b.n_columns);
  size_t panel = b.first_panel;
  for (int j = 0; j < b.n_columns; j += Panels::width) {
    panels_.unpack(panel++, dense.data() + static_cast<size_t>(j) * n_rows + j, n_rows);
    for (int c = j; c < std::min(j + Panels::width, b.n_columns); ++c) dense(c, c) = 1.0 / dense(c, c);
  }
}

// Several right-hand sides: a block is read once for all of them, and its products go to BLAS.
void PackedFactor::forward(double* x, int n_rhs, Eigen::Index stride) const {
  if (n_rhs == 1) return forward_one(x);
  thread_local Mat dense, work;
  for (const Block& b : blocks_) {
    unpack(b, dense);
    const int n_rows = b.n_columns + b.n_below;
    cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasNoTrans, CblasNonUnit, b.n_columns, n_rhs, 1.0, dense.data(), n_rows,
                x + b.first, static_cast<int>(stride));
    if (b.n_below == 0) continue;
    if (work.rows() < b.n_below || work.cols() != n_rhs) work.resize(b.n_below, n_rhs);
    cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, b.n_below, n_rhs, b.n_columns, 1.0, dense.data() + b.n_columns, n_rows,
                x + b.first, static_cast<int>(stride), 0.0, work.data(), static_cast<int>(work.rows()));
    const int* below = below_.data() + b.below;
    for (int c = 0; c < n_rhs; ++c)
      for (int i = 0; i < b.n_below; ++i) x[below[i] + c * stride] -= work(i, c);
  }
}

void PackedFactor::backward(double* x, int n_rhs, Eigen::Index stride) const {
  if (n_rhs == 1) return backward_one(x);
  thread_local Mat dense, work;
  for (size_t s = blocks_.size(); s-- > 0;) {
    const Block& b = blocks_[s];
    unpack(b, dense);
    const int n_rows = b.n_columns + b.n_below;
    if (b.n_below > 0) {
      if (work.rows() < b.n_below || work.cols() != n_rhs) work.resize(b.n_below, n_rhs);
      const int* below = below_.data() + b.below;
      for (int c = 0; c < n_rhs; ++c)
        for (int i = 0; i < b.n_below; ++i) work(i, c) = x[below[i] + c * stride];
      cblas_dgemm(CblasColMajor, CblasTrans, CblasNoTrans, b.n_columns, n_rhs, b.n_below, -1.0, dense.data() + b.n_columns, n_rows,
                  work.data(), static_cast<int>(work.rows()), 1.0, x + b.first, static_cast<int>(stride));
    }
    cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, CblasTrans, CblasNonUnit, b.n_columns, n_rhs, 1.0, dense.data(), n_rows,
                x + b.first, static_cast<int>(stride));
  }
}

SymmetricOperator::SymmetricOperator(const Mat& lower, Precision precision) : n_(static_cast<int>(lower.rows())), panels_(precision) {
  const Vec size = lower.diagonal().cwiseSqrt();
  Mat panel;
  Vec tolerance;
  for (int j = 0; j < n_; j += Panels::width) {
    const int width = std::min(Panels::width, n_ - j);
    panel = lower.block(j, j, n_ - j, width);
    for (int c = 0; c < width; ++c)
      for (int r = 0; r < c; ++r) panel(r, c) = lower(j + c, j + r);
    tolerance = single_operator * size.segment(j, width).minCoeff() * size.tail(n_ - j);
    panels_.add(panel.data(), n_ - j, n_ - j, width, tolerance.data());
  }
}

void SymmetricOperator::multiply(const Vec& x, Vec& y) const {
  CHECK(x.size() == n_, "product with a vector of another length");
  const int room = n_ + Panels::height;
  double* out = workspace(2 * room);
  std::fill_n(out, room, 0.0);
  if (panels_.precision() == Precision::double_precision) {
    double* in = out + room;
    std::copy_n(x.data(), n_, in);
    std::fill_n(in + n_, Panels::height, 0.0);
    for (size_t p = 0; p < panels_.size(); ++p) panels_.multiply_symmetric(p, in + p * Panels::width, out + p * Panels::width);
  } else {
    thread_local std::vector<float> in;
    in.assign(room, 0.0f);
    for (int i = 0; i < n_; ++i) in[i] = static_cast<float>(x[i]);
    for (size_t p = 0; p < panels_.size(); ++p) panels_.multiply_symmetric(p, in.data() + p * Panels::width, out + p * Panels::width);
  }
  y = Eigen::Map<const Vec>(out, n_);
}

}  // namespace dygita
