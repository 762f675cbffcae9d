// The iteration of an increment: both stages in turn, and what accelerates and rescues it (latin.cpp).
#pragma once

#include "latin/directions.hpp"
#include "latin/told.hpp"
#include "latin/warm_start.hpp"

namespace dygita {

class Iteration {
 public:
  // k: search directions of the assembled q.
  Iteration(StepData& step, const Vec& k);

  // Both stages in turn from the fields at hand until the goal is reached, as the step is solved; or as told.
  void run(int increment, const Goal& goal, Best& best) { run(*usual_, increment, goal, best); }
  void run(SearchDirections& directions, int increment, const Goal& goal, Best& best);
  // Iterates, and leaves pieces and laws with the answer: the last one, or the best where none is good enough.
  Best answer(int increment, const Goal& goal);
  // Where the iteration of an increment starts; false: not from another case's fields.
  bool predict(int increment);

  // Do strategies correct V of the n-th linear stage? What is in balance to the tolerance is left as it is.
  bool corrects(int n) const;
  void correct();
  void after_local_stage();

  StepData& step() { return step_; }
  Stages& stages() { return stages_; }
  Told& told() { return told_; }
  ConstantDirections& constant() { return constant_; }
  LooseParts* loose_parts() { return loose_; }  // null: no part can be loose

 private:
  bool is_over(int n, const Goal& goal, Persistence& persistence, const Best& best, const Outcome& outcome) const;
  void note(const Outcome& outcome, Best& best);

  StepData& step_;
  Stages stages_;
  Told told_;
  std::optional<WarmStart> warm_start_;
  Strategies strategies_;
  LooseParts* loose_ = nullptr;  // of these
  ConstantDirections constant_;
  std::optional<TangentDirections> tangents_;
  SearchDirections* usual_;
};

}  // namespace dygita
