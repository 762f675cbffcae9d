#include "run/passes.hpp"

#include <algorithm>

#include "base/log.hpp"
#include "result/limits.hpp"
#include "result/spectrum_band.hpp"

namespace dygita {

namespace {

constexpr double first_tolerance = 1e-3;

}  // namespace

std::vector<double> pass_tolerances(const Problem& problem) {
  const bool has_spectra = std::any_of(problem.outputs.begin(), problem.outputs.end(),
                                       [](const OutputPtr& o) { return o->kind == OutputKind::srs; });
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
    if (output->kind != OutputKind::srs) continue;
    const Table &now = result.tables.at(output.get()), &then = before.tables.at(output.get());
    worst = std::max(worst, largest_move(now, then));
    if (const auto band = result.bands.find(output.get()); band != result.bands.end())
      take_iteration_from(now, then, band->second);
  }
  say(fmt::format("  tolerance {:g}: the spectra have moved by up to {:.3g} dB", problem.solver.tolerance, worst));
  result.figures.spectra_moved = worst;
  return worst < problem.solver.spectra;
}

void add_pass(const RunResult& before, RunResult& result) {
  result.figures.passes = 1.0 + before.figures.passes.value_or(1.0);
  result.figures.iterations_of_passes =
      static_cast<double>(result.iterations) +
      before.figures.iterations_of_passes.value_or(static_cast<double>(before.iterations));
}

void say_bands(const Problem& problem, const RunResult& result) {
  for (const OutputPtr& output : problem.outputs) {
    const auto band = result.bands.find(output.get());
    if (band == result.bands.end()) continue;
    const auto mean = [&](const char* column) { return mean_band(band->second, column); };
    say(
        fmt::format("  spectrum '{}': iteration leaves about {:.2g} dB, time step {:.2g} dB, mesh {:.2g} dB (mean over "
                    "its frequencies)",
                    output->name, mean("iteration"), mean("time_step"), mean("mesh")));
  }
}

void warn_of_bands(const Problem& problem, const RunResult& result) {
  for (const OutputPtr& output : problem.outputs) {
    const auto band = result.bands.find(output.get());
    if (band == result.bands.end()) continue;
    if (const double all = mean_band(band->second, "all"); all > limit::spectrum_band)
      warn(
          fmt::format("spectrum '{}' is uncertain by about {:.2g} dB (mean over its frequencies, by the run's own "
                      "estimate): little arrives there beside the errors of dt and the mesh",
                      output->name, all));
  }
}

}  // namespace dygita
