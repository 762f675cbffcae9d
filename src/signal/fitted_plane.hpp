// The plane through weighted heights that fits best.
#pragma once

#include <cmath>

namespace dygita {

// Of points (u, v, h) about an origin; where they lie on a line, their mean.
class FittedPlane {
 public:
  void add(double u, double v, double h, double weight) {
    const double x[3] = {1.0, u, v};
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) m_[i][j] += weight * x[i] * x[j];
      b_[i] += weight * x[i] * h;
    }
  }
  bool is_empty() const { return m_[0][0] == 0.0; }
  // At the origin; length: of what spreads far enough to have a slope.
  double height(double length) const {
    const double a = m_[1][1] - m_[0][1] * m_[0][1] / m_[0][0], b = m_[1][2] - m_[0][1] * m_[0][2] / m_[0][0],
                 c = m_[2][2] - m_[0][2] * m_[0][2] / m_[0][0];  // spread about the middle
    const double mean = b_[0] / m_[0][0], det = a * c - b * b;
    constexpr double narrow = 1e-6;
    if (!(det > narrow * std::pow(length * length * m_[0][0], 2))) return mean;
    const double p = b_[1] - m_[0][1] * mean, q = b_[2] - m_[0][2] * mean;
    return mean - ((c * p - b * q) * m_[0][1] + (a * q - b * p) * m_[0][2]) / (det * m_[0][0]);
  }

 private:
  double m_[3][3] = {}, b_[3] = {};
};

}  // namespace dygita
