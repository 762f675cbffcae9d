// Nodes that move as one: copies on cuts, and both sides of ties whose nodes meet, of explicit substructures with a
// tuned mass. What pulls at any of them the mass spreads to the neighbours of all, so that neither a cut nor a tie
// changes the motion (manual, eq. S13).
#pragma once

#include "base/parallel.hpp"
#include "ranks/neighbours.hpp"
#include "step/step_model.hpp"

namespace dygita {

struct TiedNode {
  int piece, node;
  Mat3 turn;  // of its motions to those that the group has in common: that of a cyclic tie
};

class TiedNodes {
 public:
  // Before or after the pieces are made; the same on all ranks.
  explicit TiedNodes(const StepModel& model);

  // Of two nodes or more, none of them lumped.
  const std::vector<std::vector<TiedNode>>& groups() const { return groups_; }
  // Of each node of such a substructure: do its cells stay lumped? What other laws act on, or supports that are
  // non-reflecting or move, has a mass of its own.
  const std::vector<char>& keeps_lumped(int part) const { return lumped_[static_cast<size_t>(part)]; }

 private:
  bool is_concerned(int part) const { return part >= 0 && !lumped_[static_cast<size_t>(part)].empty(); }
  bool joins_nodes(const Surface& surface) const;
  void lump_where_supports_act(const StepModel& model, int part);

  const Problem* problem_;
  std::vector<std::vector<char>> lumped_;  // of each substructure; empty: not concerned
  std::vector<std::vector<TiedNode>> groups_;
};

// Sums over the groups' nodes, wherever their pieces are.
class TiedSums {
 public:
  struct Entry {
    TiedNode node;
    bool is_here;
  };

  TiedSums() = default;
  TiedSums(const StepModel& model, const std::vector<std::vector<TiedNode>>& groups);

  bool is_empty() const { return entries_.empty(); }
  const std::vector<Entry>& entries() const { return entries_; }
  // The first of its group: what belongs to all of them belongs to it once.
  bool is_first(size_t entry) const { return is_first_[entry] != 0; }
  // at(entry): a vector of a node that is here. give(entry, sum): the sum over its group, in the node's own axes.
  // Collective.
  template <class At, class Give>
  void sum(At&& at, Give&& give, int most_threads) {
    sum_turned([&](size_t e) { return Vec3(entries_[e].node.turn * at(e)); },
               [&](size_t e, const Vec3& sum) { give(e, Vec3(entries_[e].node.turn.transpose() * sum)); },
               most_threads);
  }
  // The same of a number.
  std::vector<double> sum(const std::vector<double>& of_entries);

 private:
  template <class At, class Give>
  void sum_turned(At&& at, Give&& give, int most_threads) {
    constexpr std::ptrdiff_t together = 256;
    const auto for_groups = [&](auto&& visit) {
      parallel_for_ranges(
          static_cast<std::ptrdiff_t>(first_.size()) - 1,
          [&](std::ptrdiff_t first, std::ptrdiff_t n) {
            for (auto g = static_cast<size_t>(first); g < static_cast<size_t>(first + n); ++g)
              visit(first_[g], first_[g + 1]);
          },
          together, most_threads);
    };
    for_groups([&](size_t first, size_t end) {
      for (size_t e = first; e < end; ++e)
        if (entries_[e].is_here) Eigen::Map<Vec3>(values_.data() + 3 * e) = at(e);
    });
    between_.begin(values_.data());
    between_.end(values_.data());
    for_groups([&](size_t first, size_t end) {
      Vec3 all = Vec3::Zero();
      for (size_t e = first; e < end; ++e) all += Eigen::Map<const Vec3>(values_.data() + 3 * e);
      for (size_t e = first; e < end; ++e)
        if (entries_[e].is_here) give(e, all);
    });
  }

  std::vector<Entry> entries_;
  std::vector<size_t> first_;  // entry of each group, and their number
  std::vector<char> is_first_;
  ranks::Neighbours between_;
  std::vector<double> values_;  // three an entry
};

}  // namespace dygita
