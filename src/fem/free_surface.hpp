// What the stress of the cells leaves of traction where nothing acts on a body: an error that no neighbour tells, and
// all that there is to see of it where every cell lies at the surface.
#pragma once

#include "fem/assembly.hpp"
#include "mesh/facet_keys.hpp"

namespace dygita {

// A cell of a mesh with facets at which nothing acts: bit k is facet k of its type.
struct FreeCell {
  int block = 0, cell = 0;
  unsigned facets = 0;
};

// The linear cells that have facets among these, block after block. Of cells of order two those alone that have no cell
// behind their surface, as in a bar of one cell across: else the recovered stress tells enough. node_of: of each node
// of the mesh its number in the keys.
std::vector<FreeCell> free_cells(const Mesh& mesh, const FacetKeys& facets, const std::vector<int>& node_of);

struct SurfaceErrors {
  Vec energies;                   // J, of each cell: 1/2 of the integral of d : C^-1 : d
  std::vector<Tensors> at_nodes;  // Pa, of each cell: d at its nodes, 6 x nodes
};

// Of each of them, with d the stress that cancels the traction at its free facets and has no resultant within the cell.
// stress: at the cells' nodes, column by column in the order of each block's, Pa. Manual, eq. Q13.
SurfaceErrors surface_errors(const Mesh& mesh, const Elastic& material, const std::vector<FreeCell>& cells,
                             const std::vector<Tensors>& stress);

}  // namespace dygita
