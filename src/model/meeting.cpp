#include "model/meeting.hpp"

#include "law/law.hpp"
#include "model/extent.hpp"

namespace dygita {

PlacedFace placed(const Face& face) { return {face.part->mesh.get(), face.facets(), face.part->place, face.label()}; }

double default_within(const Problem& problem) { return 1e-4 * extent_of(problem.substructures).size().norm(); }

Meeting meeting_of(const Interface& interface, double within) {
  const auto impedance = [](const Face& face) {
    return face.part->material.density * face.part->material.p_wave_speed();
  };
  const MeetingOptions options{interface.within.value_or(within), interface.points,
                               impedance(interface.side_2) < impedance(interface.side_1), !interface.law->is_tie(),
                               !interface.law->is_tie()};
  try {
    return {placed(interface.side_1), placed(interface.side_2), options};
  } catch (const InputError& error) {
    throw InputError(interface.origin, "interface '" + interface.name + "': " + error.what());
  }
}

}  // namespace dygita
