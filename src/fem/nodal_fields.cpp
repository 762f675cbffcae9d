#include <array>

#include "fem/assembly.hpp"
#include "fem/cell_loop.hpp"
#include "fem/cell_stress.hpp"
#include "fem/own_stress.hpp"

namespace dygita {

namespace {

// Computes cells ahead, those of the next ones that its owner touches.
template <class Cell>
struct StressKernel {
  static constexpr int n = Cell::n_nodes, at_once = 8;

  const Mesh& mesh;
  const CellBlock& block;
  const NodeOwners& owners;
  const CellFields fields;
  Tensors& sum;

  int me = 0, n_batch = 0, current = 0;  // current: of the batch, the cell at hand
  std::array<int, at_once> batch{};
  std::array<CornerStress<n>, at_once> stress{};

  void begin(int owner) { me = owner; }
  void compute(const int*, int i) {
    while (current < n_batch && batch[current] != i) ++current;
    if (current < n_batch) return;
    n_batch = current = 0;
    std::array<const int*, at_once> nodes{};
    for (int j = i; j < block.n_cells() && n_batch < at_once; ++j) {
      if (!owners.has_part_of(me, block.cell(j), n)) continue;
      nodes[n_batch] = block.cell(j);
      batch[n_batch++] = j;
    }
    stresses_of<Cell>(fields, {nodes.data(), static_cast<size_t>(n_batch)}, stress.data());
  }
  void add(const int* nodes, int a) { sum.col(nodes[a]) += stress[current].col(a); }
  void finish() {}
};

template <class Cell, bool is_lumped>
struct VolumeKernel {
  static constexpr int n = Cell::n_nodes;

  const Mesh& mesh;
  Vec& sum;

  Eigen::Matrix<double, n, 1> volumes;

  void compute(const int* nodes, int) {
    const Nodes<n> x = gather<n>(mesh.nodes, nodes);
    if constexpr (is_lumped)
      volumes = node_volumes<Cell>(x);
    else
      volumes = shape_integrals<Cell>(x);
  }
  void add(const int* nodes, int a) { sum[nodes[a]] += volumes[a]; }
  void finish() {}
};

template <bool is_lumped>
Vec summed_volumes(const Mesh& mesh) {
  const NodeOwners owners = node_owners(mesh);
  Vec volumes = Vec::Zero(mesh.n_nodes());
  for (const CellBlock& block : mesh.blocks)
    with_cell(block.type, [&](auto cell) {
      sum_at_nodes(block, owners, VolumeKernel<decltype(cell), is_lumped>{mesh, volumes, {}});
    });
  return volumes;
}

}  // namespace

Tensors nodal_stress(const Mesh& mesh, const Elastic& material, const Points& displacement) {
  if (material.layup) return layered_stress(mesh, material, displacement);
  const NodeOwners owners = node_owners(mesh);
  Tensors stress = Tensors::Zero(6, mesh.n_nodes());
  Vec n_cells = Vec::Zero(mesh.n_nodes());
  for (const CellBlock& block : mesh.blocks) {
    with_cell(block.type, [&](auto cell) {
      sum_at_nodes(
          block, owners,
          StressKernel<decltype(cell)>{mesh, block, owners, {mesh.nodes, displacement, material, block}, stress});
    });
    for (const int node : block.nodes) n_cells[node] += 1;
  }
  return stress * n_cells.cwiseInverse().asDiagonal();
}

Vec von_mises(const Tensors& stress) {
  const auto xx = stress.row(0).array(), yy = stress.row(1).array(), zz = stress.row(2).array();
  const auto shear = stress.bottomRows<3>().array().square().colwise().sum();
  const auto normal = (xx - yy).square() + (yy - zz).square() + (zz - xx).square();
  return (0.5 * normal + 3 * shear).sqrt().matrix().transpose();
}

Vec nodal_volumes(const Mesh& mesh) { return summed_volumes<true>(mesh); }

Vec nodal_integrals(const Mesh& mesh) { return summed_volumes<false>(mesh); }

}  // namespace dygita
