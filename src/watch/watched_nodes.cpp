#include "watch/watched_nodes.hpp"

#include <algorithm>

#include "base/parallel.hpp"

namespace dygita {

WatchedNodes::WatchedNodes(const Cut& cut, std::vector<std::vector<int>> nodes)
    : nodes_(std::move(nodes)), taken_(nodes_.size()) {
  for (Points& taken : taken_) taken.resize(3, 0);
  if (!ranks::is_alone()) split_up(cut);
}

// Each rank asks the owners for what it lacks, and knows then who asks it.
void WatchedNodes::split_up(const Cut& cut) {
  struct Passed {
    int owner = ranks::me();
    std::vector<int> readers;
  };
  using Node = std::pair<int, int>;  // part, node: both sides of an exchange have them in one order
  std::map<Node, Passed> passed;
  std::vector<std::vector<int>> wanted(static_cast<size_t>(ranks::count()));
  std::map<int, std::map<int, Cut::OnOwner>> split;
  for (size_t i = 0; i < nodes_.size(); ++i) {
    const int part = static_cast<int>(i);
    std::map<int, Cut::OnOwner> on_owner = cut.on_owners(part, nodes_[i]);
    if (std::all_of(on_owner.begin(), on_owner.end(), [&](const auto& of) { return cut.is_here(of.first); })) continue;
    for (const auto& [piece, on] : on_owner) {
      if (cut.is_here(piece)) continue;
      const int owner = cut.piece(piece).rank;
      for (const int at : on.at) {
        const int node = nodes_[i][static_cast<size_t>(at)];
        passed[{part, node}] = {owner, {ranks::me()}};
        wanted[static_cast<size_t>(owner)].insert(wanted[static_cast<size_t>(owner)].end(), {part, node});
      }
    }
    split[part] = std::move(on_owner);
  }
  const std::vector<std::vector<int>> asked = ranks::swapped(wanted);
  for (size_t rank = 0; rank < asked.size(); ++rank)
    for (size_t k = 0; k < asked[rank].size(); k += 2)
      passed[{asked[rank][k], asked[rank][k + 1]}].readers.push_back(static_cast<int>(rank));
  std::vector<int> owner;
  std::vector<std::vector<int>> readers;
  std::map<Node, int> place;
  for (auto& [node, of] : passed) {
    const int at = place[node] = static_cast<int>(owner.size());
    owner.push_back(of.owner);
    readers.push_back(std::move(of.readers));
    if (of.owner != ranks::me()) continue;
    const Copy copy = cut.owner(node.first, node.second);
    asked_[copy.piece].nodes.push_back(copy.node);
    asked_[copy.piece].at.push_back(at);
  }
  for (auto& [part, on_owner] : split) {
    std::vector<int>& nodes = nodes_[static_cast<size_t>(part)];
    Split& own = split_.emplace_back(Split{part, {}, {}});
    for (auto& [piece, on] : on_owner) {
      if (cut.is_here(piece))
        own.here[piece] = std::move(on);
      else
        for (const int at : on.at) own.passed.emplace_back(at, place.at({part, nodes[static_cast<size_t>(at)]}));
    }
    taken_[static_cast<size_t>(part)].resize(3, static_cast<Eigen::Index>(nodes.size()));
    nodes = std::vector<int>();
  }
  passing_.resize(3 * owner.size());
  exchange_ = ranks::Neighbours(owner, readers, 3);
}

namespace {

Points of_part(const Instant& instant, int part, NodalField field) {
  return field == NodalField::displacement ? instant.displacement(part)
         : field == NodalField::velocity   ? instant.velocity(part)
                                           : instant.acceleration(part);
}

Points of_nodes(const Instant& instant, int part, const std::vector<int>& nodes, NodalField field) {
  return field == NodalField::displacement ? instant.displacement(part, nodes)
         : field == NodalField::velocity   ? instant.velocity(part, nodes)
                                           : instant.acceleration(part, nodes);
}

Points of_piece(const Instant& instant, int piece, const std::vector<int>& nodes, NodalField field) {
  const Piece& own = *instant.model.pieces[static_cast<size_t>(piece)];
  if (field == NodalField::velocity && instant.is_static())  // a displacement is called so there (Instant::velocity)
    return Points::Zero(3, static_cast<Eigen::Index>(nodes.size()));
  return field == NodalField::displacement ? own.displacement(nodes)
         : field == NodalField::velocity   ? own.velocity(nodes)
                                           : own.acceleration(nodes);
}

}  // namespace

void WatchedNodes::take(const Instant& instant, NodalField field) {
  const auto take_part = [&](int part) {
    const auto i = static_cast<size_t>(part);
    if (nodes_[i].empty()) return;
    const int n_nodes = instant.model.problem->substructures[i]->mesh->n_nodes();
    const bool is_all =
        static_cast<int>(nodes_[i].size()) == n_nodes && std::is_sorted(nodes_[i].begin(), nodes_[i].end());
    taken_[i] = is_all ? of_part(instant, part, field) : of_nodes(instant, part, nodes_[i], field);
  };
  parallel_for(static_cast<int>(nodes_.size()), take_part, Schedule::as_free, instant.fields ? 1 : 0);
  if (ranks::is_alone()) return;
  Eigen::Map<Points> all(passing_.data(), 3, static_cast<Eigen::Index>(passing_.size() / 3));
  for (const auto& [piece, asked] : asked_) all(Eigen::all, asked.at) = of_piece(instant, piece, asked.nodes, field);
  exchange_.exchange(passing_.data());
  for (const Split& split : split_) {
    Points& taken = taken_[static_cast<size_t>(split.part)];
    for (const auto& [piece, on] : split.here) taken(Eigen::all, on.at) = of_piece(instant, piece, on.nodes, field);
    for (const auto& [at, passed] : split.passed) taken.col(at) = all.col(passed);
  }
}

}  // namespace dygita
