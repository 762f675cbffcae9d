// How explicit time integration takes a law (manual, eq. X8-X12).
#pragma once

#include <string>
#include <variant>

#include "law/point.hpp"

namespace dygita {

// A point with springs in place of the law's conditions, in one explicit step.
struct SpringPoint {
  double area = 0.0;              // m^2
  Vec3 stiffness = Vec3::Zero();  // N/m; zero in directions without force
  LawState start;                 // at the step's start
  double offset = 0.0;            // m, contact: force = stiffness (gap + offset) where that is negative
  Vec3 jump = Vec3::Zero();       // m, since the step's start
  Vec3 force = Vec3::Zero();      // N, now
  Vec3 slip = Vec3::Zero();       // m, now
  PointState status = PointState::open;
  double plastic = 0.0, accumulated = 0.0;  // m, openings since the step's start
  double friction_work = 0.0;               // J, since last shown
};

// The penalty form of a law.
class PenaltyForm {
 public:
  virtual ~PenaltyForm() = default;
  // Stiffness of the springs, of that of the cells behind the point; penalty: the solver's setting.
  virtual double stiffness_factor(double penalty) const = 0;
  // Takes over what pressed, pulled or overlapped at the step's start.
  virtual void begin(SpringPoint& point) const = 0;
  // Moves the point on to a jump (m, since the step's start): new force, state and works. point.jump is the one before.
  virtual void move(SpringPoint& point, const Vec3& jump) const = 0;
  // Energy (J) that plasticity has dissipated since the beginning.
  virtual double plastic_work(const LawState& state, double area) const = 0;
};

// The law itself, with the inertia of the nodes in the place of search directions: a law of rates, without stiffness.
struct AtNodesInertia {};

// No explicit form, and why: "cannot be had by penalty springs".
struct NoExplicitForm {
  std::string reason;
};

using ExplicitForm = std::variant<const PenaltyForm*, AtNodesInertia, NoExplicitForm>;

}  // namespace dygita
