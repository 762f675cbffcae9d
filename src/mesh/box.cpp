#include "mesh/box.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "mesh/mesh_limits.hpp"
#include "mesh/raise_order.hpp"

namespace dygita {

namespace {

constexpr const char* axis_names[] = {"x", "y", "z"};

// Node numbers of a grid of cells[0] x cells[1] x cells[2], x fastest.
struct Grid {
  std::array<int, 3> cells;

  int node(const std::array<int, 3>& at) const { return at[0] + (cells[0] + 1) * (at[1] + (cells[1] + 1) * at[2]); }
};

// Facets of the side `axis` = 0 or its maximum: turning from the next axis to the one after gives the axis itself.
std::vector<Facet> side_facets(const Grid& grid, int axis, bool is_max) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::vector<Facet> facets;
  for (int j = 0; j < grid.cells[v]; ++j)
    for (int i = 0; i < grid.cells[u]; ++i) {
      const auto node = [&](int du, int dv) {
        std::array<int, 3> at{};
        at[axis] = is_max ? grid.cells[axis] : 0;
        at[u] = i + du;
        at[v] = j + dv;
        return grid.node(at);
      };
      if (is_max)
        facets.push_back({FacetType::quad4, {node(0, 0), node(1, 0), node(1, 1), node(0, 1)}});
      else
        facets.push_back({FacetType::quad4, {node(0, 0), node(0, 1), node(1, 1), node(1, 0)}});
    }
  return facets;
}

// While it is made, of a hexahedron, of one of order two or cut in prisms, of one cut in tetrahedra: measured.
constexpr double bytes_of_hexahedron = 60.0, bytes_of_cut = 1200.0, bytes_of_tetrahedra = 3000.0;

// The system lends more memory than there is, and ends the program when it is used.
void check_memory(const std::array<int, 3>& cells, double bytes_of_cell) {
  const double bytes = bytes_of_cell * cells[0] * cells[1] * cells[2], limit = box_memory_limit();
  if (limit <= 0.0 || bytes <= limit) return;
  throw InputError(fmt::format("box: {} x {} x {} cells require about {:.2g} GB, but this machine has {:.2g} GB",
                               cells[0], cells[1], cells[2], 1e-9 * bytes, 1e-9 * limit));
}

void check_box(const Vec3& origin, const Vec3& size, const std::array<int, 3>& cells) {
  for (int d = 0; d < 3; ++d) {
    if (!std::isfinite(origin[d]))
      throw InputError(fmt::format("box: origin along {} must be finite, not {:g} m", axis_names[d], origin[d]));
    if (!(size[d] > 0) || !std::isfinite(size[d]))
      throw InputError(fmt::format("box: size along {} must be positive, not {:g} m", axis_names[d], size[d]));
    if (cells[d] < 1)
      throw InputError(fmt::format("box: cells along {} must be at least 1, not {}", axis_names[d], cells[d]));
  }
  const double n_nodes = (cells[0] + 1.0) * (cells[1] + 1.0) * (cells[2] + 1.0);
  if (n_nodes * 8 > std::numeric_limits<int>::max())
    throw InputError(
        fmt::format("box: {} x {} x {} cells exceed the limit of about 2.6e8 nodes", cells[0], cells[1], cells[2]));
}

// The linear cells that fill a hexahedron, by its corners: as many nodes as one cell has for each.
std::span<const int> cut_hexahedron(int n_corners) {
  static constexpr int prisms[] = {0, 2, 1, 4, 6, 5, 0, 3, 2, 4, 7, 6};
  static constexpr int tetrahedra[] = {0, 1, 2, 6, 0, 2, 3, 6, 0, 3, 7, 6, 0, 7, 4, 6, 0, 4, 5, 6, 0, 5, 1, 6};
  return n_corners == 6 ? std::span<const int>(prisms) : std::span<const int>(tetrahedra);
}

// Facets on the sides of a box whose hexahedra have been cut: on a side where each corner is on one of `quadrangles`.
std::vector<Facet> facets_on_side(const std::vector<Facet>& boundary, const std::vector<Facet>& quadrangles) {
  const std::vector<int> nodes = nodes_of(quadrangles);
  std::vector<Facet> facets;
  for (const Facet& facet : boundary)
    if (std::all_of(facet.corners().begin(), facet.corners().end(),
                    [&](int node) { return std::binary_search(nodes.begin(), nodes.end(), node); }))
      facets.push_back(facet);
  return facets;
}

}  // namespace

MeshPtr box_mesh(const Vec3& origin, const Vec3& size, const std::array<int, 3>& cells, CellType type) {
  const CellShape& row = cell_shape(type);
  if (type != CellType::hex8) check_memory(cells, row.n_corners == 4 ? bytes_of_tetrahedra : bytes_of_cut);
  MeshPtr mesh = box_mesh(origin, size, cells);
  const auto linear = std::find_if(std::begin(cell_shapes), std::end(cell_shapes), [&](const CellShape& cell) {
    return cell.n_corners == row.n_corners && nodes_per_cell(cell.type) == cell.n_corners;
  });
  if (linear->type != mesh->blocks[0].type) {
    auto cut = std::make_shared<Mesh>(*mesh);
    cut->blocks = {{linear->type, {}}};
    for (int i = 0; i < mesh->n_cells(); ++i)
      for (const int a : cut_hexahedron(row.n_corners)) cut->blocks[0].nodes.push_back(mesh->blocks[0].cell(i)[a]);
    const std::vector<Facet> boundary = boundary_facets(cut->blocks);
    for (auto& [name, facets] : cut->faces) facets = facets_on_side(boundary, facets);
    cut->digest = mesh_digest(*cut);
    mesh = std::move(cut);
  }
  if (type == linear->type) return mesh;
  const bool is_complete = second_order_type(linear->type, SecondOrder::edges_only) != type;
  return second_order(*mesh, is_complete ? SecondOrder::complete : SecondOrder::edges_only);
}

MeshPtr box_mesh(const Vec3& origin, const Vec3& size, const std::array<int, 3>& cells) {
  check_box(origin, size, cells);
  check_memory(cells, bytes_of_hexahedron);
  const Grid grid{cells};
  auto mesh = std::make_shared<Mesh>();
  mesh->source = "box";

  mesh->nodes.resize(3, grid.node(cells) + 1);
  for (int k = 0; k <= cells[2]; ++k)
    for (int j = 0; j <= cells[1]; ++j)
      for (int i = 0; i <= cells[0]; ++i) {
        const Vec3 fraction(static_cast<double>(i) / cells[0], static_cast<double>(j) / cells[1],
                            static_cast<double>(k) / cells[2]);
        mesh->nodes.col(grid.node({i, j, k})) = origin + size.cwiseProduct(fraction);
      }

  CellBlock block{CellType::hex8, {}};
  const std::span<const Place> corners = cell_shape(block.type).shape.nodes;
  block.nodes.reserve(corners.size() * cells[0] * cells[1] * cells[2]);
  for (int k = 0; k < cells[2]; ++k)
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i)
        for (const Place& at : corners)
          block.nodes.push_back(grid.node({i + (at[0] > 0), j + (at[1] > 0), k + (at[2] > 0)}));
  mesh->blocks.push_back(std::move(block));

  for (int axis = 0; axis < 3; ++axis)
    for (const bool is_max : {false, true})
      mesh->faces[std::string(axis_names[axis]) + (is_max ? "max" : "min")] = side_facets(grid, axis, is_max);
  mesh->digest = mesh_digest(*mesh);
  return mesh;
}

}  // namespace dygita
