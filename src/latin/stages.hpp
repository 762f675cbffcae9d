// The two stages of the method, and what begins and ends an increment around them.
#pragma once

#include <optional>

#include "latin/anderson.hpp"
#include "latin/step_data.hpp"
#include "latin/tangent_iteration.hpp"

namespace dygita {

class Stages {
 public:
  // k: search directions of the assembled q.
  Stages(StepData& step, const Vec& k);

  // Linear stage: velocities at the interfaces for data q, every piece by itself (or all in one system). Neighbours are
  // sent both, as soon as the pieces whose data they receive have answered, where is_sent. in_half: see
  // Piece::interface_velocity_in_half.
  void linear_stage(const Vec& q, Vec& velocity, bool is_sent = false, bool in_half = false);
  // Local stage: the law at every interface point, with what other ranks have at theirs; image = F_hat + k W_hat.
  // Returns the distance between both stages. also: an acceleration whose first sums come with it.
  IndicatorSums local_stage(Vec& velocity, Vec& q, Vec& image, bool is_sent = false, Anderson* also = nullptr);
  // Both, for data q at hand.
  void answer();

  // Right-hand sides of an increment, and all that it changes on the interfaces before any iteration. Returns the
  // velocities of motions at its end.
  std::vector<double> begin_pieces(int increment);
  void begin_increment(int increment, bool starts_window);
  // Interiors of an increment for the data found.
  void finish_increment(const Vec& found);

  // Of a static step with all pieces in one system; else null.
  TangentIteration* system() { return system_ ? &*system_ : nullptr; }

 private:
  StepData& step_;
  std::optional<TangentIteration> system_;
  PieceLoops::InTurn turns_;
};

}  // namespace dygita
