#include "law/tie.hpp"

#include <algorithm>

namespace dygita {

Vec3 closing_rate(const Trial& trial, const Increment& increment, double plastic_opening) {
  Vec3 c = -trial.jump / increment.dt;
  c[0] += (plastic_opening - trial.shortening) / increment.dt;
  return c;
}

Vec3 force_for_rate(const Trial& trial, const Vec3& c) {
  Vec3 force = Vec3::Zero();
  for (int d = 0; d < 3; ++d)
    if (trial.y[d] > 0.0) force[d] = (trial.s[d] - c[d]) / trial.y[d];
  return force;
}

LawState held_end(const Trial& trial, const LawState& start, const Vec3& force) {
  LawState end = start;
  end.rate = trial.s - trial.y.cwiseProduct(force);
  end.force = force;
  end.status = PointState::stick;
  return end;
}

double energy_of_springs(const SpringPoint& point, int first, int end) {
  double sum = 0.0;
  for (int d = first; d < end; ++d)
    if (point.stiffness[d] > 0.0) sum += 0.5 * point.now.force[d] * point.now.force[d] / point.stiffness[d];
  return sum;
}

// What holds does not open and close: it can be as stiff as the cells behind it without making impacts chatter.
Vec3 TieSprings::stiffness(double, double cells, double penalty) const {
  return Vec3::Constant(std::max(1.0, penalty) * cells);
}

void TieSprings::move(SpringPoint& point, const Vec3& jump) const {
  point.now.force += point.stiffness.cwiseProduct(jump - point.jump);
  point.now.status = PointState::stick;
}

}  // namespace dygita
