// An interface law at one point over one time increment. Knows no mesh and no substructure.
//
// Components are (N, T1, T2), N from side 1 to side 2; forces are nodal (N), on side 1; a prime is side 2.
// A law turns the search problem  rate = s - Y F  into the force F and its own state at the end (manual, eq. L1-L6).
#pragma once

#include "numerics/types.hpp"

namespace dygita {

enum class PointState { open = 0, stick = 1, slip = 2 };  // a closed frictionless contact slips; a yielding bolt slips

// What a point remembers from increment to increment.
struct LawState {
  double gap = 0.0;                // m, contact: from the hat fields, so that closed is exactly closed
  double plastic_opening = 0.0;    // m, signed
  double hardening_opening = 0.0;  // m, accumulated: what hardens
  double opening_rate = 0.0;       // m/s, plastic, of the last dynamic increment; zero after a static one
  Vec3 slip = Vec3::Zero();        // m, relative tangential displacement while closed
  Vec3 rate = Vec3::Zero();        // m/s, V' - V at the end of the last increment
  Vec3 force = Vec3::Zero();       // N, of the last increment
  PointState status = PointState::stick;
};

// The increment: static steps have dt = 1, g = 0, rates are increments.
struct Increment {
  double dt = 1.0, g = 0.0;
  bool is_static = true;
  double push_out = 0.0;  // b: share of a penetration thrown back per step
};

// The search problem of a point. y is zero in directions that both sides have held: they carry no law.
struct Trial {
  Vec3 s = Vec3::Zero();     // m/s, r' - r with r = V - F/k
  Vec3 y = Vec3::Zero();     // m/(N s), 1/k + 1/k'
  Vec3 jump = Vec3::Zero();  // m, u' - u at the start of the increment
  double shortening = 0.0;   // m, reached at the end of the increment
  double area = 0.0;         // m^2
};

class Law {
 public:
  virtual ~Law() = default;
  // Does the law carry a force in this direction (0 normal, 1 and 2 tangents)? Others have no unknown.
  virtual bool acts_on(int direction) const = 0;
  // Force of the increment (N), a pure function of the trial and the state at its start.
  virtual Vec3 force(const Trial& trial, const Increment& increment, const LawState& start) const = 0;
  // State at the end of the increment, once `force` is accepted.
  virtual LawState advance(const Trial& trial, const Increment& increment, const LawState& start,
                           const Vec3& force) const = 0;
  // Energy (J) that plasticity has dissipated since the beginning.
  virtual double plastic_work(const LawState&, double /*area*/) const { return 0.0; }
  // Is the tangential work of this law friction?
  virtual bool rubs() const { return false; }
};

// Sides held together, the jump itself held (eq. L1): no drift, and the way a bolt is shortened.
class BondedLaw : public Law {
 public:
  bool acts_on(int) const override { return true; }
  Vec3 force(const Trial& trial, const Increment& increment, const LawState& start) const override;
  LawState advance(const Trial& trial, const Increment& increment, const LawState& start,
                   const Vec3& force) const override;
};

// Rigid-plastic in the normal direction, bonded in the tangents (eq. L2-L3). The plastic opening follows the same
// two-point sum as the jump does: with p + dt l the sides would be pushed apart at each yielding step, without bound at
// large steps.
class PlasticLaw : public BondedLaw {
 public:
  // yield (Pa), hardening (Pa per metre of plastic opening), compression: yields in compression too.
  PlasticLaw(double yield, double hardening, bool compression)
      : yield_(yield), hardening_(hardening), compression_(compression) {}
  Vec3 force(const Trial& trial, const Increment& increment, const LawState& start) const override;
  LawState advance(const Trial& trial, const Increment& increment, const LawState& start,
                   const Vec3& force) const override;
  double plastic_work(const LawState& state, double area) const override;

 private:
  double opening_rate(const Trial& trial, const Increment& increment, const LawState& start) const;
  double yield_, hardening_;
  bool compression_;
};

// Unilateral contact with Coulomb friction, dynamic impacts without push-out (eq. L4-L6).
class ContactLaw : public Law {
 public:
  explicit ContactLaw(double friction) : friction_(friction) {}
  bool acts_on(int direction) const override { return direction == 0 || friction_ > 0.0; }
  Vec3 force(const Trial& trial, const Increment& increment, const LawState& start) const override;
  LawState advance(const Trial& trial, const Increment& increment, const LawState& start,
                   const Vec3& force) const override;
  bool rubs() const override { return true; }

 private:
  double friction_;
};

// Force on the friction disc: F_d = s_d / (Y_d + lambda), lambda >= 0 so that |F| <= limit (eq. L6). Returns F and
// lambda.
struct DiscForce {
  Eigen::Vector2d force;
  double lambda;
};
DiscForce project_on_disc(const Eigen::Vector2d& s, const Eigen::Vector2d& y, double limit);

}  // namespace dygita
