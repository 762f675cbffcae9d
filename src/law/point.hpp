// What a law and its users say to each other of one interface point over one time increment.
//
// Components are (N, T1, T2), N from side 1 to side 2; forces are nodal (N), on side 1; a prime is side 2.
#pragma once

#include <array>

#include "law/memory.hpp"
#include "numerics/time_scheme.hpp"

namespace dygita {

enum class PointState { open = 0, stick = 1, slip = 2 };  // a closed frictionless contact slips; a yielding bolt slips

// What a point remembers from increment to increment: what outputs and solvers read, and what the law alone does.
struct LawState {
  double gap = 0.0;              // m, contact: from the hat fields, so that closed is exactly closed
  double plastic_opening = 0.0;  // m, signed
  Vec3 slip = Vec3::Zero();      // m, relative tangential displacement while closed
  Vec3 rate = Vec3::Zero();      // m/s, V' - V at the end of the last increment
  Vec3 force = Vec3::Zero();     // N, of the last increment
  PointState status = PointState::stick;
  LawMemory memory;

  // Adds the memory of one of the surface points (global axes) that a point of this frame stands for, by its share of
  // the area. The rate is not taken: it restarts with each step.
  void add(const LawState& member, double share, const Mat3& frame);
  // The memory of such a surface point, in global axes.
  LawState member(double share, const Mat3& frame) const;
};

// The increment: what its scheme says of rates and motions, and what the solver wants of contact.
struct Increment : TimeScheme {
  double push_out = 0.0;  // b: share of a penetration thrown back per step
};

// The search problem of a point. y is zero where the law does not act, and where supports or prescribed motions have
// both sides: the rate is given there, and s is that.
struct Trial {
  Vec3 s = Vec3::Zero();  // m/s, r' - r with r = V - F/k
  Vec3 y = Vec3::Zero();  // m/(N s), 1/k + 1/k'
  std::array<bool, 3> is_given{};
  Vec3 jump = Vec3::Zero();  // m, u' - u at the start of the increment
  double shortening = 0.0;   // m, reached at the end of the increment
  double area = 0.0;         // m^2
};

// Where the energy of a point goes in an increment, J.
struct Work {
  double friction = 0.0, plastic = 0.0, damping = 0.0;  // dissipated
  double stored = 0.0;                                  // more than before
  double given = 0.0;                                   // by whatever drives the point, beside a shortening

  double dissipated() const { return friction + plastic + damping; }
  void add(const Work& other, double share = 1.0) {
    friction += share * other.friction;
    plastic += share * other.plastic;
    damping += share * other.damping;
    stored += share * other.stored;
    given += share * other.given;
  }
};

// Force (N) of a law that works over an increment, and the motion (m) of side 2 against side 1.
inline Vec3 working_force(const LawState& start, const LawState& end, const Increment& increment) {
  return increment.working(start.force, end.force);
}
inline Vec3 motion_of(const LawState& start, const LawState& end, const Increment& increment) {
  return increment.motion(start.rate, end.rate);
}

// A law seen by small motions about a state.
struct Tangent {
  std::array<bool, 3> holds{};    // no relative motion in this direction
  Vec3 damping = Vec3::Zero();    // Pa s/m, traction per relative velocity
  Vec3 stiffness = Vec3::Zero();  // Pa/m, traction per relative displacement
};

}  // namespace dygita
