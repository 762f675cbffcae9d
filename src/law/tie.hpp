// What laws that hold the jump itself have in common (manual, eq. L1, X11).
#pragma once

#include "law/law.hpp"

namespace dygita {

// Relative velocity (m/s) that brings the jump to its place at the end of the increment: shortened, and opened for good
// by `plastic_opening` (m).
Vec3 closing_rate(const Trial& trial, const Increment& increment, double plastic_opening);

// Force (N) that makes the relative velocity c.
Vec3 force_for_rate(const Trial& trial, const Vec3& c);

// State at the end with this force, nothing else having changed.
LawState held_end(const Trial& trial, const LawState& start, const Vec3& force);

// Springs that hold.
class TieSprings : public PenaltyForm {
 public:
  Vec3 stiffness(double area, double cells, double penalty) const override;
  void begin(SpringPoint&) const override {}
  void move(SpringPoint& point, const Vec3& jump) const override;
  double penalty_energy(const SpringPoint& point) const override { return energy_of_springs(point); }
  double plastic_work(const LawState&, double) const override { return 0.0; }
  double stored_energy(const LawState&, double) const override { return 0.0; }
};

}  // namespace dygita
