#include "numerics/spd_inverse.hpp"

#include <cblas.h>

#include <algorithm>

#include "base/aside.hpp"
#include "base/error.hpp"
#include "base/log.hpp"
#include "numerics/dense_blocks.hpp"

namespace dygita {

namespace {

// A = L L^T, L over the lower triangle of A.
void factorise(Mat& a, const std::string& what) {
  const int n = static_cast<int>(a.rows());
  if (const int pivot = factorise_columns(n, n, a.data(), n, give_up_if_stopped); pivot >= 0)
    throw NumericalError(
        fmt::format("{}: the interface operator is not positive definite (unknown {} of {})", what, pivot + 1, n));
}

}  // namespace

Mat inverse_spd(Mat matrix, const std::string& what) {
  factorise(matrix, what);
  invert_factor(matrix, give_up_if_stopped);
  return matrix;
}

void mirror_lower(Mat& a) {
  constexpr Eigen::Index block = 64;  // both sides of it in the nearest cache
  const Eigen::Index n = a.rows();
  for (Eigen::Index j = 0; j < n; j += block)
    for (Eigen::Index i = j; i < n; i += block) {
      const Eigen::Index width = std::min(block, n - j), height = std::min(block, n - i);
      if (i == j)
        a.block(j, j, width, width).triangularView<Eigen::StrictlyUpper>() = a.block(j, j, width, width).transpose();
      else
        a.block(j, i, width, height) = a.block(i, j, height, width).transpose();
    }
}

void multiply_symmetric(const Mat& lower, const Vec& x, Vec& y) {
  const int n = static_cast<int>(lower.rows());
  y.resize(n);
  if (n > 0) cblas_dsymv(CblasColMajor, CblasLower, n, 1.0, lower.data(), n, x.data(), 1, 0.0, y.data(), 1);
}

SpdInverse::SpdInverse(Mat a, Form form, const Storage& storage, const std::string& what)
    : n_(static_cast<int>(a.rows())), form_(form) {
  factorise(a, what);
  if (form == Form::matrix) {
    invert_factor(a, give_up_if_stopped);
    matrix_ = SymmetricOperator(a, storage.precision, storage.error);
    if (storage.half_error > 0.0) half_ = SymmetricOperator(a, Precision::single_precision, storage.half_error);
    if (storage.rough_error > 0.0) rough_ = SymmetricOperator(a, Precision::single_precision, storage.rough_error);
    return;
  }
  double top[Panels::width * Panels::width];
  for (int j = 0; j < n_; j += Panels::width) {
    const int width = std::min(Panels::width, n_ - j);
    for (int c = 0; c < width; ++c)
      for (int r = 0; r < width; ++r)
        top[c * width + r] = r < c ? 0.0 : r == c ? 1.0 / a(j + c, j + c) : a(j + r, j + c);
    factor_.add(top, a.data() + static_cast<size_t>(j) * n_ + j, n_, n_ - j, width, nullptr);
  }
}

// 2/3 n^3 operations at the speed of dense products, against 4 n^2 bytes more a product from memory.
SpdInverse::Form SpdInverse::cheapest(int n, double n_products) {
  constexpr double operations_per_second = 35e9, bytes_per_second = 13e9;
  const double made = 2.0 / 3.0 * n / operations_per_second, read = 4.0 * n_products / bytes_per_second;
  return read < made ? Form::factor : Form::matrix;
}

void SpdInverse::multiply(const Vec& x, Vec& y) const {
  if (form_ == Form::matrix) return matrix_.multiply(x, y);
  CHECK(x.size() == n_, "product with a vector of another length");
  thread_local std::vector<double> work;
  work.assign(static_cast<size_t>(n_ + Panels::height), 0.0);
  std::copy_n(x.data(), n_, work.data());
  const size_t n_panels = factor_.size();
  for (size_t p = 0; p < n_panels; ++p) factor_.forward(p, work.data() + p * Panels::width);
  // What forward substitution left behind the last row is not part of the sums.
  std::fill_n(work.data() + n_, Panels::height, 0.0);
  for (size_t p = n_panels; p-- > 0;) factor_.backward(p, p > 0 ? p - 1 : 0, work.data() + p * Panels::width);
  y = Eigen::Map<const Vec>(work.data(), n_);
}

namespace {

// all(x, y) of up to sixteen vectors, which side by side take as long as about four by themselves; fewer by one(x, y).
template <class Together, class One>
void by_sixteen(std::span<const double* const> x, std::span<double* const> y, int length, Together&& all, One&& one) {
  constexpr size_t few = 4, most = panel::together;
  for (size_t first = 0; first < x.size(); first += most) {
    const size_t n = std::min(most, x.size() - first);
    if (n >= few) {
      all(x.subspan(first, n), y.subspan(first, n));
      continue;
    }
    Vec answer;
    for (size_t i = first; i < first + n; ++i) {
      one(Vec(Eigen::Map<const Vec>(x[i], length)), answer);
      std::copy_n(answer.data(), length, y[i]);
    }
  }
}

}  // namespace

void SpdInverse::multiply(std::span<const double* const> x, std::span<double* const> y) const {
  by_sixteen(
      x, y, n_,
      [this](auto from, auto to) {
        form_ == Form::matrix ? matrix_.multiply_together(from, to) : substitute_together(from, to);
      },
      [this](const Vec& from, Vec& to) { multiply(from, to); });
}

void SpdInverse::multiply_roughly(std::span<const double* const> x, std::span<double* const> y) const {
  by_sixteen(
      x, y, n_, [this](auto from, auto to) { rough_.multiply_together(from, to); },
      [this](const Vec& from, Vec& to) { multiply_roughly(from, to); });
}

Mat SpdInverse::unpacked_factor() const {
  Mat dense = Mat::Zero(n_, n_);
  for (size_t p = 0; p < factor_.size(); ++p) {
    const Eigen::Index j = static_cast<Eigen::Index>(p) * Panels::width;
    factor_.unpack(p, dense.data() + j * n_ + j, n_);
  }
  dense.diagonal() = dense.diagonal().cwiseInverse().eval();
  return dense;
}

Mat SpdInverse::times(Mat x) const {
  CHECK(x.rows() == n_, "product with vectors of another length");
  const int n = n_, m = static_cast<int>(x.cols());
  if (n == 0 || m == 0) return x;
  if (form_ == Form::factor) {
    const Mat l = unpacked_factor();
    for (const auto side : {CblasNoTrans, CblasTrans})
      cblas_dtrsm(CblasColMajor, CblasLeft, CblasLower, side, CblasNonUnit, n, m, 1.0, l.data(), n, x.data(), n);
    return x;
  }
  const Mat inverse = matrix_.lower();
  Mat product(n, m);
  cblas_dsymm(CblasColMajor, CblasLeft, CblasLower, n, m, 1.0, inverse.data(), n, x.data(), n, 0.0, product.data(), n);
  return product;
}

Mat SpdInverse::lower() const {
  if (form_ == Form::matrix) return matrix_.lower();
  Mat dense = unpacked_factor();
  invert_factor(dense);
  return dense;
}

}  // namespace dygita
