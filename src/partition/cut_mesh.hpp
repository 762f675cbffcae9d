// Cuts a mesh into pieces of about the same size.
#pragma once

#include "mesh/mesh.hpp"

namespace dygita {

// Some cells of a mesh as a mesh of their own, without named faces.
struct MeshPiece {
  MeshPtr mesh;
  std::vector<int> nodes;  // node of the whole mesh at each node of the piece, increasing
  Vec cut_areas;  // m^2, of each node of the piece: its share of the facets that the piece has in common with others
};

// Piece of each cell (block after block), 0 .. n - 1, none empty: about n_pieces of about the same number of nodes,
// with few facets between them. Cells of a piece are connected by facets where those of the mesh do; a part of the mesh
// that does not is a piece of its own. The same at each call.
// together: sets of nodes; all cells at nodes of one set are in one piece. All in one where such cells are more than a
// quarter of the mesh.
std::vector<int> piece_of_cells(const Mesh& mesh, int n_pieces, const std::vector<std::vector<int>>& together = {});

// Number of the lump each cell belongs to: cells that facets connect, numbered from 0.
std::vector<int> lump_of_cells(const Mesh& mesh);

// The pieces of `piece_of_cells`; nodes, cells and their order are those of the whole.
std::vector<MeshPiece> cut_mesh(const Mesh& mesh, const std::vector<int>& piece_of_cell);

}  // namespace dygita
