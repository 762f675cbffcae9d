#include "mesh/mesh.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <set>

#include "base/error.hpp"
#include "base/fnv1a.hpp"
#include "base/parallel.hpp"
#include "mesh/jacobian.hpp"
#include "mesh/unmatched_cells.hpp"

namespace dygita {

namespace {

double longest_edge(const Points& x) {
  double longest = 0;
  for (int a = 0; a < x.cols(); ++a)
    for (int b = 0; b < a; ++b) longest = std::max(longest, (x.col(a) - x.col(b)).norm());
  return longest;
}

void check_block(const Points& nodes, const CellBlock& block, const std::string& name) {
  // A cell flatter than this in relation to its longest edge has no volume left but rounding.
  constexpr double flattest = 1e-12;
  for (int i = 0; i < block.n_cells(); ++i) {
    const Points x = cell_nodes(nodes, block, i);
    const double length = longest_edge(x), smallest = smallest_jacobian(block.type, x);
    if (smallest > flattest * length * length * length) continue;
    const Vec3 centre = x.rowwise().mean();
    throw InputError(fmt::format(
        "mesh of '{}': cell {} ({}) at ({:.6g}, {:.6g}, {:.6g}) m, volume {:.3g} m^3, is {}\n"
        "    every Jacobian must be positive, the smallest is {:.3g} m^3: the cell is inverted or too distorted",
        name, i, cell_shape(block.type).name, centre[0], centre[1], centre[2], cell_volume(block.type, x),
        smallest < 0 ? "inverted" : "flat", smallest));
  }
}

}  // namespace

Facet::Facet(FacetType type, std::span<const int> nodes) : type_(type) {
  CHECK(static_cast<int>(nodes.size()) == nodes_per_facet(type), "a facet has the nodes of its type");
  nodes_.fill(-1);
  std::copy(nodes.begin(), nodes.end(), nodes_.begin());
}

int Mesh::n_cells() const {
  int n = 0;
  for (const CellBlock& block : blocks) n += block.n_cells();
  return n;
}

std::vector<std::span<const std::byte>> Mesh::arrays() const {
  std::vector<std::span<const std::byte>> arrays{
      std::as_bytes(std::span(nodes.data(), static_cast<size_t>(nodes.size())))};
  for (const CellBlock& block : blocks)
    arrays.push_back(std::as_bytes(std::span(block.nodes.data(), static_cast<size_t>(block.nodes.size()))));
  return arrays;
}

Facet facet_of_cell(const CellBlock& block, int i, int k) {
  const LocalFacet& local = cell_shape(block.type).facets[k];
  const int n = nodes_per_facet(local.type), *cell = block.cell(i);
  std::array<int, most_facet_nodes> nodes;
  for (int a = 0; a < n; ++a) nodes[a] = cell[local.nodes[a]];
  return {local.type, std::span<const int>(nodes.data(), static_cast<size_t>(n))};
}

// Facets are looked for among those that have the same highest corner: a dozen at most.
std::vector<Facet> boundary_facets(const std::vector<CellBlock>& blocks) {
  int n_nodes = 0;
  size_t n_facets = 0;
  for (const CellBlock& block : blocks) {
    for (const int node : block.nodes) n_nodes = std::max(n_nodes, node + 1);
    n_facets += static_cast<size_t>(block.n_cells()) * facets_per_cell(block.type);
  }
  std::vector<FacetKey> keys;
  keys.reserve(n_facets);
  std::vector<int> last(static_cast<size_t>(n_nodes), -1), before;  // facet with that highest corner; the one before it
  before.reserve(n_facets);
  std::vector<char> is_outside(n_facets, 1);
  for (const CellBlock& block : blocks)
    for (int i = 0; i < block.n_cells(); ++i)
      for (int k = 0; k < facets_per_cell(block.type); ++k) {
        const FacetKey& key = keys.emplace_back(facet_key(facet_of_cell(block, i, k)));
        const int own = static_cast<int>(before.size());
        int& chain = last[static_cast<size_t>(key.back())];
        int same = chain;
        while (same >= 0 && keys[same] != key) same = before[same];
        if (same >= 0) is_outside[same] = is_outside[own] = 0;
        before.push_back(chain);
        chain = own;
      }

  std::vector<Facet> boundary;
  size_t facet = 0;
  for (const CellBlock& block : blocks)
    for (int i = 0; i < block.n_cells(); ++i)
      for (int k = 0; k < facets_per_cell(block.type); ++k)
        if (is_outside[facet++]) boundary.push_back(facet_of_cell(block, i, k));
  return boundary;
}

std::vector<Facet> boundary_facets(const Mesh& mesh) {
  if (mesh.has_cells()) return boundary_facets(mesh.blocks);
  std::vector<Facet> boundary;
  std::set<FacetKey> known;
  for (const auto& [name, facets] : mesh.faces)
    for (const Facet& facet : facets)
      if (known.insert(facet_key(facet)).second) boundary.push_back(facet);
  return boundary;
}

FacetKey facet_key(std::span<const int> corners) {
  FacetKey key;
  key.fill(-1);
  std::copy(corners.begin(), corners.end(), key.begin());
  std::sort(key.begin(), key.end());
  return key;
}

std::vector<int> nodes_of(const std::vector<Facet>& facets) {
  std::vector<int> nodes;
  nodes.reserve(facets.size() * most_facet_nodes);
  for (const Facet& facet : facets) nodes.insert(nodes.end(), facet.nodes().begin(), facet.nodes().end());
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
  check_shared_facets(mesh, name);
}

MeshPtr turned_mesh(const Mesh& mesh, const Mat3& turn, const Vec3& shift) {
  auto turned = std::make_shared<Mesh>(mesh);
  turned->nodes = (turn * mesh.nodes).colwise() + shift;
  for (CellBlock& block : turned->blocks)
    for (Mat3& axes : block.axes) axes = (turn * axes).eval();
  turned->shape = mesh.shape_digest();
  turned->turn = turn * mesh.turn;
  turned->shift = turn * mesh.shift + shift;
  turned->inside = mesh.inside->turned(turn, turned->nodes);
  turned->digest = mesh_digest(*turned);
  return turned;
}

MeshPtr oriented_mesh(const Mesh& mesh, std::vector<std::vector<Mat3>> axes) {
  CHECK(axes.size() == mesh.blocks.size(), "axes for every block");
  auto oriented = std::make_shared<Mesh>(mesh);
  Fnv1a shape;
  shape.add(mesh.shape_digest());
  for (size_t b = 0; b < axes.size(); ++b) {
    CHECK(static_cast<int>(axes[b].size()) == mesh.blocks[b].n_cells(), "axes for every cell");
    for (const Mat3& of_cell : axes[b]) {
      const Mat3 own = mesh.turn.transpose() * of_cell;  // turned copies with turned axes are one shape
      shape.add(own.data(), sizeof(double) * 9);
    }
    oriented->blocks[b].axes = std::move(axes[b]);
  }
  oriented->shape = shape.hexadecimal();
  oriented->digest = mesh_digest(*oriented);
  return oriented;
}

std::string mesh_digest(const Mesh& mesh) {
  constexpr size_t least_in_digest = 4;  // nodes of a facet: state files hold digests made so
  Fnv1a digest;
  digest.add(mesh.n_nodes());
  digest.add(mesh.nodes.data(), sizeof(double) * static_cast<size_t>(mesh.nodes.size()));
  for (const CellBlock& block : mesh.blocks) {
    digest.add(static_cast<int>(block.type));
    digest.add(block.n_cells());
    digest.add(block.nodes.data(), sizeof(int) * block.nodes.size());
    for (const Mat3& axes : block.axes) digest.add(axes.data(), sizeof(double) * 9);
  }
  for (const auto& [name, facets] : mesh.faces) {
    digest.add(name);
    digest.add(facets.size());
    for (const Facet& facet : facets) {
      digest.add(facet.nodes().data(), facet.nodes().size_bytes());
      for (size_t a = facet.nodes().size(); a < least_in_digest; ++a) digest.add(-1);
    }
  }
  for (const auto& [name, nodes] : mesh.point_groups) {
    digest.add(name);
    digest.add(nodes.data(), sizeof(int) * nodes.size());
  }
  mesh.inside->add_to(digest);
  return digest.hexadecimal();
}

double volume(const Mesh& mesh) {
  constexpr int chunk = 1024;  // cells that are added up by themselves, whatever the number of threads
  double total = 0;
  for (const CellBlock& block : mesh.blocks) {
    std::vector<double> sums(static_cast<size_t>((block.n_cells() + chunk - 1) / chunk), 0.0);
    parallel_for(static_cast<int>(sums.size()), [&](int k) {
      const int end = std::min(block.n_cells(), (k + 1) * chunk);
      for (int i = k * chunk; i < end; ++i)
        sums[static_cast<size_t>(k)] += cell_volume(block.type, cell_nodes(mesh.nodes, block, i));
    });
    for (const double sum : sums) total += sum;
  }
  return total;
}

}  // namespace dygita
