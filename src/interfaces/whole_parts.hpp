// Parts whose cells are not connected: their pieces pass through each other, since no part is kept out of itself.
#pragma once

#include "interfaces/surfaces.hpp"

namespace dygita {

// Throws InputError where cells of a part lie on others of it, or in them, and neither share nodes nor have an
// interface there: nodes that were not merged, nodes in the middle of a neighbour's facet, solids in one volume.
void refuse_seams(const Problem& problem, const std::vector<Surface>& surfaces);

// Says with warn() which parts are in pieces that are near each other or of which one is held by nothing. Those of a
// part that stands for several bodies, each with its interfaces, are taken as they are.
void doubt_loose_pieces(const Problem& problem, const std::vector<Surface>& surfaces);

}  // namespace dygita
