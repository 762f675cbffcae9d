#include "watch/watched_jumps.hpp"

#include <algorithm>

namespace dygita {

WatchedJumps::WatchedJumps(const Cut& cut, const std::vector<const Surface*>& surfaces) {
  for (const Surface* surface : surfaces) {
    sides_.emplace_back(*surface);
    const MovedSide& first = sides_.back().first;
    watchers_.push_back(cut.piece(cut.owner(first.part(), first.nodes().front()).piece).rank);
  }
  if (ranks::is_alone()) return;
  std::vector<int> owner;
  std::vector<std::vector<int>> readers;
  for (size_t i = 0; i < sides_.size(); ++i)
    place_.push_back({pass(cut, sides_[i].first, watchers_[i], owner, readers),
                      pass(cut, sides_[i].second, watchers_[i], owner, readers)});
  passing_.resize(3 * owner.size());
  exchange_ = ranks::Neighbours(owner, readers, 3);
}

// Nothing where neither it is watched here nor any of its nodes is, or where it is rigid.
int WatchedJumps::pass(const Cut& cut, const MovedSide& side, int watcher, std::vector<int>& owner,
                       std::vector<std::vector<int>>& readers) {
  if (side.part() < 0) return -1;
  Passed passed{static_cast<int>(owner.size()), cut.on_owners(side.part(), side.nodes())};
  const bool is_known =
      watcher == ranks::me() || std::any_of(passed.on_owner.begin(), passed.on_owner.end(),
                                            [&](const auto& of_piece) { return cut.is_here(of_piece.first); });
  if (!is_known) return -1;
  owner.resize(owner.size() + side.nodes().size());
  for (const auto& [piece, on] : passed.on_owner)
    for (const int at : on.at) owner[static_cast<size_t>(passed.first + at)] = cut.piece(piece).rank;
  readers.resize(owner.size(), {watcher});
  passed_.push_back(std::move(passed));
  return static_cast<int>(passed_.size()) - 1;
}

std::vector<Points> WatchedJumps::take(const Instant& instant) {
  std::vector<Points> jumps(sides_.size());
  if (ranks::is_alone()) {
    for (size_t i = 0; i < sides_.size(); ++i) jumps[i] = sides_[i].jump(instant);
    return jumps;
  }
  Eigen::Map<Points> all(passing_.data(), 3, static_cast<Eigen::Index>(passing_.size() / 3));
  for (const Passed& passed : passed_)
    for (const auto& [piece, on] : passed.on_owner) {
      if (!instant.model.cut->is_here(piece)) continue;
      const Points own = instant.model.pieces[static_cast<size_t>(piece)]->displacement(on.nodes);
      for (size_t k = 0; k < on.at.size(); ++k)
        all.col(passed.first + on.at[k]) = own.col(static_cast<Eigen::Index>(k));
    }
  exchange_.exchange(passing_.data());
  const auto moved = [&](const MovedSide& side, int place) {
    const int first = passed_[static_cast<size_t>(place)].first;
    return side.carried_by(all.middleCols(first, static_cast<Eigen::Index>(side.nodes().size())));
  };
  for (size_t i = 0; i < sides_.size(); ++i) {
    if (watchers_[i] != ranks::me()) continue;
    const Points first = moved(sides_[i].first, place_[i][0]);
    jumps[i] =
        (place_[i][1] < 0 ? Points(Points::Zero(3, first.cols())) : moved(sides_[i].second, place_[i][1])) - first;
  }
  return jumps;
}

}  // namespace dygita
