// The mass of a piece on its free unknowns: lumped or a matrix, and nodes without any (manual, eq. S6-S7).
#pragma once

#include "pieces/body.hpp"
#include "pieces/free_unknowns.hpp"

namespace dygita {

class PieceMass {
 public:
  // unknowns: in their final order. A static step has no mass matrix and no nodes without mass.
  PieceMass(const Body& body, const TimeScheme& scheme, const FreeUnknowns& unknowns);

  const Vec& lumped() const { return lumped_; }  // kg, of each unknown
  bool is_matrix() const { return matrix_.size() > 0; }
  Vec times(const Vec& v) const;
  Vec solve(const Vec& momentum) const;  // of a matrix: velocities, by conjugate gradients
  // M times a nodal field (3 x n_nodes), held directions included; of those directions alone.
  Points times_nodal(const Points& nodal) const;
  std::vector<double> times_held(const Points& nodal, const std::vector<HeldDirection>& held) const;

  // Unknowns without mass in a dynamic step: their force is that of the step's end (manual, eq. S7).
  bool has_massless() const { return !massless_.empty(); }
  const std::vector<int>& massless() const { return massless_; }
  Vec of_massless(const Vec& v) const;                                        // those entries of v
  const SparseMatrix& massless_columns() const { return massless_columns_; }  // of K, one a massless unknown
  const Vec& end_factor() const { return end_factor_; }                       // D: 1 - g, and 1 for them

 private:
  void make_massless(const Body& body, const TimeScheme& scheme, const FreeUnknowns& unknowns);
  void make_matrix(const FreeUnknowns& unknowns);

  std::shared_ptr<const Mass> mass_;
  Vec lumped_;
  SparseMatrix matrix_;  // empty: lumped
  std::vector<int> massless_;
  SparseMatrix massless_columns_;
  Vec end_factor_;
};

}  // namespace dygita
