// Each part is watched by the rank that has most of it; displacements of its nodes elsewhere are brought there.
#pragma once

#include <memory>

#include "ranks/neighbours.hpp"
#include "solution/all_pieces.hpp"
#include "solution/observer.hpp"

namespace dygita {

// The rank with most nodes of a part, of several the first.
int watcher_of(const Cut& cut, int part);
inline bool is_watched_here(const Cut& cut, int part) { return watcher_of(cut, part) == ranks::me(); }
// Has one rank all of its pieces?
bool is_on_one_rank(const Cut& cut, int part);

// Numbers of all nodes of each part.
std::vector<std::vector<int>> all_nodes(const Problem& problem);

// Collective. n_of: numbers of each part; fill(part, at) writes them where the part is watched. Returns those of all
// parts, one after the other.
template <class Fill>
std::vector<double> of_all_parts(const Cut& cut, const std::vector<int>& n_of, Fill&& fill) {
  std::vector<int> owner, offset{0};
  for (size_t part = 0; part < n_of.size(); ++part) {
    owner.push_back(watcher_of(cut, static_cast<int>(part)));
    offset.push_back(offset.back() + n_of[part]);
  }
  std::vector<double> values(static_cast<size_t>(offset.back()), 0.0);
  for (size_t part = 0; part < n_of.size(); ++part)
    if (owner[part] == ranks::me()) fill(static_cast<int>(part), values.data() + offset[part]);
  ranks::Segments(owner, offset).complete(values.data());
  return values;
}

enum class NodalField { displacement, velocity, acceleration };

class WatchedNodes {
 public:
  WatchedNodes() = default;
  // Collective. nodes: of each part, none twice; all ranks name the same of a part that is on several,
  // others matter where they are watched alone.
  WatchedNodes(const Cut& cut, std::vector<std::vector<int>> nodes);
  // Collective.
  void take(const Instant& instant, NodalField field = NodalField::displacement);
  // Of a part that is watched here, as last taken: 3 x nodes, m; or what else was taken.
  const Points& displacement(int part) const { return field(part); }
  const Points& field(int part) const { return taken_[static_cast<size_t>(part)]; }

 private:
  // Of a part on several ranks.
  struct Split {
    int part, first;                       // first: of its nodes, in passing_
    std::map<int, Cut::OnOwner> on_owner;  // by piece
  };
  std::vector<std::vector<int>> nodes_;  // of the parts watched here that are on one rank
  std::vector<Split> split_;
  std::vector<double> passing_;  // three numbers for each node of the split parts
  ranks::Neighbours exchange_;
  std::vector<Points> taken_;
};

}  // namespace dygita
