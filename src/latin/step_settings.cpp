#include "latin/step_settings.hpp"

#include <algorithm>

#include "latin/coarse_correction.hpp"
#include "model/extent.hpp"

namespace dygita {

namespace {

bool is_single(const StepModel& model) {
  return ranks::any(std::any_of(model.pieces.begin(), model.pieces.end(),
                                [](const auto& piece) { return piece->figures().is_in_single_precision; }));
}

}  // namespace

StepSettings step_settings(const Problem& problem, const StepModel& model, bool has_start) {
  const LatinSettings& asked = problem.solver;
  const bool is_static = model.scheme.is_static;
  const int n = model.step->n_increments();
  StepSettings settings;
  settings.i_step = index_of(problem.steps, model.step);
  settings.tolerance = is_static ? asked.static_tolerance : asked.tolerance;
  settings.limit = asked.max_iterations > 0 ? IterationLimit{asked.max_iterations, asked.max_iterations}
                   : model.is_assembled     ? IterationLimit{100, 400}
                   : is_static              ? IterationLimit{400, 5000}
                                            : IterationLimit{200, 2000};
  settings.more_iterations = has_start ? asked.more_iterations : 0;
  settings.round_off = is_single(model) ? 1e-8 : 1e-13;
  settings.window = is_static || model.has_explicit() ? 1 : asked.window == 0 ? n : std::min(asked.window, n);
  settings.assembly_size = extent_of(problem.substructures).size().norm();
  settings.is_assembled = is_static && model.is_assembled;
  settings.has_correction = model.n_q() > 0 && !settings.is_assembled && settings.window == 1 && asked.anderson != 0 &&
                            needs_coarse_correction(model);
  settings.n_inner = model.has_inner_iterations() ? 2 : 0;
  const auto relaxation = [&](double usual) { return asked.relaxation > 0.0 ? asked.relaxation : usual; };
  const auto depth = [&](int usual) { return asked.anderson >= 0 ? asked.anderson : usual; };
  settings.of_increment = {depth(is_static ? 40 : 10), is_static ? 0 : 20, relaxation(is_static ? 0.8 : 0.95)};
  settings.of_window = {depth(settings.window > 20 ? 0 : 5), 0, relaxation(0.8)};
  return settings;
}

}  // namespace dygita
