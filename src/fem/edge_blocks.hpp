// A stiffness by edges: of each pair of neighbours the force that their difference makes. There are no diagonal blocks,
// since a translation has no force: it has none here either, however coarsely the blocks are stored. Nor has a turn of
// the whole (manual, eq. S17).
#pragma once

#include <vector>

#include "mesh/mesh.hpp"
#include "numerics/panel_kernels.hpp"
#include "numerics/types.hpp"

namespace dygita {

// In single precision, which changes the material by some 3e-8 and neither momentum nor energy balance. Fields have
// four numbers a node, the fourth of them zero: what a register takes.
class EdgeBlocks {
 public:
  // stiffness: symmetric, 3n x 3n, with the 3x3 block pattern of `assemble`, without force in a rigid motion of the
  // nodes (3 x n, m).
  EdgeBlocks(const SparseMatrix& stiffness, const Points& nodes);

  int n_nodes() const { return static_cast<int>(starts_.size()) - 1; }
  // y += K x, both 4 n long.
  void add_product(const double* x, double* y) const;
  // The same of the blocks alone, as they are rounded: a turn has a force, and the diagonal is not symmetric.
  void add_product_of_blocks(const double* x, double* y) const;
  double bytes() const {
    return 4.0 * static_cast<double>(starts_.size() + others_.size() + blocks_.size() + rigid_.size());
  }

 private:
  Points skew_diagonal() const;
  void find_rigid(const Points& nodes);
  RigidView rigid() const { return {rigid_.data(), n_nodes()}; }

  std::vector<int> starts_, others_;
  std::vector<float> blocks_, rigid_;
  Mat3 turn_of_sum_, work_of_turn_, force_of_turn_;  // 1/m^2; N m: what the forces of turns do on turns; N
};

}  // namespace dygita
