#include "numerics/packed_factor.hpp"

#include <algorithm>

#include "base/error.hpp"

namespace dygita {

namespace {

// Local unknowns, with room for the rows that the last tile lacks; one per thread.
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

PackedFactor::PackedFactor(Precision precision, Vec largest_error)
    : panels_(precision), tolerance_(std::move(largest_error)) {}

void PackedFactor::arrange() {
  std::sort(blocks_.begin(), blocks_.end(), [](const Block& a, const Block& b) { return a.place < b.place; });
}

void PackedFactor::clear() {
  blocks_.clear();
  below_.clear();
  panels_.clear();
  nonzeros_ = 0.0;
}

void PackedFactor::add(const SupernodeView& s, int place) {
  const int n_rows = s.n_columns + s.n_below;
  blocks_.push_back({s.first, s.n_columns, s.n_below, below_.size(), panels_.size(), place});
  below_.insert(below_.end(), s.below, s.below + s.n_below);
  std::vector<double> tolerance(n_rows, 0.0);
  for (int i = 0; i < n_rows && tolerance_.size() > 0; ++i)
    tolerance[i] = tolerance_[i < s.n_columns ? s.first + i : s.below[i - s.n_columns]];
  double top[Panels::width * Panels::width];
  for (int j = 0; j < s.n_columns; j += Panels::width) {
    const int width = std::min(Panels::width, s.n_columns - j), height = n_rows - j;
    const double* values = s.values + static_cast<size_t>(j) * s.stride + j;
    for (int c = 0; c < width; ++c) {
      const double* column = values + static_cast<size_t>(c) * s.stride;
      for (int r = 0; r < width; ++r) top[c * width + r] = r < c ? 0.0 : r == c ? 1.0 / column[c] : column[r];
      nonzeros_ += height - c;
    }
    panels_.add(top, values, s.stride, height, width, tolerance.data() + j);
  }
}

void PackedFactor::forward_one(double* x, const std::vector<char>* reach) const {
  for (size_t s = 0; s < blocks_.size(); ++s) {
    if (reach && !(*reach)[s]) continue;
    const Block& b = blocks_[s];
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

void PackedFactor::backward_one(double* x, const std::vector<char>* reach) const {
  for (size_t s = blocks_.size(); s-- > 0;) {
    if (reach && !(*reach)[s]) continue;
    const Block& b = blocks_[s];
    const int n_rows = b.n_columns + b.n_below;
    double* y = workspace(n_rows);
    std::copy_n(x + b.first, b.n_columns, y);
    const int* below = below_.data() + b.below;
    for (int i = 0; i < b.n_below; ++i) y[b.n_columns + i] = x[below[i]];
    std::fill_n(y + n_rows, Panels::height, 0.0);
    const int last = (b.n_columns - 1) / Panels::width;
    const size_t after = s > 0 ? last_panel(blocks_[s - 1]) : b.first_panel;
    for (int p = last; p >= 0; --p)
      panels_.backward(b.first_panel + p, p > 0 ? b.first_panel + p - 1 : after, y + p * Panels::width);
    std::copy_n(y, b.n_columns, x + b.first);
  }
}

namespace {

constexpr int lanes = 8;
constexpr Eigen::Index in_cache = 128;  // rows turned at a time

// Columns of x as rows of 8 or 16 values, in a buffer of the thread; missing columns are zero.
double* interleave(const Eigen::Ref<Mat>& x, int row) {
  thread_local std::vector<double> together;
  together.assign(static_cast<size_t>(x.rows()) * row, 0.0);
  for (Eigen::Index first = 0; first < x.rows(); first += in_cache) {
    const Eigen::Index end = std::min(first + in_cache, x.rows());
    for (Eigen::Index c = 0; c < x.cols(); ++c)
      for (Eigen::Index i = first; i < end; ++i) together[i * row + c] = x(i, c);
  }
  return together.data();
}

void separate(const double* together, int row, Eigen::Ref<Mat> x) {
  for (Eigen::Index first = 0; first < x.rows(); first += in_cache) {
    const Eigen::Index end = std::min(first + in_cache, x.rows());
    for (Eigen::Index c = 0; c < x.cols(); ++c)
      for (Eigen::Index i = first; i < end; ++i) x(i, c) = together[i * row + c];
  }
}

}  // namespace

// Right-hand sides side by side: an entry of the factor is read once for all of them.
void PackedFactor::forward_many(Eigen::Ref<Mat> x) const {
  const int n_vectors = x.cols() > lanes ? 2 : 1, row = n_vectors * lanes;
  double* all = interleave(x, row);
  for (const Block& b : blocks_) {
    const size_t here = static_cast<size_t>(b.n_columns) * row;
    double* y = workspace((b.n_columns + b.n_below + Panels::height) * row);
    std::copy_n(all + static_cast<size_t>(b.first) * row, here, y);
    std::fill_n(y + here, static_cast<size_t>(b.n_below + Panels::height) * row, 0.0);
    size_t panel = b.first_panel;
    for (int j = 0; j < b.n_columns; j += Panels::width)
      panels_.forward(panel++, y + static_cast<size_t>(j) * row, n_vectors);
    std::copy_n(y, here, all + static_cast<size_t>(b.first) * row);
    const int* below = below_.data() + b.below;
    for (int i = 0; i < b.n_below; ++i)
      for (int c = 0; c < row; ++c)
        all[static_cast<size_t>(below[i]) * row + c] += y[here + static_cast<size_t>(i) * row + c];
  }
  separate(all, row, x);
}

void PackedFactor::backward_many(Eigen::Ref<Mat> x) const {
  const int n_vectors = x.cols() > lanes ? 2 : 1, row = n_vectors * lanes;
  double* all = interleave(x, row);
  for (size_t s = blocks_.size(); s-- > 0;) {
    const Block& b = blocks_[s];
    const size_t here = static_cast<size_t>(b.n_columns) * row;
    double* y = workspace((b.n_columns + b.n_below + Panels::height) * row);
    std::copy_n(all + static_cast<size_t>(b.first) * row, here, y);
    const int* below = below_.data() + b.below;
    for (int i = 0; i < b.n_below; ++i)
      std::copy_n(all + static_cast<size_t>(below[i]) * row, row, y + here + static_cast<size_t>(i) * row);
    std::fill_n(y + here + static_cast<size_t>(b.n_below) * row, Panels::height * row, 0.0);
    for (int p = (b.n_columns - 1) / Panels::width; p >= 0; --p)
      panels_.backward(b.first_panel + p, y + static_cast<size_t>(p) * Panels::width * row, n_vectors);
    std::copy_n(y, here, all + static_cast<size_t>(b.first) * row);
  }
  separate(all, row, x);
}

void PackedFactor::forward(Eigen::Ref<Mat> x) const {
  if (x.cols() == 1) return forward_one(x.data());
  for (Eigen::Index first = 0; first < x.cols(); first += 2 * lanes)
    forward_many(x.middleCols(first, std::min<Eigen::Index>(2 * lanes, x.cols() - first)));
}

void PackedFactor::backward(Eigen::Ref<Mat> x) const {
  if (x.cols() == 1) return backward_one(x.data());
  for (Eigen::Index first = 0; first < x.cols(); first += 2 * lanes)
    backward_many(x.middleCols(first, std::min<Eigen::Index>(2 * lanes, x.cols() - first)));
}

SymmetricOperator::SymmetricOperator(const Mat& lower, Precision precision, double error)
    : n_(static_cast<int>(lower.rows())), panels_(precision) {
  const Vec size = lower.diagonal().cwiseSqrt();
  double top[Panels::width * Panels::width];
  Vec tolerance;
  for (int j = 0; j < n_; j += Panels::width) {
    const int width = std::min(Panels::width, n_ - j);
    for (int c = 0; c < width; ++c)
      for (int r = 0; r < width; ++r) top[c * width + r] = lower(j + std::max(c, r), j + std::min(c, r));
    tolerance = error * size.segment(j, width).minCoeff() * size.tail(n_ - j);
    panels_.add(top, lower.data() + static_cast<size_t>(j) * n_ + j, n_, n_ - j, width, tolerance.data());
  }
}

Mat SymmetricOperator::lower() const {
  Mat dense = Mat::Zero(n_, n_);
  for (size_t p = 0; p < panels_.size(); ++p) {
    const Eigen::Index j = static_cast<Eigen::Index>(p) * Panels::width;
    panels_.unpack(p, dense.data() + j * n_ + j, n_);
  }
  return dense;
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
    for (size_t p = 0; p < panels_.size(); ++p)
      panels_.multiply_symmetric(p, in + p * Panels::width, out + p * Panels::width);
  } else {
    thread_local std::vector<float> in;
    in.assign(room, 0.0f);
    for (int i = 0; i < n_; ++i) in[i] = static_cast<float>(x[i]);
    for (size_t p = 0; p < panels_.size(); ++p)
      panels_.multiply_symmetric(p, in.data() + p * Panels::width, out + p * Panels::width);
  }
  y = Eigen::Map<const Vec>(out, n_);
}

}  // namespace dygita
