// The boundary of an assembly as a picture needs it: kept cells, merged nodes, sharp edges.
#pragma once

#include <vector>

#include "drawing/picture.hpp"

namespace dygita {

constexpr double sharp_cosine = 0.82;  // 35 degrees: edges between facets that turn by more are drawn

// A facet as it is drawn: its corners, of which merging may leave fewer.
struct SkinFacet {
  std::array<int, most_facet_corners> corners;
  int n_corners = 0;
};

// Boundary facets of all parts, with one numbering of their nodes.
struct Skin {
  Points position;   // m, deformed
  Points reference;  // m, undeformed
  Vec value;
  std::vector<SkinFacet> facets;
  std::vector<int> part;  // of each facet

  Vec3 normal(int i_facet) const;  // of the deformed facet, its length is twice the area
};

// Empty `displacement`, `values`: zero. What lies in front of the view's cut is left out; cells that
// it passes through are divided by it, and what they show in its plane is part of the boundary.
Skin make_skin(const std::vector<SubstructurePtr>& parts, const View& view, const std::vector<Points>& displacement,
               const std::vector<Vec>& values, double scale);

// To where the surface looks at nodes, as one of 27 directions, given normals (3 x n): what tells the two sides of a
// thin wall apart when nodes are merged.
std::vector<int> sides_of(const Points& normals);

// Nodes of a part that lie in one cube of edge `size` (m, undeformed) and look to one side become one, with the largest
// of their values; facets that lose their area are left out.
Skin merged(const Skin& skin, double size);

// Pairs of nodes: edges of one facet only, or between facets whose normals are more than 35 degrees apart; with a facet
// beside it.
struct SharpEdge {
  int a, b, facet;
};
std::vector<SharpEdge> sharp_edges(const Skin& skin);

}  // namespace dygita
