// Initial gaps of an interface that are those of the places of its faces.
#pragma once

#include "model/meeting.hpp"

namespace dygita {

// Of `gap = "geometry"`, of a function, or of round surfaces of which the deck says nothing. Throws InputError where
// the facets are too coarse to tell them.
void take_gaps_of_places(const Problem& problem, const Interface& interface, Facing& facing);

}  // namespace dygita
