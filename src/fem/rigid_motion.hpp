// What nodes move by as a rigid body.
#pragma once

#include "numerics/types.hpp"

namespace dygita {

// Small displacements, or velocities: moved + rotation x (x - middle).
struct NearestRigidMotion {
  Vec3 middle, moved, rotation;
};

// The one that is nearest to a field, by least squares. x, field: 3 x n, at least one node.
NearestRigidMotion nearest_rigid_motion(const Points& x, const Points& field);

// What is left of the field without it.
Points without_rigid_motion(Points field, const Points& x);

}  // namespace dygita
