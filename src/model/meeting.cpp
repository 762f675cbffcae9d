#include "model/meeting.hpp"

#include <utility>

#include "law/law.hpp"
#include "model/extent.hpp"
#include "model/joint_path.hpp"

namespace dygita {

PlacedFace placed(const Face& face) { return {face.part->mesh.get(), face.facets(), face.part->place, face.label()}; }

std::array<PlacedFace, 2> placed_sides(const Interface& interface) {
  const Face& other = interface.side_2;
  if (!interface.cyclic) return {placed(interface.side_1), placed(other)};
  return {placed(interface.side_1),
          PlacedFace{interface.cyclic->turned.get(), other.facets(), Vec3::Zero(), other.label() + " (turned)"}};
}

double default_within(const Problem& problem) { return 1e-4 * extent_of(problem.substructures).size().norm(); }

Meeting meeting_of(const Interface& interface, double within) {
  // The softer one; of equal ones the first by name, so that the order in which they are declared decides nothing.
  const auto rank = [](const Face& face) {
    return std::pair(face.part->material.density * face.part->material.p_wave_speed(), face.label());
  };
  const MeetingOptions options{
      interface.within.value_or(within), interface.points,         rank(interface.side_2) < rank(interface.side_1),
      !interface.law->is_tie(),          !interface.law->is_tie(), is_isolator(interface)};
  try {
    const auto [side_1, side_2] = placed_sides(interface);
    return {side_1, side_2, options};
  } catch (const InputError& error) {
    throw InputError(interface.origin, "interface '" + interface.name + "': " + error.what());
  }
}

}  // namespace dygita
