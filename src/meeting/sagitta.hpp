// How far flat facets are off the round face that they stand for.
#pragma once

#include "mesh/polygons.hpp"

namespace dygita {

// Where facets are triangles: some are longer around the face than they are across their edges.
constexpr double sagitta_margin = 1.5;

struct FlatFacet {
  const Polygon& x;
  const Vec3 &centre, &normal;  // normal: unit, outward
};

// The height (m) of the arc over the wider of two facets that have the edge from `start` to `end` in common: its
// curvature is the angle between them over the distance of their middles. 0 where they turn by more than 45 degrees,
// which is an edge and no round face.
double sagitta_of(const FlatFacet& one, const FlatFacet& other, const Vec3& start, const Vec3& end);

}  // namespace dygita
