#include <algorithm>
#include <cmath>

#include "law/law.hpp"

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

namespace {

// How fast the sides may come together at the end of the increment (m/s). In dynamics a gap may close, a penetration is
// not thrown back but for `push_out`, and sides that were parting may come back as fast: the mean of the two rates
// never opens under pressure, so the normal force never feeds energy in, and the gap is at worst what it was (manual,
// eq. L4).
double closing_speed(const Increment& increment, const LawState& start) {
  if (increment.is_static) return start.gap / increment.dt;
  const double gap = std::max(start.gap, increment.push_out * start.gap);
  const double parting = increment.g / (1.0 - increment.g) * start.rate[0];
  return parting > 0.0 ? std::max(gap / increment.dt, parting) : gap / increment.dt;
}

}  // namespace

Vec3 ContactLaw::force(const Trial& trial, const Increment& increment, const LawState& start) const {
  Vec3 force = Vec3::Zero();
  if (trial.y[0] <= 0.0) return force;
  const double closing = -closing_speed(increment, start);
  force[0] = std::min((trial.s[0] - closing) / trial.y[0], 0.0);
  if (friction_ > 0.0)
    force.tail<2>() = project_on_disc(trial.s.tail<2>(), trial.y.tail<2>(), friction_ * std::abs(force[0])).force;
  return force;
}

LawState ContactLaw::advance(const Trial& trial, const Increment& increment, const LawState& start,
                             const Vec3& force) const {
  LawState end = start;
  end.rate = trial.s - trial.y.cwiseProduct(force);
  const Vec3 moved = increment.dt * (increment.g * start.rate + (1.0 - increment.g) * end.rate);
  end.gap = start.gap + moved[0];
  end.force = force;
  const double limit = friction_ * std::abs(force[0]);
  if (force[0] == 0.0) {
    end.status = PointState::open;
  } else {
    if (friction_ > 0.0) end.slip.tail<2>() += moved.tail<2>();
    end.status = force.tail<2>().norm() >= (1.0 - 1e-9) * limit ? PointState::slip : PointState::stick;
  }
  return end;
}

}  // namespace dygita
