// A right-handed frame that begins with a given direction.
#pragma once

#include <Eigen/Geometry>

#include "numerics/types.hpp"

namespace dygita {

// e (unit) and two directions across it: the first near `tangent`, or, where that is zero, across the axis of
// coordinates that e is least along.
inline Mat3 frame_along(const Vec3& e, const Vec3& tangent = Vec3::Zero()) {
  int least = 0;
  e.cwiseAbs().minCoeff(&least);
  Mat3 frame;
  frame.col(0) = e;
  frame.col(1) =
      (tangent.isZero() ? Vec3(e.cross(Vec3::Unit(least))) : Vec3(tangent - e.dot(tangent) * e)).normalized();
  frame.col(2) = e.cross(frame.col(1));
  return frame;
}

}  // namespace dygita
