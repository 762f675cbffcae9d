// How Newton's method on the interfaces of a static step proceeds, whatever its unknowns are: friction limited a step
// behind until the solution is near, steps cut, loose parts held until it is known what they rest on (manual, eq. U2
// and below U6).
#pragma once

#include <functional>
#include <vector>

namespace dygita {

class TangentSteps {
 public:
  // Distance (any unit) of the fields at hand from a solution, where friction is limited by these normal trials, one a
  // point; empty: each point's own.
  using Distance = std::function<double(const std::vector<double>& limits)>;

  // Forgets the increment before.
  void begin();
  bool is_first() const { return n_ == 0; }
  // Distance at the start of an iteration, with the limits that it shall have. trials: normal trials of the fields, as
  // of the last distance; eta: their indicator.
  double begin_step(const Distance& distance, const std::function<std::vector<double>()>& trials, double eta);
  // Is friction limited by each point's own normal force, so that the slopes are to know how it follows?
  bool follows() const { return follows_; }
  // What follows has not been solved: limits are a step behind again for some problems.
  void cannot_follow();
  const std::vector<double>& limits() const { return limits_; }
  // Least stiffness of what is open or slides, for TangentBounds.
  double softest() const { return softest_; }
  // How far to go: the first half, quarter, ... that lessens the distance; else the best of them; all the way where the
  // distance may rise. distance: that far.
  double end_step(double before, const std::function<double(double share)>& distance, int n_changed, double eta);

 private:
  void choose_softest(double share, int n_changed, bool is_quiet);

  int n_ = 0;
  bool follows_ = false;
  int n_in_vain_ = 0, n_to_wait_ = 0;  // times in a row that friction has followed; problems until it does again
  double softest_ = 0.0, rises_below_ = 0.0;
  std::vector<double> limits_;  // empty: none yet
};

}  // namespace dygita
