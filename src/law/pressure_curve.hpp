// The pressure with which rough faces resist an approach, beyond their first touch (manual, eq. L12).
#pragma once

#include <vector>

namespace dygita {

// Pa against m of approach: nothing before the faces touch, never falling after.
class PressureCurve {
 public:
  // Pa/m.
  static PressureCurve linear(double stiffness) { return PressureCurve({{0.0, stiffness, 0.0, 0.0}}); }
  // Through these points and none; straight beyond the last one.
  static PressureCurve through(const std::vector<double>& approach, const std::vector<double>& pressure);
  // Elastic tips whose heights are spread evenly over `height` (m): coefficient (Pa/m^2.5) times the power 5/2 of the
  // approach, less that of the tips which there are not beyond the height.
  static PressureCurve asperities(double coefficient, double height);

  double pressure(double approach) const;  // Pa
  double slope(double approach) const;     // Pa/m, of more approach
  double energy(double approach) const;    // J/m^2
  // The mean pressure over a way from one approach to another.
  double mean(double from, double to) const;
  // The approach beyond which the slope is larger, infinite where there is none.
  double approach_of_slope(double slope) const;

 private:
  struct Piece {
    double start, slope, pressure, energy;  // of both at its start
  };
  explicit PressureCurve(std::vector<Piece> pieces) : pieces_(std::move(pieces)) {}
  const Piece& piece_at(double approach) const;

  std::vector<Piece> pieces_;  // none: asperities
  double coefficient_ = 0.0, height_ = 0.0;
};

}  // namespace dygita
