#include "fem/assembly.hpp"
#include "fem/cell_loop.hpp"

namespace dygita {

namespace {

template <class Cell>
void add_stress(const Mesh& mesh, const CellBlock& block, const Elastic& material, const Points& displacement,
                Tensors& sum) {
  constexpr int n = Cell::n_nodes;
  const auto compute = [&](int first, int last, CornerStress<n>* results) {
    for (int i = first; i < last; ++i)
      results[i - first] =
          Cell::stress(gather<n>(mesh.nodes, block.cell(i)), material, gather<n>(displacement, block.cell(i)));
  };
  const auto add = [&](int i, int a, const CornerStress<n>& stress) { sum.col(block.cell(i)[a]) += stress.col(a); };
  sum_at_nodes<CornerStress<n>>(block, compute, add);
}

template <class Cell>
void add_volumes(const Mesh& mesh, const CellBlock& block, Vec& sum) {
  constexpr int n = Cell::n_nodes;
  using Volumes = Eigen::Matrix<double, n, 1>;
  const auto compute = [&](int first, int last, Volumes* results) {
    for (int i = first; i < last; ++i) results[i - first] = node_volumes<Cell>(gather<n>(mesh.nodes, block.cell(i)));
  };
  const auto add = [&](int i, int a, const Volumes& volumes) { sum[block.cell(i)[a]] += volumes[a]; };
  sum_at_nodes<Volumes>(block, compute, add);
}

}  // namespace

Tensors nodal_stress(const Mesh& mesh, const Elastic& material, const Points& displacement) {
  Tensors stress = Tensors::Zero(6, mesh.n_nodes());
  Vec n_cells = Vec::Zero(mesh.n_nodes());
  for (const CellBlock& block : mesh.blocks) {
    with_cell(block.type, [&](auto cell) { add_stress<decltype(cell)>(mesh, block, material, displacement, stress); });
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

Vec nodal_volumes(const Mesh& mesh) {
  Vec volumes = Vec::Zero(mesh.n_nodes());
  for (const CellBlock& block : mesh.blocks)
    with_cell(block.type, [&](auto cell) { add_volumes<decltype(cell)>(mesh, block, volumes); });
  return volumes;
}

}  // namespace dygita
