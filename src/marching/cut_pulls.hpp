// What pulls at the nodes on cuts and ties of explicit substructures with a tuned mass, in each increment: that of all
// nodes of a group, before the mass of any of them spreads it to its neighbours (manual, eq. S13). So neither a cut nor
// a tie changes anything.
#pragma once

#include "pieces/explicit_piece.hpp"
#include "step/tied_nodes.hpp"

namespace dygita {

class CutPulls {
 public:
  explicit CutPulls(const StepModel& model);

  // Is there none that is here? Has this piece any?
  bool is_empty() const { return sums_.is_empty(); }
  bool has(int piece) const { return !is_empty() && concerned_[static_cast<size_t>(piece)] != 0; }
  // Between the halves of `begin` of these pieces: each node gets its share, by mass.
  void share(int most_threads);

 private:
  struct OwnNode {
    ExplicitPiece* piece = nullptr;  // null: on another rank
    double share = 0.0;              // of the group's mass
    Points* to = nullptr;            // the piece's field of shares
    Eigen::Index at = 0;             // in it
  };

  std::vector<char> concerned_;  // of each piece
  TiedSums sums_;
  std::vector<OwnNode> nodes_;  // of its entries
};

}  // namespace dygita
