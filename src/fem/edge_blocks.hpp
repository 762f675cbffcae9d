// A stiffness by edges: of each pair of neighbours the force that their difference makes. There are no diagonal blocks,
// since a translation has no force: it has none here either, however coarsely the blocks are stored. A turn of the
// whole has no moment and no force in sum.
#pragma once

#include <vector>

#include "numerics/panel_kernels.hpp"
#include "numerics/types.hpp"

namespace dygita {

// In single precision, which changes the material by some 3e-8 and neither momentum nor energy balance. Fields have
// four numbers a node, the fourth of them zero: what a register takes.
class EdgeBlocks {
 public:
  // Sums of the forces and of their moments in turns about the three axes.
  using TurnSums = Eigen::Matrix<double, 18, 1>;

  // stiffness: symmetric, 3n x 3n, with the 3x3 block pattern of `assemble`, rows adding up to zero. places: of the
  // nodes, 3 x n, m.
  EdgeBlocks(const SparseMatrix& stiffness, const Points& places);

  int n_nodes() const { return static_cast<int>(starts_.size()) - 1; }
  // y += K x, both 4 n long.
  void add_product(const double* x, double* y) const;
  double bytes() const { return 4.0 * static_cast<double>(starts_.size() + others_.size() + blocks_.size()); }

 private:
  TurnSums sums_of_turns(const Points& arms) const;
  void balance_turns(const Points& places);

  std::vector<int> starts_, others_;
  std::vector<float> blocks_;
};

}  // namespace dygita
