// Stiffness and lumped mass of a body. Implicit increments and the start of a step read the matrix itself; explicit
// increments have all they need by edges, in a sixth of its memory.
#pragma once

#include <memory>
#include <mutex>

#include "fem/assembly.hpp"
#include "fem/edge_blocks.hpp"
#include "model/model.hpp"

namespace dygita {

using StiffnessPtr = std::shared_ptr<const SparseMatrix>;

// Shared by equal substructures, and read by several threads.
class StoredMatrices {
 public:
  // Matrices that stay.
  explicit StoredMatrices(BodyMatrices matrices);
  // Of a mesh. keeps: the matrix is held here until it is given up; otherwise only its edges are.
  StoredMatrices(MeshPtr mesh, const Elastic& material, bool keeps);

  const Vec& mass() const { return mass_; }    // kg, n_nodes, as assembled
  double n_pairs() const { return n_pairs_; }  // of nodes that share a cell
  double bytes() const;                        // of the matrix, where it is held here
  // 3n x 3n, N/m. Where nobody holds it it is assembled again, the same to the bit, for as long as who asks holds it.
  StiffnessPtr stiffness() const;
  // Made when first asked for.
  std::shared_ptr<const EdgeBlocks> edges() const;
  // What is held here goes; who has got it keeps it.
  void give_up() const;

 private:
  MeshPtr mesh_;
  Elastic material_;
  Vec mass_;
  double n_pairs_ = 0.0;
  mutable std::mutex mutex_;
  mutable StiffnessPtr held_;
  mutable std::weak_ptr<const SparseMatrix> last_;
  mutable std::shared_ptr<const EdgeBlocks> held_edges_;
  mutable std::weak_ptr<const EdgeBlocks> last_edges_;
};

}  // namespace dygita
