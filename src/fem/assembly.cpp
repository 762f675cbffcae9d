#include "fem/assembly.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "fem/cell_loop.hpp"
#include "fem/frequency.hpp"
#include "fem/node_pattern.hpp"

namespace dygita {

namespace {

// Are the cells equal but for a translation, as those of a box are?
template <int n>
bool is_translated(const Nodes<n>& x, const Nodes<n>& y) {
  const Nodes<n> relative_x = x.colwise() - x.col(0), relative_y = y.colwise() - y.col(0);
  return (relative_x - relative_y).cwiseAbs().maxCoeff() <= 1e-12 * relative_x.cwiseAbs().maxCoeff();
}

// The cell whose matrices serve for each cell: itself, or the last one before it that it is a translation of.
template <int n>
std::vector<int> models(const Points& nodes, const CellBlock& block) {
  std::vector<int> model(block.n_cells());
  Nodes<n> last;
  for (int i = 0; i < block.n_cells(); ++i) {
    const Nodes<n> x = gather<n>(nodes, block.cell(i));
    const bool is_copy = i > 0 && is_translated<n>(last, x);
    model[i] = is_copy ? model[i - 1] : i;
    if (!is_copy) last = x;
  }
  return model;
}

template <class Cell>
struct AssemblyKernel {
  static constexpr int n = Cell::n_nodes;

  const Mesh& mesh;
  const CellBlock& block;
  const Elastic& material;
  const NodePattern& pattern;
  const std::vector<int>& model;
  BodyMatrices& body;
  FrequencyBound& highest;

  std::array<int, n> order;  // of the cell's nodes, increasing: their neighbours are walked once
  int computed = -1;
  Stiffness<n> stiffness;
  Eigen::Matrix<double, n, 1> mass;
  FrequencyBound seen;

  void compute(const int* nodes, int i_cell) {
    std::sort(order.begin(), order.end(), [nodes](int a, int b) { return nodes[a] < nodes[b]; });
    if (model[i_cell] == computed) return;
    computed = model[i_cell];
    const Nodes<n> x = gather<n>(mesh.nodes, block.cell(computed));
    stiffness = Cell::stiffness(x, material);
    mass = material.density * node_volumes<Cell>(x);
    seen.see(stiffness, mass);
  }

  void add(const int* nodes, int a) {
    body.mass[nodes[a]] += mass[a];
    const int first = pattern.starts[nodes[a]], count = pattern.starts[nodes[a] + 1] - first;
    const int* neighbours = pattern.neighbours.data() + first;
    double* row = body.stiffness.valuePtr() + 9 * static_cast<std::ptrdiff_t>(first);
    int slot = 0;
    for (const int b : order) {
      while (neighbours[slot] != nodes[b]) ++slot;
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)  // by columns: the cell's matrix is symmetric
          row[3 * (i * count + slot) + j] += stiffness(3 * b + j, 3 * a + i);
    }
  }

  void finish() { highest.see(seen); }
};

}  // namespace

BodyMatrices assemble(const Mesh& mesh, const Elastic& material) {
  const NodePattern pattern = node_pattern(mesh);
  const NodeOwners owners = node_owners(mesh);
  BodyMatrices body{block_matrix(pattern), Vec::Zero(mesh.n_nodes()), 0.0};
  FrequencyBound highest;
  for (const CellBlock& block : mesh.blocks)
    with_cell(block.type, [&](auto cell) {
      using Cell = decltype(cell);
      const std::vector<int> model = models<Cell::n_nodes>(mesh.nodes, block);
      AssemblyKernel<Cell> kernel{mesh, block, material, pattern, model, body, highest, {}, -1, {}, {}, {}};
      std::iota(kernel.order.begin(), kernel.order.end(), 0);
      sum_at_nodes(block, owners, kernel);
    });
  body.max_frequency = highest.frequency();
  return body;
}

}  // namespace dygita
