// Whether facets of two faces lie on one another without having the same nodes.
#pragma once

#include <optional>

#include "mesh/polygons.hpp"

namespace dygita {

struct Overlap {
  int n_1 = 0, n_2 = 0;          // polygons of each side that lie on one of the other side
  Vec3 place;                    // middle of one common region
  double area = 0.0;             // m^2, of all common regions; of those met, where only their number is asked for
  int first_1 = 0, first_2 = 0;  // the polygons of `place`
};

enum class Facings { all, opposed };  // opposed: only polygons whose normals point against each other

// Pairs that lie on nearly one plane and whose projections on it have a region in common, a thousandth of the smaller
// polygon or more; touching along an edge is no overlap. On curved faces the chords of two meshes are a sagitta apart:
// the distance allowed grows with the angle between the two normals. Searched in a grid: n log n for even facets.
std::optional<Overlap> find_overlap(const std::vector<Polygon>& side_1, const std::vector<Polygon>& side_2,
                                    Facings facings = Facings::all);

}  // namespace dygita
