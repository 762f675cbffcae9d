// What a rank sees of the parts: the cells of its pieces, and around them those of others that have a say in the
// stresses at their nodes. Both sides of a cut so compute the same there, from the same displacements, in the order of
// the whole part's cells.
#pragma once

#include "watch/watched_nodes.hpp"

namespace dygita {

class PartView {
 public:
  PartView() = default;
  PartView(const Cut& cut, int part, const MeshPtr& whole);

  // Of the part that are here, increasing; none: nothing is seen of it, and there is no mesh.
  const std::vector<int>& pieces() const { return pieces_; }
  bool is_empty() const { return pieces_.empty(); }
  bool is_whole() const { return nodes_.empty(); }  // all of the part is here
  const Mesh& mesh() const { return *mesh_; }
  // Of the view's nodes: their numbers in the part, and the index of the piece here that owns them (-1: elsewhere).
  int node(int i) const { return is_whole() ? i : nodes_[static_cast<size_t>(i)]; }
  int owner(int i) const { return owner_.empty() ? 0 : owner_[static_cast<size_t>(i)]; }
  std::vector<int> all_nodes() const;  // of the part
  // The sum over the cells of each piece that is here. of_cells: of each block's cells of the view.
  std::vector<double> sums(const std::vector<Vec>& of_cells) const;

  // The cells that are here, as a mesh of their own, and the view's number of each of its nodes.
  struct Shown {
    MeshPtr mesh;
    std::vector<int> nodes;
  };
  Shown shown() const;

 private:
  std::vector<std::vector<int>> pieces_of_cells(const Cut& cut, const Mesh& whole) const;

  std::vector<int> pieces_;
  MeshPtr mesh_;
  std::vector<int> nodes_, owner_;          // empty: the part's; one piece owns all
  std::vector<std::vector<int>> of_cells_;  // piece of each cell of each block, as owner_; empty: one has all
};

// The cells of a mesh that are kept, in their order, all blocks staying, with the nodes that they have; and those.
std::pair<MeshPtr, std::vector<int>> some_cells(const Mesh& mesh, const std::vector<std::vector<char>>& is_kept);

// The same for the same numbers, whatever the rank.
double sum_of(const std::vector<double>& values);

// Ranks that have pieces of a part, increasing.
std::vector<int> ranks_of(const Cut& cut, int part);

// Of all parts, for all that watch them, one instant after the other.
class PartViews {
 public:
  explicit PartViews(const Problem& problem) : problem_(problem) {}
  // Collective.
  void take(const Instant& instant, NodalField field = NodalField::displacement);
  // Of a part, as last taken: 3 x nodes of its view; 0 at what is no place.
  const Points& field(int part) const { return nodes_.field(part); }
  // Known where something was taken, or the cut has been told.
  const PartView& of(int part) const { return views_[static_cast<size_t>(part)]; }
  void prepare(const CutPtr& cut);  // collective
  const Cut& cut() const { return *cut_; }

 private:
  const Problem& problem_;
  CutPtr cut_;
  std::vector<PartView> views_;
  WatchedNodes nodes_;
};

}  // namespace dygita
