#include "latin/told.hpp"

#include <spdlog/fmt/fmt.h>

#include "ranks/ranks.hpp"

namespace dygita {

void Told::heed_interrupt(int iteration, int every) {
  if ((ranks::is_alone() || iteration % every == every - 1) && ranks::any(interrupt_requested())) throw Abandoned();
}

void Told::tell_iteration(const Best& best, int n_turned) {
  if (!step_.model.scheme.is_static) return;
  told_ = fmt::format("iteration {}, indicator {:.1e} (to {:.0e})", best.iterations, best.outcome.eta,
                      step_.settings.tolerance);
  if (n_turned > 0) told_ += fmt::format(", {} points changed", n_turned);
  tell("");
}

void Told::tell(const std::string& doing) {
  if (!progress_ || !progress_->is_due()) return;
  progress_->tell(told_.empty() || doing.empty() ? told_ + doing : told_ + ", " + doing);
}

// Ranks solve the same system each: one that left it would leave the others waiting.
void Told::watch(TangentIteration& iteration) {
  iteration.be_watched([this](const std::string& doing) {
    if (ranks::is_alone() && interrupt_requested()) throw Abandoned();
    tell(doing);
  });
}

}  // namespace dygita
