// Substructures that are to be explicit: does the problem allow it?
#include "checks/parts.hpp"

namespace dygita::check {

namespace {

std::string why_not(const Problem& problem) {
  if (problem.numerical_damping() != 0.0) return "'numerical_damping' belongs to the implicit scheme";
  if (problem.mass().is_moved_from_contact) return "'massless_contact' gives nodes without mass";
  return "";
}

}  // namespace

void integration(const Problem& problem) {
  if (problem.monolithic || problem.explicit_dynamics || !has_dynamic_step(problem)) return;
  for (const SubstructurePtr& part : problem.substructures) {
    if (part->integration != IntegrationChoice::explicitly) continue;
    if (const std::string reason = why_not(problem); !reason.empty())
      fail(problem, part->origin, "substructure '" + part->name + "' cannot be explicit: " + reason);
  }
}

}  // namespace dygita::check
