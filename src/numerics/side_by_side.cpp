// Sixteen vectors side by side: an entry of a factor or of an operator is read once for all of them, and where it is
// stored in single precision twice as many are worked on at a time as in double.
#include <algorithm>

#include "base/error.hpp"
#include "numerics/spd_inverse.hpp"

namespace dygita {

namespace {

constexpr int row = panel::together;
constexpr int most_panels = 16;  // whose products are summed in single precision

template <class T>
T* room_of(std::vector<T>& values, size_t n_rows) {
  if (values.size() < n_rows * row) values.resize(n_rows * row);
  return values.data();
}

size_t at(int i) { return static_cast<size_t>(i) * row; }

// n numbers of each vector as rows; the vectors that lack up to sixteen are zero.
template <class T, class Pointer>
void interleave(std::span<const Pointer> vectors, int n, T* to) {
  constexpr int in_cache = 128;
  if (vectors.size() < row) std::fill_n(to, at(n), T(0));
  for (int first = 0; first < n; first += in_cache)
    for (size_t v = 0; v < vectors.size(); ++v)
      for (int i = first; i < std::min(first + in_cache, n); ++i) to[at(i) + v] = static_cast<T>(vectors[v][i]);
}

void separate(const double* from, int n, std::span<double* const> vectors) {
  constexpr int in_cache = 128;
  for (int first = 0; first < n; first += in_cache)
    for (size_t v = 0; v < vectors.size(); ++v)
      for (int i = first; i < std::min(first + in_cache, n); ++i) vectors[v][i] = from[at(i) + v];
}

// Adds what is left in single precision.
void flush(float* from, size_t n, double* to) {
  for (size_t i = 0; i < n; ++i) to[i] += static_cast<double>(from[i]);
  std::fill_n(from, n, 0.0f);
}

thread_local std::vector<double> all_rows, rows_of_block;
thread_local std::vector<float> singles;

}  // namespace

void PackedFactor::forward_together(std::span<double* const> x, int n) const {
  const bool is_single = panels_.precision() == Precision::single_precision;
  double* all = room_of(all_rows, static_cast<size_t>(n));
  interleave(x, n, all);
  for (const Block& b : blocks_) {
    const auto n_rows = static_cast<size_t>(b.n_columns + b.n_below), n_padded = n_rows + Panels::height;
    double* y = room_of(rows_of_block, n_padded);
    float* left = room_of(singles, n_padded);
    std::copy_n(all + at(b.first), at(b.n_columns), y);
    std::fill(y + at(b.n_columns), y + n_padded * row, 0.0);
    std::fill_n(left, n_padded * row, 0.0f);
    for (int p = 0, j = 0; j < b.n_columns; ++p, j += Panels::width) {
      const size_t panel = b.first_panel + static_cast<size_t>(p);
      if (!is_single) {
        panels_.forward(panel, y + at(j), row / 8);
        continue;
      }
      if (p > 0 && p % most_panels == 0) flush(left + at(j), (n_rows - static_cast<size_t>(j)) * row, y + at(j));
      panels_.forward(panel, y + at(j), left + at(j));
    }
    if (is_single) flush(left + at(b.n_columns), at(b.n_below), y + at(b.n_columns));
    std::copy_n(y, at(b.n_columns), all + at(b.first));
    const int* below = below_.data() + b.below;
    for (int i = 0; i < b.n_below; ++i)
      for (int c = 0; c < row; ++c) all[at(below[i]) + c] += y[at(b.n_columns + i) + c];
  }
  separate(all, n, x);
}

void PackedFactor::backward_together(std::span<double* const> x, int n) const {
  const bool is_single = panels_.precision() == Precision::single_precision;
  double* all = room_of(all_rows, static_cast<size_t>(n));
  interleave(x, n, all);
  for (size_t s = blocks_.size(); s-- > 0;) {
    const Block& b = blocks_[s];
    const auto n_rows = static_cast<size_t>(b.n_columns + b.n_below), n_padded = n_rows + Panels::height;
    double* y = room_of(rows_of_block, n_padded);
    float* rows = room_of(singles, n_padded);
    std::copy_n(all + at(b.first), at(b.n_columns), y);
    const int* below = below_.data() + b.below;
    for (int i = 0; i < b.n_below; ++i) std::copy_n(all + at(below[i]), row, y + at(b.n_columns + i));
    std::fill(y + n_rows * row, y + n_padded * row, 0.0);
    for (size_t i = at(b.n_columns); i < n_padded * row && is_single; ++i) rows[i] = static_cast<float>(y[i]);
    for (int p = (b.n_columns - 1) / Panels::width; p >= 0; --p) {
      const size_t panel = b.first_panel + static_cast<size_t>(p), here = at(p * Panels::width);
      is_single ? panels_.backward(panel, y + here, rows + here) : panels_.backward(panel, y + here, row / 8);
    }
    std::copy_n(y, at(b.n_columns), all + at(b.first));
  }
  separate(all, n, x);
}

void SymmetricOperator::multiply_together(std::span<const double* const> x, std::span<double* const> y) const {
  CHECK(x.size() == y.size() && x.size() <= row, "at most sixteen vectors side by side");
  const auto n_padded = static_cast<size_t>(n_ + Panels::height);
  double* out = room_of(all_rows, n_padded);
  std::fill_n(out, n_padded * row, 0.0);
  if (panels_.precision() == Precision::double_precision) {
    double* in = room_of(rows_of_block, n_padded);
    interleave(x, n_, in);
    std::fill(in + at(n_), in + n_padded * row, 0.0);
    for (size_t p = 0; p < panels_.size(); ++p) {
      const size_t here = p * Panels::width * row;
      panels_.multiply_together(p, in + here, out + here);
    }
  } else {
    float* in = room_of(singles, 2 * n_padded);
    float* left = in + n_padded * row;
    interleave(x, n_, in);
    std::fill(in + at(n_), left + n_padded * row, 0.0f);
    for (size_t p = 0; p < panels_.size(); ++p) {
      const size_t here = p * Panels::width * row;
      if (p > 0 && p % most_panels == 0) flush(left, n_padded * row, out);
      panels_.multiply_together(p, in + here, left + here, out + here);
    }
    flush(left, n_padded * row, out);
  }
  separate(out, n_, y);
}

void SpdInverse::substitute_together(std::span<const double* const> x, std::span<double* const> y) const {
  const auto n_padded = static_cast<size_t>(n_ + Panels::height);
  double* all = room_of(all_rows, n_padded);
  interleave(x, n_, all);
  std::fill(all + at(n_), all + n_padded * row, 0.0);
  for (size_t p = 0; p < factor_.size(); ++p) factor_.forward(p, all + p * Panels::width * row, row / 8);
  // What forward substitution left behind the last row is not part of the sums.
  std::fill(all + at(n_), all + n_padded * row, 0.0);
  for (size_t p = factor_.size(); p-- > 0;) factor_.backward(p, all + p * Panels::width * row, row / 8);
  separate(all, n_, y);
}

}  // namespace dygita
