// Parts that are near each other with no interface between them there: they would pass through each other.
#pragma once

#include <vector>

#include "interfaces/surfaces.hpp"
#include "meeting/neighbours.hpp"

namespace dygita {

struct Unjoined {
  int part_1, part_2;  // index in problem.substructures, part_1 < part_2
  double size;         // m, diagonal of the smaller part's bounding box
  double reach;        // m, how far apart they may be to be near
  Neighbours neighbours;
  double offset = 0.0;  // m, by which the facets of its joined round faces are off them
};

// Pairs of parts that touch, overlap or are near where no interface joins them: within a twentieth of the smaller one's
// size, and what their velocities at the start bring them together in the dynamic steps, half of that size at most.
// Parts whose bounding boxes are farther apart cost nothing.
std::vector<Unjoined> find_unjoined(const Problem& problem, const std::vector<Surface>& surfaces);

// Says with warn() which of them touch or overlap, and what an interface hardly means: faces of one size shifted by a
// cell or so, a face that a support holds as well. Answers the pairs.
std::vector<Unjoined> doubt_neighbours(const Problem& problem, const std::vector<Surface>& surfaces);

// "'plate.top'", the smallest named face of a part that has the facet; "'plate'" where none has.
std::string face_with(const Substructure& part, const Facet& facet);

}  // namespace dygita
