// How the force of a law answers to motions, for methods that take slopes of laws (manual, eq. U1-U2).
#pragma once

#include "law/law.hpp"

namespace dygita {

// Between what slopes of a law are kept, in its search directions: what sticks is that much stiffer, open points that
// much softer. None of them moves the solution, since a tangent only multiplies the distance of the two stages.
// tie: of ties, which stay ties.
struct TangentBounds {
  double stiffest = 1e3, softest = 1e-3, tie = 1e3;
};

// Force of a law (N); with a limit, tangential forces are those that the normal trial (m/s; static m) `limit` allows.
Vec3 limited_force(const Law& law, const Trial& trial, const Increment& increment, const LawState& start,
                   const double* limit);

// d force / d s at the trial (N s/m; static N/m), by differences: exact where the law is piecewise linear. Where it has
// a kink the stiffer side counts: what just touches is closed. least: velocity (m/s; static m) below which differences
// tell nothing.
Mat3 slope_of(const Law& law, const Trial& trial, const Increment& increment, const LawState& start,
              const double* limit, double least);

// How tangential forces follow the normal one where the limit of friction does: d F_t / d F_n at fixed tangential
// motion (0 first, then both tangents). slope: d force / d s, without a limit; stiffness: of the same point, as
// stiffness_of has it.
Vec3 following_of(const Mat3& slope, const Mat3& stiffness, const Vec3& y);

// From d force / d s at fixed F + s/y to d force / d rate (N s/m; static N/m), symmetric, its eigenvalues times y
// between the bounds. sticks: what carries a normal force holds the tangents too.
Mat3 stiffness_of(const Mat3& slope, const Vec3& y, bool sticks, const TangentBounds& bounds);

}  // namespace dygita
