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
constexpr int n_point = 25, n_port = 3;       // of a point and of each of its ports, over a time step of the deck

// Writes what it reads elsewhere, in the same order.
struct Writer {
  double* at;
  void operator()(double value) { *at++ = value; }
  void operator()(const Vec3& v) { at = std::copy_n(v.data(), 3, at); }
};

struct Reader {
  const double* at;
  template <class Value>
  void operator()(Value& value) {
    value = static_cast<Value>(*at++);
  }
  void operator()(Vec3& v) {
    v = Eigen::Map<const Vec3>(at);
    at += 3;
  }
};

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
  // Ranks that solve the points; is this one of them?
  const auto share = [&](const std::vector<int>& members) {
    std::set<int> solving;
    for (const int i : members)
      for (int p = points_[i].side_1.first; p < points_[i].side_2.end; ++p) solving.insert(rank_of(p));
    for (const int i : members)
      for (int p = points_[i].side_1.first; p < points_[i].side_2.end; ++p)
        for_each_node(ports_[p], [&](int node) {
          readers_of[{ports_[p].nodes, node}].insert(solving.begin(), solving.end());
        });
    return solving.contains(ranks::me());
  };
  std::erase_if(alone_, [&](int i) { return !share({i}); });
  std::erase_if(clusters_, [&](const std::vector<int>& members) { return !share(members); });
  swept_.resize(clusters_.size());
  std::vector<int> owner;
  std::vector<std::vector<int>> readers;
  for (const Motions& motion : motions_) {
    const std::set<int>& ranks_here = readers_of[{motion.nodes, motion.index}];
    owner.push_back(model_->cut->piece(motion.piece).rank);
    readers.emplace_back(ranks_here.begin(), ranks_here.end());
  }
  of_motions_ = ranks::Neighbours(owner, readers, static_cast<int>(n_motion));
  std::vector<int> booking, offset{0};
  for (const OwnPoint& p : points_) {
    booking.push_back(p.owner);
    offset.push_back(offset.back() + n_point + n_port * (p.side_2.end - p.side_1.first));
  }
  of_points_ = ranks::Segments(booking, offset);
}

void DirectPoints::complete_motions() {
  if (motions_.empty()) return;
  told_.resize(n_motion * motions_.size());
  for (size_t i = 0; i < motions_.size(); ++i)
    if (motions_[i].is_here) motions_[i].nodes->tell_motion(motions_[i].index, told_.data() + n_motion * i);
  of_motions_.exchange(told_.data());
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

// What was booked elsewhere over the time step of the deck.
void DirectPoints::complete_points() {
  for (OwnPoint& p : points_)
    if (p.owner == ranks::me()) p.gap_difference = difference_of_gaps(p);
  if (ranks::is_alone()) return;
  const auto run_through = [&](auto&& archive, auto& p, auto& ports) {
    archive(p.impulse);
    auto& law = p.record.law;
    archive(law.gap);
    archive(law.plastic_opening);
    archive(law.hardening_opening);
    archive(law.opening_rate);
    archive(law.slip);
    archive(law.rate);
    archive(law.force);
    archive(p.record.trial.shortening);
    archive(p.work.friction);
    archive(p.work.plastic);
    archive(p.work.damping);
    archive(p.work.given);
    archive(p.on_pieces);
    archive(p.gap_difference);
    archive(p.record.is_released);
    for (int i = p.side_1.first; i < p.side_2.end; ++i) archive(ports[static_cast<size_t>(i)].impulse);
  };
  int n = 0;
  for (const OwnPoint& p : points_) n += n_point + n_port * (p.side_2.end - p.side_1.first);
  told_.resize(static_cast<size_t>(n));
  for (const bool reads : {false, true}) {
    if (reads) of_points_.complete(told_.data());
    double* at = told_.data();
    for (OwnPoint& p : points_) {
      double* const end = at + n_point + n_port * (p.side_2.end - p.side_1.first);
      const bool is_own = p.owner == ranks::me();
      if (!reads && is_own) {
        run_through(Writer{at}, p, ports_);
        end[-1] = static_cast<double>(p.record.law.status);
      } else if (reads && !is_own) {
        run_through(Reader{at}, p, ports_);
        p.record.law.status = static_cast<PointState>(end[-1]);
      }
      at = end;
    }
  }
}

}  // namespace dygita
