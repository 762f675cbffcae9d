#include <spdlog/fmt/fmt.h>

#include "checks/parts.hpp"
#include "model/load.hpp"
#include "model/output.hpp"

namespace dygita::check {

void outputs(const Problem& problem) {
  for (const OutputPtr& output : problem.outputs) output->check(problem);
  for (const StepPtr& step : problem.steps)
    for (const LoadPtr& load : step->loads)
      if (const OutputPtr of = load->made_of())
        listed(problem, fmt::format("{} of step '{}' is made of", load->path, step->name), *of, problem.outputs,
               "outputs");
}

}  // namespace dygita::check
