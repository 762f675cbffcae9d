// Each interface is watched by one rank; displacements of its nodes elsewhere are brought there.
#pragma once

#include "ranks/neighbours.hpp"
#include "watch/moved_side.hpp"

namespace dygita {

class WatchedJumps {
 public:
  WatchedJumps() = default;
  // Collective. surfaces: the same on all ranks, which outlive this.
  WatchedJumps(const Cut& cut, const std::vector<const Surface*>& surfaces);
  // Rank that watches one of them: who has the first node of its first side.
  const std::vector<int>& watchers() const { return watchers_; }
  // Collective. Displacement of the second side of each against the first, 3 x n_points, m; empty of those that others
  // watch.
  std::vector<Points> take(const Instant& instant);

 private:
  // Of a side that is watched here or has nodes here.
  struct Passed {
    int first;  // of its nodes, in passing_
    std::map<int, Cut::OnOwner> on_owner;
  };
  int pass(const Cut& cut, const MovedSide& side, int watcher, std::vector<int>& owner,
           std::vector<std::vector<int>>& readers);

  std::vector<MovedSides> sides_;
  std::vector<int> watchers_;
  std::vector<std::array<int, 2>> place_;  // of both sides of each, in passed_; -1: nothing is passed
  std::vector<Passed> passed_;
  std::vector<double> passing_;  // three numbers a node
  ranks::Neighbours exchange_;
};

}  // namespace dygita
