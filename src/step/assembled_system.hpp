// All pieces of a static step in one system, joined by the tangents of the laws (manual, eq. U4).
#pragma once

#include <functional>
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
  // watch: is called with what takes long at the moment ("factor 40 %"), one call at a time, on any thread; what it
  // throws ends it.
  void be_watched(std::function<void(const std::string&)> watch) { watch_ = std::move(watch); }

  // Of each point of the exchange, as tangents have them.
  const std::vector<std::vector<int>>& unknowns_of_points() const { return unknowns_of_points_; }
  double bytes() const;  // of factor and matrices, as they will be
  double operations() const { return factor_ ? factor_->operations() : 0.0; }  // of a factorisation
  // What a step takes beside what this takes now: the factor, what one thread works in, tangents of several iterations.
  double bytes_to_come() const;

  // Takes these tangents from now on, and factorises. Throws NumericalError where they leave a motion free.
  void set_tangents(Tangents tangents);
  // The same beside the factor of others (eq. U8). k: search directions, of the assembled q.
  void set_other_tangents(const Tangents& tangents, const Vec& k);
  // How friction follows the normal forces, as in these tangents, which are nearly those of the factor; no more.
  void set_following(const Tangents& tangents);
  // The factor's own tangents, and nothing beside them.
  void set_own();
  // From V and F: those in balance with the loads of the increment where F changes with V as the tangents say; lengths
  // n_q. False: they were not found beside the factor, which knows nothing of how friction follows, nor of tangents
  // since. precision: to which part of it what these add is found.
  bool solve(Vec& velocity, Vec& force, double precision = 1e-3);
  bool has_others() const { return has_others_; }
  // Products with the factor that the last solve took beside it, and how many are worth a factor.
  int n_products() const { return n_products_; }
  int most_products() const;
  // What rounding left of the last balance, largest over the unknowns, of the largest force there.
  double imbalance() const { return imbalance_; }
  // The free unknowns found last, to the pieces.
  void set_velocities();

 private:
  std::string place_of(int unknown) const;  // as messages say it
  // Rows of a point's unknowns on the unknowns of the system.
  struct PointTraces {
    std::vector<int> unknowns;
    Mat rows;
  };
  // A point and which of its unknowns one of the system is.
  struct PointAt {
    int point, column;
  };

  void find_points();
  PointTraces traces_of(const std::vector<int>& rows) const;
  SparseMatrix make_pattern();
  void put_in_order(const SparseMatrix& pattern);
  void fill_matrix();
  void add_row(int unknown, const SparseMatrix& of_piece, int first, const std::vector<Mat>& forces);
  Vec stiffness_times(const Vec& x) const;
  void answer_preloads();
  Vec at_rows(const Vec& x) const;
  Vec from_rows(const Vec& values) const;
  Vec tangent_times(const Vec& velocity) const;  // less what preloads give way
  Vec following_times(const Vec& velocity) const;
  Vec others_times(const Vec& velocity) const;  // what the tangents at hand add to the factor's, with what follows
  Vec scaled(Vec force) const;
  std::optional<Vec> what_others_add(const Vec& to_image, double precision);
  std::vector<char> reach_of_others() const;
  // reach: of the right-hand side, and where the answer is asked for; null: everywhere.
  Vec balanced(const Vec& right_hand_side, const std::vector<char>* reach = nullptr) const;

  const StepModel* model_;
  std::vector<AssembledPiece*> pieces_;
  std::vector<int> first_;     // unknown of each piece in the system; the last entry is its size
  SparseMatrix matrix_;        // of the factor: the upper triangle, in its order
  std::vector<int> position_;  // of each unknown there
  std::vector<int> entry_at_;  // of the row at hand, at each position of its columns
  Vec diagonal_;               // of the pieces alone
  std::vector<std::vector<int>> unknowns_of_points_;
  std::vector<PointTraces> points_;
  std::vector<std::vector<PointAt>> points_at_;  // of each unknown
  std::unique_ptr<RepeatedFactor> factor_;
  Tangents tangents_;  // of the factor
  Tangents at_hand_;   // beside it; empty: its own
  // Of points whose tangents are others, with what they add and how that changes their forces, about.
  struct OtherPoint {
    size_t point;
    Mat added, scale;
  };
  std::vector<OtherPoint> others_;
  bool is_following_ = false, has_others_ = false;
  int n_products_ = 0;
  Mat columns_, answers_;  // of the preloads: T^T g and what the system answers to it
  Mat yielding_;           // c - g^T T A^-1 T^T g
  std::function<void(const std::string&)> watch_;
  Vec x_;
  double imbalance_ = 0.0;
};

}  // namespace dygita
