// Nodes, cells and named faces of one substructure. Immutable once made.
#pragma once

#include <array>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "numerics/types.hpp"

namespace dygita {

// Node numbering of each type is VTK's (vtkHexahedron, vtkWedge, vtkTetra). Beware of vtkWedge: the normal of the
// triangle 0 1 2 points out of the cell, away from 3 4 5 (gmsh, Abaqus and most others have it inward).
enum class CellType { hex8, prism6, tet4 };

int nodes_per_cell(CellType type);
const char* cell_type_name(CellType type);

struct CellBlock {
  CellType type;
  std::vector<int> nodes;  // n_cells x nodes_per_cell, row after row

  int n_cells() const { return static_cast<int>(nodes.size()) / nodes_per_cell(type); }
  const int* cell(int i) const { return nodes.data() + static_cast<size_t>(i) * nodes_per_cell(type); }
};

// A boundary facet, triangle or quadrangle, ordered so that its normal points out of the body.
struct Facet {
  std::array<int, 4> nodes{-1, -1, -1, -1};
  int n_nodes = 0;
};

struct Mesh {
  Points nodes;  // 3 x n_nodes, metres
  std::vector<CellBlock> blocks;
  std::map<std::string, std::vector<Facet>> faces;  // every named face of this body
  std::string source;                               // "box" or the file's path, for messages and the run record
  std::string digest;                               // changes when the nodes, cells or faces change

  int n_nodes() const { return static_cast<int>(nodes.cols()); }
  int n_cells() const;
};

using MeshPtr = std::shared_ptr<const Mesh>;

// The facet's nodes in increasing order (-1 first in a triangle): equal for the same facet seen from two cells.
using FacetKey = std::array<int, 4>;
FacetKey facet_key(const Facet& facet);

struct FacetKeyHash {
  size_t operator()(const FacetKey& key) const {
    size_t hash = 0;
    for (const int node : key) hash = (hash ^ static_cast<size_t>(node + 1)) * 0x9e3779b97f4a7c15u;
    return hash ^ (hash >> 32);
  }
};

// All facets of a cell of the block, normals outward.
std::vector<Facet> facets_of_cell(const CellBlock& block, int i);

// Facets of the cells that belong to one cell only, normals outward.
std::vector<Facet> boundary_facets(const std::vector<CellBlock>& blocks);

// Nodes of the facets, each once, in increasing order.
std::vector<int> nodes_of(const std::vector<Facet>& facets);

// Throws InputError naming the cell, its type, place and volume if a Jacobian is not positive at a corner or
// Gauss point, if a node belongs to no cell, or if there is no cell.
void check_mesh(const Mesh& mesh, const std::string& name);

// Digest (FNV-1a 64, in hexadecimal) of nodes, cells and faces.
std::string mesh_digest(const Mesh& mesh);

// Volume (m^3) of the whole body.
double volume(const Mesh& mesh);

}  // namespace dygita
