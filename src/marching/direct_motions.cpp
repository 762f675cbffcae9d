// Direct points on several ranks. Each solves those that touch its pieces: points on nodes of two ranks are solved by
// both, from the same numbers, and booked by one. Motions of nodes pass in every increment, to neighbours alone.
#include <algorithm>

#include "base/error.hpp"
#include "exchange/direct_links.hpp"
#include "marching/direct_points.hpp"

namespace dygita {

namespace {

constexpr size_t n_motion = 6, n_start = 18;  // numbers of a node: D and V; also U_start and its compliance

}  // namespace

void DirectPoints::find_motions(const StepModel& model, const NearDirect& near) {
  std::vector<int> owner;
  std::vector<std::vector<int>> readers;
  for (const NearDirect::Node& node : near.nodes) {
    if (node.readers.size() < 2) continue;
    auto* of_piece = model.pieces[node.piece]->explicit_nodes();
    motions_.push_back({node.piece, of_piece->index_of(node.node), of_piece, model.cut->is_here(node.piece)});
    owner.push_back(model.cut->piece(node.piece).rank);
    readers.push_back(node.readers);
    if (motions_.back().is_here && (border_pieces_.empty() || border_pieces_.back() != node.piece))
      border_pieces_.push_back(node.piece);
  }
  complete_starts(ranks::Neighbours(owner, readers, static_cast<int>(n_start)));
  of_motions_ = ranks::Neighbours(owner, readers, static_cast<int>(n_motion));
  packed_ = std::vector<double>(n_motion * motions_.size());
}

void DirectPoints::tell() {
  if (motions_.empty()) return;
  for (size_t i = 0; i < motions_.size(); ++i)
    if (motions_[i].is_here) motions_[i].nodes->pack_motion(motions_[i].index, packed_.data() + n_motion * i);
  of_motions_.begin(packed_.data());
}

void DirectPoints::receive_motions() {
  if (motions_.empty()) return;
  of_motions_.end(packed_.data());
  for (size_t i = 0; i < motions_.size(); ++i)
    if (!motions_[i].is_here) motions_[i].nodes->unpack_motion(motions_[i].index, packed_.data() + n_motion * i);
}

void DirectPoints::complete_starts(const ranks::Neighbours& of_starts) {
  std::vector<double> packed(n_start * motions_.size(), 0.0);
  for (size_t i = 0; i < motions_.size(); ++i) {
    if (!motions_[i].is_here) continue;
    motions_[i].nodes->pack_start(motions_[i].index, packed.data() + n_start * i);
    Eigen::Map<Mat3>(packed.data() + n_start * i + 3) = motions_[i].nodes->node_compliance(motions_[i].index);
    motions_[i].nodes->pack_motion(motions_[i].index, packed.data() + n_start * i + 12);
  }
  of_starts.exchange(packed.data());
  for (size_t i = 0; i < motions_.size(); ++i) {
    if (motions_[i].is_here) continue;
    ExplicitNodes& distant = *motions_[i].nodes;
    distant.unpack_start(motions_[i].index, packed.data() + n_start * i);
    distant.set_compliance(motions_[i].index, Eigen::Map<const Mat3>(packed.data() + n_start * i + 3));
    distant.unpack_motion(motions_[i].index, packed.data() + n_start * i + 12);
  }
}

}  // namespace dygita
