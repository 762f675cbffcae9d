// Direct points on several ranks. Each solves those that touch its pieces: points on nodes of two ranks are solved by
// both, from the same numbers, and booked by one. Motions of nodes pass in every increment, to neighbours alone.
#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "base/error.hpp"
#include "latin/direct_points.hpp"
#include "solution/all_pieces.hpp"
#include "solution/direct_links.hpp"

namespace dygita {

namespace {

constexpr size_t n_motion = 6, n_start = 18;  // numbers of a node: D and V; also U_start and its compliance

}  // namespace

void DirectPoints::find_motions(const StepModel& model) {
  if (ranks::is_alone() || !model.has_explicit()) return;
  std::vector<int> standing;
  for (int i = 0; i < model.cut->n_pieces(); ++i) {
    const std::vector<int> nodes =
        model.integration.is_explicit_piece(i) ? direct_nodes(*model.cut, model.exchange, i) : std::vector<int>();
    standing.push_back(static_cast<int>(n_start * nodes.size()));
    for (size_t n = 0; n < nodes.size(); ++n) {
      auto* of_piece = dynamic_cast<ExplicitNodes*>(model.pieces[i].get());
      motions_.push_back({i, of_piece->index_of(nodes[n]), of_piece, model.cut->is_here(i)});
    }
  }
  of_starts_ = segments_of(*model.cut, standing);
}

// Of the exchange's points those that touch a piece that is here, and those that these share nodes with.
std::vector<char> DirectPoints::points_near(const StepModel& model) {
  const std::vector<Point>& points = model.exchange.points;
  std::vector<char> is_near(points.size(), 1);
  if (ranks::is_alone()) return is_near;
  std::vector<int> root(points.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  std::map<std::pair<int, int>, int> first_at;  // by piece and node
  for (int i = 0; i < static_cast<int>(points.size()); ++i)
    for (int p = points[i].first_port; p < points[i].end_port && points[i].is_direct; ++p) {
      const Port& port = model.exchange.ports[p];
      for (const int node : piece_nodes(*model.cut, port))
        root[find(i)] = find(first_at.emplace(std::pair(port.piece, node), i).first->second);
    }
  std::vector<char> touches(points.size(), 0);
  for (int i = 0; i < static_cast<int>(points.size()); ++i)
    for (int p = points[i].first_port; p < points[i].end_port; ++p)
      if (model.cut->is_here(model.exchange.ports[p].piece)) touches[find(i)] = 1;
  for (int i = 0; i < static_cast<int>(points.size()); ++i) is_near[i] = touches[find(i)];
  return is_near;
}

// Who reads the motion of which node.
void DirectPoints::find_readers() {
  const Exchange& exchange = model_->exchange;
  const auto rank_of = [&](int port) { return model_->cut->piece(exchange.ports[ports_[port].index].piece).rank; };
  std::map<std::pair<const ExplicitNodes*, int>, std::set<int>> readers_of;
  const auto share = [&](const std::vector<int>& members) {
    std::set<int> solving;
    for (const int i : members)
      for (int p = points_[i].side_1.first; p < points_[i].side_2.end; ++p) solving.insert(rank_of(p));
    for (const int i : members)
      for (int p = points_[i].side_1.first; p < points_[i].side_2.end; ++p)
        for_each_node(ports_[p], [&](int node) {
          readers_of[{ports_[p].nodes, node}].insert(solving.begin(), solving.end());
        });
  };
  for (const int i : alone_) share({i});
  for (const std::vector<int>& members : clusters_) share(members);
  std::vector<Motions> passed;
  std::vector<int> owner;
  std::vector<std::vector<int>> readers;
  for (const Motions& motion : motions_) {
    const std::set<int>& reading = readers_of[{motion.nodes, motion.index}];
    if (motion.is_here ? reading.size() < 2 : !reading.contains(ranks::me())) continue;
    passed.push_back(motion);
    owner.push_back(model_->cut->piece(motion.piece).rank);
    readers.emplace_back(reading.begin(), reading.end());
  }
  motions_ = std::move(passed);
  of_motions_ = ranks::Neighbours(owner, readers, static_cast<int>(n_motion));
  told_.resize(n_motion * motions_.size());
  for (const Motions& motion : motions_)
    if (motion.is_here && (border_pieces_.empty() || border_pieces_.back() != motion.piece))
      border_pieces_.push_back(motion.piece);
}

void DirectPoints::tell() {
  if (motions_.empty()) return;
  for (size_t i = 0; i < motions_.size(); ++i)
    if (motions_[i].is_here) motions_[i].nodes->tell_motion(motions_[i].index, told_.data() + n_motion * i);
  of_motions_.begin(told_.data());
}

void DirectPoints::hear() {
  if (motions_.empty()) return;
  of_motions_.end(told_.data());
  for (size_t i = 0; i < motions_.size(); ++i)
    if (!motions_[i].is_here) motions_[i].nodes->hear_motion(motions_[i].index, told_.data() + n_motion * i);
}

void DirectPoints::complete_starts() {
  if (motions_.empty()) return;
  told_.assign(n_start * motions_.size(), 0.0);
  for (size_t i = 0; i < motions_.size(); ++i) {
    if (!motions_[i].is_here) continue;
    motions_[i].nodes->tell_start(motions_[i].index, told_.data() + n_start * i);
    Eigen::Map<Mat3>(told_.data() + n_start * i + 3) = motions_[i].nodes->node_compliance(motions_[i].index);
    motions_[i].nodes->tell_motion(motions_[i].index, told_.data() + n_start * i + 12);
  }
  of_starts_.complete(told_.data());
  for (size_t i = 0; i < motions_.size(); ++i) {
    auto* distant = dynamic_cast<DistantNodes*>(model_->pieces[motions_[i].piece].get());
    if (!distant) continue;
    distant->hear_start(motions_[i].index, told_.data() + n_start * i);
    distant->set_compliance(motions_[i].index, Eigen::Map<const Mat3>(told_.data() + n_start * i + 3));
    distant->hear_motion(motions_[i].index, told_.data() + n_start * i + 12);
  }
}

}  // namespace dygita
