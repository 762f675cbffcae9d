#include <algorithm>

#include "law/law.hpp"
#include "model/check.hpp"

namespace dygita::check {

namespace {

void support_is_on_what_it_can_be(const Problem& problem, const Support& support) {
  if (support.on.empty()) fail(problem, support.origin, describe(support) + " is on nothing");
  for (size_t i = 0; i < support.on.size(); ++i) {
    const FaceOrRegion& place = support.on[i];
    place_exists(problem, support.origin, describe(support) + " is on", place);
    if (!support.kind->takes_regions() && std::holds_alternative<Region>(place)) {
      fail(problem, support.origin, describe(support) + " is on a region: " + label_of(place),
           "a region has no normal and no area: give a face (part:face \"group\"); support.fixed takes both");
    }
    for (size_t j = 0; j < i; ++j) {
      if (!coincide(place, support.on[j])) continue;
      fail(problem, support.origin,
           describe(support) + " is twice on the same place: " + label_of(support.on[j]) + ", " + label_of(place));
    }
  }
}

void supports_do_not_coincide(const Problem& problem, const Step& step, const Support& a, const Support& b) {
  for (const FaceOrRegion& place_a : a.on) {
    for (const FaceOrRegion& place_b : b.on) {
      if (!coincide(place_a, place_b)) continue;
      fail(problem, b.origin,
           "step '" + step.name + "': " + label_of(place_b) + " is under both " + describe(a) + " and " + describe(b),
           "one support per face: 'supports' of a step replaces the problem's for that step");
    }
  }
}

}  // namespace

void interfaces(const Problem& problem) {
  const bool is_explicit =
      problem.explicit_dynamics &&
      std::any_of(problem.steps.begin(), problem.steps.end(), [](const StepPtr& step) { return !step->is_static; });
  for (const InterfacePtr& interface : problem.interfaces) {
    const std::string who = describe(*interface);
    for (const Face* side : {&interface->side_1, &interface->side_2}) {
      place_exists(problem, interface->origin, who + " joins", *side);
    }
    if (interface->side_1.part == interface->side_2.part && interface->side_1.group == interface->side_2.group) {
      fail(problem, interface->origin, who + " joins " + interface->side_1.label() + " with itself",
           "'between' requires two faces that touch");
    }
    const ExplicitForm form = interface->law->explicit_form();
    if (form.is_none() && is_explicit)
      fail(problem, interface->origin, "solver.explicit does not take " + who + ": " + form.refusal,
           "use solver.latin or solver.monolithic");
  }
}

void supports(const Problem& problem) {
  for (const SupportPtr& support : all_supports(problem)) support_is_on_what_it_can_be(problem, *support);
  for (const StepPtr& step : problem.steps) {
    const std::vector<SupportPtr>& in_force = supports_of(problem, *step);
    for (size_t i = 0; i < in_force.size(); ++i) {
      for (size_t j = 0; j < i; ++j) supports_do_not_coincide(problem, *step, *in_force[j], *in_force[i]);
    }
  }
}

}  // namespace dygita::check
