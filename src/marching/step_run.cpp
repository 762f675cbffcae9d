#include "marching/step_run.hpp"

#include <algorithm>

namespace dygita {

StepRun::StepRun(const StepSettings& settings, StepModel& model, const Vec& k, const RunFiles& files)
    : step_(settings, model, k, files),
      iteration_(step_, k),
      books_(step_),
      increments_(model.has_explicit()   ? substeps(iteration_, books_)
                  : settings.window == 1 ? single_increments(iteration_, books_)
                                         : windows(iteration_, books_)) {}

void StepRun::run() {
  iteration_.told().begin_step();
  run_increments();
  iteration_.told().end_step();
}

void StepRun::run_increments() {
  const int n = step_.model.step->n_increments(), window = step_.settings.window;
  books_.begin_step();
  for (int i = 0; i < n && !ranks::any(interrupt_requested()); i += window) {
    const int last = std::min(i + window, n);
    try {
      increments_->solve(i, last);
    } catch (const Abandoned&) {
      is_left_unsolved_ = true;
      return;
    }
    iteration_.told().end_increment(last, books_.describe_progress());
  }
  books_.end_step();
  if (step_.settings.is_assembled) share_first(step_.files.state);
}

void StepRun::add_to(SolverFigures& figures) {
  const TangentIteration* const system = iteration_.stages().system();
  books_.add_to(figures, system ? system->bytes() : 0.0, increments_->gap_difference());
}

}  // namespace dygita
