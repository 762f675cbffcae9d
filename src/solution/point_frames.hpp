// Frames of points, and which of their directions carry an unknown.
#pragma once

#include "solution/exchange.hpp"

namespace dygita {

// N and two tangents; t: the first of them, or zero for any.
Mat3 frame_of(const Vec3& n, Vec3 t);

// A direction is active where one of the ports is free and a law, or the tie of a group, acts.
void activate(const std::vector<Port>& ports, bool has_group, Point& point);

}  // namespace dygita
