// Progress and interrupts within a static increment, which may take minutes.
#include <spdlog/fmt/fmt.h>

#include "latin/step_run.hpp"

namespace dygita {

void StepRun::heed_interrupt(int iteration, int every) {
  if ((ranks::is_alone() || iteration % every == every - 1) && ranks::any(interrupt_requested())) throw LeftUnsolved();
}

void StepRun::tell_iteration(const Best& best) {
  if (!model_.scheme.is_static) return;
  told_ =
      fmt::format("iteration {}, indicator {:.1e} (to {:.0e})", best.iterations, best.outcome.eta, settings_.tolerance);
  if (assembled_ && !goes_part_by_part_ && assembled_->n_turned() > 0)
    told_ += fmt::format(", {} points changed", assembled_->n_turned());
  tell("");
}

void StepRun::tell(const std::string& doing) {
  if (!progress_ || !progress_->is_due()) return;
  progress_->tell(told_.empty() || doing.empty() ? told_ + doing : told_ + ", " + doing);
}

// Ranks solve the same system each: one that left it would leave the others waiting.
void StepRun::watch(TangentIteration& iteration) {
  iteration.be_watched([this](const std::string& doing) {
    if (ranks::is_alone() && interrupt_requested()) throw LeftUnsolved();
    tell(doing);
  });
}

}  // namespace dygita
