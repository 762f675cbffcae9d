#include "result/watched_nodes.hpp"

#include <algorithm>
#include <numeric>

namespace dygita {

int watcher_of(const Cut& cut, int part) {
  std::map<int, Eigen::Index> n_nodes;
  for (int i = cut.first(part); i < cut.first(part) + cut.n_pieces(part); ++i)
    n_nodes[cut.piece(i).rank] += cut.piece(i).body->mesh->n_nodes();
  int most = n_nodes.begin()->first;
  for (const auto& [rank, n] : n_nodes)
    if (n > n_nodes[most]) most = rank;
  return most;
}

bool is_on_one_rank(const Cut& cut, int part) {
  for (int i = cut.first(part); i < cut.first(part) + cut.n_pieces(part); ++i)
    if (cut.piece(i).rank != cut.piece(cut.first(part)).rank) return false;
  return true;
}

std::vector<std::vector<int>> all_nodes(const Problem& problem) {
  std::vector<std::vector<int>> nodes;
  for (const SubstructurePtr& part : problem.substructures) {
    nodes.emplace_back(static_cast<size_t>(part->mesh->n_nodes()));
    std::iota(nodes.back().begin(), nodes.back().end(), 0);
  }
  return nodes;
}

WatchedNodes::WatchedNodes(const Cut& cut, std::vector<std::vector<int>> nodes)
    : nodes_(std::move(nodes)), taken_(nodes_.size()) {
  std::vector<int> owner;
  std::vector<std::vector<int>> readers;
  for (size_t i = 0; i < nodes_.size(); ++i) {
    const int part = static_cast<int>(i);
    if (!is_on_one_rank(cut, part)) {
      const int first = static_cast<int>(owner.size()), watcher = watcher_of(cut, part);
      for (const int node : nodes_[i]) {
        owner.push_back(cut.piece(cut.owner(part, node).piece).rank);
        readers.push_back({watcher});
      }
      split_.push_back({part, first, cut.on_owners(part, nodes_[i])});
      if (watcher == ranks::me()) taken_[i].resize(3, static_cast<Eigen::Index>(nodes_[i].size()));
      nodes_[i] = {};
    } else if (!is_watched_here(cut, part)) {
      nodes_[i] = {};
    }
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
  for (size_t i = 0; i < nodes_.size(); ++i) {
    if (nodes_[i].empty()) continue;
    const int part = static_cast<int>(i), n_nodes = instant.model.problem->substructures[i]->mesh->n_nodes();
    const bool is_all =
        static_cast<int>(nodes_[i].size()) == n_nodes && std::is_sorted(nodes_[i].begin(), nodes_[i].end());
    taken_[i] = is_all ? of_part(instant, part, field) : of_nodes(instant, part, nodes_[i], field);
  }
  if (split_.empty()) return;
  Eigen::Map<Points> all(passing_.data(), 3, static_cast<Eigen::Index>(passing_.size() / 3));
  for (const Split& split : split_)
    for (const auto& [piece, on] : split.on_owner) {
      if (!instant.model.cut->is_here(piece)) continue;
      const Points own = of_piece(instant, piece, on.nodes, field);
      for (size_t k = 0; k < on.at.size(); ++k) all.col(split.first + on.at[k]) = own.col(static_cast<Eigen::Index>(k));
    }
  exchange_.exchange(passing_.data());
  for (const Split& split : split_) {
    Points& of_part = taken_[static_cast<size_t>(split.part)];
    of_part = all.middleCols(split.first, of_part.cols());  // of none where it is not watched here
  }
}

}  // namespace dygita
