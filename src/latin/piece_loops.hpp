// Loops over the pieces of a step that are solved here, on the threads at hand.
#pragma once

#include "base/parallel.hpp"
#include "base/thread_choice.hpp"
#include "latin/piece_clock.hpp"
#include "step/step_model.hpp"

namespace dygita {

class PieceLoops {
 public:
  explicit PieceLoops(const StepModel& model);

  // Pieces that other ranks receive, and the rest, the largest first.
  struct InTurn {
    std::vector<int> border, interior;
  };
  InTurn in_turn(const std::vector<int>& border) const;

  // f(piece, index) on some of the pieces that are here; on all of them; f(pieces, indices) on every group of pieces
  // that are solved together.
  template <class Function>
  void for_each(const std::vector<int>& pieces, Function&& f) {
    parallel_for(
        static_cast<int>(pieces.size()),
        [&](int at) {
          const PieceClock clock(seconds_, {pieces[at]});
          f(*model_.pieces[pieces[at]], pieces[at]);
        },
        Schedule::as_free, threads.threads());
  }
  template <class Function>
  void for_each(Function&& f) {
    for_each(largest_first_, f);
  }
  template <class Function>
  void for_each_group(Function&& f) {
    parallel_for(static_cast<int>(model_.equal.size()), [&](int i) {
      std::vector<Piece*> group;
      for (const int member : model_.equal[i]) group.push_back(model_.pieces[member].get());
      const PieceClock clock(seconds_, model_.equal[i]);
      f(group, model_.equal[i]);
    });
  }
  // Of a processor, of each piece; empty: one process, whose phases tell enough.
  const std::vector<double>& seconds() const { return seconds_; }

  ThreadChoice threads;  // of loops over pieces

 private:
  const StepModel& model_;
  std::vector<int> largest_first_;
  std::vector<double> seconds_;
};

}  // namespace dygita
