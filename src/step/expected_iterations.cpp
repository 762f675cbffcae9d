#include "step/expected_iterations.hpp"

#include <algorithm>

#include "law/law.hpp"
#include "model/extent.hpp"

namespace dygita {

namespace {

// Of a dynamic increment with contact at most, by how often P waves cross an implicit part within it, in the mean:
// a part that they cross often depends on its neighbours alone, and what these do passes on with each iteration.
// Fitted to the flanges, the box of electronics and a unit of 78 parts.
double most_of_shocks(const Problem& problem, const Step& step, const Integration& integration) {
  constexpr double usual = 15.0, a_crossing = 12.0, limit = 200.0;
  double sum = 0.0;
  int n = 0;
  for (size_t i = 0; i < problem.substructures.size(); ++i) {
    const Substructure& part = *problem.substructures[i];
    if (!part.mesh->has_cells() || (!integration.parts.empty() && integration.parts[i].is_explicit)) continue;
    sum += crossings(part, step.dt / integration.n_substeps);
    ++n;
  }
  return n > 0 ? std::clamp(a_crossing * sum / n, usual, limit) : usual;
}

}  // namespace

ExpectedIterations expected_iterations(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces,
                                       const Integration& integration) {
  constexpr double few_static = 20.0, many_static = 40.0, many_with_contact = 160.0;
  const bool turns = may_turn(problem, step, surfaces);
  if (step.is_static) return {few_static, turns ? many_with_contact : many_static};
  return {iterations_of_shocks, turns ? most_of_shocks(problem, step, integration) : iterations_of_shocks};
}

bool may_turn(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces) {
  return std::any_of(surfaces.begin(), surfaces.end(), [&](const Surface& surface) {
    return takes_part(problem, step, surface) && surface.declared_law().shown().states;
  });
}

}  // namespace dygita
