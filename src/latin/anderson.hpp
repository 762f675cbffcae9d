// Anderson acceleration of a fixed-point iteration q <- G(q).
#pragma once

#include <deque>

#include "numerics/types.hpp"

namespace dygita {

class Anderson {
 public:
  // depth: differences kept (0: relaxation alone); relaxation: share of the residual taken; weight: scales each component of the
  // residual in the least squares (1/sqrt(k)).
  Anderson(int depth, double relaxation, Vec weight) : depth_(depth), relaxation_(relaxation), weight_(std::move(weight)) {}

  void clear();
  // Replaces q by the next iterate, from image = G(q). The history is cleared where the residual exceeds twice the best.
  void advance(Vec& q, const Vec& image);

 private:
  int depth_;
  double relaxation_;
  Vec weight_;
  Vec q_before_, residual_before_;
  std::deque<Vec> dq_, df_;  // differences of iterates and of weighted residuals
  double best_ = 0.0;
};

}  // namespace dygita
