// From cells of order one to cells of order two.
#pragma once

#include "mesh/mesh.hpp"

namespace dygita {

// Whose middles of facets and of the cell are nodes too: hex27 and prism18 in place of hex20 and prism15.
enum class SecondOrder { edges_only, complete };

// The type of order two on the corners of a linear one; the type itself where it is of order two already.
CellType second_order_type(CellType linear, SecondOrder kind);

// The corners that each further node of a cell of order two lies in the middle of, in the order of its nodes.
std::vector<std::vector<int>> middle_corners(CellType type);

// The same body with a node in the middle of every edge (and facet, and cell), straight as it was; named faces follow.
// Nodes of the linear mesh keep their numbers.
MeshPtr second_order(const Mesh& linear, SecondOrder kind);

}  // namespace dygita
