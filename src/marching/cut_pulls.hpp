// What pulls at the nodes on cuts of explicit substructures with a tuned mass, in each increment: that of all copies of
// a node, before the mass of any of them spreads it to its neighbours (manual, eq. S13). So a cut changes nothing.
#pragma once

#include "pieces/explicit_piece.hpp"
#include "ranks/neighbours.hpp"
#include "step/step_model.hpp"

namespace dygita {

class CutPulls {
 public:
  explicit CutPulls(const StepModel& model);

  // Is there none that is here? Has this piece any?
  bool is_empty() const { return nodes_.empty(); }
  bool has(int piece) const { return !nodes_.empty() && concerned_[static_cast<size_t>(piece)] != 0; }
  // Between the halves of `begin` of these pieces: each copy gets its share, by mass.
  void share(int most_threads);

 private:
  struct OwnCopy {
    ExplicitPiece* piece;  // null: on another rank
    int node;
    double share;  // of the node's mass
  };

  std::vector<char> concerned_;  // of each piece
  std::vector<int> nodes_;       // where the copies of each begin, and their number
  std::vector<OwnCopy> copies_;
  ranks::Neighbours of_pulls_;
  std::vector<double> pulls_;  // N, three a copy
};

}  // namespace dygita
