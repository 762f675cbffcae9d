// How far two faces are apart, or in each other, as the round surfaces that their facets stand for: nodes lie on these,
// facets are chords of them.
#pragma once

#include "meeting/facing.hpp"

namespace dygita {

struct TrueGaps {
  double area = 0.0;                           // m^2, where facets lie within the reach of each other
  double apart = 0.0, into = 0.0;              // m^2 of it, whatever the surfaces between the nodes
  double touching = 0.0;                       // m^2 of it, as far as the surfaces are known
  double mean = 0.0, least = 0.0, most = 0.0;  // m, at least so far from zero; negative where they pass into each other
  double mean_doubt = 0.0;                     // m, how well the mean is known
  double bend = 0.0;                           // m, how far facets of both are off their surfaces, at most

  // More of a gap or of an interference than the facets can hide.
  bool is_told() const;
};

// Of facets no farther apart than `within` (m) and what facets of round faces are off: those that an interface takes
// for touching. The surface over a facet is a parabola through its corners, with the curvature that the normals of its
// neighbours have.
TrueGaps true_gaps(const PlacedFace& side_1, const PlacedFace& side_2, double within);

}  // namespace dygita
