// A right-handed frame that begins with a given direction.
#pragma once

#include <Eigen/Geometry>

#include "numerics/types.hpp"

namespace dygita {

// e (unit) and two directions across it, the first across the axis of coordinates that e is least along.
inline Mat3 frame_along(const Vec3& e) {
  int least = 0;
  e.cwiseAbs().minCoeff(&least);
  Mat3 frame;
  frame.col(0) = e;
  frame.col(1) = e.cross(Vec3::Unit(least)).normalized();
  frame.col(2) = e.cross(frame.col(1));
  return frame;
}

}  // namespace dygita
