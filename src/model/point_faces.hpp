// Faces that a body without cells has as points alone: their facets are those of what is attached.
#pragma once

#include <optional>

#include "model/model.hpp"

namespace dygita {

// Has the face points and no facets?
bool is_of_points(const Face& face);
// Its points, as a region.
Region region_of_points(const Face& face);

// The face itself where it has facets; else with those of `other` whose nodes lie on its points, turned round. Throws
// InputError where a node that such a facet needs has no point within reach (m; none: a ten thousandth of the face's
// size), or no facet is left.
Face with_facets(const Face& face, const Face& other, const std::optional<double>& within);

}  // namespace dygita
