// Areas and normals of facets and at their nodes.
#pragma once

#include "mesh/mesh.hpp"

namespace dygita {

// Area (m^2) of each node of the facets (lumped: integral of its shape function) and unit normals, outward.
struct FaceNodes {
  std::vector<int> nodes;
  Vec areas;
  Points normals;
};
FaceNodes face_nodes(const Mesh& mesh, const std::vector<Facet>& facets);

// Integral of the normal over a facet (m^2); x: 3 x n, m, of the nodes that its numbers count.
Vec3 facet_area_vector(const Points& x, const Facet& facet);

}  // namespace dygita
