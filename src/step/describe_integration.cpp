// What is said of the choice, in one line.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <limits>

#include "base/name_list.hpp"
#include "fem/mass.hpp"
#include "model/model.hpp"
#include "step/integration.hpp"

namespace dygita {

namespace {

// Substructures by the reason that keeps them implicit; none: they may be explicit.
using ByReason = std::vector<std::pair<std::string, std::vector<std::string>>>;

void add_to(ByReason& groups, std::string reason, const std::string& name) {
  if (reason.starts_with("interface '"))
    reason = "interfaces between meshes that do not match bind it to implicit ones";
  const auto it = std::find_if(groups.begin(), groups.end(), [&](const auto& group) { return group.first == reason; });
  if (it == groups.end())
    groups.push_back({reason, {name}});
  else
    it->second.push_back(name);
}

// "tuned mass in 'rod' (lumped mass would give a phase lag of up to 3.2 rad), ": what is not lumped.
std::string mass_of_explicit(const Integration& integration, const Problem& problem) {
  std::vector<std::string> tuned;
  ByReason lumped;
  bool has_diagonal = false, has_lumped = false;
  double phase = 0.0;
  for (size_t i = 0; i < integration.parts.size(); ++i) {
    const Integration::Part& part = integration.parts[i];
    if (!part.is_explicit) continue;
    has_diagonal |= has_consistent_mass(*problem.substructures[i]->mesh);
    has_lumped |= !part.is_tuned;
    if (!part.why_lumped.empty() && !has_consistent_mass(*problem.substructures[i]->mesh))
      add_to(lumped, part.why_lumped, problem.substructures[i]->name);
    if (!part.is_tuned) continue;
    tuned.push_back(problem.substructures[i]->name);
    phase = std::max(phase, part.phase);
  }
  std::string text = tuned.empty() ? "" : has_lumped ? "tuned mass in " + list_of_names(tuned) : "tuned mass";
  if (phase > 0.0) text += fmt::format(" (lumped mass would give a phase lag of up to {:.2g} rad)", phase);
  if (!text.empty()) text += ", ";
  for (const auto& [reason, names] : lumped)
    text += fmt::format("{}{} ({}), ", &reason == &lumped.front().first ? "lumped, despite the phase lag: " : "",
                        list_of_names(names), reason);
  return has_diagonal ? text + "diagonal mass in cells of order two, " : text;
}

}  // namespace

std::string describe(const Integration& integration, const Problem& problem, const Step& step) {
  if (integration.parts.empty()) return "";
  std::vector<std::string> is_explicit;
  ByReason is_implicit;
  double shortest = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < integration.parts.size(); ++i) {
    const Integration::Part& part = integration.parts[i];
    const std::string& name = problem.substructures[i]->name;
    if (part.is_explicit) {
      is_explicit.push_back(name);
      shortest = std::min(shortest, part.longest);
    } else {
      add_to(is_implicit, part.why_not, name);
    }
  }
  std::string text;
  if (!is_explicit.empty())
    text = fmt::format(
        "explicit: {}; {}{} increment{} of {:.4g} us in each dt (stable to {:.4g} us), an estimated {:.2g} "
        "of the cost of implicit ones",
        list_of_names(is_explicit), mass_of_explicit(integration, problem), integration.n_substeps,
        integration.n_substeps == 1 ? "" : "s", 1e6 * step.dt / integration.n_substeps, 1e6 * shortest,
        integration.cost);
  for (size_t i = 0; i < is_implicit.size(); ++i) {
    const auto& [reason, names] = is_implicit[i];
    text += (text.empty() ? "implicit: " : i == 0 ? "; implicit: " : ", ") + list_of_names(names);
    if (!reason.empty()) text += " (" + reason + ")";
  }
  return text;
}

}  // namespace dygita
