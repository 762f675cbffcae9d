// Nodes that a rank looks at, whoever has them: motions of those elsewhere come from the ranks that own them.
#pragma once

#include "partition/all_pieces.hpp"
#include "ranks/neighbours.hpp"
#include "step/observer.hpp"

namespace dygita {

enum class NodalField { displacement, velocity, acceleration };

class WatchedNodes {
 public:
  WatchedNodes() = default;
  // Collective. nodes: of each part, those that this rank looks at, none twice.
  WatchedNodes(const Cut& cut, std::vector<std::vector<int>> nodes);
  // Collective.
  void take(const Instant& instant, NodalField field = NodalField::displacement);
  // Forgets what was taken at some of them, which are no places: 0.
  void clear(int part, const std::vector<int>& at) {
    for (const int i : at) taken_[static_cast<size_t>(part)].col(i).setZero();
  }
  // Of a part, as last taken: 3 x nodes, m; or what else was taken.
  const Points& displacement(int part) const { return field(part); }
  const Points& field(int part) const { return taken_[static_cast<size_t>(part)]; }

 private:
  // A part of whose nodes others own some.
  struct Split {
    int part;
    std::map<int, Cut::OnOwner> here;         // by piece
    std::vector<std::pair<int, int>> passed;  // place among the nodes, and in passing_
  };
  struct Asked {
    std::vector<int> nodes, at;  // of a piece that is here; in passing_
  };
  void split_up(const Cut& cut);

  std::vector<std::vector<int>> nodes_;  // of the parts all of whose nodes are here
  std::vector<Split> split_;
  std::map<int, Asked> asked_;   // by others, by piece
  std::vector<double> passing_;  // three numbers for each node that passes
  ranks::Neighbours exchange_;
  std::vector<Points> taken_;
};

}  // namespace dygita
