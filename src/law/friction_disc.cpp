#include "law/friction_disc.hpp"

#include <algorithm>
#include <cmath>

namespace dygita {

DiscForce project_on_disc(const Eigen::Vector2d& s, const Eigen::Vector2d& y, double limit) {
  const auto force_at = [&](double lambda) {
    Eigen::Vector2d f = Eigen::Vector2d::Zero();
    for (int d = 0; d < 2; ++d)
      if (y[d] > 0.0) f[d] = s[d] / (y[d] + lambda);
    return f;
  };
  if (limit <= 0.0) return {Eigen::Vector2d::Zero(), 0.0};
  const Eigen::Vector2d stick = force_at(0.0);
  if (stick.norm() <= limit) return {stick, 0.0};

  // Newton on 1/|F| - 1/limit, nearly linear in lambda and convex: from the left it climbs without overshoot.
  double lambda = 0.0;
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector2d f = force_at(lambda);
    const double norm = f.norm();
    if (std::abs(norm - limit) <= 1e-14 * limit) break;
    double slope = 0.0;  // -d(|F|^2)/(2 d lambda)
    for (int d = 0; d < 2; ++d)
      if (y[d] > 0.0) slope += f[d] * f[d] / (y[d] + lambda);
    lambda = std::max(0.0, lambda + (norm / limit - 1.0) * norm * norm / slope);
  }
  const Eigen::Vector2d f = force_at(lambda);
  return {f * (limit / f.norm()), lambda};
}

}  // namespace dygita
