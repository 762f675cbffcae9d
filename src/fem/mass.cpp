#include "fem/mass.hpp"

#include <algorithm>
#include <array>

#include "fem/cell_loop.hpp"
#include "fem/node_pattern.hpp"

namespace dygita {

namespace {

template <class Cell>
struct MassKernel {
  static constexpr int n = Cell::n_nodes;

  const Mesh& mesh;
  const Elastic& material;
  const WaveTuning* tuning;  // none: lumped where the row says so
  const std::vector<char>& keeps_lumped;
  const NodePattern& pattern;
  double* values;  // of the pattern's entries

  MassMatrix<n> mass;
  Eigen::Matrix<double, n, 1> lumped;

  void compute(const int* nodes, int) {
    const Nodes<n> x = gather<n>(mesh.nodes, nodes);
    if constexpr (Cell::row.inertia == Inertia::consistent) {
      mass = consistent_mass<Cell>(x, material.density);
      lumped = mass.rowwise().sum();
      return;
    }
    lumped = material.density * node_volumes<Cell>(x);
    mass.setZero();
    if (!tuning) return;
    if (keeps_lumped.empty() || std::none_of(nodes, nodes + n, [&](int node) { return keeps_lumped[node]; }))
      mass = Cell::tuned_mass(x, material.density, *tuning);
  }
  void add(const int* nodes, int a) {
    const int first = pattern.starts[nodes[a]], end = pattern.starts[nodes[a] + 1];
    const auto entry = [&](int node) -> double& {
      return values[std::lower_bound(pattern.neighbours.begin() + first, pattern.neighbours.begin() + end, node) -
                    pattern.neighbours.begin()];
    };
    double rest = lumped[a];
    for (int b = 0; b < n; ++b) {
      if (b == a) continue;
      entry(nodes[b]) += mass(a, b);
      rest -= mass(a, b);
    }
    entry(nodes[a]) += rest;
  }
  void finish() {}
};

SparseMatrix assembled_mass(const Mesh& mesh, const Elastic& material, const WaveTuning* tuning,
                            const std::vector<char>& keeps_lumped) {
  const NodePattern pattern = node_pattern(mesh);
  const NodeOwners owners = node_owners(mesh);
  SparseMatrix matrix(mesh.n_nodes(), mesh.n_nodes());
  matrix.resizeNonZeros(static_cast<Eigen::Index>(pattern.neighbours.size()));
  std::copy(pattern.starts.begin(), pattern.starts.end(), matrix.outerIndexPtr());
  std::copy(pattern.neighbours.begin(), pattern.neighbours.end(), matrix.innerIndexPtr());
  std::fill_n(matrix.valuePtr(), matrix.nonZeros(), 0.0);
  for (const CellBlock& block : mesh.blocks)
    with_cell(block.type, [&](auto cell) {
      sum_at_nodes(
          block, owners,
          MassKernel<decltype(cell)>{mesh, material, tuning, keeps_lumped, pattern, matrix.valuePtr(), {}, {}});
    });
  return matrix;
}

}  // namespace

SparseMatrix tuned_mass(const Mesh& mesh, const Elastic& material, const WaveTuning& tuning,
                        const std::vector<char>& keeps_lumped) {
  CHECK(tuning.dt > 0.0, "a mass is tuned to steps of some length");
  return assembled_mass(mesh, material, &tuning, keeps_lumped);
}

SparseMatrix consistent_mass(const Mesh& mesh, const Elastic& material) {
  return assembled_mass(mesh, material, nullptr, {});
}

std::vector<Vec> lumping_energies(const Mesh& mesh, double density, const Points& velocity) {
  std::vector<Vec> of_cells;
  for (const CellBlock& block : mesh.blocks) {
    Vec& energy = of_cells.emplace_back(Vec::Zero(block.n_cells()));
    with_cell(block.type, [&](auto cell) {
      using Cell = decltype(cell);
      constexpr int n = Cell::n_nodes;
      if constexpr (Cell::row.inertia == Inertia::lumped) {
        const auto& shapes = Cell::mass_shapes();
        const auto compute = [&](int i) {
          const auto x = gather<n>(mesh.nodes, block.cell(i)), v = gather<n>(velocity, block.cell(i));
          const Nodes<n> beside = v.colwise() - v.col(0);  // rounding of what is carried along
          double twice = node_volumes<Cell>(x).dot(beside.colwise().squaredNorm().transpose());
          for (int k = 0; k < shapes.n_points; ++k) {
            const double volume = jacobian_at(shapes, x, k).determinant() * shapes.weights[k];
            twice -= volume * beside.lazyProduct(shapes.values.col(k)).squaredNorm();
          }
          energy[i] = 0.5 * density * twice;
        };
        parallel_for(block.n_cells(), compute, Schedule::evenly);
      }
    });
  }
  return of_cells;
}

bool has_consistent_mass(const Mesh& mesh) {
  if (!mesh.has_cells()) return true;
  return std::any_of(mesh.blocks.begin(), mesh.blocks.end(),
                     [](const CellBlock& block) { return cell_shape(block.type).inertia == Inertia::consistent; });
}

bool loses_by_diagonal(const Mesh& mesh) {
  const auto has_no_middle = [](const LocalFacet& facet) {
    const FacetShape& shape = facet_shape(facet.type);
    return shape.n_corners == 4 && nodes_per_facet(facet.type) == 2 * shape.n_corners;
  };
  return std::any_of(mesh.blocks.begin(), mesh.blocks.end(), [&](const CellBlock& block) {
    const std::span<const LocalFacet> facets = cell_shape(block.type).facets;
    return std::any_of(facets.begin(), facets.end(), has_no_middle);
  });
}

}  // namespace dygita
