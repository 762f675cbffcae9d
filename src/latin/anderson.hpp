// Anderson acceleration of a fixed-point iteration q <- G(q).
#pragma once

#include "latin/differences.hpp"

namespace dygita {

class Anderson {
 public:
  using Field = Eigen::Ref<const Vec>;
  // depth: differences of one fixed-point problem kept (0: relaxation alone); n_problems: changes from start to end of
  // past problems kept, with which the next one is predicted; relaxation: share of the residual taken; weight: scales
  // each component of the residual in the least squares (1/sqrt(k)). Collective where the sums are.
  Anderson(int depth, int n_problems, double relaxation, Vec weight, const InterfaceSums& sums);
  // Of one process, in one sum.
  Anderson(int depth, int n_problems, double relaxation, const Vec& weight)
      : Anderson(depth, n_problems, relaxation, weight, InterfaceSums(weight.size())) {}

  // Another fixed-point problem begins: the same derivative or nearly, other data.
  void begin();
  // Takes the first iterate of a problem whose end is known, in place of `advance`: the next one is predicted as if it
  // had been iterated.
  void replay(const Field& q, const Field& image);
  // Replaces q by the next iterate, from image = G(q). The history is cleared where the residual exceeds twice the
  // best.
  void advance(Eigen::Ref<Vec> q, const Field& image);
  // The first sums that `advance` of the same will need, for who takes others at that time: given them it asks for no
  // more. Nothing comes of them where the problem ends instead.
  InterfaceSums::ToCome first_sums(const Field& q, const Field& image);
  void take_first_sums(const double* sums, int n) { first_sums_.assign(sums, sums + n); }
  int n_problems() const { return n_problems_; }
  // Relaxation alone while it is so.
  void pause(bool is_paused) { is_paused_ = is_paused; }
  bool accelerates() const { return depth_ > 0 && !is_paused_; }
  // The problem ends with q. If it is solved, what it changed helps to predict the next; if not, nothing past does.
  void end(const Field& q, const Field& image, bool is_solved);

 private:
  int depth_, n_problems_;
  double relaxation_;
  Vec weight_;
  Differences recent_, past_;
  Vec q_first_, q_before_, residual_first_, residual_before_, residual_;
  InterfaceSums sums_;
  std::vector<double> first_sums_;  // of the next `advance`; empty: they are not known
  bool has_before_ = false, is_paused_ = false;
  double best_ = 0.0;
};

}  // namespace dygita
