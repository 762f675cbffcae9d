// The matrices of a substructure, or of a piece of one: the same in all steps.
#pragma once

#include <memory>
#include <vector>

#include "fem/assembly.hpp"
#include "model/model.hpp"

namespace dygita {

// The mass of a substructure in dynamic steps.
struct Mass {
  Vec lumped;                     // kg, of each node
  SparseMatrix matrix;            // n_nodes x n_nodes, kg, row sums as above; empty: lumped
  std::vector<char> is_massless;  // nodes whose mass has been moved inside (manual, eq. S7); empty: none
};

// A substructure's matrices; shared by equal substructures and by all steps.
struct Body {
  const Substructure* part = nullptr;
  std::shared_ptr<const BodyMatrices> matrices;
  std::shared_ptr<const Mass> mass;
};

}  // namespace dygita
