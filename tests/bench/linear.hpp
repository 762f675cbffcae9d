// What a user of the best linear code pays for the same shock: the deck's assembly as one uncut body, every interface
// bonded, CHOLMOD on METIS's ordering, one cholmod_solve2 per step. The other side of the headline, and a check.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "model/model.hpp"

namespace dygita::bench {

// How P0 = K (U0 + dt/4 V0) of the right-hand side is had.
enum class RightHandSide {
  stiffness_product,  // by a product with K, as a user's own program does
  recurrence          // from the equation just solved (manual, eq. S3-S4): no product
};

struct LinearOptions {
  RightHandSide right_hand_side = RightHandSide::stiffness_product;
  int threads = 1;       // of the product by K
  int blas_threads = 1;  // of OpenBLAS, in the solve
  int n_steps = 0;       // 0: the whole step
};

// Seconds of a run of n_steps: sums, and the median of one solve. Loads are evaluated outside the clock.
struct LinearSeconds {
  int n_steps = 0;
  double all = 0.0, right_hand_side = 0.0, solve = 0.0, update = 0.0, median_solve = 0.0;
};

// The last dynamic step of a problem on the uncut body, from rest (or the substructures' velocities), by the same
// scheme, meshes, lumped mass, supports and loads: with g = 1/2, (M/dt + dt/4 K) V1 = M V0/dt - K (U0 + dt/4 V0) + f.
// Velocities are to fit the supports: a held node starts at rest with all its copies.
// Throws InputError for what it does not do: walls, absorbing, oblique or moving supports, damping, other masses.
class LinearAnalysis {
 public:
  explicit LinearAnalysis(const Problem& problem);  // assembles
  ~LinearAnalysis();

  // CHOLMOD's own analysis with METIS, and the supernodal factor, with this many threads in OpenBLAS.
  void factorise(int blas_threads);
  LinearSeconds run(const LinearOptions& options);

  int n_dofs() const { return static_cast<int>(mass_.size()); }  // free ones
  double factor_entries() const;                                 // lower triangle, padding of supernodes included
  double factor_bytes() const;
  double assembly_seconds() const { return assembly_seconds_; }
  double analysis_seconds() const { return analysis_seconds_; }
  double factor_seconds() const { return factor_seconds_; }

  // After a run, on the nodes of a substructure (3 x n_nodes, m).
  Points displacement(int part) const;

 private:
  struct Cholmod;
  void merge_nodes();
  void number_unknowns();
  void assemble_free();
  Vec force(int increment);
  Vec stiffness_times(const Vec& x, int threads) const;

  const Problem& problem_;
  const Step* step_ = nullptr;
  std::vector<std::vector<int>> node_of_;  // of each substructure: node -> node of the uncut body
  int n_nodes_ = 0;
  std::vector<int> unknown_of_;      // 3 node + axis of the uncut body -> unknown, -1 where held
  SparseMatrix stiffness_, matrix_;  // of the unknowns; matrix_ = M/dt + dt/4 K
  Vec mass_, velocity_start_;        // of the unknowns
  struct Forces;
  std::unique_ptr<Forces> forces_;
  std::unique_ptr<Cholmod> cholmod_;
  Vec displacement_, velocity_;
  double assembly_seconds_ = 0.0, analysis_seconds_ = 0.0, factor_seconds_ = 0.0;
};

}  // namespace dygita::bench
