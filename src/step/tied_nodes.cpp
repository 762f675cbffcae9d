#include "step/tied_nodes.hpp"

#include <algorithm>
#include <map>

#include "pieces/absorbing_impedance.hpp"

namespace dygita {

namespace {

using PartNode = std::pair<int, int>;

// Union-find of nodes of substructures, whose motions are turned to one another.
class TurnedGroups {
 public:
  struct Member {
    PartNode node;
    Mat3 turn;
  };

  void tie(const PartNode& a, const PartNode& b, const Mat3& b_to_a) {
    const auto [root_a, of_a] = root(a);
    const auto [root_b, of_b] = root(b);
    const Mat3 between = of_a * b_to_a * of_b.transpose();
    if (root_a == root_b) {
      // A node on the axis of a cyclic tie is tied to itself, turned.
      if (!between.isIdentity(1e-9)) parents_[root_a].is_twisted = true;
      return;
    }
    parents_[root_b].parent = root_a;
    parents_[root_b].turn = between;
    parents_[root_a].is_twisted |= parents_[root_b].is_twisted;
  }
  // Each with all its members, in the order in which they came; twisted ones with those of `lump`.
  template <class Lump>
  std::vector<std::vector<Member>> groups(Lump&& lump) {
    std::vector<std::vector<Member>> of_roots(parents_.size());
    for (size_t i = 0; i < nodes_.size(); ++i) {
      const auto [at, turn] = root(nodes_[i]);
      if (parents_[at].is_twisted)
        lump(nodes_[i]);
      else
        of_roots[at].push_back({nodes_[i], turn});
    }
    std::erase_if(of_roots, [](const auto& members) { return members.empty(); });
    return of_roots;
  }

 private:
  struct Parent {
    size_t parent;
    Mat3 turn = Mat3::Identity();  // to it
    bool is_twisted = false;
  };
  std::pair<size_t, Mat3> root(const PartNode& node) {
    const auto [it, is_new] = index_.emplace(node, parents_.size());
    if (is_new) {
      parents_.push_back({parents_.size()});
      nodes_.push_back(node);
    }
    size_t at = it->second;
    Mat3 turn = Mat3::Identity();
    for (; parents_[at].parent != at; at = parents_[at].parent) turn = parents_[at].turn * turn;
    return {at, turn};
  }

  std::map<PartNode, size_t> index_;
  std::vector<Parent> parents_;
  std::vector<PartNode> nodes_;
};

// What its supports leave, turned.
Mat3 held_directions(const Conditions& conditions, const TurnedGroups::Member& member) {
  const Held* held = conditions.at(member.node.first, member.node.second);
  if (!held) return Mat3::Zero();
  const auto directions = (member.turn * held->directions.leftCols(held->n)).eval();
  return directions * directions.transpose();
}

bool moves_as_one_node(const SideTrace& side, int i) {
  return side.is_of_one_node(i) && side.share(i, 0).weight == 1.0;
}

}  // namespace

bool TiedNodes::joins_nodes(const Surface& surface) const {
  if (!is_concerned(surface.part_1) || !is_concerned(surface.part_2)) return false;
  // Damping by mass goes by the momenta of each.
  const auto alpha = [&](int part) {
    return problem_->substructures[static_cast<size_t>(part)]->material.damping.mass;
  };
  if (alpha(surface.part_1) != alpha(surface.part_2)) return false;
  if (!surface.law) return surface.facing.matches();
  if (!surface.interface || !surface.interface->cyclic || !surface.law->is_tie()) return false;
  for (int i = 0; i < surface.n_points(); ++i)
    if (!moves_as_one_node(surface.facing.side_1, i) || !moves_as_one_node(surface.facing.side_2, i)) return false;
  return true;
}

void TiedNodes::lump_where_supports_act(const StepModel& model, int part) {
  std::vector<char>& lumped = lumped_[static_cast<size_t>(part)];
  const Substructure& body = *model.problem->substructures[static_cast<size_t>(part)];
  for (const auto& [node, impedance] : absorbing_impedance(*model.problem, *model.step, body, true).of_nodes)
    lumped[static_cast<size_t>(node)] = 1;
  for (const auto& [node, held] : model.conditions.held[static_cast<size_t>(part)])
    for (int j = 0; j < held.n; ++j)
      if (!held.motion[static_cast<size_t>(j)].empty()) lumped[static_cast<size_t>(node)] = 1;
}

TiedNodes::TiedNodes(const StepModel& model) : problem_(model.problem), lumped_(model.problem->substructures.size()) {
  const Cut& cut = *model.cut;
  for (int part = 0; part < cut.n_parts(); ++part)
    if (model.integration.is_explicit_piece(cut.first(part)) &&
        model.integration.parts[static_cast<size_t>(part)].is_tuned)
      lumped_[static_cast<size_t>(part)].assign(
          static_cast<size_t>(model.problem->substructures[static_cast<size_t>(part)]->mesh->n_nodes()), 0);
  const auto lump = [&](const PartNode& node) {
    if (is_concerned(node.first)) lumped_[static_cast<size_t>(node.first)][static_cast<size_t>(node.second)] = 1;
  };
  TurnedGroups tied;
  for (int part = 0; part < cut.n_parts(); ++part) {
    if (!is_concerned(part)) continue;
    lump_where_supports_act(model, part);
    for (const int node : cut.on_cuts(part).nodes()) tied.tie({part, node}, {part, node}, Mat3::Identity());
  }
  for (const Surface& surface : *model.surfaces) {
    if (!takes_part(*model.problem, *model.step, surface)) continue;
    const Facing& facing = surface.facing;
    const bool joins = joins_nodes(surface);
    for (int i = 0; i < surface.n_points(); ++i) {
      if (joins) {
        tied.tie({surface.part_1, facing.side_1.main_node(i)}, {surface.part_2, facing.side_2.main_node(i)},
                 facing.side_2.block(i, 0));
        continue;
      }
      for (int k = 0; k < facing.side_1.n_shares(i); ++k) lump({surface.part_1, facing.side_1.share(i, k).node});
      for (int k = 0; surface.part_2 >= 0 && k < facing.side_2.n_shares(i); ++k)
        lump({surface.part_2, facing.side_2.share(i, k).node});
    }
  }
  for (const auto& members : tied.groups(lump)) {
    const Mat3 held = held_directions(model.conditions, members.front());
    if (std::any_of(members.begin(), members.end(), [&](const TurnedGroups::Member& member) {
          return keeps_lumped(member.node.first)[static_cast<size_t>(member.node.second)] ||
                 !held_directions(model.conditions, member).isApprox(held, 1e-9);
        })) {
      for (const TurnedGroups::Member& member : members) lump(member.node);
      continue;
    }
    std::vector<TiedNode>& group = groups_.emplace_back();
    for (const TurnedGroups::Member& member : members)
      for (const Copy& copy : cut.copies(member.node.first, member.node.second))
        group.push_back({copy.piece, copy.node, member.turn});
  }
}

TiedSums::TiedSums(const StepModel& model, const std::vector<std::vector<TiedNode>>& groups) {
  std::vector<int> owner;
  std::vector<std::vector<int>> readers;
  first_.push_back(0);
  for (const std::vector<TiedNode>& group : groups) {
    std::vector<int> ranks_of;
    for (const TiedNode& node : group) {
      owner.push_back(model.cut->piece(node.piece).rank);
      ranks_of.push_back(owner.back());
      entries_.push_back({node, model.solves(node.piece)});
      is_first_.push_back(entries_.size() == first_.back() + 1);
    }
    std::sort(ranks_of.begin(), ranks_of.end());
    ranks_of.erase(std::unique(ranks_of.begin(), ranks_of.end()), ranks_of.end());
    readers.resize(entries_.size(), ranks_of);
    first_.push_back(entries_.size());
  }
  if (entries_.empty()) return;
  between_ = ranks::Neighbours(owner, readers, 3);
  values_.assign(3 * entries_.size(), 0.0);
}

std::vector<double> TiedSums::sum(const std::vector<double>& of_entries) {
  std::vector<double> sums(of_entries);
  sum_turned([&](size_t e) { return Vec3::Constant(of_entries[e]).eval(); },
             [&](size_t e, const Vec3& sum) { sums[e] = sum[0]; }, 1);
  return sums;
}

}  // namespace dygita
