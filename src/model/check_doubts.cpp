#include <algorithm>

#include "model/check.hpp"
#include "model/load.hpp"
#include "model/output.hpp"

namespace dygita::check {

namespace {

bool is_touched(const Problem& problem, const SubstructurePtr& part) {
  for (const InterfacePtr& interface : problem.interfaces) {
    if (interface->side_1.part == part || interface->side_2.part == part) return true;
  }
  for (const SupportPtr& support : all_supports(problem)) {
    for (const FaceOrRegion& place : support->on) {
      if (&part_of(place) == part.get()) return true;
    }
  }
  for (const StepPtr& step : problem.steps) {
    for (const LoadPtr& load : step->loads) {
      for (const Target& target : load->on) {
        const auto place = place_of(target);
        if (place && &part_of(*place) == part.get()) return true;
      }
    }
  }
  return false;
}

void doubt_supports(const Problem& problem, bool moves) {
  for (const SupportPtr& support : problem.supports) {
    const bool is_used = std::any_of(problem.steps.begin(), problem.steps.end(), [&](const StepPtr& step) {
      return index_of(supports_of(problem, *step), support.get()) >= 0;
    });
    if (!is_used) {
      doubt(problem, support->origin, describe(*support) + " holds in no step: every step has 'supports' of its own");
    }
  }
  if (moves) return;
  for (const SupportPtr& support : all_supports(problem)) {
    if (support->kind != SupportKind::absorbing) continue;
    doubt(problem, support->origin, describe(*support) + " acts like a fixed one: there is no dynamic step");
  }
}

}  // namespace

void doubts(const Problem& problem) {
  const bool moves = has_dynamic_step(problem);
  const bool has_spectrum = std::any_of(problem.outputs.begin(), problem.outputs.end(),
                                        [](const OutputPtr& output) { return output->settles(); });
  if (problem.solver.spectra > 0.0 && !has_spectrum)
    doubt(
        problem, problem.origin,
        "'spectra' of solver.latin waits for spectra to stand still, and no output.srs is asked for: one pass is run");
  for (const SubstructurePtr& part : problem.substructures) {
    const std::string who = "substructure '" + part->name + "'";
    if (!is_touched(problem, part)) doubt(problem, part->origin, "no interface, support or load touches " + who);
    if (!moves && !part->velocity.isZero()) {
      doubt(problem, part->origin, "the velocity of " + who + " is not used: there is no dynamic step");
    }
  }
  doubt_supports(problem, moves);
  for (const OutputPtr& output : problem.outputs) output->doubt(problem);
}

}  // namespace dygita::check
