// How far the stress of the cells is from a smooth one: an indication of the mesh error.
#pragma once

#include "fem/free_surface.hpp"

namespace dygita {

struct StressError {
  std::vector<Vec> of_cells;    // J, 1/2 of the integral of (s* - s) : C^-1 : (s* - s), of each cell of each block
  std::vector<Vec> at_surface;  // J, of the same cells: what is left of traction at free facets
  // Pa, at each node the largest among its cells of the root of squares of von Mises stresses: of s* - s, and of d.
  Vec at_nodes;

  double energy() const;  // J, of all
};

// s is the stress of the cells, s* that of nodal_stress (Pa), interpolated, or where all cells are of order two that of
// recovered_stress; displacement: 3 x n_nodes, m. O. C. Zienkiewicz, J. Z. Zhu (Int. J. Numer. Methods Eng. 24, 1987);
// manual, eq. Q5. free: cells at whose facets nothing acts, manual, eq. Q13.
StressError stress_error(const Mesh& mesh, const Elastic& material, const Points& displacement,
                         const std::vector<FreeCell>& free = {});

}  // namespace dygita
