#include "mesh/box.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <limits>

#include "base/error.hpp"

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
        fmt::format("box: {} x {} x {} cells are too many: at most about 2.6e8 nodes", cells[0], cells[1], cells[2]));
}

}  // namespace

MeshPtr box_mesh(const Vec3& origin, const Vec3& size, const std::array<int, 3>& cells) {
  check_box(origin, size, cells);
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
