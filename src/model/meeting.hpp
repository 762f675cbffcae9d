// How the faces of an interface meet.
#pragma once

#include "meeting/mortar.hpp"
#include "model/model.hpp"

namespace dygita {

PlacedFace placed(const Face& face);

// Both sides where they meet: side 2 of a cyclic interface is turned onto side 1.
std::array<PlacedFace, 2> placed_sides(const Interface& interface);

// How far apart (m) faces may be that touch, beside what facets of round ones are off: a ten thousandth of the
// assembly's diagonal.
double default_within(const Problem& problem);

// Throws InputError naming the interface where its faces do not meet.
// within (m): where the interface does not say itself how far apart its faces may be.
Meeting meeting_of(const Interface& interface, double within);

}  // namespace dygita
