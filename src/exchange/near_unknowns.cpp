#include "exchange/near_unknowns.hpp"

#include <algorithm>
#include <set>
#include <unordered_map>

#include "exchange/near_points.hpp"
#include "partition/all_pieces.hpp"

namespace dygita {

namespace {

// Who has and who reads an unknown of the assembled q.
struct Passing {
  int owner = 0;
  std::vector<int> readers;
};

// Notes who reads the unknowns of a point; returns those of pieces elsewhere.
std::vector<int> note_readers(const Cut& cut, const Exchange& exchange, const std::vector<int>& offset,
                              const Point& point, const std::vector<int>& readers,
                              std::unordered_map<int, Passing>& passing) {
  std::vector<int> elsewhere;
  for (int p = point.first_port; p < point.end_port; ++p) {
    const Port& port = exchange.ports[static_cast<size_t>(p)];
    for (const int of_piece : port.unknown) {
      if (of_piece < 0) continue;
      const int unknown = offset[static_cast<size_t>(port.piece)] + of_piece;
      passing[unknown] = {cut.piece(port.piece).rank, readers};
      if (!cut.is_here(port.piece)) elsewhere.push_back(unknown);
    }
  }
  return elsewhere;
}

}  // namespace

NearUnknowns::NearUnknowns(const Exchange& exchange, const std::vector<int>& offset)
    : n_(offset.back()), n_own_(n_), n_assembled_(n_), start_(offset) {
  for (int i = 0; i < static_cast<int>(exchange.points.size()); ++i)
    if (!exchange.points[static_cast<size_t>(i)].is_direct) points_.push_back(i);
}

NearUnknowns::NearUnknowns(const Cut& cut, const Exchange& exchange, const std::vector<int>& offset)
    : is_all_(false), n_assembled_(offset.back()), of_pieces_(segments_of(cut, exchange.n_unknowns)) {
  start_.assign(static_cast<size_t>(cut.n_pieces()), -1);
  for (int i = 0; i < cut.n_pieces(); ++i) {
    if (!cut.is_here(i)) continue;
    start_[static_cast<size_t>(i)] = static_cast<int>(assembled_.size());
    for (int u = offset[static_cast<size_t>(i)]; u < offset[static_cast<size_t>(i) + 1]; ++u) assembled_.push_back(u);
  }
  n_own_ = static_cast<int>(assembled_.size());
  std::set<int> told;
  std::unordered_map<int, Passing> passing;
  for (int i = 0; i < static_cast<int>(exchange.points.size()); ++i) {
    const Point& point = exchange.points[static_cast<size_t>(i)];
    if (point.is_direct) continue;
    const std::vector<int> touching = ranks_at(cut, exchange, point);
    points_.push_back(i);
    const std::vector<int> elsewhere = note_readers(cut, exchange, offset, point, touching, passing);
    assembled_.insert(assembled_.end(), elsewhere.begin(), elsewhere.end());
    (elsewhere.empty() ? inner_ : outer_).push_back(i);
    for (int p = point.first_port; p < point.end_port && touching.size() > 1; ++p)
      if (const int piece = exchange.ports[static_cast<size_t>(p)].piece; cut.is_here(piece)) told.insert(piece);
  }
  border_pieces_.assign(told.begin(), told.end());
  n_ = static_cast<int>(assembled_.size());
  // What passes between two ranks stands in the assembled order on both.
  std::sort(assembled_.begin() + n_own_, assembled_.end());
  at_.assign(static_cast<size_t>(n_assembled_), -1);
  std::vector<int> owner;
  std::vector<std::vector<int>> readers;
  for (int i = 0; i < n_; ++i) {
    const int unknown = assembled_[static_cast<size_t>(i)];
    at_[static_cast<size_t>(unknown)] = i;
    owner.push_back(passing.at(unknown).owner);
    readers.push_back(std::move(passing.at(unknown).readers));
  }
  passing_ = ranks::Neighbours(owner, readers, 1);
}

void NearUnknowns::exchange(std::initializer_list<double*> fields) const { passing_.exchange(fields); }

Vec NearUnknowns::part(const Vec& assembled) const {
  if (is_all_) return assembled;
  Vec near(n_);
  for (int i = 0; i < n_; ++i) near[i] = assembled[assembled_[static_cast<size_t>(i)]];
  return near;
}

Vec NearUnknowns::spread(const Vec& near) const {
  Vec assembled(n_assembled_);
  for (int i = 0; i < n_own_; ++i) assembled[assembled_[static_cast<size_t>(i)]] = near[i];
  return assembled;
}

Vec NearUnknowns::assembled(const Vec& near) const {
  if (is_all_) return near;
  Vec all = spread(near);
  of_pieces_.complete(all.data());
  return all;
}

AssembledRuns NearUnknowns::kept_runs() const {
  if (ranks::is_alone()) return {};
  AssembledRuns kept{n_assembled_, {}};
  if (is_all_ && ranks::is_first()) kept.runs.push_back({0, n_assembled_});
  for (int i = 0; i < n_own_ && !is_all_; ++i) {
    const int unknown = assembled_[static_cast<size_t>(i)];
    if (kept.runs.empty() || kept.runs.back().first + kept.runs.back().n != unknown) kept.runs.push_back({unknown, 0});
    ++kept.runs.back().n;
  }
  return kept;
}

Vec NearUnknowns::kept_part(const Vec& near) const {
  return is_all_ && !ranks::is_first() ? Vec() : Vec(near.head(n_own_));
}

}  // namespace dygita
