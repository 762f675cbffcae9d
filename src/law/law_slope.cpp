#include "law/law_slope.hpp"

#include <algorithm>
#include <cmath>

#include "numerics/dense.hpp"

namespace dygita {

Vec3 limited_force(const Law& law, const Trial& trial, const Increment& increment, const LawState& start,
                   const double* limit) {
  Vec3 force = law.force(trial, increment, start);
  if (!limit) return force;
  Trial limited = trial;
  limited.s[0] = *limit;
  force.tail<2>() = law.force(limited, increment, start).tail<2>();
  return force;
}

Mat3 slope_of(const Law& law, const Trial& trial, const Increment& increment, const LawState& start,
              const double* limit, double least) {
  const auto force_of = [&](const Trial& at) { return limited_force(law, at, increment, start, limit); };
  const Vec3 force = force_of(trial);
  const double reach =
      std::max({trial.s.cwiseAbs().maxCoeff(), trial.y.cwiseProduct(force).cwiseAbs().maxCoeff(), least});
  const double h = 1e-6 * reach;
  Mat3 slope = Mat3::Zero();
  for (int d = 0; d < 3; ++d) {
    if (trial.y[d] <= 0.0) continue;
    Trial moved = trial;
    moved.s[d] = trial.s[d] + h;
    const Vec3 up = (force_of(moved) - force) / h;
    moved.s[d] = trial.s[d] - h;
    const Vec3 down = (force - force_of(moved)) / h;
    slope.col(d) = up.norm() > down.norm() ? up : down;
  }
  return slope;
}

Mat3 stiffness_of(const Mat3& slope, const Vec3& y, bool sticks, const TangentBounds& bounds) {
  const Vec3 root = y.cwiseMax(0.0).cwiseSqrt();
  Mat3 scaled = root.asDiagonal() * slope * root.asDiagonal();
  scaled = (0.5 * (scaled + scaled.transpose())).eval();
  if (sticks && scaled(0, 0) > 0.5)
    for (const int d : {1, 2}) {
      scaled.row(d).setZero();
      scaled.col(d).setZero();
      scaled(d, d) = y[d] > 0.0 ? 1.0 : 0.0;
    }
  const PrincipalAxes modes = principal_axes(scaled);
  Vec3 stiffness;
  for (int i = 0; i < 3; ++i) {
    const double g = modes.values[i];
    stiffness[i] =
        g >= bounds.stiffest / (1.0 + bounds.stiffest) ? bounds.stiffest : std::max(bounds.softest, g / (1.0 - g));
  }
  Vec3 inverse_root = Vec3::Zero();
  for (int d = 0; d < 3; ++d)
    if (root[d] > 0.0) inverse_root[d] = 1.0 / root[d];
  const Mat3 half = inverse_root.asDiagonal() * modes.vectors;
  return half * stiffness.asDiagonal() * half.transpose();
}

// d F_t = a d s_n + G (d rate_t + Y d F_t), and d s_n = d F_n / g where g = d F_n / d s_n.
Vec3 following_of(const Mat3& slope, const Mat3& stiffness, const Vec3& y) {
  if (slope(0, 0) * y[0] < 0.5) return Vec3::Zero();
  const Vec3 own(0.0, slope(1, 0), slope(2, 0));
  const Vec3 way = (y.cwiseProduct(own) / slope(0, 0)).eval();
  Vec3 following = own / slope(0, 0) + stiffness.col(1) * way[1] + stiffness.col(2) * way[2];
  following[0] = 0.0;
  return following;
}

}  // namespace dygita
