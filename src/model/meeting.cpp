#include "model/meeting.hpp"

#include "law/law.hpp"

namespace dygita {

PlacedFace placed(const Face& face) { return {face.part->mesh.get(), face.facets(), face.part->place, face.label()}; }

double default_within(const Problem& problem) {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::max()), high = -low;
  for (const SubstructurePtr& part : problem.substructures) {
    low = low.cwiseMin(part->mesh->nodes.rowwise().minCoeff() + part->place);
    high = high.cwiseMax(part->mesh->nodes.rowwise().maxCoeff() + part->place);
  }
  return 1e-4 * (high - low).norm();
}

Meeting meeting_of(const Interface& interface, double within) {
  const auto impedance = [](const Face& face) {
    return face.part->material.density * face.part->material.p_wave_speed();
  };
  const MeetingOptions options{interface.within.value_or(within), interface.points,
                               impedance(interface.side_2) < impedance(interface.side_1), !interface.law->is_tie()};
  try {
    return {placed(interface.side_1), placed(interface.side_2), options};
  } catch (const InputError& error) {
    throw InputError(interface.origin, "interface '" + interface.name + "': " + error.what());
  }
}

}  // namespace dygita
