// How explicit time integration takes a law (manual, eq. X8-X12).
#pragma once

#include <string>

#include "law/law_fwd.hpp"
#include "law/point.hpp"

namespace dygita {

// A point in one explicit step, its force one of the jump.
struct SpringPoint {
  double area = 0.0;              // m^2
  Vec3 stiffness = Vec3::Zero();  // N/m, the most there can be; zero in directions without force
  LawState start, now;            // at the step's start; the rate is not kept up to date
  double offset = 0.0;            // m, contact: force = stiffness (gap + offset) where that is negative
  Vec3 jump = Vec3::Zero();       // m, since the step's start
  double friction_work = 0.0;     // J, since last shown
};

// The form of a law that is a force of the jump: its own springs, or penalty springs in place of its conditions.
class PenaltyForm {
 public:
  virtual ~PenaltyForm() = default;
  // Stiffness (N/m) in each direction, which the time step has to reckon with. cells: N/m, of those behind the point;
  // penalty: the solver's setting.
  virtual Vec3 stiffness(double area, double cells, double penalty) const = 0;
  // Takes over what pressed, pulled or overlapped at the step's start; point.now is point.start.
  virtual void begin(SpringPoint& point) const = 0;
  // Moves point.now on to a jump (m, since the step's start), and the works. point.jump is the one before.
  virtual void move(SpringPoint& point, const Vec3& jump) const = 0;
  // Energy (J) in penalty springs, which the law knows nothing of.
  virtual double penalty_energy(const SpringPoint& point) const = 0;
  // Energy (J) that plasticity has dissipated since the beginning, and that is stored now.
  virtual double plastic_work(const LawState& state, double area) const = 0;
  virtual double stored_energy(const LawState& state, double area) const = 0;
};

// Energy (J) of the springs in the directions from `first` to `end`, if all are springs alone.
double energy_of_springs(const SpringPoint& point, int first = 0, int end = 3);

// A force of the jump, a force of the rate alone, or both; neither: the law cannot be had.
struct ExplicitForm {
  const PenaltyForm* springs = nullptr;
  const Law* rates = nullptr;  // the law itself or a part of it, with the inertia of the nodes in the place of search
                               // directions: without stiffness
  std::string refusal;         // why there is neither: "cannot be had by penalty springs"

  bool is_none() const { return !springs && !rates; }
};

}  // namespace dygita
