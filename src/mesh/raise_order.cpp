#include "mesh/raise_order.hpp"

#include <algorithm>
#include <unordered_map>

#include "base/error.hpp"
#include "mesh/shape_functions.hpp"

namespace dygita {

namespace {

// Nodes between others, made where they are first asked for.
class MiddleNodes {
 public:
  explicit MiddleNodes(const Points& nodes) : n_(static_cast<int>(nodes.cols())), nodes_(nodes) {}

  int between(std::vector<int> corners) {
    std::sort(corners.begin(), corners.end());
    const auto [at, is_new] = known_.try_emplace(corners, n_);
    if (!is_new) return at->second;
    places_.push_back(nodes_(Eigen::all, corners).rowwise().mean());
    return n_++;
  }

  Points all() const {
    Points all(3, n_);
    all.leftCols(nodes_.cols()) = nodes_;
    for (size_t i = 0; i < places_.size(); ++i) all.col(nodes_.cols() + static_cast<Eigen::Index>(i)) = places_[i];
    return all;
  }

 private:
  int n_;
  const Points& nodes_;
  std::map<std::vector<int>, int> known_;
  std::vector<Vec3> places_;
};

}  // namespace

std::vector<std::vector<int>> middle_corners(CellType type) {
  const CellShape& cell = cell_shape(type);
  const auto linear = std::find_if(std::begin(cell_shapes), std::end(cell_shapes), [&](const CellShape& other) {
    return other.n_corners == cell.n_corners && nodes_per_cell(other.type) == cell.n_corners;
  });
  std::vector<std::vector<int>> middles;
  for (size_t a = static_cast<size_t>(cell.n_corners); a < cell.shape.nodes.size(); ++a) {
    const Vec weights = shape_functions(linear->type).values(vector_of(cell.shape.nodes[a]));
    std::vector<int>& corners = middles.emplace_back();
    for (int c = 0; c < linear->n_corners; ++c)
      if (weights[c] > 1e-9) corners.push_back(c);
  }
  return middles;
}

CellType second_order_type(CellType linear, SecondOrder kind) {
  const CellShape& row = cell_shape(linear);
  const CellShape* best = nullptr;
  for (const CellShape& cell : cell_shapes) {
    const bool is_raised = cell.n_corners == row.n_corners && nodes_per_cell(cell.type) > cell.n_corners;
    if (!is_raised) continue;
    const bool is_better =
        best && (nodes_per_cell(cell.type) > nodes_per_cell(best->type)) == (kind == SecondOrder::complete);
    if (!best || is_better) best = &cell;
  }
  CHECK(best, "every linear type has one of order two");
  return nodes_per_cell(linear) > row.n_corners ? linear : best->type;
}

MeshPtr second_order(const Mesh& linear, SecondOrder kind) {
  auto mesh = std::make_shared<Mesh>();
  mesh->source = linear.source;
  MiddleNodes nodes(linear.nodes);
  for (const CellBlock& block : linear.blocks) {
    CellBlock raised{second_order_type(block.type, kind), {}};
    CHECK(raised.type != block.type, "cells of order one");
    const std::vector<std::vector<int>> middles = middle_corners(raised.type);
    for (int i = 0; i < block.n_cells(); ++i) {
      const int* cell = block.cell(i);
      raised.nodes.insert(raised.nodes.end(), cell, cell + nodes_per_cell(block.type));
      for (const std::vector<int>& local : middles) {
        std::vector<int> corners;
        for (const int c : local) corners.push_back(cell[c]);
        raised.nodes.push_back(nodes.between(std::move(corners)));
      }
    }
    mesh->blocks.push_back(std::move(raised));
  }
  mesh->nodes = nodes.all();
  std::unordered_map<FacetKey, Facet, FacetKeyHash> boundary;
  for (const Facet& facet : boundary_facets(mesh->blocks)) boundary.emplace(facet_key(facet), facet);
  for (const auto& [name, facets] : linear.faces)
    for (const Facet& facet : facets) mesh->faces[name].push_back(boundary.at(facet_key(facet)));
  mesh->digest = mesh_digest(*mesh);
  return mesh;
}

}  // namespace dygita
