#include "mesh/mesh.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <limits>
#include <unordered_map>

#include "base/error.hpp"
#include "mesh/fnv1a.hpp"
#include "mesh/jacobian.hpp"

namespace dygita {

namespace {

// Local facets of each cell type, normals outward; -1 ends a triangle.
const std::vector<std::array<int, 4>>& local_facets(CellType type) {
  static const std::vector<std::array<int, 4>> hex = {{0, 4, 7, 3}, {1, 2, 6, 5}, {0, 1, 5, 4},
                                                      {3, 7, 6, 2}, {0, 3, 2, 1}, {4, 5, 6, 7}};
  static const std::vector<std::array<int, 4>> prism = {
      {0, 1, 2, -1}, {3, 5, 4, -1}, {0, 3, 4, 1}, {1, 4, 5, 2}, {2, 5, 3, 0}};
  static const std::vector<std::array<int, 4>> tet = {{0, 2, 1, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {2, 0, 3, -1}};
  return type == CellType::hex8 ? hex : type == CellType::prism6 ? prism : tet;
}

double longest_edge(const Points& x) {
  double longest = 0;
  for (int a = 0; a < x.cols(); ++a)
    for (int b = 0; b < a; ++b) longest = std::max(longest, (x.col(a) - x.col(b)).norm());
  return longest;
}

// Smallest Jacobian over the corners and the quadrature points.
double smallest_jacobian(CellType type, const Points& x) {
  double smallest = std::numeric_limits<double>::max();
  for (const Vec3& corner : reference_corners(type)) smallest = std::min(smallest, jacobian(type, x, corner));
  for (const ReferencePoint& point : volume_quadrature(type))
    smallest = std::min(smallest, jacobian(type, x, point.position));
  return smallest;
}

void check_block(const Points& nodes, const CellBlock& block, const std::string& name) {
  // A cell flatter than this in relation to its longest edge has no volume left but rounding.
  constexpr double flattest = 1e-12;
  for (int i = 0; i < block.n_cells(); ++i) {
    const Points x = cell_nodes(nodes, block, i);
    const double length = longest_edge(x), smallest = smallest_jacobian(block.type, x);
    if (smallest > flattest * length * length * length) continue;
    const Vec3 centre = x.rowwise().mean();
    throw InputError(
        fmt::format("mesh of '{}': cell {} ({}) at ({:.6g}, {:.6g}, {:.6g}) m, volume {:.3g} m^3, is {}\n"
                    "    every Jacobian must be positive, the smallest is {:.3g} m^3: the cell is turned inside out or "
                    "too distorted",
                    name, i, cell_type_name(block.type), centre[0], centre[1], centre[2], cell_volume(block.type, x),
                    smallest < 0 ? "inverted" : "flat", smallest));
  }
}

}  // namespace

int nodes_per_cell(CellType type) { return type == CellType::hex8 ? 8 : type == CellType::prism6 ? 6 : 4; }

const char* cell_type_name(CellType type) {
  return type == CellType::hex8 ? "hex8" : type == CellType::prism6 ? "prism6" : "tet4";
}

int Mesh::n_cells() const {
  int n = 0;
  for (const CellBlock& block : blocks) n += block.n_cells();
  return n;
}

std::vector<Facet> facets_of_cell(const CellBlock& block, int i) {
  std::vector<Facet> facets;
  for (const std::array<int, 4>& local : local_facets(block.type)) {
    Facet& facet = facets.emplace_back();
    for (const int a : local)
      if (a >= 0) facet.nodes[facet.n_nodes++] = block.cell(i)[a];
  }
  return facets;
}

std::vector<Facet> boundary_facets(const std::vector<CellBlock>& blocks) {
  struct Seen {
    Facet facet;
    int cells;
  };
  std::unordered_map<FacetKey, Seen, FacetKeyHash> seen;
  std::vector<FacetKey> order;
  for (const CellBlock& block : blocks)
    for (int i = 0; i < block.n_cells(); ++i)
      for (const Facet& facet : facets_of_cell(block, i)) {
        const FacetKey key = facet_key(facet);
        const auto [at, is_new] = seen.try_emplace(key, Seen{facet, 0});
        if (is_new) order.push_back(key);
        ++at->second.cells;
      }

  std::vector<Facet> boundary;
  for (const FacetKey& key : order)
    if (const Seen& found = seen.at(key); found.cells == 1) boundary.push_back(found.facet);
  return boundary;
}

FacetKey facet_key(const Facet& facet) {
  FacetKey key = facet.nodes;
  std::sort(key.begin(), key.end());
  return key;
}

std::vector<int> nodes_of(const std::vector<Facet>& facets) {
  std::vector<int> nodes;
  nodes.reserve(facets.size() * 4);
  for (const Facet& facet : facets) nodes.insert(nodes.end(), facet.nodes.begin(), facet.nodes.begin() + facet.n_nodes);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

void check_mesh(const Mesh& mesh, const std::string& name) {
  if (mesh.n_cells() == 0) throw InputError(fmt::format("mesh of '{}' has no cell ({})", name, mesh.source));
  if (!mesh.nodes.allFinite()) throw InputError(fmt::format("mesh of '{}' has a node that is not finite", name));

  std::vector<bool> is_used(mesh.n_nodes(), false);
  for (const CellBlock& block : mesh.blocks)
    for (const int node : block.nodes) {
      CHECK(node >= 0 && node < mesh.n_nodes(),
            fmt::format("node {} of {} in mesh of '{}'", node, mesh.n_nodes(), name));
      is_used[node] = true;
    }
  const auto lone = std::find(is_used.begin(), is_used.end(), false);
  if (lone != is_used.end()) {
    const auto node = static_cast<int>(lone - is_used.begin());
    const Vec3 x = mesh.nodes.col(node);
    throw InputError(fmt::format("mesh of '{}': node {} at ({:.6g}, {:.6g}, {:.6g}) m belongs to no cell", name, node,
                                 x[0], x[1], x[2]));
  }

  for (const CellBlock& block : mesh.blocks) check_block(mesh.nodes, block, name);
}

std::string mesh_digest(const Mesh& mesh) {
  Fnv1a digest;
  digest.add(mesh.n_nodes());
  digest.add(mesh.nodes.data(), sizeof(double) * static_cast<size_t>(mesh.nodes.size()));
  for (const CellBlock& block : mesh.blocks) {
    digest.add(static_cast<int>(block.type));
    digest.add(block.n_cells());
    digest.add(block.nodes.data(), sizeof(int) * block.nodes.size());
  }
  for (const auto& [name, facets] : mesh.faces) {
    digest.add(name);
    digest.add(facets.size());
    for (const Facet& facet : facets) digest.add(facet.nodes);
  }
  return digest.hexadecimal();
}

double volume(const Mesh& mesh) {
  double total = 0;
  for (const CellBlock& block : mesh.blocks)
    for (int i = 0; i < block.n_cells(); ++i) total += cell_volume(block.type, cell_nodes(mesh.nodes, block, i));
  return total;
}

}  // namespace dygita
