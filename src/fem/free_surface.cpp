#include "fem/free_surface.hpp"

#include <algorithm>
#include <array>
#include <iterator>

#include "fem/cell_loop.hpp"
#include "fem/cell_tensor.hpp"

namespace dygita {

namespace {

// The most exact rule of the cells with so many corners: what is integrated goes with the fourth power of a distance.
constexpr QuadratureRule finest_rule(int n_corners) {
  QuadratureRule rule{{}, -1};
  for (const CellShape& row : cell_shapes)
    if (row.n_corners == n_corners && row.mass.degree > rule.degree) rule = row.mass;
  return rule;
}

template <class Cell>
struct LinearCell {
  static constexpr int n = Cell::n_nodes;
  static constexpr QuadratureRule rule = finest_rule(n);
  static constexpr int n_points = static_cast<int>(rule.points.size());

  std::array<Eigen::Matrix<double, n, 3>, n> slopes;  // of the shape functions, at the nodes
  ShapeTable<n, n_points> inside{shape_functions(Cell::type), rule};

  LinearCell() {
    for (int a = 0; a < n; ++a)
      slopes[a] = shape_functions(Cell::type).slopes(vector_of(Cell::row.shape.nodes[static_cast<size_t>(a)]));
  }
  static const LinearCell& table() {
    static const LinearCell cell;
    return cell;
  }
};

// The least stress with the traction that `stress` has across `normal`: it has none across the two directions beside.
Eigen::Matrix<double, 6, 1> across(const Eigen::Matrix<double, 6, 1>& stress, const Vec3& normal) {
  Mat3 s;
  s << stress[0], stress[3], stress[5], stress[3], stress[1], stress[4], stress[5], stress[4], stress[2];
  const Vec3 t = s * normal;
  const Mat3 d = t * normal.transpose() + normal * t.transpose() - normal.dot(t) * normal * normal.transpose();
  return {d(0, 0), d(1, 1), d(2, 2), d(0, 1), d(1, 2), d(2, 0)};
}

// From a facet, where it is 1, the stress falls as x (c x - c + 1) to what lies opposite, where x is 0: another facet,
// an edge or a corner. c is such that its integral over the cell is none, so that resultants stay.
double fall(int n_opposite) { return n_opposite == 1 ? 5.0 : n_opposite == 2 ? 4.0 : 3.0; }

// at_nodes: d, 6 x n.
template <class Cell>
double surface_error(const ElasticTensor& tensor, const Nodes<Cell::n_nodes>& x,
                     const CornerStress<Cell::n_nodes>& stress, unsigned facets, Tensors& at_nodes) {
  constexpr int n = Cell::n_nodes, n_points = LinearCell<Cell>::n_points;
  const LinearCell<Cell>& table = LinearCell<Cell>::table();
  Eigen::Matrix<double, 6, n_points> error = Eigen::Matrix<double, 6, n_points>::Zero();
  at_nodes = Tensors::Zero(6, n);
  for (size_t k = 0; k < Cell::row.facets.size(); ++k) {
    if (!(facets >> k & 1u)) continue;
    const LocalFacet& facet = Cell::row.facets[k];
    const int n_on = nodes_per_facet(facet.type);
    Eigen::Matrix<double, n, 1> is_on = Eigen::Matrix<double, n, 1>::Zero();
    for (int i = 0; i < n_on; ++i) is_on[facet.nodes[static_cast<size_t>(i)]] = 1.0;
    CornerStress<n> traction = CornerStress<n>::Zero();
    for (int i = 0; i < n_on; ++i) {
      const int a = facet.nodes[static_cast<size_t>(i)];
      const Mat3 jacobian = x.lazyProduct(table.slopes[a]);
      const Vec3 normal = (jacobian.inverse().transpose() * (table.slopes[a].transpose() * is_on)).normalized();
      traction.col(a) = across(stress.col(a), normal);
    }
    at_nodes += traction;
    const double c = fall(n - n_on);
    const Eigen::Matrix<double, 1, n_points> distance = is_on.transpose().lazyProduct(table.inside.values);
    error += traction.lazyProduct(table.inside.values) * (c * distance.array() - (c - 1.0)).matrix().asDiagonal();
  }
  double energy = 0.0;
  for (int i = 0; i < n_points; ++i) {
    const double volume = jacobian_at(table.inside, x, i).determinant() * table.inside.weights[i];
    energy += volume * tensor.energy_density(error.col(i));
  }
  return energy;
}

// The linear cell with the same corners and facets.
CellType linear_type(CellType type) {
  const int n = cell_shape(type).n_corners;
  const auto found = std::find_if(std::begin(cell_shapes), std::end(cell_shapes), [n](const CellShape& row) {
    return row.n_corners == n && nodes_per_cell(row.type) == n;
  });
  CHECK(found != std::end(cell_shapes), "every cell of order two has a linear one of its corners");
  return found->type;
}

// Cells of order two see their surface by the cells behind it. Where none is, as in a bar of one cell across, every
// corner lies on two free facets.
bool has_surface_all_around(CellType type, unsigned facets) {
  const CellShape& shape = cell_shape(type);
  if (shape.n_corners == 4) return false;  // a bar has several of them across
  constexpr int most_corners = 8;
  std::array<int, most_corners> n_facets{};
  for (size_t k = 0; k < shape.facets.size(); ++k)
    for (int a = 0; a < facet_shape(shape.facets[k].type).n_corners; ++a)
      n_facets[static_cast<size_t>(shape.facets[k].nodes[static_cast<size_t>(a)])] +=
          static_cast<int>(facets >> k & 1u);
  return std::all_of(n_facets.begin(), n_facets.begin() + shape.n_corners, [](int n) { return n >= 2; });
}

// At all nodes of a cell, from its corners.
template <class Cell>
Tensors at_all_nodes(CellType type, const Tensors& at_corners) {
  const int n = nodes_per_cell(type);
  if (n == Cell::n_nodes) return at_corners;
  Tensors all(6, n);
  for (int a = 0; a < n; ++a)
    all.col(a) = at_corners *
                 shape_functions(Cell::type).values(vector_of(cell_shape(type).shape.nodes[static_cast<size_t>(a)]));
  return all;
}

}  // namespace

std::vector<FreeCell> free_cells(const Mesh& mesh, const FacetKeys& facets, const std::vector<int>& node_of) {
  std::vector<char> is_on(static_cast<size_t>(mesh.n_nodes()), 0);
  {
    std::unordered_set<int> nodes;
    for (const FacetKey& key : facets) nodes.insert(key.begin(), key.end());
    for (int i = 0; i < mesh.n_nodes(); ++i)
      is_on[static_cast<size_t>(i)] = nodes.contains(node_of[static_cast<size_t>(i)]);
  }
  std::vector<FreeCell> cells;
  for (size_t b = 0; b < mesh.blocks.size(); ++b) {
    const CellBlock& block = mesh.blocks[b];
    const CellShape& shape = cell_shape(block.type);
    const bool is_of_order_two = nodes_per_cell(block.type) > shape.n_corners;
    for (int i = 0; i < block.n_cells(); ++i) {
      FreeCell cell{static_cast<int>(b), i};
      const auto is_free = [&](const LocalFacet& facet) {
        std::array<int, most_facet_corners> corners{};
        const auto n = static_cast<size_t>(facet_shape(facet.type).n_corners);
        for (size_t a = 0; a < n; ++a) {
          const auto node = static_cast<size_t>(block.cell(i)[facet.nodes[a]]);
          if (!is_on[node]) return false;
          corners[a] = node_of[node];
        }
        return facets.contains(facet_key(std::span<const int>(corners.data(), n)));
      };
      for (size_t k = 0; k < shape.facets.size(); ++k)
        if (is_free(shape.facets[k])) cell.facets |= 1u << k;
      if (is_of_order_two && !has_surface_all_around(block.type, cell.facets)) continue;
      if (cell.facets) cells.push_back(cell);
    }
  }
  return cells;
}

SurfaceErrors surface_errors(const Mesh& mesh, const Elastic& material, const std::vector<FreeCell>& cells,
                             const std::vector<Tensors>& stress) {
  SurfaceErrors errors{Vec::Zero(static_cast<Eigen::Index>(cells.size())), std::vector<Tensors>(cells.size())};
  parallel_for(
      static_cast<int>(cells.size()),
      [&](int i) {
        const FreeCell& at = cells[static_cast<size_t>(i)];
        const CellBlock& block = mesh.blocks[static_cast<size_t>(at.block)];
        const int n_nodes = nodes_per_cell(block.type);
        with_cell(linear_type(block.type), [&](auto cell) {
          using Cell = decltype(cell);
          constexpr int n = Cell::n_nodes;
          if constexpr (n == Cell::row.n_corners) {
            Tensors& at_nodes = errors.at_nodes[static_cast<size_t>(i)];
            errors.energies[i] = surface_error<Cell>(
                tensor_in(material, block, at.cell), gather<n>(mesh.nodes, block.cell(at.cell)),
                stress[static_cast<size_t>(at.block)].template middleCols<n>(n_nodes * at.cell), at.facets, at_nodes);
            at_nodes = at_all_nodes<Cell>(block.type, at_nodes);
          }
        });
      },
      Schedule::evenly);
  return errors;
}

}  // namespace dygita
