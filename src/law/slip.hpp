// Slip of a contact: how far its sides have moved on each other since they first touched.
#pragma once

#include "law/point.hpp"

namespace dygita {

// Adds a relative motion along the tangents (m). What the sides move while they are apart counts as well: whether each
// of many impacts falls on a time step must not tell how far they slide. A slip tells that they have touched.
inline void follow_slip(const Eigen::Vector2d& moved, bool touches, LawState& state) {
  if (touches || !state.slip.isZero(0.0)) state.slip.tail<2>() += moved;
}

}  // namespace dygita
