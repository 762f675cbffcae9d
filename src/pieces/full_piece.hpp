// Implicit pieces that are solved in full: by themselves at each iteration, or together with others by someone else.
#pragma once

#include <optional>

#include "pieces/condensed_piece.hpp"

namespace dygita {

// A + T^T k T factorised, and a whole solve for each q: where almost all of a piece is interface (a washer, a thin
// plate) that costs less than products with H; and the plain path that checks the condensed one.
class FullPiece final : public ImplicitPiece {
 public:
  // condensation: of the plain path, whose vectors keep that factor's order; none: unknowns in the order of their
  // numbers.
  FullPiece(PieceOperator op, std::optional<Condensation> condensation, bool is_shared);
  // twin: the same piece of another run, without a condensation.
  FullPiece(PieceOperator op, const FullPiece& twin) : FullPiece(std::move(op), std::nullopt, true) { twin_ = &twin; }

  const Condensation* condensation() const override { return condensation_ ? &*condensation_ : nullptr; }
  void set_search_directions(const Vec& k) override;
  Mat row_compliance(const std::vector<int>& columns) const override;
  bool shares_operator() const override { return is_shared_; }
  void interface_velocity(Eigen::Ref<const Vec> q, Eigen::Ref<Vec> velocity) override;
  PieceFigures figures() const override;

 protected:
  void prepare(double quiet) override;
  bool solves_for_change() const override { return !op_.scheme().is_static && !op_.mass().has_massless(); }

 private:
  std::optional<Condensation> condensation_;
  bool is_shared_;
  const FullPiece* twin_ = nullptr;
  std::shared_ptr<const Factor> factor_;
};

// The system is solved elsewhere, with other pieces' in it.
class AssembledPiece final : public ImplicitPiece {
 public:
  using ImplicitPiece::ImplicitPiece;

  // Matrix and right-hand side of the increment on the free unknowns, and the velocities found.
  SparseMatrix matrix() const { return op_.matrix(Vec::Zero(n_rows())); }
  const Vec& right_hand_side() const { return work_.x; }
  // Velocities at the rows that moving supports bring; null: none.
  const Vec* moved_rows() const { return held_rows(); }
  void set_velocity(const Vec& free) { state_.v = free; }
};

}  // namespace dygita
