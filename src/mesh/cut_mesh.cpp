#include "mesh/cut_mesh.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <set>
#include <unordered_map>

#include "base/error.hpp"
#include "mesh/divide_tetrahedra.hpp"
#include "mesh/facet_keys.hpp"

namespace dygita {

namespace {

constexpr double flat_within = 1e-6;  // of the body's size

double extent_of_nodes(const Points& x) { return (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).norm(); }

// Names of the facets on the boundary of the whole.
using Outside = std::unordered_map<FacetKey, std::vector<std::string>, FacetKeyHash>;

Outside outside_of(const Mesh& mesh) {
  Outside outside;
  for (const Facet& facet : boundary_facets(mesh.blocks)) outside[facet_key(facet)];
  for (const auto& [name, facets] : mesh.faces)
    for (const Facet& facet : facets) outside[facet_key(facet)].push_back(name);
  return outside;
}

// A facet lies in the one of the whole whose corners carry its own; in none where it is new.
Outside::const_iterator whole_facet(const Outside& outside, const DividedCells& all, const std::vector<int>& numbers,
                                    const Facet& facet) {
  std::set<int> carriers;
  for (const int corner : facet.corners()) {
    const int node = numbers[static_cast<size_t>(corner)];
    const auto edge = all.new_corners.find(node);
    if (edge == all.new_corners.end())
      carriers.insert(node);
    else
      carriers.insert({edge->second.first, edge->second.second});
  }
  if (carriers.size() > most_facet_corners) return outside.end();
  return outside.find(facet_key(std::vector<int>(carriers.begin(), carriers.end())));
}

MeshHalf half_of(const Mesh& whole, const DividedCells& all, int side, const Outside& outside,
                 const std::string& face) {
  std::vector<int> local(static_cast<size_t>(all.nodes.cols()), -1), numbers;
  std::map<CellType, CellBlock> blocks;
  for (const DividedCell& cell : all.cells) {
    if (cell.side != side) continue;
    CellBlock& block = blocks.try_emplace(cell.type, CellBlock{cell.type, {}}).first->second;
    block.nodes.insert(block.nodes.end(), cell.nodes.begin(), cell.nodes.end());
    if (cell.axes) block.axes.push_back(*cell.axes);
    numbers.insert(numbers.end(), cell.nodes.begin(), cell.nodes.end());
  }
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  auto mesh = std::make_shared<Mesh>();
  MeshHalf half;
  mesh->source = whole.source;
  mesh->nodes.resize(3, static_cast<long>(numbers.size()));
  for (size_t i = 0; i < numbers.size(); ++i) {
    local[static_cast<size_t>(numbers[i])] = static_cast<int>(i);
    mesh->nodes.col(static_cast<long>(i)) = all.nodes.col(numbers[i]);
    half.nodes.push_back(numbers[i] < whole.n_nodes() ? numbers[i] : -1);
  }
  for (auto& [type, block] : blocks) {
    for (int& node : block.nodes) node = local[static_cast<size_t>(node)];
    mesh->blocks.push_back(std::move(block));
  }
  for (const Facet& facet : boundary_facets(mesh->blocks)) {
    const auto found = whole_facet(outside, all, numbers, facet);
    if (found == outside.end()) mesh->faces[face].push_back(facet);
    if (found != outside.end())
      for (const std::string& name : found->second) mesh->faces[name].push_back(facet);
  }
  mesh->digest = mesh_digest(*mesh);
  half.mesh = mesh;
  return half;
}

MeshCut both_halves(const Mesh& mesh, const DividedCells& all, const std::string& face) {
  MeshCut cut;
  const Outside outside = outside_of(mesh);
  for (int side = 0; side < 2; ++side) cut.halves[static_cast<size_t>(side)] = half_of(mesh, all, side, outside, face);
  cut.n_divided = all.n_divided;
  return cut;
}

void check_name(const Mesh& mesh, const std::string& face) {
  if (mesh.faces.contains(face))
    throw InputError(fmt::format("the mesh has a face '{}' already\n    face = \"...\" names the new one", face));
}

// The new face of cells that stay whole must be plane; where it lies is told.
double height_of_cut(const Mesh& half, const Vec3& normal, double tolerance, const std::string& face) {
  const std::vector<int> nodes = nodes_of(half.faces.at(face));
  const Vec heights = half.nodes(Eigen::all, nodes).transpose() * normal;
  if (heights.maxCoeff() - heights.minCoeff() > tolerance)
    throw InputError(fmt::format(
        "the plane crosses cells that are no tetrahedra and have no facets in a plane there: those nearest "
        "to it lie at {:g} to {:g} m along the normal\n    cut where they have, or mesh the part with tetrahedra",
        heights.minCoeff(), heights.maxCoeff()));
  return heights.mean();
}

// Every cell as it is, on the side of its middle.
DividedCells whole_cells(const Mesh& mesh, const Vec3& normal, double at, double tolerance) {
  DividedCells all{mesh.nodes, {}, {}, 0};
  for (const CellBlock& block : mesh.blocks)
    for (int i = 0; i < block.n_cells(); ++i) {
      Vec3 middle = Vec3::Zero();
      const int n = cell_shape(block.type).n_corners;
      for (int a = 0; a < n; ++a) middle += mesh.nodes.col(block.cell(i)[a]) / n;
      all.add(block, i, normal.dot(middle) - at > tolerance ? 1 : 0);
    }
  return all;
}

}  // namespace

MeshCut cut_by_plane(const Mesh& mesh, const Vec3& normal, double at, const std::string& face) {
  check_name(mesh, face);
  const Vec heights = mesh.nodes.transpose() * normal;
  const double tolerance = flat_within * extent_of_nodes(mesh.nodes);
  if (heights.minCoeff() > at - tolerance || heights.maxCoeff() < at + tolerance)
    throw InputError(fmt::format("the plane does not cut the mesh, which lies at {:g} to {:g} m along the normal",
                                 heights.minCoeff(), heights.maxCoeff()));
  if (crosses_tetrahedra_alone(mesh, normal, at, tolerance)) {
    MeshCut cut = both_halves(mesh, divided_tetrahedra(mesh, normal, at, tolerance), face);
    for (const MeshHalf& half : cut.halves) check_mesh(*half.mesh, "a half of what the plane cuts");
    cut.at = at;
    return cut;
  }
  MeshCut cut = both_halves(mesh, whole_cells(mesh, normal, at, tolerance), face);
  for (const MeshHalf& half : cut.halves)
    if (half.mesh->n_cells() == 0)
      throw InputError("the plane crosses cells that are no tetrahedra, and leaves all of them on one side");
  cut.at = height_of_cut(*cut.halves[0].mesh, normal, tolerance, face);
  return cut;
}

MeshCut cut_along(const Mesh& mesh, const std::vector<InnerFacet>& facets, const std::string& face) {
  check_name(mesh, face);
  std::unordered_map<FacetKey, std::array<int, 2>, FacetKeyHash> cells_at;
  std::vector<std::pair<const CellBlock*, int>> cells;
  for (const CellBlock& block : mesh.blocks)
    for (int i = 0; i < block.n_cells(); ++i) {
      for (int k = 0; k < facets_per_cell(block.type); ++k) {
        auto& both = cells_at.try_emplace(facet_key(facet_of_cell(block, i, k)), std::array{-1, -1}).first->second;
        both[both[0] < 0 ? 0 : 1] = static_cast<int>(cells.size());
      }
      cells.emplace_back(&block, i);
    }
  std::vector<char> is_first(cells.size(), 0);
  std::vector<int> open;
  const auto reach = [&](int cell) {
    if (cell < 0 || is_first[static_cast<size_t>(cell)] != 0) return;
    is_first[static_cast<size_t>(cell)] = 1;
    open.push_back(cell);
  };
  FacetKeys barrier;
  for (const InnerFacet& facet : facets) barrier.insert(facet.corners);
  for (const InnerFacet& facet : facets)
    for (const int cell : cells_at.at(facet.corners)) {
      if (cell < 0) continue;
      const auto& [block, i] = cells[static_cast<size_t>(cell)];
      const int* nodes = block->cell(i);
      if (std::find(nodes, nodes + nodes_per_cell(block->type), facet.behind) != nodes + nodes_per_cell(block->type))
        reach(cell);
    }
  while (!open.empty()) {
    const auto [block, i] = cells[static_cast<size_t>(open.back())];
    open.pop_back();
    for (int k = 0; k < facets_per_cell(block->type); ++k) {
      const FacetKey key = facet_key(facet_of_cell(*block, i, k));
      if (barrier.contains(key)) continue;
      for (const int other : cells_at.at(key)) reach(other);
    }
  }
  for (const FacetKey& key : barrier) {
    const auto [one, other] = cells_at.at(key);
    if (other >= 0 && is_first[static_cast<size_t>(one)] == is_first[static_cast<size_t>(other)])
      throw InputError("the surface does not divide the part: cells on both sides of it are connected around it");
  }
  DividedCells all{mesh.nodes, {}, {}, 0};
  for (size_t c = 0; c < cells.size(); ++c) all.add(*cells[c].first, cells[c].second, is_first[c] != 0 ? 0 : 1);
  return both_halves(mesh, all, face);
}

}  // namespace dygita
