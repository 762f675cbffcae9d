#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "checks/parts.hpp"
#include "law/law.hpp"

namespace dygita::check {

namespace {

// The steps form one line, in the order listed, from the undeformed state.
void steps_are_a_line(const Problem& problem) {
  const std::vector<StepPtr>& steps = problem.steps;
  for (size_t i = 0; i < steps.size(); ++i) {
    const Step& step = *steps[i];
    const std::string who = "step '" + step.name + "'";
    if (step.after) listed(problem, who + " comes after", *step.after, steps, "steps");
    if (i == 0 && step.after) {
      fail(problem, step.origin, who + " is listed first but follows '" + step.after->name + "'",
           "list the steps in the order they happen");
    }
    if (i == 0) continue;
    const std::string& previous = steps[i - 1]->name;
    if (!step.after) {
      fail(problem, step.origin,
           who + " has no 'after', so it starts from the undeformed state, but '" + previous + "' is listed before it",
           "write after = the step '" + previous + "', or make two problems");
    }
    if (step.after != steps[i - 1]) {
      fail(problem, step.origin,
           who + " comes after '" + step.after->name + "', but '" + previous + "' is listed before it",
           "steps form one sequence in the order listed; use two problems for a branch");
    }
  }
}

void static_step_has_increments(const Problem& problem, const Step& step) {
  if (step.increments >= 1) return;
  fail(problem, step.origin,
       fmt::format("step '{}': 'increments' = {}, at least 1 is needed", step.name, step.increments));
}

// A number of dt is a whole one up to the rounding of `200*us / (1*us)`.
void dynamic_step_has_times(const Problem& problem, const Step& step) {
  const std::string who = "step '" + step.name + "'";
  if (!(step.duration > 0.0) || !std::isfinite(step.duration)) {
    fail(problem, step.origin, fmt::format("{}: 'duration' = {:g} s, it must be positive", who, step.duration));
  }
  if (!(step.dt > 0.0) || !std::isfinite(step.dt)) {
    fail(problem, step.origin, fmt::format("{}: 'dt' = {:g} s, it must be positive", who, step.dt));
  }
  const double n = step.duration / step.dt, nearest = std::max(1.0, std::round(n));
  const double rounding = 1e-6;
  if (n < 1.0 - rounding) {
    fail(problem, step.origin,
         fmt::format("{}: 'dt' = {:g} s is longer than 'duration' = {:g} s", who, step.dt, step.duration));
  }
  const double most = 1e8;
  if (n > most) {
    fail(problem, step.origin, fmt::format("{}: 'duration' / 'dt' is {:g} increments, more than {:g}", who, n, most),
         "was a unit forgotten?");
  }
  if (std::abs(n - nearest) > rounding) {
    fail(problem, step.origin,
         fmt::format("{}: 'duration' = {:g} s is not a multiple of 'dt' = {:g} s ({:.6g} increments)", who,
                     step.duration, step.dt, n),
         fmt::format("nearest: duration = {:.9g} s, or dt = {:.9g} s ({:.0f} increments)", nearest * step.dt,
                     step.duration / nearest, nearest));
  }
}

// An interference that appears at once would be a shock of the model, not of the assembly.
void interferences_are_closed_in_a_static_step(const Problem& problem) {
  const Step& first = *problem.steps.front();
  if (first.is_static) return;
  const auto check_gap = [&](const Origin& origin, const std::string& what, double gap) {
    if (gap >= 0.0) return;
    fail(problem, origin,
         fmt::format("{} has 'gap' = {:g} m, an interference, but the first step, '{}', is dynamic", what, gap,
                     first.name),
         "put a step.static before it to press the parts apart");
  };
  for (const InterfacePtr& interface : problem.interfaces) {
    check_gap(interface->origin, describe(*interface), interface->law->initial().gap);
    double least = 0.0;
    for (const auto& [node, gap] : interface->form[0]) least = std::min(least, gap);
    check_gap(interface->origin, describe(*interface), least);
  }
  for (const SupportPtr& support : all_supports(problem))
    if (const LawPtr law = support->kind->law()) check_gap(support->origin, describe(*support), law->initial().gap);
}

}  // namespace

void steps(const Problem& problem) {
  steps_are_a_line(problem);
  for (const StepPtr& step : problem.steps) {
    if (step->is_static) {
      static_step_has_increments(problem, *step);
    } else {
      dynamic_step_has_times(problem, *step);
    }
  }
  interferences_are_closed_in_a_static_step(problem);
}

}  // namespace dygita::check
