// What a facet is cut into where it meets another mesh: convex polygons, linear in space, with corners at its nodes.
#pragma once

#include "mesh/facet_types.hpp"

namespace dygita {

using FacetPart = SubFacet;

struct FacetParts {
  std::span<const FacetPart> parts;
  // Are the multipliers dual to the facet's own shape functions? Else to the linear ones of each part, whose areas are
  // all positive (manual, eq. J2).
  bool has_own_multipliers;
};

constexpr FacetParts facet_parts(FacetType type) {
  const FacetShape& shape = facet_shape(type);
  return {shape.sub_facets, !shape.is_shared_by_sub_facets};
}

}  // namespace dygita
