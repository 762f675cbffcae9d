// How two faces meet: nodes that coincide, normals and areas at them.
#pragma once

#include "mesh/face_nodes.hpp"

namespace dygita {

// One body's face in space: the mesh, the facets and the translation of its nodes.
struct PlacedFace {
  const Mesh* mesh;
  std::vector<Facet> facets;
  Vec3 place = Vec3::Zero();
  std::string name;  // "specimen.zmax", for messages
};

struct Facing {
  std::vector<Facet> facets;  // matched facets, node numbers of side 1, normals from side 1 to side 2
  std::vector<int> nodes_1;   // node of side 1 at each interface point
  std::vector<int> nodes_2;   // node of side 2 at the same place
  Points normals;             // unit, from side 1 to side 2, area-weighted mean of the matched facets
  Vec areas;                  // m^2, integral of the shape function over the matched facets
};

// Matches facets whose nodes coincide (tolerance 1e-6 of the smallest facet edge, found with a grid hash: n log n).
// Facets without partner are simply outside the interface. Throws InputError when no facet matches, or when unmatched
// facets of the two faces overlap (their projections intersect on nearly the same plane): names both faces, a point and
// counts.
Facing match_faces(const PlacedFace& side_1, const PlacedFace& side_2);

}  // namespace dygita
