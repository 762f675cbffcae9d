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

// Memory of matrices that nobody keeps, for who assembles the next one.
class SpareMatrices {
 public:
  std::unique_ptr<SparseMatrix> take();
  void give(std::unique_ptr<SparseMatrix> matrix);

 private:
  std::mutex mutex_;
  std::vector<std::unique_ptr<SparseMatrix>> spare_;
};

// Shared by equal substructures, and read by several threads.
class StoredMatrices {
 public:
  // Matrices that stay.
  explicit StoredMatrices(BodyMatrices matrices);
  // Of a mesh. keeps: the matrix is held here until it is given up; otherwise only its edges are, and its memory
  // spared.
  StoredMatrices(MeshPtr mesh, const Elastic& material, bool keeps, SpareMatrices* spares = nullptr);

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
  void take_sizes(BodyMatrices& matrices);

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
