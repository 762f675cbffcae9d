// Facets and mirrored numbering of the reference cells.
#pragma once

#include "mesh/cell_shape.hpp"

namespace dygita {

namespace reference {
inline constexpr LocalFacet hex8_facets[] = {{FacetType::quad4, {0, 4, 7, 3}}, {FacetType::quad4, {1, 2, 6, 5}},
                                             {FacetType::quad4, {0, 1, 5, 4}}, {FacetType::quad4, {3, 7, 6, 2}},
                                             {FacetType::quad4, {0, 3, 2, 1}}, {FacetType::quad4, {4, 5, 6, 7}}};
inline constexpr LocalFacet prism6_facets[] = {{FacetType::tri3, {0, 1, 2}},
                                               {FacetType::tri3, {3, 5, 4}},
                                               {FacetType::quad4, {0, 3, 4, 1}},
                                               {FacetType::quad4, {1, 4, 5, 2}},
                                               {FacetType::quad4, {2, 5, 3, 0}}};
inline constexpr LocalFacet tet4_facets[] = {{FacetType::tri3, {0, 2, 1}},
                                             {FacetType::tri3, {0, 1, 3}},
                                             {FacetType::tri3, {1, 2, 3}},
                                             {FacetType::tri3, {2, 0, 3}}};

// The facets of a cell of order two: corners as `flat` has them, its other nodes where the facet's own reference has
// them.
template <size_t n>
constexpr std::array<LocalFacet, n> facets_of(const LocalFacet (&flat)[n], std::span<const Place> cell,
                                              FacetType triangle, FacetType quadrangle) {
  std::array<LocalFacet, n> facets{};
  for (size_t k = 0; k < n; ++k) {
    const int n_corners = facet_shape(flat[k].type).n_corners;
    facets[k].type = n_corners == 3 ? triangle : quadrangle;
    const auto node_between = [&](int first, int count) {
      Place middle{};
      for (int c = first; c < first + count; ++c)
        for (size_t d = 0; d < 3; ++d)
          middle[d] += cell[static_cast<size_t>(flat[k].nodes[static_cast<size_t>(c % n_corners)])][d] / count;
      return static_cast<int>(std::find(cell.begin(), cell.end(), middle) - cell.begin());
    };
    for (int a = 0; a < nodes_per_facet(facets[k].type); ++a)
      facets[k].nodes[static_cast<size_t>(a)] = a < n_corners       ? flat[k].nodes[static_cast<size_t>(a)]
                                                : a < 2 * n_corners ? node_between(a - n_corners, 2)
                                                                    : node_between(0, n_corners);
  }
  return facets;
}
inline constexpr auto tet10_facets = facets_of(tet4_facets, tet10_nodes, FacetType::tri6, FacetType::quad8);
inline constexpr auto hex20_facets = facets_of(hex8_facets, hex20_nodes, FacetType::tri6, FacetType::quad8);
inline constexpr auto hex27_facets = facets_of(hex8_facets, hex27_nodes, FacetType::tri6, FacetType::quad9);
inline constexpr auto prism15_facets = facets_of(prism6_facets, prism15_nodes, FacetType::tri6, FacetType::quad8);
inline constexpr auto prism18_facets = facets_of(prism6_facets, prism18_nodes, FacetType::tri6, FacetType::quad9);

inline constexpr int hex8_mirrored[] = {4, 5, 6, 7, 0, 1, 2, 3};
inline constexpr int prism6_mirrored[] = {3, 4, 5, 0, 1, 2};
inline constexpr int tet4_mirrored[] = {1, 0, 2, 3};
inline constexpr int tet10_mirrored[] = {1, 0, 2, 3, 4, 6, 5, 8, 7, 9};
inline constexpr int hex27_mirrored[] = {4,  5,  6,  7,  0,  1,  2,  3,  12, 13, 14, 15, 8, 9,
                                         10, 11, 16, 17, 18, 19, 20, 21, 22, 23, 25, 24, 26};
inline constexpr int prism18_mirrored[] = {3, 4, 5, 0, 1, 2, 9, 10, 11, 6, 7, 8, 12, 13, 14, 15, 16, 17};
inline constexpr std::span<const int> hex20_mirrored{hex27_mirrored, 20}, prism15_mirrored{prism18_mirrored, 15};
}  // namespace reference

}  // namespace dygita
