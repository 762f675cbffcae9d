#include "model/model.hpp"

#include <cmath>

#include "base/parallel.hpp"

namespace dygita {

std::string label(const Target& target) {
  if (const auto* face = std::get_if<Face>(&target)) return face->label();
  if (const auto* region = std::get_if<Region>(&target)) return region->label();
  if (const auto* interface = std::get_if<InterfacePtr>(&target)) return (*interface)->name;
  return std::get<SupportPtr>(target)->name;
}

int Step::n_increments() const {
  if (is_static) return increments;
  CHECK(dt > 0.0 && duration >= dt, "a dynamic step needs 0 < dt <= duration");
  return static_cast<int>(std::lround(duration / dt));
}

const std::vector<SupportPtr>& supports_of(const Problem& problem, const Step& step) {
  return step.supports ? *step.supports : problem.supports;
}

std::vector<double> volumes(const Problem& problem) {
  std::vector<double> volumes(problem.substructures.size());
  parallel_for(static_cast<int>(volumes.size()), [&](int i) { volumes[i] = volume(*problem.substructures[i]->mesh); });
  return volumes;
}

double mass_of(const Substructure& part, double volume) {
  return part.mesh->inside->mass(part.material.density * volume);
}

}  // namespace dygita
