#include "watch/moved_side.hpp"

#include <tuple>

namespace dygita {

MovedSide::MovedSide(const Surface& surface, int which)
    : part_(which == 1 ? surface.part_1 : surface.part_2), n_points_(surface.n_points()) {
  if (part_ < 0) return;
  std::tie(trace_, nodes_) = (which == 1 ? surface.facing.side_1 : surface.facing.side_2).on_its_nodes();
}

Points MovedSide::displacement(const Instant& instant) const {
  return part_ < 0 ? Points::Zero(3, n_points_) : carried_by(instant.displacement(part_, nodes_));
}

Points MovedSide::carried_by(const Points& at_nodes) const {
  Points moved(3, n_points_);
  for (int i = 0; i < n_points_; ++i) moved.col(i) = trace_.at(i, at_nodes);
  return moved;
}

}  // namespace dygita
