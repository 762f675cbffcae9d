// How far a step is, for the user who waits, and whether he still does.
#pragma once

#include <optional>
#include <string>

#include "base/aside.hpp"
#include "base/progress.hpp"
#include "latin/step_data.hpp"
#include "latin/tangent_iteration.hpp"

namespace dygita {

class Told {
 public:
  explicit Told(const StepData& step) : step_(step) {}

  void begin_step() { progress_.emplace(step_.model.step->name, step_.model.step->n_increments()); }
  void end_step() { progress_.reset(); }

  // An increment may take minutes: the user who stops the run does not wait for it. Throws Abandoned.
  static void heed_interrupt(int iteration, int every);
  // n_turned: points that answer otherwise than before.
  void tell_iteration(const Best& best, int n_turned);
  // Of what takes long within an iteration.
  void watch(TangentIteration& iteration);
  void begin_increment() { told_.clear(); }
  void end_increment(int done, const std::string& detail) { progress_->update(done, detail); }

 private:
  void tell(const std::string& doing);

  const StepData& step_;
  std::optional<Progress> progress_;  // while the step runs
  std::string told_;                  // how far the increment at hand is
};

}  // namespace dygita
