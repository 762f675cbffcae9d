// Nodes, cells and named faces of one substructure; or matrices in the place of cells. Immutable once made.
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "mesh/cell_types.hpp"
#include "mesh/condensed_body.hpp"
#include "numerics/types.hpp"

namespace dygita {

struct CellBlock {
  CellType type;
  std::vector<int> nodes;  // n_cells x nodes_per_cell, row after row
  // Of the material of each cell, one column an axis; empty: of a material without directions.
  std::vector<Mat3> axes = {};

  int n_cells() const { return static_cast<int>(nodes.size()) / nodes_per_cell(type); }
  const int* cell(int i) const { return nodes.data() + static_cast<size_t>(i) * nodes_per_cell(type); }
};

// A boundary facet, its nodes in the order of its type: corners first, the normal points out of the body.
class Facet {
 public:
  Facet(FacetType type, std::initializer_list<int> nodes) : Facet(type, std::span(nodes.begin(), nodes.size())) {}
  // As many nodes as the type has.
  Facet(FacetType type, std::span<const int> nodes);

  FacetType type() const { return type_; }
  std::span<const int> nodes() const { return {nodes_.data(), static_cast<size_t>(nodes_per_facet(type_))}; }
  std::span<int> nodes() { return {nodes_.data(), static_cast<size_t>(nodes_per_facet(type_))}; }
  std::span<const int> corners() const { return nodes().first(static_cast<size_t>(facet_shape(type_).n_corners)); }

 private:
  FacetType type_;
  std::array<int, most_facet_nodes> nodes_;
};

struct Mesh {
  Points nodes;  // 3 x n_nodes, metres
  std::vector<CellBlock> blocks;
  std::map<std::string, std::vector<Facet>> faces;       // every named face of this body
  std::map<std::string, std::vector<int>> point_groups;  // of a body without cells: named nodes that have no facets
  std::string source;                                    // "box" or the file's path, for messages and the run record
  std::string digest;                                    // changes when the nodes, cells or faces change
  // Of a copy, x = turn x0 + shift: the digest of the mesh whose nodes are x0; empty: it is none.
  std::string shape;
  Mat3 turn = Mat3::Identity();
  Vec3 shift = Vec3::Zero();  // m
  std::shared_ptr<const Interior> inside = Interior::of_cells();

  // Equal for meshes that are one mesh, turned and moved.
  const std::string& shape_digest() const { return shape.empty() ? digest : shape; }
  int n_nodes() const { return static_cast<int>(nodes.cols()); }
  int n_cells() const;
  // For what only cells have: stress, waves, a mass at each node.
  bool has_cells() const { return !inside->matrices(); }
  // Memory of the nodes and of each block's cells.
  std::vector<std::span<const std::byte>> arrays() const;
};

using MeshPtr = std::shared_ptr<const Mesh>;

// The facet's corners in increasing order, -1 first where it has fewer than most: equal for the same facet seen from
// two cells.
using FacetKey = std::array<int, most_facet_corners>;
FacetKey facet_key(std::span<const int> corners);
inline FacetKey facet_key(const Facet& facet) { return facet_key(facet.corners()); }

struct FacetKeyHash {
  size_t operator()(const FacetKey& key) const {
    size_t hash = 0;
    for (const int node : key) hash = (hash ^ static_cast<size_t>(node + 1)) * 0x9e3779b97f4a7c15u;
    return hash ^ (hash >> 32);
  }
};

// Facet `k` of cell `i` of the block, in the order of the cell's type, normal outward.
Facet facet_of_cell(const CellBlock& block, int i, int k);
inline int facets_per_cell(CellType type) { return static_cast<int>(cell_shape(type).facets.size()); }

// Facets of the cells that belong to one cell only, normals outward.
std::vector<Facet> boundary_facets(const std::vector<CellBlock>& blocks);

// The same of a mesh; of a body without cells those of all its faces, each once.
std::vector<Facet> boundary_facets(const Mesh& mesh);

// Nodes of the facets, each once, in increasing order.
std::vector<int> nodes_of(const std::vector<Facet>& facets);

// Throws InputError naming the cell, its type, place and volume if a Jacobian is not positive at a corner or
// Gauss point, if a node belongs to no cell, or if there is no cell.
void check_mesh(const Mesh& mesh, const std::string& name);

// The mesh turned (a rotation about the origin), then moved (m): a copy of what it is a copy of.
MeshPtr turned_mesh(const Mesh& mesh, const Mat3& turn, const Vec3& shift);

// The mesh with axes for the material of each cell, block by block: a shape of its own.
MeshPtr oriented_mesh(const Mesh& mesh, std::vector<std::vector<Mat3>> axes);

// Digest (FNV-1a 64, in hexadecimal) of nodes, cells, their axes and faces.
std::string mesh_digest(const Mesh& mesh);

// Volume (m^3) of the whole body.
double volume(const Mesh& mesh);

}  // namespace dygita
