// Coarse correction: the forces that tied substructures exert on each other are brought into balance against rigid
// motions of each of them, so that what happens far away is felt within an iteration (manual, coarse correction).
#pragma once

#include <Eigen/Cholesky>
#include <vector>

#include "step/step_model.hpp"

namespace dygita {

class CoarseCorrection {
 public:
  CoarseCorrection() = default;  // none
  // k: search directions of all unknowns (length n_q), as the pieces have them. Costs the inverse of each piece's
  // operator on its tied unknowns, and a dense matrix of 6 unknowns per substructure.
  CoarseCorrection(const StepModel& model, const Vec& k);
  bool is_empty() const { return pieces_.empty(); }
  // Is it, made of another run's step, what this one would make? Of pieces that share the operators of that one's,
  // which are still there (step/shared_operators.hpp).
  bool serves(const StepModel& model, const Vec& k) const;
  // Changes data q and the velocities that the linear stage answered them with, which remain its answer, of the pieces
  // that are here. Changes nothing where the forces of the ties are in balance. Collective.
  void correct(Vec& q, Vec& velocity);

 private:
  // The share of a piece; c coarse motions reach its tied unknowns.
  struct Local {
    std::vector<int> tied, rest;  // near unknowns; of pieces elsewhere none
    std::vector<int> motions;     // coarse motions, length c
    std::vector<char> balances;   // of the tied: no law has a say in their balance
    Vec k;                        // of the tied that balance, else 0
    Mat shape, data,
        answer;  // tied x c: velocities, and the q that brings them; rest x c: velocities that come with it
    Vec force, amount, change;  // work space
  };
  // A tied unknown: its side of its point moves as one.
  struct Tied {
    int unknown, port, point, direction;
    double share;  // of the side's k
    bool balances;
    bool operator==(const Tied&) const = default;
  };
  using Side = std::vector<Tied>;
  static std::vector<Side> find_sides(const StepModel& model, const Vec& k);
  void make_shapes(const StepModel& model, const Vec& k, const std::vector<Side>& sides);
  // Data and answers of a piece; returns its share of the coarse stiffness (c x c).
  static Mat respond(const Piece& piece, int offset, Local& local);

  void complete_motions(const Cut& cut);
  void complete_shares(const StepModel& model, std::vector<Mat>& share) const;

  // What it is made of: sides, search directions, operators of the pieces.
  std::vector<Side> sides_;
  Vec k_;
  std::vector<const void*> operators_;
  std::vector<Local> pieces_;
  std::vector<int> here_;
  std::vector<int> first_;  // of each piece's amounts in those of all
  ranks::Segments of_amounts_;
  std::vector<double> amounts_;
  Eigen::LLT<Mat> factor_;
  Vec amount_;
};

// Does what happens in a time step reach across a substructure (or at once, in a static step)? Below, the correction
// changes nothing that the iteration does not find as fast.
bool needs_coarse_correction(const StepModel& model);

}  // namespace dygita
