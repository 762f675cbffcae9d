// An implicit piece whose interior is condensed: one forward and one backward solve in an increment, and in between
// products with the interface operator H alone (manual, eq. H1-H4).
#pragma once

#include "numerics/spd_inverse.hpp"
#include "pieces/implicit_piece.hpp"

namespace dygita {

// The factor of a piece's interior and what it leaves on the interface; shared by equal pieces.
struct Condensation {
  std::shared_ptr<const Factor> factor;
  std::shared_ptr<Mat> schur;  // S0, n_interface x n_interface, without the rows' reference stiffness; as it is while
                               // several pieces have it
  Vec schur_diagonal;          // in the directions of a piece's rows, shared between their laws

  // op: of the piece that was factorised, its unknowns in the factor's order; the reference stiffness of its rows is
  // included in the factor.
  Condensation(std::unique_ptr<Factor> own, const PieceOperator& op);
  // The stiffness of the rows of op, an equal piece's; the Schur complement is still there.
  void set_diagonal(const PieceOperator& op);
  // S0 + T^T k T, with T the rows on the interface unknowns.
  Mat with_rows(const PieceOperator& op, const Vec& k) const;
  // The same, in the place of S0 where no other piece has it.
  Mat take_with_rows(const PieceOperator& op, const Vec& k);
};

// T H T^T, with T the rows of op on the interface unknowns and H by its lower triangle: some of its columns, or those
// of some rows too.
Mat on_rows(const Mat& h, const PieceOperator& op, int n_interior, const std::vector<int>& columns);
Mat on_rows(const Mat& h, const PieceOperator& op, int n_interior, const std::vector<int>& rows,
            const std::vector<int>& columns);

class CondensedPiece final : public ImplicitPiece {
 public:
  // twin: the equal piece that the condensation comes from, null for its own.
  CondensedPiece(PieceOperator op, Condensation condensation, const CondensedPiece* twin);

  const Condensation* condensation() const override { return &condensation_; }
  void set_search_directions(const Vec& k) override;
  Mat row_compliance(const std::vector<int>& columns) const override;
  bool shares_operator() const override { return twin_ != nullptr; }
  const void* shared_key() const override { return condensation_.factor.get(); }
  void forward(std::span<Piece* const> equal) override;
  void backward(std::span<Piece* const> equal) override;
  bool is_moved() const override { return is_moved_; }
  void wake() override;
  void interface_velocity(Eigen::Ref<const Vec> q, Eigen::Ref<Vec> velocity) override;
  bool has_operator_in_half() const override { return h_ && h_->has_half(); }
  void interface_velocity_in_half(Eigen::Ref<const Vec> q, Eigen::Ref<Vec> velocity) override;
  // What the solves of an increment are made of, where somebody else does them for several pieces of one key or one H
  // at once, of whichever runs. Null: nothing to solve.
  Vec* to_substitute_forward();  // then take_forward()
  void take_forward();
  Vec* to_substitute_backward();
  // rhs: of H, whose answer goes to product(); null: velocity has been found without.
  const SpdInverse* to_multiply(Eigen::Ref<const Vec> q, Eigen::Ref<Vec> velocity, Vec& rhs);
  Vec& product() { return dv_b_; }
  void take_product(Eigen::Ref<Vec> velocity) const;
  // The same of rough_change: rhs of the rough operator, and what its answer says. Null: there is no rough operator.
  const SpdInverse* to_multiply_roughly(const Vec& change, Vec& rhs) const;
  void take_rough_product(const Vec& answer, Eigen::Ref<Vec> velocity) const;
  const Factor& factor() const { return *condensation_.factor; }

  bool has_rough_operator() const override { return h_ && h_->has_rough(); }
  void rough_change(Eigen::Ref<const Vec> q, Eigen::Ref<Vec> velocity) const override;
  PieceFigures figures() const override;

 protected:
  void prepare(double quiet) override;
  bool find_velocity() override;
  // Nodes without mass have a recurrence of their own.
  bool solves_for_change() const override { return !op_.scheme().is_static && !op_.mass().has_massless(); }

 private:
  Condensation condensation_;
  const CondensedPiece* twin_;
  std::shared_ptr<const SpdInverse> h_;
  // Of the increment at hand: the condensed right-hand side, and the interface's answer.
  Vec b_, dv_b_;
  Vec v_rows_;  // V0 at the rows, where the piece solves for the change
  // What H itself was last multiplied with, and its answer; empty: H has no form in half precision.
  Vec whole_rhs_, whole_;
  double quiet_ = 0.0;
  bool is_forward_due_ = false, is_moved_ = false;  // the forward solve is put off; the interfaces have moved
  long n_solved_ = 0, n_spared_ = 0;
};

}  // namespace dygita
