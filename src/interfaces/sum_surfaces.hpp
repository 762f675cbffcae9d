// Surfaces without facets: equations and springs between the mean motions of places.
#pragma once

#include "interfaces/surfaces.hpp"

namespace dygita {

// Adds those of a support that sums the motions of its places (manual, eq. J7). Throws InputError where these are on
// more than two parts.
void add_sums(const Problem& problem, const Support& sum, std::vector<Surface>& surfaces);

}  // namespace dygita
