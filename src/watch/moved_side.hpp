// How one side of an interface moves at its points, asked of the nodes that carry them alone.
#pragma once

#include "step/observer.hpp"

namespace dygita {

class MovedSide {
 public:
  MovedSide() = default;
  // which: 1 or 2. The second side of a wall does not move.
  MovedSide(const Surface& surface, int which);
  // 3 x n_points, m.
  Points displacement(const Instant& instant) const;

  // The part, -1: it does not move; and its nodes that carry the points.
  int part() const { return part_; }
  const std::vector<int>& nodes() const { return nodes_; }
  // From the displacements of these, 3 x nodes.
  Points carried_by(const Points& at_nodes) const;

 private:
  int part_ = -1, n_points_ = 0;
  std::vector<int> nodes_;  // of the part
  SideTrace trace_;         // on nodes_
};

// Both sides of an interface.
struct MovedSides {
  MovedSides() = default;
  explicit MovedSides(const Surface& surface) : first(surface, 1), second(surface, 2) {}
  // Displacement of the second against the first, 3 x n_points, m.
  Points jump(const Instant& instant) const { return second.displacement(instant) - first.displacement(instant); }

  MovedSide first, second;
};

}  // namespace dygita
