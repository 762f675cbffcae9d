#include "fem/patch_recovery.hpp"

#include <algorithm>

#include "fem/cell_loop.hpp"
#include "fem/cell_tensor.hpp"
#include "mesh/raise_order.hpp"
#include "numerics/dense.hpp"

namespace dygita {

namespace {

constexpr int n_terms = 10;
using Terms = Eigen::Matrix<double, n_terms, 1>;
using Fit = Eigen::Matrix<double, 6, n_terms>;
constexpr double least_pivot = 1e-9;  // of the normal matrix: what the points see less is left out

// Those of second degree weigh little, so that where points do not tell them from the others they stay small.
Terms terms(const Vec3& x) {
  constexpr double w = 1e-2;
  Terms t;
  t << 1, x, w * x.cwiseAbs2(), w * x[0] * x[1], w * x[1] * x[2], w * x[2] * x[0];
  return t;
}

// Where the cells know their stress best: places and stresses of a cell lie side by side.
struct Samples {
  std::vector<int> first;                     // of each cell, and the number of all at the end
  std::vector<std::span<const int>> corners;  // of each cell
  Points places;
  Tensors stress;
};

template <class Cell>
void sample_block(const Mesh& mesh, const CellBlock& block, const Elastic& material, const Points& displacement,
                  int first, Samples& samples) {
  const auto& shapes = Cell::recovery_shapes();
  const auto compute = [&](int i) {
    const auto x = gather<Cell::n_nodes>(mesh.nodes, block.cell(i));
    const auto u = gather<Cell::n_nodes>(displacement, block.cell(i));
    const ElasticTensor tensor = tensor_in(material, block, i);
    for (int k = 0; k < shapes.n_points; ++k) {
      const int at = first + i * shapes.n_points + k;
      samples.places.col(at) = x.lazyProduct(shapes.values.col(k));
      samples.stress.col(at) = tensor.stress(u.lazyProduct(point_in_cell(shapes, x, k).gradient));
    }
  };
  parallel_for(block.n_cells(), compute, Schedule::evenly);
}

Samples sample(const Mesh& mesh, const Elastic& material, const Points& displacement) {
  Samples samples;
  int n = 0;
  for (const CellBlock& block : mesh.blocks) {
    const CellShape& shape = cell_shape(block.type);
    for (int i = 0; i < block.n_cells(); ++i) {
      samples.first.push_back(n);
      samples.corners.emplace_back(block.cell(i), static_cast<size_t>(shape.n_corners));
      n += static_cast<int>(shape.at_recovery.points.size());
    }
  }
  samples.first.push_back(n);
  samples.places.resize(3, n);
  samples.stress.resize(6, n);
  int first = 0;
  for (const CellBlock& block : mesh.blocks)
    with_cell(block.type, [&](auto cell) {
      sample_block<decltype(cell)>(mesh, block, material, displacement, first, samples);
      first += block.n_cells() * cell.n_recovery_points;
    });
  return samples;
}

// The cells at each corner node.
std::vector<std::vector<int>> cells_at_corners(const Samples& samples, int n_nodes) {
  std::vector<std::vector<int>> cells(static_cast<size_t>(n_nodes));
  for (size_t i = 0; i < samples.corners.size(); ++i)
    for (const int corner : samples.corners[i]) cells[static_cast<size_t>(corner)].push_back(static_cast<int>(i));
  return cells;
}

// Those around the cells, too.
std::vector<int> next_ring(const std::vector<int>& cells, const Samples& samples,
                           const std::vector<std::vector<int>>& at_corners) {
  std::vector<int> more;
  for (const int cell : cells)
    for (const int corner : samples.corners[static_cast<size_t>(cell)]) {
      const std::vector<int>& around = at_corners[static_cast<size_t>(corner)];
      more.insert(more.end(), around.begin(), around.end());
    }
  std::sort(more.begin(), more.end());
  more.erase(std::unique(more.begin(), more.end()), more.end());
  return more;
}

// A polynomial about a corner, in lengths of `size`.
struct Patch {
  Vec3 at = Vec3::Zero();
  double size = 1.0;
  Fit fit = Fit::Zero();
  Eigen::Matrix<double, 6, 1> stress(const Vec3& x) const { return fit * terms((x - at) / size); }
};

// Least squares; false where the points do not determine the polynomial, which is then the smallest that fits.
bool fit_to(const std::vector<int>& cells, const Samples& samples, Patch& patch) {
  patch.size = 0.0;
  const auto each = [&](const auto& visit) {
    for (const int cell : cells)
      for (int k = samples.first[static_cast<size_t>(cell)]; k < samples.first[static_cast<size_t>(cell) + 1]; ++k)
        visit(k);
  };
  each([&](int k) { patch.size = std::max(patch.size, (samples.places.col(k) - patch.at).norm()); });
  using Normal = Eigen::Matrix<double, n_terms, n_terms>;
  Normal normal = Normal::Zero();
  Fit right = Fit::Zero();
  each([&](int k) {
    const Terms t = terms((samples.places.col(k) - patch.at) / patch.size);
    normal += t * t.transpose();
    right += samples.stress.col(k) * t.transpose();
  });
  const LeastNorm found = solve_least_norm(normal, right.transpose(), least_pivot);
  patch.fit = found.x.transpose();
  return found.rank == n_terms;
}

std::vector<Patch> fit_patches(const Mesh& mesh, const Samples& samples) {
  const std::vector<std::vector<int>> at_corners = cells_at_corners(samples, mesh.n_nodes());
  std::vector<Patch> patches(static_cast<size_t>(mesh.n_nodes()));
  const auto compute = [&](int i) {
    const std::vector<int>& cells = at_corners[static_cast<size_t>(i)];
    if (cells.empty()) return;
    Patch& patch = patches[static_cast<size_t>(i)];
    patch.at = mesh.nodes.col(i);
    if (!fit_to(cells, samples, patch)) fit_to(next_ring(cells, samples, at_corners), samples, patch);
  };
  parallel_for(mesh.n_nodes(), compute, Schedule::evenly);
  return patches;
}

}  // namespace

bool is_of_order_two(const Mesh& mesh) {
  return std::all_of(mesh.blocks.begin(), mesh.blocks.end(), [](const CellBlock& block) {
    return nodes_per_cell(block.type) > cell_shape(block.type).n_corners;
  });
}

Tensors recovered_stress(const Mesh& mesh, const Elastic& material, const Points& displacement) {
  const std::vector<Patch> patches = fit_patches(mesh, sample(mesh, material, displacement));
  Tensors smooth = Tensors::Zero(6, mesh.n_nodes());
  Vec n_patches = Vec::Zero(mesh.n_nodes());
  for (const CellBlock& block : mesh.blocks) {
    const int n_corners = cell_shape(block.type).n_corners;
    const std::vector<std::vector<int>> middles = middle_corners(block.type);
    for (int i = 0; i < block.n_cells(); ++i) {
      const int* nodes = block.cell(i);
      const auto add = [&](int a, int corner) {
        smooth.col(nodes[a]) += patches[static_cast<size_t>(nodes[corner])].stress(mesh.nodes.col(nodes[a]));
        n_patches[nodes[a]] += 1;
      };
      for (int a = 0; a < n_corners; ++a) add(a, a);
      for (size_t m = 0; m < middles.size(); ++m)
        for (const int corner : middles[m]) add(n_corners + static_cast<int>(m), corner);
    }
  }
  return smooth * n_patches.cwiseInverse().asDiagonal();
}

}  // namespace dygita
