// How substructures are cut into the pieces that are solved (manual, cutting): what a deck names, and every result, is
// of whole substructures.
#pragma once

#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "model/model.hpp"
#include "ranks/machine_copies.hpp"
#include "ranks/ranks.hpp"

namespace dygita {

struct Surface;

// One piece: cells of a substructure, and the nodes they have.
struct CutPiece {
  int part = -1;           // index of the substructure
  SubstructurePtr body;    // the piece as a body of its own; the substructure itself where that is not cut
  std::vector<int> nodes;  // node of the substructure at each node of the piece; empty: not cut, the same numbers
  std::vector<char>
      is_owner;   // of each node of the piece: this copy carries what belongs to the node once; empty: not cut
  Vec cut_areas;  // m^2, of each node of the piece: its share of the cut, positive on it; empty: not cut
  int rank = 0;   // which has it (share_out.hpp)

  bool is_whole() const { return nodes.empty(); }
  int node(int i) const { return is_whole() ? i : nodes[i]; }
  bool owns(int i) const { return is_whole() || is_owner[i] != 0; }
};

// A node of a substructure in a piece.
struct Copy {
  int piece, node;
  double share;  // of the node's cells: how areas are split
};

// The nodes of a substructure on a cut, and their copies but the owner, in the order of the pieces: none comes before
// the owner.
class NodesOnCuts {
 public:
  NodesOnCuts() = default;
  // Node and copy, those of a node in the order of the pieces.
  explicit NodesOnCuts(std::vector<std::pair<int, Copy>> copies);

  // Increasing.
  const std::vector<int>& nodes() const { return nodes_; }
  // Of the i-th of them.
  std::span<const Copy> others(size_t i) const { return {copies_.data() + first_[i], copies_.data() + first_[i + 1]}; }
  // Of any node; none of one that is not on a cut.
  std::span<const Copy> others_of(int node) const;
  std::vector<MachineArray> arrays() const {
    return {machine_array(nodes_), machine_array(first_), machine_array(copies_)};
  }

 private:
  std::vector<int> nodes_;
  std::vector<size_t> first_{0};
  std::vector<Copy> copies_;
};

class Cut {
 public:
  // surfaces: no point of one whose faces do not match is on two pieces of a side; null: there is none.
  Cut(const Problem& problem, const std::vector<int>& n_pieces, const std::vector<Surface>* surfaces = nullptr);

  int n_pieces() const { return static_cast<int>(pieces_.size()); }
  int n_parts() const { return static_cast<int>(on_cuts_.size()); }
  const CutPiece& piece(int i) const { return pieces_[i]; }
  const std::vector<CutPiece>& pieces() const { return pieces_; }
  bool is_here(int i) const { return pieces_[i].rank == ranks::me(); }
  void give(int i, int rank) { pieces_[i].rank = rank; }
  // Pieces of a substructure: first, and their number.
  int first(int part) const { return first_[part]; }
  int n_pieces(int part) const { return first_[part + 1] - first_[part]; }
  std::vector<int> counts() const;  // of the pieces of each substructure
  bool is_cut(int part) const { return n_pieces(part) > 1; }
  const NodesOnCuts& on_cuts(int part) const { return on_cuts_[part]; }
  // Copies of a node of a substructure, the owner first.
  std::vector<Copy> copies(int part, int node) const;
  // The large ones of what is known of pieces wherever they are.
  std::vector<MachineArray> arrays() const;
  Copy owner(int part, int node) const { return is_cut(part) ? owner_[part][node] : Copy{first_[part], node, 1.0}; }

  // Some nodes of a substructure on the pieces that own them: their numbers there, and their places among all.
  struct OnOwner {
    std::vector<int> nodes, at;
  };
  std::map<int, OnOwner> on_owners(int part, const std::vector<int>& nodes) const;

  // Values (3 x n) at the piece's nodes of a field on its substructure: at every copy, or zero at those that are no
  // owners.
  Points on_piece(int piece, const Points& nodal) const;
  Points on_owners(int piece, const Points& nodal) const;
  // Zero at copies that are no owners.
  void keep_owned(int piece, Points& on_piece) const;
  // Field on a substructure from those on its pieces: of the owners, or summed over the copies. of_piece(i): 3 x n of
  // piece i.
  template <class OfPiece>
  Points from_owners(int part, OfPiece&& of_piece) const {
    if (!is_cut(part)) return of_piece(first_[part]);
    Points nodal(3, static_cast<Eigen::Index>(owner_[part].size()));
    for (int p = first_[part]; p < first_[part + 1]; ++p) {
      const Points own = of_piece(p);
      for (Eigen::Index i = 0; i < own.cols(); ++i)
        if (pieces_[p].is_owner[i]) nodal.col(pieces_[p].nodes[i]) = own.col(i);
    }
    return nodal;
  }
  // The same at some nodes alone, in their order. of_piece(i, nodes): 3 x nodes, of piece i.
  template <class OfPiece>
  Points from_owners(int part, const std::vector<int>& nodes, OfPiece&& of_piece) const {
    if (!is_cut(part)) return of_piece(first_[part], nodes);
    Points nodal(3, static_cast<Eigen::Index>(nodes.size()));
    for (const auto& [piece, on_piece] : on_owners(part, nodes))
      nodal(Eigen::all, on_piece.at) = of_piece(piece, on_piece.nodes);
    return nodal;
  }
  template <class OfPiece>
  Points summed(int part, OfPiece&& of_piece) const {
    if (!is_cut(part)) return of_piece(first_[part]);
    Points nodal = Points::Zero(3, static_cast<Eigen::Index>(owner_[part].size()));
    for (int p = first_[part]; p < first_[part + 1]; ++p) {
      const Points own = of_piece(p);
      for (Eigen::Index i = 0; i < own.cols(); ++i) nodal.col(pieces_[p].nodes[i]) += own.col(i);
    }
    return nodal;
  }

 private:
  void add_cut(int part, const SubstructurePtr& body, const std::vector<int>& piece_of_cell);

  std::vector<CutPiece> pieces_;
  std::vector<int> first_;
  std::vector<std::vector<Copy>> owner_;  // of each node of the substructures that are cut
  std::vector<NodesOnCuts> on_cuts_;      // of each substructure
};

using CutPtr = std::shared_ptr<const Cut>;

// Every substructure in one piece.
CutPtr no_cut(const Problem& problem);

inline constexpr double smallest_cut = 20e3;  // unknowns of a substructure that the program cuts by itself

// How a run is to be cut and shared out, as far as that does not follow from the problem.
struct SharePlan {
  std::vector<int> n_pieces;    // of each substructure; empty: as usual
  std::vector<double> seconds;  // that each piece took in a run before, and its unknowns; empty: nobody knows
  std::vector<long> unknowns;
};

// Pieces of each substructure, as the problem's solver.latin has it: a number of them, or large substructures only
// (manual, cutting); by sizes alone, so that the answer does not depend on the machine.
std::vector<int> usual_pieces(const Problem& problem);
// The most that a substructure may be cut into; 1 where it may not.
int most_pieces(const Problem& problem, int part);

// A substructure gets fewer pieces than asked for where they would have less than 8 cells each, or more than a quarter
// of its cells at a face that does not match; with massless contact none is cut. Several ranks share the pieces out
// (share_out.hpp).
CutPtr make_cut(const Problem& problem, const std::vector<Surface>& surfaces, const SharePlan& plan = {});

}  // namespace dygita
