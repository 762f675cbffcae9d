// Points that no facets give: where the mean motions of two faces are joined, or a weighted sum of nodes is held.
#pragma once

#include "meeting/facing.hpp"
#include "meeting/meeting_options.hpp"

namespace dygita {

// Six rows that make the mean motion of both faces one, translation and rotation, in the sense of least squares; both
// deform freely (manual, eq. J8). Three points with 3, 2 and 1 directions. Throws InputError where a face has no mean
// rotation.
Facing facing_of_means(const PlacedFace& side_1, const PlacedFace& side_2, MeanBy by);

// One point, of which neither side is there yet, along the axes of the deck. area: m^2.
Facing facing_of_sum(const Vec3& place, double area);

}  // namespace dygita
