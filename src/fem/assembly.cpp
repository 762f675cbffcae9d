#include "fem/assembly.hpp"

#include <algorithm>
#include <array>

#include "fem/cell_lanes.hpp"
#include "fem/cell_loop.hpp"
#include "fem/cell_tensor.hpp"
#include "fem/frequency.hpp"
#include "fem/layered_cell.hpp"
#include "fem/node_pattern.hpp"

namespace dygita {

namespace {

// Does the material lie in both cells alike?
bool has_equal_axes(const CellBlock& block, int i, int j) {
  return block.axes.empty() || block.axes[static_cast<size_t>(i)] == block.axes[static_cast<size_t>(j)];
}

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
    const bool is_copy = i > 0 && has_equal_axes(block, i - 1, i) && is_translated<n>(last, x);
    model[i] = is_copy ? model[i - 1] : i;
    if (!is_copy) last = x;
  }
  return model;
}

// Of any material, one by one.
template <class Cell>
Stiffness<Cell::n_nodes> stiffness_in(const Elastic& material, const CellBlock& block, int i,
                                      const Nodes<Cell::n_nodes>& x) {
  if constexpr (Cell::row.n_corners == 8)
    if (material.layup)
      return LayeredCell(block.type, x, block.axes[static_cast<size_t>(i)], *material.layup).stiffness();
  return Cell::stiffness(x, tensor_in(material, block, i));
}

// Computes cells ahead, as many as there are lanes.
template <class Cell>
struct AssemblyKernel {
  static constexpr int n = Cell::n_nodes;
  static constexpr int furthest = 16 * n_lanes;  // cells looked at for the lanes of one batch
  static constexpr int few = 8;                  // models of a block that are computed one by one

  const Mesh& mesh;
  const CellBlock& block;
  const Elastic& material;
  const NodePattern& pattern;
  const std::uint16_t* slots;  // of the block
  const std::vector<int>& model;
  const NodeOwners& owners;
  BodyMatrices& body;
  std::vector<char>& is_begun;  // nodes whose rows have been set
  bool is_plain = false;  // by the kernel of a single cell, whatever the number of owners: few models, or directions

  int me = 0;
  std::array<int, n_lanes> batch{};  // models computed, increasing
  int n_batch = 0, current = 0;      // how many; the lane of the cell at hand
  int i_cell = -1;
  CellLanes<n> matrices{};

  void begin(int owner) { me = owner; }

  void compute(const int*, int i) {
    i_cell = i;
    while (current < n_batch && batch[current] != model[i]) ++current;
    if (current == n_batch) compute_from(i);
  }

  void compute_from(int i) {
    n_batch = current = 0;
    if (is_plain) return compute_one(model[i]);
    const int end = std::min(block.n_cells(), i + furthest);
    for (int j = i; j < end && n_batch < n_lanes; ++j)
      if ((n_batch == 0 || model[j] != batch[n_batch - 1]) && owners.has_part_of(me, block.cell(j), n))
        batch[n_batch++] = model[j];
    Lanes x[n][3];
    for (int lane = 0; lane < n_lanes; ++lane) {
      const int* nodes = block.cell(batch[std::min(lane, n_batch - 1)]);
      for (int a = 0; a < n; ++a)
        for (int p = 0; p < 3; ++p) x[a][p][lane] = mesh.nodes(p, nodes[a]) - mesh.nodes(p, nodes[0]);
    }
    stiffness_in_lanes<Cell>(x, material.tensor(), matrices);
    if constexpr (Cell::row.lumping != Lumping::row_sums)
      for (int lane = 0; lane < n_batch; ++lane) {
        const Eigen::Matrix<double, n, 1> volumes = node_volumes<Cell>(gather<n>(mesh.nodes, block.cell(batch[lane])));
        for (int a = 0; a < n; ++a) matrices.volume[a][lane] = volumes[a];
      }
  }

  void compute_one(int i) {
    batch[n_batch++] = i;
    const Nodes<n> x = gather<n>(mesh.nodes, block.cell(i));
    const Stiffness<n> stiffness = stiffness_in<Cell>(material, block, i, x);
    const Eigen::Matrix<double, n, 1> volumes = node_volumes<Cell>(x);
    for (int a = 0; a < n; ++a) {
      matrices.volume[a][0] = volumes[a];
      for (int b = 0; b < n; ++b)
        for (int p = 0; p < 3; ++p)
          for (int q = p; q < 3; ++q)
            matrices.plane[CellLanes<n>::plane_of(p, q)][a][b][0] = stiffness(3 * a + p, 3 * b + q);
    }
  }

  void add(const int* nodes, int a) {
    const int node = nodes[a], first = pattern.starts[node], count = pattern.starts[node + 1] - first;
    double* const row = body.stiffness.valuePtr() + 9 * static_cast<std::ptrdiff_t>(first);
    if (!is_begun[node]) {
      std::fill_n(row, 9 * count, 0.0);
      is_begun[node] = 1;
    }
    body.mass[node] += material.density * matrices.volume[a][current];
    const auto* const values = reinterpret_cast<const double*>(matrices.plane) + current;
    const std::uint16_t* const slot = slots + (static_cast<size_t>(i_cell) * n + a) * n;
    constexpr int plane = n * n * n_lanes;
    for (int b = 0; b < n; ++b) {
      const double* const ab = values + (a * n + b) * n_lanes;
      const double* const ba = values + (b * n + a) * n_lanes;
      double* const x = row + 3 * slot[b];
      double* const y = x + 3 * count;
      double* const z = y + 3 * count;
      x[0] += ab[0];
      x[1] += ab[plane];
      x[2] += ab[2 * plane];
      y[0] += ba[plane];
      y[1] += ab[3 * plane];
      y[2] += ab[4 * plane];
      z[0] += ba[2 * plane];
      z[1] += ba[4 * plane];
      z[2] += ab[5 * plane];
    }
  }

  void finish() {}
};

// Hands each element's stiffness and mass to the bound on the frequencies.
template <class Cell>
void see_cells(const Mesh& mesh, const CellBlock& block, const Elastic& material, FrequencyBound& highest) {
  constexpr int n = Cell::n_nodes;
  const std::vector<int> model = models<n>(mesh.nodes, block);
  for (int i = 0; i < block.n_cells(); ++i) {
    if (model[i] != i) continue;
    const Nodes<n> x = gather<n>(mesh.nodes, block.cell(i));
    const Eigen::Matrix<double, n, 1> mass = material.density * node_volumes<Cell>(x);
    highest.see(stiffness_in<Cell>(material, block, i, x), mass);
  }
}

}  // namespace

BodyMatrices assemble(const Mesh& mesh, const Elastic& material, SparseMatrix* memory) {
  if (const CondensedBody* own = mesh.inside->matrices()) return {own->stiffness, own->node_masses()};
  CellSlots slots;
  const NodePattern pattern = node_pattern(mesh, &slots);
  const NodeOwners owners = node_owners(mesh);
  BodyMatrices body{block_matrix(pattern, memory), Vec::Zero(mesh.n_nodes())};
  std::vector<char> is_begun(mesh.n_nodes(), 0);
  for (size_t k = 0; k < mesh.blocks.size(); ++k)
    with_cell(mesh.blocks[k].type, [&](auto cell) {
      using Cell = decltype(cell);
      const CellBlock& block = mesh.blocks[k];
      const std::vector<int> model = models<Cell::n_nodes>(mesh.nodes, block);
      AssemblyKernel<Cell> kernel{mesh,  block,  material, pattern, slots.of_block[k].data(),
                                  model, owners, body,     is_begun};
      int n_models = 0;
      for (int i = 0; i < block.n_cells(); ++i) n_models += model[i] == i;
      kernel.is_plain = n_models <= kernel.few || !material.is_isotropic();
      sum_at_nodes(block, owners, kernel);
    });
  return body;
}

double max_frequency(const Mesh& mesh, const Elastic& material) {
  FrequencyBound highest;
  for (const CellBlock& block : mesh.blocks)
    with_cell(block.type, [&](auto cell) { see_cells<decltype(cell)>(mesh, block, material, highest); });
  return highest.frequency();
}

}  // namespace dygita
