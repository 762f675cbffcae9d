#include "result/moved_side.hpp"

#include <algorithm>
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

std::vector<Points> jumps_of(const std::vector<const MovedSides*>& interfaces, const Instant& instant) {
  std::vector<Points> jumps;
  if (ranks::is_alone()) {
    for (const MovedSides* sides : interfaces) jumps.push_back(sides->jump(instant));
    return jumps;
  }
  // The nodes of each side on the pieces that own them, one after the other.
  const Cut& cut = *instant.model.cut;
  std::vector<const MovedSide*> all;
  for (const MovedSides* sides : interfaces) all.insert(all.end(), {&sides->first, &sides->second});
  std::vector<int> owner, offset{0};
  std::vector<double> values;
  for (const MovedSide* side : all) {
    if (side->part() < 0) continue;
    for (const auto& [piece, on] : cut.on_owners(side->part(), side->nodes())) {
      owner.push_back(cut.piece(piece).rank);
      offset.push_back(offset.back() + 3 * static_cast<int>(on.nodes.size()));
      values.resize(static_cast<size_t>(offset.back()));
      if (!cut.is_here(piece)) continue;
      const Points own = instant.model.pieces[static_cast<size_t>(piece)]->displacement(on.nodes);
      std::copy_n(own.data(), own.size(), values.end() - own.size());
    }
  }
  ranks::Segments(owner, offset).complete(values.data());
  const double* next = values.data();
  const auto moved = [&](const MovedSide& side, int n_points) -> Points {
    if (side.part() < 0) return Points::Zero(3, n_points);
    Points at_nodes(3, static_cast<Eigen::Index>(side.nodes().size()));
    for (const auto& [piece, on] : cut.on_owners(side.part(), side.nodes()))
      for (const int at : on.at) at_nodes.col(at) = Eigen::Map<const Vec3>(next), next += 3;
    return side.carried_by(at_nodes);
  };
  for (const MovedSides* sides : interfaces) {
    const Points first = moved(sides->first, 0);
    jumps.push_back(moved(sides->second, static_cast<int>(first.cols())) - first);
  }
  return jumps;
}

}  // namespace dygita
