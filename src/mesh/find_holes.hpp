// Round holes of a part, by the shape of its boundary.
#pragma once

#include <vector>

#include "mesh/mesh.hpp"

namespace dygita {

struct Hole {
  Vec3 low, high;       // m, on its axis, in the middle of its two rims
  double radius = 0.0;  // m, of the circle through its nodes
};

// Holes all around that end in planes: facets along the normal of a plane face, less than 80 degrees apart from each
// other (a circle of five cells or more), whose corners are on one cylinder within two per cent of its radius, and that
// face its axis. place: m, added to the nodes. A hole that changes its radius at a plane is several.
std::vector<Hole> find_holes(const Mesh& mesh, const Vec3& place);

}  // namespace dygita
