// What runs share whose problems differ in numbers of laws, loads and starts alone, as members of an ensemble do
// (model/members.hpp): one cut, its bodies and, of each step, the pieces of the first run, whose factors and interface
// operators serve the others.
#pragma once

#include <memory>
#include <vector>

#include "step/make_pieces.hpp"

namespace dygita {

struct ExplicitOperator;
class CoarseCorrection;

// N/m, of the laws at each port that are springs: zero elsewhere. Those that are springs under pressure alone are taken
// where rough faces are pressed at all. Static steps, whose search directions follow them; else empty.
std::vector<Vec3> law_springs(const StepModel& model);

// Of a step of an earlier run. No pieces: it has kept none.
struct StepOperators {
  Pieces pieces;
  Integration integration;
  std::vector<Vec3> springs;
  double bytes = 0.0;
  bool is_assembled = false;  // in one system, which is not kept
};

class SharedOperators {
 public:
  bool are_made() const { return cut_ != nullptr; }
  // By the first run, and by one alone.
  void make_for(const Problem& problem, const std::vector<Surface>& surfaces, CutPtr cut);
  // Not for another whose laws are of other kinds where that decides about masses.
  bool serve(const Problem& problem, const std::vector<Surface>& surfaces) const;

  const CutPtr& cut() const { return cut_; }
  const std::vector<Body>& bodies() const { return bodies_; }
  // Null: there is nothing to take over.
  const StepOperators* of_step(size_t i_step) const;
  // What the first run has made of them (latin/coarse_correction.hpp); forgotten where they are not kept.
  std::shared_ptr<const CoarseCorrection>& coarse_of_step(size_t i_step);
  // Has the first run left all that others need: pieces of every step, but for those that each makes and gives up?
  bool have_all() const;
  // Takes the pieces of a step that has come to its end, unless it has some, they are solved in one system or there is
  // no room for them beside those of the steps to come.
  void keep(size_t i_step, StepModel& model);

 private:
  CutPtr cut_;
  std::vector<Body> bodies_;
  std::vector<char> massless_;  // may mass move from the nodes of each surface? Empty: none does
  std::vector<StepOperators> steps_;
  std::vector<std::shared_ptr<const CoarseCorrection>> coarse_;
};

// Do operators (bytes) that are kept leave twice as much for those of other steps and for what else a run takes?
// available: beside them; 0: nobody knows.
bool leave_room(double kept, double available);

// The same piece of an earlier run, whose operator is what the piece of this set-up would make; null: it is another.
const ImplicitPiece* same_implicit(const PieceSetup& setup, const Piece& earlier);
std::shared_ptr<const ExplicitOperator> same_explicit(const PieceSetup& setup, const Piece& earlier);

}  // namespace dygita
