// The types of facets: one table, one row a type.
#pragma once

#include <algorithm>

#include "mesh/reference_elements.hpp"

namespace dygita {

enum class FacetType { tri3, quad4 };  // in the order of the rows

struct FacetShape {
  FacetType type;
  ShapeSpace shape;  // nodes turn counter-clockwise seen from outside, corners first
  int n_corners;
  std::span<const int> rim;  // nodes in the order they follow each other around the facet
  QuadratureRule rule;       // of the integrals of shape functions over the facet
  int gmsh_type, vtk_type;
};

namespace reference {
inline constexpr int around[] = {0, 1, 2, 3};
}

#pragma GCC diagnostic push
#pragma GCC diagnostic error "-Wmissing-field-initializers"
inline constexpr FacetShape facet_shapes[] = {
    {.type = FacetType::tri3,
     .shape = reference::tri3,
     .n_corners = 3,
     .rim = {reference::around, 3},
     .rule = reference::triangle_1,
     .gmsh_type = 2,
     .vtk_type = 5},
    {.type = FacetType::quad4,
     .shape = reference::quad4,
     .n_corners = 4,
     .rim = {reference::around, 4},
     .rule = reference::square_4,
     .gmsh_type = 3,
     .vtk_type = 9},
};
#pragma GCC diagnostic pop
constexpr const FacetShape& facet_shape(FacetType type) { return facet_shapes[static_cast<int>(type)]; }

inline constexpr int most_facet_nodes = [] {
  size_t most = 0;
  for (const FacetShape& facet : facet_shapes) most = std::max(most, facet.shape.nodes.size());
  return static_cast<int>(most);
}();

constexpr int nodes_per_facet(FacetType type) { return static_cast<int>(facet_shape(type).shape.nodes.size()); }
inline constexpr int most_facet_corners = 4;  // of any facet: what identifies it

}  // namespace dygita
