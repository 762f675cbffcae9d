#include "step/alike_parts.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "interfaces/node_groups.hpp"
#include "model/model.hpp"

namespace dygita {

namespace {

// Calls back with each node that a point of a surface moves with, as (substructure, node).
template <typename Visit>
void for_each_node(const Surface& surface, int point, Visit&& visit) {
  const auto of_side = [&](const SideTrace& side, int part) {
    if (part < 0) return;
    for (int k = 0; k < side.n_shares(point); ++k) visit(NodeKey{part, side.share(point, k).node});
  };
  of_side(surface.facing.side_1, surface.part_1);
  if (surface.part_2 >= 0) of_side(surface.facing.side_2, surface.part_2);
}

class Finder {
 public:
  Finder(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces) {
    for (const Surface& s : surfaces)
      if (takes_part(problem, step, s)) link(s);
    root_.resize(problem.substructures.size());
    std::iota(root_.begin(), root_.end(), 0);
  }

  AlikeParts find() {
    std::map<int, const Surface*> binding;  // of linked nodes
    for (const auto& [key, surface] : spread_) binding.emplace(linked_.of(key), surface);
    AlikeParts alike;
    alike.interfaces.resize(root_.size());
    std::map<int, int> first_of;  // of linked nodes, a substructure
    for (const NodeKey& key : std::vector<NodeKey>(linked_.keys())) {
      const int links = linked_.of(key);
      const auto it = binding.find(links);
      if (it == binding.end()) continue;
      if (alike.interfaces[static_cast<size_t>(key.first)].empty())
        alike.interfaces[static_cast<size_t>(key.first)] = it->second->name();
      root_[static_cast<size_t>(root(first_of.emplace(links, key.first).first->second))] = root(key.first);
    }
    for (int i = 0; i < static_cast<int>(root_.size()); ++i) alike.group.push_back(root(i));
    return alike;
  }

 private:
  void link(const Surface& surface) {
    for (int i = 0; i < surface.n_points(); ++i) {
      NodeKey first{-1, -1};
      for_each_node(surface, i, [&](const NodeKey& key) {
        if (first.first < 0) first = key;
        linked_.tie(first, key);
      });
      if (!surface.facing.matches()) spread_.emplace_back(first, &surface);
    }
  }
  int root(int i) {
    while (root_[static_cast<size_t>(i)] != i) i = root_[static_cast<size_t>(i)];
    return i;
  }

  NodeGroups linked_;
  std::vector<std::pair<NodeKey, const Surface*>> spread_;
  std::vector<int> root_;
};

}  // namespace

AlikeParts find_alike(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces) {
  if (std::any_of(surfaces.begin(), surfaces.end(),
                  [&](const Surface& s) { return !s.facing.matches() && takes_part(problem, step, s); }))
    return Finder(problem, step, surfaces).find();
  AlikeParts alike;
  alike.group.resize(problem.substructures.size());
  std::iota(alike.group.begin(), alike.group.end(), 0);
  alike.interfaces.resize(problem.substructures.size());
  return alike;
}

}  // namespace dygita
