// How the two stages take turns: with constant search directions, or with the tangents of the laws.
#pragma once

#include <optional>

#include "latin/loose_parts.hpp"
#include "latin/stages.hpp"

namespace dygita {

class SearchDirections {
 public:
  virtual ~SearchDirections() = default;
  // Iterations begin from the fields at hand. tolerance: of the indicator.
  virtual void begin(double tolerance) = 0;
  // V for q, before the n-th local stage. is_sent: neighbours are sent both.
  virtual void linear_stage(int n, bool is_sent) = 0;
  // What V misses of being the answer to q, beside the indicator.
  virtual double imbalance() const { return 0.0; }
  // Near a solution: is something changed, so that the laws are to answer once more?
  virtual bool settles(const Goal& /*goal*/, const Outcome& /*outcome*/, Best& /*best*/) { return false; }
  // From the image to the data of the next linear stage.
  virtual void advance(const Outcome& outcome) = 0;
  virtual void end(bool /*is_solved*/, Best& /*best*/) {}
  virtual int n_turned() const { return 0; }  // points that answered otherwise in the last iteration
};

// Search directions k: relaxed and accelerated data are answered.
class ConstantDirections final : public SearchDirections {
 public:
  explicit ConstantDirections(StepData& step, Stages& stages);
  void begin(double tolerance) override;
  void linear_stage(int n, bool is_sent) override;
  bool settles(const Goal& goal, const Outcome& outcome, Best& best) override;
  void advance(const Outcome& outcome) override;
  Anderson& acceleration() { return anderson_; }

 private:
  StepData& step_;
  Stages& stages_;
  Anderson anderson_;
  // Changes within an increment are answered in half precision (manual, eq. A6): was the last linear stage, is the next
  // one to be whole, has one been so near the tolerance?
  const bool has_half_;
  bool is_in_half_ = false, is_whole_due_ = false, is_near_ = false;
  double tolerance_ = 0.0, eta_before_ = 0.0;
};

// All pieces in one system: V and F are in balance after every iteration but the first.
class TangentDirections final : public SearchDirections {
 public:
  // loose: null: no part can be.
  TangentDirections(StepData& step, Stages& stages, TangentIteration& system, LooseParts* loose)
      : step_(step), stages_(stages), system_(system), loose_(loose) {}
  void begin(double tolerance) override;
  void linear_stage(int n, bool is_sent) override;
  double imbalance() const override { return is_balanced_ ? system_.imbalance() : 1.0; }
  bool settles(const Goal& goal, const Outcome& outcome, Best& best) override;
  void advance(const Outcome& outcome) override;
  void end(bool is_solved, Best& best) override;
  int n_turned() const override { return system_.n_turned(); }

 private:
  struct Carried {
    Vec velocity, q;
    Outcome outcome;
  };
  StepData& step_;
  Stages& stages_;
  TangentIteration& system_;
  LooseParts* loose_;
  std::optional<Carried> carried_;  // a solution with loose parts carried along
  bool has_left_ = false, is_balanced_ = false;
};

}  // namespace dygita
