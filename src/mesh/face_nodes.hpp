// Areas and normals of facets and at their nodes.
#pragma once

#include "mesh/mesh.hpp"

namespace dygita {

// Of each node of some facets. A uniform traction t has the nodal forces weights t, a uniform pressure p -vectors p.
// Areas are weights where those are positive; on facets where they are not (tri6: zero at corners, quad8: negative),
// integrals of the functions linear on the sub-facets. Their sums are the same.
struct FaceNodes {
  std::vector<int> nodes;
  Vec areas;       // m^2, positive
  Points normals;  // unit, outward, mean by area
  Vec weights;     // m^2, integral of the node's shape function
  Points vectors;  // m^2, integral of that times the normal
  Points moments;  // m^3, integral of the shape function times the place
};
FaceNodes face_nodes(const Mesh& mesh, const std::vector<Facet>& facets);

// A quadrature point of a facet: the shape functions of its nodes, and the normal times the point's share of the area
// (m^2). On a flat facet of order two sums are exact for products of two shape functions.
struct FacetSample {
  Vec values;
  Vec3 area;
};
std::vector<FacetSample> facet_samples(const Points& x, const Facet& facet);

// Integral of the normal over a facet (m^2); x: 3 x n, m, of the nodes that its numbers count.
Vec3 facet_area_vector(const Points& x, const Facet& facet);

}  // namespace dygita
