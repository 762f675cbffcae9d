#include "exchange/reach.hpp"

namespace dygita {

Reach::Reach(const Problem& problem, const Step& step, const Cut& cut, const std::vector<Surface>& surfaces,
             const std::vector<char>& explicit_pieces, std::vector<char> everywhere)
    : cut_(&cut), everywhere_(std::move(everywhere)) {
  std::vector<int> in_force;
  for (size_t s = 0; s < surfaces.size(); ++s) {
    points_.emplace_back(static_cast<size_t>(surfaces[s].n_points()), 0);
    if (takes_part(problem, step, surfaces[s])) in_force.push_back(static_cast<int>(s));
  }
  for (bool grows = true; grows;) {
    grows = false;
    for (const int s : in_force) grows |= grow(surfaces[static_cast<size_t>(s)], s, explicit_pieces);
    for (int part = 0; part < cut.n_parts(); ++part) grows |= grow_over_cuts(part);
  }
}

template <class Visit>
void Reach::for_each_copy(int part, int node, Visit&& visit) const {
  const Copy owner = cut_->owner(part, node);
  visit(NodeKey{owner.piece, owner.node});
  for (const Copy& copy : cut_->on_cuts(part).others_of(node)) visit(NodeKey{copy.piece, copy.node});
}

// visit(key, follows): a node that the point acts on, and whether what else acts on it depends on the point. Where
// faces match, groups and laws meet at nodes; where they do not, points share nodes: those of explicit pieces are
// solved together, the others each for itself.
template <class Visit>
void Reach::for_each_key(const Surface& surface, int point, const std::vector<char>& explicit_pieces,
                         Visit&& visit) const {
  for (const auto& [part, trace] :
       {std::pair{surface.part_1, &surface.facing.side_1}, std::pair{surface.part_2, &surface.facing.side_2}}) {
    if (part < 0) continue;
    if (surface.facing.matches()) {
      for_each_copy(part, trace->main_node(point), [&](const NodeKey& key) { visit(key, true); });
      continue;
    }
    for (int k = 0; k < trace->n_shares(point); ++k) {
      const Copy owner = cut_->owner(part, trace->share(point, k).node);
      visit(NodeKey{owner.piece, owner.node},
            !explicit_pieces.empty() && explicit_pieces[static_cast<size_t>(owner.piece)] != 0);
    }
  }
}

bool Reach::take(const NodeKey& key) { return !cut_->is_here(key.first) && distant_.insert(word_of(key)).second; }

// Has the reach grown by nodes of pieces elsewhere?
bool Reach::grow(const Surface& surface, int s, const std::vector<char>& explicit_pieces) {
  bool grows = false;
  std::vector<char>& taken = points_[static_cast<size_t>(s)];
  for (int i = 0; i < surface.n_points(); ++i) {
    if (taken[static_cast<size_t>(i)]) continue;
    bool is_touched = is_everywhere(s);
    for_each_key(surface, i, explicit_pieces, [&](const NodeKey& key, bool follows) {
      is_touched = is_touched || cut_->is_here(key.first) || (follows && has(key));
    });
    if (!is_touched) continue;
    taken[static_cast<size_t>(i)] = 1;
    for_each_key(surface, i, explicit_pieces,
                 [&](const NodeKey& key, bool follows) { grows = (follows && take(key)) || grows; });
  }
  return grows;
}

bool Reach::grow_over_cuts(int part) {
  bool grows = false;
  for (const int node : cut_->on_cuts(part).nodes()) {
    bool is_touched = false;
    for_each_copy(part, node, [&](const NodeKey& key) { is_touched = is_touched || has(key); });
    if (is_touched) for_each_copy(part, node, [&](const NodeKey& key) { grows = take(key) || grows; });
  }
  return grows;
}

}  // namespace dygita
