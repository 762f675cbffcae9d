#include "law/friction_disc.hpp"

#include <algorithm>
#include <cmath>

namespace dygita {

DiscForce project_on_disc(const Eigen::Vector2d& s, const Eigen::Vector2d& y, double limit, const GivenRates& given) {
  if (limit <= 0.0) return {Eigen::Vector2d::Zero(), 0.0};
  std::array<bool, 2> moves{};
  Eigen::Vector2d driven = Eigen::Vector2d::Zero(), kept = Eigen::Vector2d::Zero();
  for (int d = 0; d < 2; ++d) {
    const bool is_driven = given.is_given[d] && s[d] != 0.0;
    moves[d] = y[d] > 0.0 || is_driven;
    if (is_driven) driven[d] = s[d];
    if (given.is_given[d] && !is_driven) kept[d] = given.before[d];
  }
  const auto force_at = [&](double lambda) {
    Eigen::Vector2d f = Eigen::Vector2d::Zero();
    for (int d = 0; d < 2; ++d)
      if (moves[d]) f[d] = s[d] / (y[d] + lambda);
    return f;
  };
  if (driven.isZero(0.0)) {
    Eigen::Vector2d stick = force_at(0.0);
    if (stick.norm() <= limit) {
      const double room = std::sqrt(std::max(0.0, limit * limit - stick.squaredNorm())), rest = kept.norm();
      if (rest > 0.0) stick += std::min(1.0, room / rest) * kept;
      return {stick, 0.0};
    }
  }

  // Newton on 1/|F| - 1/limit, nearly linear in lambda and convex: from the left it climbs without overshoot.
  double lambda = driven.norm() / limit;
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector2d f = force_at(lambda);
    const double norm = f.norm();
    if (std::abs(norm - limit) <= 1e-14 * limit) break;
    double slope = 0.0;  // -d(|F|^2)/(2 d lambda)
    for (int d = 0; d < 2; ++d)
      if (moves[d]) slope += f[d] * f[d] / (y[d] + lambda);
    lambda = std::max(0.0, lambda + (norm / limit - 1.0) * norm * norm / slope);
  }
  const Eigen::Vector2d f = force_at(lambda);
  return {f * (limit / f.norm()), lambda};
}

}  // namespace dygita
