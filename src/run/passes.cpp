#include "run/passes.hpp"

#include <algorithm>

#include "base/log.hpp"
#include "model/output.hpp"

namespace dygita {

namespace {

constexpr double first_tolerance = 1e-3;

}  // namespace

std::vector<double> pass_tolerances(const Problem& problem) {
  const bool has_spectra =
      std::any_of(problem.outputs.begin(), problem.outputs.end(), [](const OutputPtr& o) { return o->settles(); });
  const double last = problem.solver.tolerance;
  std::vector<double> tolerances;
  if (problem.solver.spectra > 0.0 && has_spectra && !problem.monolithic && !problem.explicit_dynamics)
    for (double t = first_tolerance; t > 1.5 * last; t /= 10.0) tolerances.push_back(t);
  tolerances.push_back(last);
  return tolerances;
}

bool have_settled(const Problem& problem, const RunResult& before, RunResult& result) {
  double worst = 0.0;
  for (const OutputPtr& output : problem.outputs) {
    if (!output->settles()) continue;
    const Table &then = before.tables.at(output.get()), &now = result.tables.at(output.get());
    worst = std::max(worst, output->settle(then, now, result.findings[output.get()]));
  }
  say(fmt::format("  tolerance {:g}: the spectra have changed by up to {:.3g} dB", problem.solver.tolerance, worst));
  result.figures.spectra_moved = worst;
  return worst < problem.solver.spectra;
}

void add_pass(const RunResult& before, RunResult& result) {
  result.figures.passes = 1.0 + before.figures.passes.value_or(1.0);
  result.figures.iterations_of_passes =
      static_cast<double>(result.iterations) +
      before.figures.iterations_of_passes.value_or(static_cast<double>(before.iterations));
}

}  // namespace dygita
