#include "law/law.hpp"

namespace dygita {

namespace {

// Relative velocity that brings the jump to its place at the end of the increment.
Vec3 closing_rate(const Trial& trial, const Increment& increment, double plastic_opening) {
  Vec3 c = -trial.jump / increment.dt;
  c[0] += (plastic_opening - trial.shortening) / increment.dt;
  return c;
}

Vec3 elastic_force(const Trial& trial, const Vec3& c) {
  Vec3 force = Vec3::Zero();
  for (int d = 0; d < 3; ++d)
    if (trial.y[d] > 0.0) force[d] = (trial.s[d] - c[d]) / trial.y[d];
  return force;
}

LawState common_end(const Trial& trial, const LawState& start, const Vec3& force) {
  LawState end = start;
  end.rate = trial.s - trial.y.cwiseProduct(force);
  end.force = force;
  end.status = PointState::stick;
  return end;
}

}  // namespace

Vec3 BondedLaw::force(const Trial& trial, const Increment& increment, const LawState& start) const {
  return elastic_force(trial, closing_rate(trial, increment, start.plastic_opening));
}

LawState BondedLaw::advance(const Trial& trial, const Increment&, const LawState& start, const Vec3& force) const {
  return common_end(trial, start, force);
}

double PlasticLaw::opening_rate(const Trial& trial, const Increment& increment, const LawState& start) const {
  const double z = trial.s[0] - closing_rate(trial, increment, start.plastic_opening)[0];
  // A dynamic force is the mean of the increment: it hardens with the opening half way, and its work is then exact.
  const double half = increment.is_static ? 1.0 : 0.5;
  const double hardened = start.hardening_opening + half * increment.g * increment.dt * std::abs(start.opening_rate);
  const double limit = trial.area * (yield_ + hardening_ * hardened);
  const double excess = (compression_ ? std::abs(z) : z) - trial.y[0] * limit;
  if (excess <= 0.0 || trial.y[0] <= 0.0) return 0.0;
  const double rate = excess / (1.0 + trial.y[0] * trial.area * hardening_ * half * (1.0 - increment.g) * increment.dt);
  return z < 0.0 ? -rate : rate;
}

Vec3 PlasticLaw::force(const Trial& trial, const Increment& increment, const LawState& start) const {
  Vec3 c = closing_rate(trial, increment, start.plastic_opening);
  c[0] += opening_rate(trial, increment, start);
  return elastic_force(trial, c);
}

LawState PlasticLaw::advance(const Trial& trial, const Increment& increment, const LawState& start,
                             const Vec3& force) const {
  LawState end = common_end(trial, start, force);
  const double rate = opening_rate(trial, increment, start), before = start.opening_rate;
  end.plastic_opening += increment.dt * (increment.g * before + (1.0 - increment.g) * rate);
  end.hardening_opening += increment.dt * (increment.g * std::abs(before) + (1.0 - increment.g) * std::abs(rate));
  end.opening_rate = increment.is_static ? 0.0 : rate;
  if (rate != 0.0) end.status = PointState::slip;
  return end;
}

double PlasticLaw::plastic_work(const LawState& state, double area) const {
  const double p = state.hardening_opening;
  return area * (yield_ * p + 0.5 * hardening_ * p * p);
}

}  // namespace dygita
