// All pieces of a static step in one system, joined by the tangents of the laws (manual, eq. U4).
#pragma once

#include <memory>
#include <optional>

#include "numerics/repeated_factor.hpp"
#include "pieces/full_piece.hpp"
#include "step/step_model.hpp"
#include "step/tangents.hpp"

namespace dygita {

class AssembledSystem {
 public:
  // The step's pieces are assembled ones (make_assembled_pieces); orders the system, factorises nothing. Throws
  // NumericalError where it is too large.
  explicit AssembledSystem(const StepModel& model);

  // Of each point of the exchange, as tangents have them.
  const std::vector<std::vector<int>>& unknowns_of_points() const { return unknowns_of_points_; }
  double bytes() const;  // of factor and matrices, as they will be

  // Takes these tangents from now on, and factorises. Throws NumericalError where they leave a motion free.
  void set_tangents(Tangents tangents);
  // How friction follows the normal forces, as in these tangents, which are nearly those of the factor; no more.
  void set_following(const Tangents& tangents);
  void stop_following() { is_following_ = false; }
  // From V and F: those in balance with the loads of the increment where F changes with V as the tangents say; lengths
  // n_q. False: they were not found beside the factor, which knows nothing of how friction follows.
  bool solve(Vec& velocity, Vec& force);
  // What rounding left of the last balance, largest over the unknowns, of the largest force there.
  double imbalance() const { return imbalance_; }
  // The free unknowns found last, to the pieces.
  void set_velocities();

 private:
  // Rows of a point's unknowns on the unknowns of the system.
  struct PointTraces {
    std::vector<int> unknowns;
    Mat rows;
    std::vector<int> entries;  // of the matrix, where rows^T M rows goes, column by column
  };

  void put_pieces_together();
  void find_points();
  PointTraces traces_of(const std::vector<int>& rows) const;
  void make_pattern();
  void add_tangents();
  void answer_preloads();
  Vec at_rows(const Vec& x) const;
  Vec from_rows(const Vec& values) const;
  Vec tangent_times(const Vec& velocity) const;  // less what preloads give way
  Vec following_times(const Vec& velocity) const;
  std::optional<Vec> what_follows(const Vec& to_image) const;
  Vec balanced(const Vec& right_hand_side) const;

  const StepModel* model_;
  std::vector<AssembledPiece*> pieces_;
  std::vector<int> first_;  // unknown of each piece in the system; the last entry is its size
  SparseMatrix stiffness_;  // of the pieces, side by side
  SparseMatrix matrix_;
  std::vector<double> stiffness_values_;  // in the pattern of the matrix
  std::vector<std::vector<int>> unknowns_of_points_;
  std::vector<PointTraces> points_;
  std::unique_ptr<RepeatedFactor> factor_;
  Tangents tangents_;  // of the factor
  bool is_following_ = false;
  Mat columns_, answers_;  // of the preloads: T^T g and what the system answers to it
  Mat yielding_;           // c - g^T T A^-1 T^T g
  Vec x_;
  double imbalance_ = 0.0;
};

}  // namespace dygita
