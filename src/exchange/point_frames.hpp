// Frames of points, and which of their directions carry an unknown.
#pragma once

#include <optional>

#include "exchange/exchange.hpp"

namespace dygita {

// Axes that the frames of points follow. Parts that stand in several places at several angles take theirs along, so
// that their rows are the same ones in each of them (manual, equal substructures).
class FrameAxes {
 public:
  explicit FrameAxes(const Problem& problem);

  // Of a point at a place (m) where these substructures meet: of the one that has it first in its own coordinates.
  // Nothing where none of them turns.
  std::optional<Mat3> at(const std::vector<int>& parts, const Vec3& place) const;

 private:
  const Problem& problem_;
  std::vector<char> turns_;
};

// N and two tangents; t: the first of them, or zero for the one that the axes choose.
Mat3 frame_of(const Vec3& n, Vec3 t, const std::optional<Mat3>& axes);

// A direction is active where one of the ports is free and a law, or the tie of a group, acts.
void activate(const std::vector<Port>& ports, bool has_group, Point& point);

}  // namespace dygita
