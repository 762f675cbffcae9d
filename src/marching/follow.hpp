// Increments that were computed before are gone over again: from what their iterations left behind everything else
// follows, bit for bit (manual, "The checkpoint").
#pragma once

#include "latin/iteration.hpp"

namespace dygita {

class Follow {
 public:
  explicit Follow(Iteration& iteration) : iteration_(iteration), step_(iteration.step()) {}

  // Have n increments been computed before?
  bool leads(long n) const { return leaves() && step_.files.trail->leads(n); }
  bool leaves() const { return step_.files.trail != nullptr; }
  // An increment up to where its interiors are finished: gone over again where is_led, else iterated, and what it
  // leaves for that.
  Best solve(int increment, const Goal& goal, bool is_led);
  // The same of the time steps of a window. missed: of the first.
  void leave_window(const std::vector<Vec>& q, int iterations, double eta, const std::optional<Missed>& missed);
  TrailEntry take_entry();

 private:
  Best go_over(int increment, const Goal& goal);
  Best go_over_again(const TrailEntry& entry, int increment, const Goal& goal);
  void leave(const Best& best, bool is_solved);

  Iteration& iteration_;
  StepData& step_;
};

}  // namespace dygita
