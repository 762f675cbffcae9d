// A place of an assembly from near: the part that it is on, the parts around it as lines.
#pragma once

#include <vector>

#include "drawing/picture.hpp"

namespace dygita {

struct CloseUp {
  Picture picture;                         // of the part alone, undeformed; its number is that of the assembly
  std::vector<std::array<int, 4>> around;  // x1 y1 x2 y2, tenths of a pixel: sharp edges of the other parts
  std::array<int, 2> mark;                 // tenths of a pixel: the place
};

// From the first of eight sides from which the part does not hide its place (m, undeformed). values: at the part's
// nodes (empty: zero).
CloseUp make_close_up(const std::vector<SubstructurePtr>& parts, int part, const Vec3& place, const Vec& values);

}  // namespace dygita
