// What a facet is cut into where it meets another mesh: convex polygons, linear in space, with corners at its nodes.
#pragma once

#include "mesh/facet_types.hpp"

namespace dygita {

struct FacetPart {
  int n;
  std::array<int, 4> corners;  // the first n of them, by the facet's numbers
};

struct FacetParts {
  std::span<const FacetPart> parts;
  // Are the multipliers dual to the facet's own shape functions? Else to the linear ones of each part, whose areas are
  // all positive (manual, eq. J2).
  bool has_own_multipliers;
};

namespace reference {
inline constexpr FacetPart tri3_parts[] = {{3, {0, 1, 2}}}, quad4_parts[] = {{4, {0, 1, 2, 3}}},
                           tri6_parts[] = {{3, {0, 3, 5}}, {3, {3, 1, 4}}, {3, {5, 4, 2}}, {3, {3, 4, 5}}},
                           quad8_parts[] = {{3, {0, 4, 7}},
                                            {3, {4, 1, 5}},
                                            {3, {5, 2, 6}},
                                            {3, {7, 6, 3}},
                                            {4, {4, 5, 6, 7}}},
                           quad9_parts[] = {{4, {0, 4, 8, 7}}, {4, {4, 1, 5, 8}}, {4, {8, 5, 2, 6}}, {4, {7, 8, 6, 3}}};
}

// By the numbers of corners and nodes: corners come first, then the middles of the edges in their order, then the
// centre.
constexpr FacetParts facet_parts(FacetType type) {
  const int n_nodes = nodes_per_facet(type);
  if (facet_shape(type).n_corners == 3)
    return n_nodes == 3 ? FacetParts{reference::tri3_parts, true} : FacetParts{reference::tri6_parts, false};
  return n_nodes == 4   ? FacetParts{reference::quad4_parts, true}
         : n_nodes == 8 ? FacetParts{reference::quad8_parts, false}
                        : FacetParts{reference::quad9_parts, true};
}

}  // namespace dygita
