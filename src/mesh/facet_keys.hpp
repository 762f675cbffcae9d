// Facets by their corners, whichever cell they are seen from.
#pragma once

#include <unordered_set>

#include "mesh/mesh.hpp"

namespace dygita {

using FacetKeys = std::unordered_set<FacetKey, FacetKeyHash>;

}  // namespace dygita
