#include "numerics/gmres.hpp"

#include <cmath>
#include <vector>

namespace dygita {

namespace {

// Makes the second of two numbers zero.
struct Rotation {
  double c = 1.0, s = 0.0;
  Rotation(double a, double b) {
    const double size = std::hypot(a, b);
    if (size > 0.0) c = a / size, s = b / size;
  }
  void turn(double& a, double& b) const {
    const double first = c * a + s * b;
    b = c * b - s * a;
    a = first;
  }
};

}  // namespace

std::optional<Vec> gmres(const GmresSystem& system, const Vec& b, double tolerance, int most) {
  const double size = b.norm();
  if (size == 0.0) return Vec(Vec::Zero(b.size()));
  std::vector<Vec> basis{b / size};
  std::vector<Rotation> rotations;
  Mat triangle = Mat::Zero(most + 1, most);
  Vec left = Vec::Zero(most + 1);
  left[0] = size;
  for (int k = 0; k < most; ++k) {
    Vec next = system.times(system.precondition(basis.back()));
    for (int i = 0; i <= k; ++i) {
      triangle(i, k) = next.dot(basis[static_cast<size_t>(i)]);
      next -= triangle(i, k) * basis[static_cast<size_t>(i)];
    }
    triangle(k + 1, k) = next.norm();
    const bool is_invariant = triangle(k + 1, k) <= 1e-14 * triangle.col(k).norm();
    if (!is_invariant) basis.push_back(next / triangle(k + 1, k));
    for (int i = 0; i < k; ++i) rotations[static_cast<size_t>(i)].turn(triangle(i, k), triangle(i + 1, k));
    rotations.emplace_back(triangle(k, k), triangle(k + 1, k));
    rotations.back().turn(triangle(k, k), triangle(k + 1, k));
    rotations.back().turn(left[k], left[k + 1]);
    if (!std::isfinite(left[k + 1]) || triangle(k, k) == 0.0) return std::nullopt;
    if (std::abs(left[k + 1]) > tolerance * size) {
      if (is_invariant) return std::nullopt;
      continue;
    }
    const Vec weights = triangle.topLeftCorner(k + 1, k + 1).triangularView<Eigen::Upper>().solve(left.head(k + 1));
    Vec sum = Vec::Zero(b.size());
    for (int i = 0; i <= k; ++i) sum += weights[i] * basis[static_cast<size_t>(i)];
    return system.precondition(sum);
  }
  return std::nullopt;
}

}  // namespace dygita
