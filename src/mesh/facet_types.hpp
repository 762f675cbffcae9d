// The types of facets: one table, one row a type.
#pragma once

#include <algorithm>

#include "mesh/quadratic_elements.hpp"

namespace dygita {

enum class FacetType { tri3, quad4, tri6, quad8, quad9 };  // in the order of the rows

// A convex polygon with straight edges between nodes of a facet, which turns as the facet does.
struct SubFacet {
  int n;
  std::array<int, 4> nodes;
};

struct FacetShape {
  FacetType type;
  ShapeSpace shape;  // nodes turn counter-clockwise seen from outside, corners first
  int n_corners;
  std::span<const int> rim;              // nodes in the order they follow each other around the facet
  std::span<const SubFacet> sub_facets;  // through all nodes: what is drawn and searched
  bool is_shared_by_sub_facets;          // areas of nodes by sub-facets: the integral of a function is not positive
  QuadratureRule rule;                   // of the integrals of shape functions over the facet
  int gmsh_type, vtk_type;
};

namespace reference {
inline constexpr int around[] = {0, 1, 2, 3};
inline constexpr SubFacet tri3_itself[] = {{3, {0, 1, 2}}}, quad4_itself[] = {{4, {0, 1, 2, 3}}};
inline constexpr SubFacet tri6_cut[] = {{3, {0, 3, 5}}, {3, {3, 1, 4}}, {3, {5, 4, 2}}, {3, {3, 4, 5}}};
inline constexpr SubFacet quad8_cut[] = {
    {3, {0, 4, 7}}, {3, {4, 1, 5}}, {3, {5, 2, 6}}, {3, {7, 6, 3}}, {4, {4, 5, 6, 7}}};
inline constexpr SubFacet quad9_cut[] = {{4, {0, 4, 8, 7}}, {4, {4, 1, 5, 8}}, {4, {8, 5, 2, 6}}, {4, {7, 8, 6, 3}}};
inline constexpr int around_6[] = {0, 3, 1, 4, 2, 5}, around_8[] = {0, 4, 1, 5, 2, 6, 3, 7};
}  // namespace reference

#pragma GCC diagnostic push
#pragma GCC diagnostic error "-Wmissing-field-initializers"
inline constexpr FacetShape facet_shapes[] = {
    {.type = FacetType::tri3,
     .shape = reference::tri3,
     .n_corners = 3,
     .rim = {reference::around, 3},
     .sub_facets = reference::tri3_itself,
     .is_shared_by_sub_facets = false,
     .rule = reference::triangle_1,
     .gmsh_type = 2,
     .vtk_type = 5},
    {.type = FacetType::quad4,
     .shape = reference::quad4,
     .n_corners = 4,
     .rim = {reference::around, 4},
     .sub_facets = reference::quad4_itself,
     .is_shared_by_sub_facets = false,
     .rule = reference::square_4,
     .gmsh_type = 3,
     .vtk_type = 9},
    {.type = FacetType::tri6,
     .shape = reference::tri6,
     .n_corners = 3,
     .rim = reference::around_6,
     .sub_facets = reference::tri6_cut,
     .is_shared_by_sub_facets = true,
     .rule = reference::triangle_6,
     .gmsh_type = 9,
     .vtk_type = 22},
    {.type = FacetType::quad8,
     .shape = reference::quad8,
     .n_corners = 4,
     .rim = reference::around_8,
     .sub_facets = reference::quad8_cut,
     .is_shared_by_sub_facets = true,
     .rule = reference::square_9,
     .gmsh_type = 16,
     .vtk_type = 23},
    {.type = FacetType::quad9,
     .shape = reference::quad9,
     .n_corners = 4,
     .rim = reference::around_8,
     .sub_facets = reference::quad9_cut,
     .is_shared_by_sub_facets = false,
     .rule = reference::square_9,
     .gmsh_type = 10,
     .vtk_type = 28},
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
