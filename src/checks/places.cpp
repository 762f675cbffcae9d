#include <algorithm>

#include "checks/parts.hpp"
#include "law/law.hpp"

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

// Its places would have to jump to where the sum is zero.
void equations_are_there_from_the_start(const Problem& problem) {
  for (size_t i = 1; i < problem.steps.size(); ++i) {
    const std::vector<SupportPtr>&before = supports_of(problem, *problem.steps[i - 1]),
          &now = supports_of(problem, *problem.steps[i]);
    for (const SupportPtr& support : now)
      if (support->kind->sums() != Directions::none && index_of(before, support.get()) < 0)
        fail(problem, support->origin,
             "step '" + problem.steps[i]->name + "': " + describe(*support) + " is not in step '" +
                 problem.steps[i - 1]->name + "' before it",
             "an equation can end with a step, not begin with one that is not the first");
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
    if (interface->means && is_explicit)
      fail(problem, interface->origin, "solver.explicit does not take " + who + ", which joins mean motions",
           "use solver.latin or solver.monolithic");
    const ExplicitForm form = interface->law->explicit_form();
    if (form.is_none() && is_explicit)
      fail(problem, interface->origin, "solver.explicit does not take " + who + ": " + form.refusal,
           "use solver.latin or solver.monolithic");
  }
}

void supports(const Problem& problem) {
  for (const SupportPtr& support : all_supports(problem)) {
    support_is_on_what_it_can_be(problem, *support);
    if (support->kind->sums() != Directions::none && problem.explicit_dynamics && has_dynamic_step(problem))
      fail(problem, support->origin, "solver.explicit does not take " + describe(*support),
           "use solver.latin or solver.monolithic");
  }
  equations_are_there_from_the_start(problem);
  for (const StepPtr& step : problem.steps) {
    const std::vector<SupportPtr>& in_force = supports_of(problem, *step);
    for (size_t i = 0; i < in_force.size(); ++i) {
      if (in_force[i]->kind->sums() != Directions::none) continue;  // what else holds its places is another matter
      for (size_t j = 0; j < i; ++j)
        if (in_force[j]->kind->sums() == Directions::none)
          supports_do_not_coincide(problem, *step, *in_force[j], *in_force[i]);
    }
  }
}

}  // namespace dygita::check
