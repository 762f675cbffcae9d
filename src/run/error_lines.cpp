#include "run/error_lines.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "result/contact_summary.hpp"

namespace dygita {

namespace {

// Where iterations go on to far less than dt and mesh leave: the tolerance that would do. Empty: there is none.
std::string tolerance_line(const Problem& problem, const RunResult& result) {
  constexpr double enough = 1e-4, many = 30.0, beside = 0.01;  // of what dt or the mesh leaves
  constexpr double faster = 3.0;  // iteration errors grow that much faster than a tolerance of a hundred times
  const Figures& figures = result.figures;
  if (problem.monolithic || problem.explicit_dynamics || problem.solver.tolerance >= enough ||
      problem.solver.spectra > 0.0 || !figures.iteration_error || !figures.mesh_error)
    return "";
  double most = 0.0;
  for (const StepSummary& step : result.steps)
    if (!step.is_static && step.increments > 0)
      most = std::max(most, static_cast<double>(step.iterations) / step.increments);
  const double left = faster * enough / problem.solver.tolerance * *figures.iteration_error;
  const double others = std::max(figures.time_step_error.value_or(0.0), *figures.mesh_error);
  if (most < many || left > beside * others) return "";
  return fmt::format(
      "  solver.latin{{ tolerance = {:g} }} would need fewer than these {:.0f} iterations an increment: it would leave "
      "{:.1g} % or less, where dt and mesh leave {:.2g} %",
      enough, most, left, others);
}

}  // namespace

std::vector<std::string> error_lines(const Problem& problem, const RunResult& result) {
  std::vector<std::string> lines;
  const Figures& figures = result.figures;
  if (figures.mesh_error)
    lines.push_back(fmt::format(
        "  estimated errors (energy norm, {:.3g} kHz on average): {} {:.2g} %, time step {:.2g} %, mesh {:.2g} %",
        figures.mean_frequency.value() / 1e3, figures.penalty_error ? "penalty" : "iteration",
        (figures.penalty_error ? figures.penalty_error : figures.iteration_error).value(),
        figures.time_step_error.value(), *figures.mesh_error));
  if (std::string line = tolerance_line(problem, result); !line.empty()) lines.push_back(std::move(line));
  if (figures.mesh_frequency_error)
    lines.push_back(fmt::format(
        "  use these to choose dt and mesh, since lags accumulate in them; errors to report: a frequency is off by "
        "{:.2g} % (time step) and {:.2g} % (mesh), an amplitude by {:.2g} % (mesh), a spectrum by its band",
        figures.step_frequency_error.value(), *figures.mesh_frequency_error, figures.mesh_amplitude_error.value()));
  if (figures.mesh_frequency_error && contacts_change(problem, result.contacts))
    lines.push_back(
        "  contacts touch, open or slide in the shock, when and where dt and mesh decide: these errors are orders of "
        "magnitude there; compare with a finer run (dygita converge)");
  if (figures.static_mesh_error)
    lines.push_back(fmt::format(
        "  estimated errors of static steps: iteration {:.2g} %, mesh {:.2g} % (of stresses; of the displacement "
        "under a load its square, {:.2g} %)",
        figures.static_iteration_error.value(), *figures.static_mesh_error,
        std::pow(*figures.static_mesh_error, 2) / 100.0));
  return lines;
}

}  // namespace dygita
