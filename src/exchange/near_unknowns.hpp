// The iterated points and the interface unknowns that a rank has to do with: those of the pieces that are here, and
// after them those of others at points that both touch.
#pragma once

#include <initializer_list>
#include <vector>

#include "exchange/exchange.hpp"
#include "interfaces/interface_fields.hpp"
#include "ranks/neighbours.hpp"
#include "ranks/ranks.hpp"

namespace dygita {

class NearUnknowns {
 public:
  NearUnknowns() = default;
  // All of them, in the assembled order: one process, or ranks that each solve all pieces. offset: of each piece's
  // unknowns in the assembled q, and its length.
  NearUnknowns(const Exchange& exchange, const std::vector<int>& offset);
  // Those of this rank.
  NearUnknowns(const Cut& cut, const Exchange& exchange, const std::vector<int>& offset);

  // Of the exchange, increasing; none in closed form.
  const std::vector<int>& points() const { return points_; }
  // Those of them all of whose unknowns are of pieces that are here, and the others.
  const std::vector<int>& inner_points() const { return is_all_ ? points_ : inner_; }
  const std::vector<int>& outer_points() const { return outer_; }
  // Pieces that are here and whose unknowns others read.
  const std::vector<int>& border_pieces() const { return border_pieces_; }
  int n() const { return n_; }
  int n_own() const { return n_own_; }  // of the pieces that are here; they come first
  // First unknown of a piece that is here; they stand one after the other.
  int start(int piece) const { return start_[static_cast<size_t>(piece)]; }
  // Of an unknown of the assembled q; -1: it is not near.
  int at(int assembled) const { return is_all_ ? assembled : at_[static_cast<size_t>(assembled)]; }
  int n_assembled() const { return n_assembled_; }
  bool is_all() const { return is_all_; }

  // Collective: fields of which each rank has its own pieces' values (the first n_own) get those of the others (n in
  // all), from those who have them.
  void exchange(std::initializer_list<double*> fields) const;
  void exchange(const std::vector<double*>& fields) const { passing_.exchange(fields); }
  // The same in two halves: what is sent is read by the first, the others' values are there after the second.
  void begin(std::initializer_list<const double*> fields) const { passing_.begin(fields); }
  void end(std::initializer_list<double*> fields) const { passing_.end(fields); }
  // The near values of the assembled q.
  Vec part(const Vec& assembled) const;
  // Collective: the assembled q of fields of which each rank has its own.
  Vec assembled(const Vec& near) const;
  // Where the values that a rank keeps of a field lie in the assembled q: its own, or all where all ranks have them
  // (the first keeps them then); and these.
  AssembledRuns kept_runs() const;
  Vec kept_part(const Vec& near) const;

 private:
  Vec spread(const Vec& near) const;

  bool is_all_ = true;
  int n_ = 0, n_own_ = 0, n_assembled_ = 0;
  std::vector<int> points_, start_;
  std::vector<int> inner_, outer_, border_pieces_;
  std::vector<int> at_, assembled_;  // empty: they are the same
  ranks::Segments of_pieces_;
  ranks::Neighbours passing_;
};

}  // namespace dygita
