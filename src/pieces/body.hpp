// The matrices of a substructure, or of a piece of one: the same in all steps.
#pragma once

#include <memory>
#include <vector>

#include "pieces/stored_matrices.hpp"

namespace dygita {

// The mass of a substructure in dynamic steps. Of one that another rank has the sum and the least are known, and no
// others where nothing asks for them.
struct Mass {
  Vec lumped;                     // kg, of each node, positive but where it has been moved
  SparseMatrix matrix;            // n_nodes x n_nodes, kg, of the same total; empty: lumped
  std::vector<char> is_massless;  // nodes whose mass has been moved inside (manual, eq. S7); empty: none
  bool is_consistent = false;     // row sums of the matrix are not the lumped masses
  double all = 0.0, least = 0.0;  // kg, of all nodes; of that which has least
  SparseMatrix full = {};         // 3n x 3n, kg, in the place of the others, of a body without cells; else empty

  // Forces (N) of an acceleration, both 3 x n_nodes; in explicit steps by the lumped mass, whatever the cells.
  Points times(const Points& acceleration, bool is_explicit) const {
    if (full.size() > 0) {
      Points force(3, acceleration.cols());
      force.reshaped() = full * acceleration.reshaped();
      return force;
    }
    if (is_consistent && !is_explicit) return (matrix * acceleration.transpose()).transpose();
    return acceleration * lumped.asDiagonal();
  }
};

// A substructure's matrices; shared by equal substructures and by all steps.
struct Body {
  const Substructure* part = nullptr;
  std::shared_ptr<const StoredMatrices> matrices;
  std::shared_ptr<const Mass> mass;
};

}  // namespace dygita
