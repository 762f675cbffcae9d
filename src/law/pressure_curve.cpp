#include "law/pressure_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dygita {

namespace {

// x^1.5, of what is positive.
double power_of_three_halves(double x) { return x > 0.0 ? x * std::sqrt(x) : 0.0; }

}  // namespace

PressureCurve PressureCurve::through(const std::vector<double>& approach, const std::vector<double>& pressure) {
  std::vector<Piece> pieces;
  double x = 0.0, p = 0.0, energy = 0.0;
  for (size_t i = 0; i < approach.size(); ++i) {
    const double slope = (pressure[i] - p) / (approach[i] - x);
    pieces.push_back({x, slope, p, energy});
    energy += 0.5 * (p + pressure[i]) * (approach[i] - x);
    x = approach[i];
    p = pressure[i];
  }
  return PressureCurve(std::move(pieces));
}

PressureCurve PressureCurve::asperities(double coefficient, double height) {
  PressureCurve curve({});
  curve.coefficient_ = coefficient;
  curve.height_ = height;
  return curve;
}

const PressureCurve::Piece& PressureCurve::piece_at(double approach) const {
  const auto next = std::upper_bound(pieces_.begin(), pieces_.end(), approach,
                                     [](double x, const Piece& piece) { return x < piece.start; });
  return *(next - 1);
}

double PressureCurve::pressure(double approach) const {
  if (!(approach > 0.0)) return 0.0;
  const double beyond = std::max(0.0, approach - height_);
  if (pieces_.empty())
    return coefficient_ * (approach * power_of_three_halves(approach) - beyond * power_of_three_halves(beyond));
  const Piece& piece = piece_at(approach);
  return piece.pressure + piece.slope * (approach - piece.start);
}

double PressureCurve::slope(double approach) const {
  if (approach < 0.0) return 0.0;
  if (!pieces_.empty()) return piece_at(approach).slope;
  return 2.5 * coefficient_ * (power_of_three_halves(approach) - power_of_three_halves(approach - height_));
}

double PressureCurve::energy(double approach) const {
  if (!(approach > 0.0)) return 0.0;
  const double beyond = std::max(0.0, approach - height_);
  if (pieces_.empty())
    return coefficient_ / 3.5 *
           (approach * approach * power_of_three_halves(approach) - beyond * beyond * power_of_three_halves(beyond));
  const Piece& piece = piece_at(approach);
  const double more = approach - piece.start;
  return piece.energy + more * (piece.pressure + 0.5 * piece.slope * more);
}

// Differences of the energy lose digits where both are near, and Simpson's rule loses none there.
double PressureCurve::mean(double from, double to) const {
  const double near = pieces_.empty() ? 1e-2 : 1e-6;
  if (std::abs(to - from) > near * std::max(std::abs(from), std::abs(to)))
    return (energy(to) - energy(from)) / (to - from);
  return (pressure(from) + 4.0 * pressure(0.5 * (from + to)) + pressure(to)) / 6.0;
}

double PressureCurve::approach_of_slope(double slope) const {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  if (!pieces_.empty()) return infinite;
  double low = 0.0, high = height_;
  while (this->slope(high) < slope) high *= 2.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (this->slope(middle) < slope ? low : high) = middle;
  }
  return low;
}

}  // namespace dygita
