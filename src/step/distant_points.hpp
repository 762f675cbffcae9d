// Points are kept by the ranks whose pieces they touch, and by no other. One of these books a point: it answers rank 0,
// where an output reads its fields.
#pragma once

#include <vector>

#include "step/step_model.hpp"

namespace dygita {

class DistantPoints {
 public:
  // Question::what, of a surface; those that are asked of pieces are not negative.
  static constexpr int asked = -1;

  // state: of all surfaces, known to all ranks at the start of a step. Collective.
  DistantPoints(const StepModel& model, State& state);

  // Rank that books a point: who has the piece of its first port.
  static int booking(const StepModel& model, const Point& point);
  // Points of a surface that this rank books, and those that all ranks keep since they have no part in the step.
  const std::vector<int>& here(int surface) const { return here_[static_cast<size_t>(surface)]; }
  // Another time step of the deck is over: what is booked elsewhere is not known any more, and no number.
  void forget();
  // On rank 0, while the others answer: the surface's fields in the state are those of now.
  void complete(int surface) const;
  // What this rank has booked of it.
  std::vector<double> answer(int surface) const;
  // Collective: the same of all surfaces on all ranks.
  void complete_all();

 private:
  // Do other ranks book points of a surface?
  bool has_others(size_t surface) const {
    return n_ranks_[surface] > 1 || (n_ranks_[surface] == 1 && own_[surface].empty());
  }
  void complete_some(size_t first, size_t end);

  State* state_;
  std::vector<std::vector<int>> here_, own_;
  std::vector<int> n_ranks_;               // of each surface, those that book points of it
  std::vector<std::vector<int>> booking_;  // on rank 0, of each surface: which ranks these are, but itself
  mutable std::vector<char> is_known_;
};

// Collective. Interfaces and energies of rank 0, on all: where each has solved all for itself, on a processor that may
// round otherwise.
void share_first(State& state);

}  // namespace dygita
