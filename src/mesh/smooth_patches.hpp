// Facets by the smooth surface that they are on.
#pragma once

#include "mesh/mesh.hpp"

namespace dygita {

// Number of the smooth patch of each facet: neighbours over an edge with normals (unit, of each facet) less than 35
// degrees apart are in one.
std::vector<int> smooth_patches(const std::vector<Facet>& facets, const std::vector<Vec3>& normals);

}  // namespace dygita
