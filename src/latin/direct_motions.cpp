// Direct points on several ranks. Each solves those that touch its pieces: points on nodes of two ranks are solved by
// both, from the same numbers, and booked by one. Motions of nodes pass in every increment, to neighbours alone.
#include <algorithm>
#include <map>
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

// Points that touch a piece that is here, and those that they share nodes with; who reads the motion of which node.
void DirectPoints::find_near() {
  const Exchange& exchange = model_->exchange;
  const auto rank_of = [&](int port) { return model_->cut->piece(exchange.ports[ports_[port].index].piece).rank; };
  std::map<std::pair<const ExplicitNodes*, int>, std::set<int>> readers_of;
  std::vector<char> is_near(points_.size(), 0);
  const auto share = [&](const std::vector<int>& members) {
    std::set<int> solving;
    for (const int i : members)
      for (int p = points_[i].side_1.first; p < points_[i].side_2.end; ++p) solving.insert(rank_of(p));
    for (const int i : members) {
      is_near[i] = solving.contains(ranks::me());
      for (int p = points_[i].side_1.first; p < points_[i].side_2.end; ++p)
        for_each_node(ports_[p], [&](int node) {
          readers_of[{ports_[p].nodes, node}].insert(solving.begin(), solving.end());
        });
    }
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
  keep_near(is_near);
}

// All others are solved elsewhere.
void DirectPoints::keep_near(const std::vector<char>& is_near) {
  std::vector<int> place(points_.size(), -1);
  std::vector<OwnPoint> points;
  std::vector<OwnPort> ports;
  std::vector<Share> shares;
  for (size_t i = 0; i < points_.size(); ++i) {
    if (!is_near[i]) continue;
    place[i] = static_cast<int>(points.size());
    OwnPoint& p = points.emplace_back(std::move(points_[i]));
    const int moved = static_cast<int>(ports.size()) - p.side_1.first;
    for (int k = p.side_1.first; k < p.side_2.end; ++k) {
      OwnPort& port = ports.emplace_back(std::move(ports_[k]));
      const int first = static_cast<int>(shares.size());
      shares.insert(shares.end(), shares_.begin() + port.first_share, shares_.begin() + port.end_share);
      port.end_share = first + port.end_share - port.first_share;
      port.first_share = first;
    }
    for (int* at : {&p.side_1.first, &p.side_1.end, &p.side_2.first, &p.side_2.end}) *at += moved;
  }
  points_ = std::move(points);
  ports_ = std::move(ports);
  shares_ = std::move(shares);
  const auto keep = [&](std::vector<int>& all) {
    std::erase_if(all, [&](int i) { return place[i] < 0; });
    for (int& i : all) i = place[i];
  };
  keep(alone_);
  for (std::vector<int>& members : clusters_) keep(members);
  std::erase_if(clusters_, [](const std::vector<int>& members) { return members.empty(); });
  swept_.resize(clusters_.size());
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
