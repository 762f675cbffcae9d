#include "numerics/tridiagonal.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dygita {

namespace {

struct Pivot {
  double value, slope;
};

// The last pivot of T - x, which is zero at the eigenvalues of T; with its slope, 1 / (last entry)^2 there. Beyond the
// largest eigenvalue of all rows but the last it falls from infinity, and all pivots before it are negative.
Pivot last_pivot(const std::vector<double>& diagonal, const std::vector<double>& squares, double x) {
  Pivot pivot{diagonal[0] - x, -1.0};
  for (size_t i = 1; i < diagonal.size(); ++i) {
    if (pivot.value >= 0.0) return {std::numeric_limits<double>::infinity(), 0.0};
    const double share = squares[i] / pivot.value;
    pivot = {diagonal[i] - x - share, -1.0 + share * pivot.slope / pivot.value};
  }
  return pivot;
}

}  // namespace

void TopOfTridiagonal::add(double diagonal, double beside) {
  constexpr int most_rounds = 100;
  constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();
  const double before = diagonal_.empty() ? diagonal : value_;
  diagonal_.push_back(diagonal);
  squares_.push_back(diagonal_.size() == 1 ? 0.0 : beside * beside);
  if (squares_.back() == 0.0) {
    last_entry_ = diagonal >= before ? 1.0 : 0.0;
    value_ = std::max(before, diagonal);
    return;
  }
  double low = std::max(before, diagonal), high = low + std::abs(beside), x = high;
  Pivot pivot{};
  for (int i = 0; i < most_rounds; ++i) {
    pivot = last_pivot(diagonal_, squares_, x);
    (pivot.value < 0.0 ? high : low) = x;
    double next = x - pivot.value / pivot.slope;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    const bool is_close = std::abs(next - x) <= rounding * std::max(std::abs(low), std::abs(high));
    x = next;
    if (is_close) break;
  }
  // Where rounding hides what the row has changed, the pivot says nothing, and its entry is none to speak of.
  const bool is_hidden = x - before <= 8.0 * rounding * std::max(std::abs(low), std::abs(high));
  value_ = x;
  last_entry_ = is_hidden || pivot.slope >= 0.0 ? 0.0 : 1.0 / std::sqrt(-pivot.slope);
}

}  // namespace dygita
