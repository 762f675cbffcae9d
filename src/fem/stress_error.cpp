#include "fem/stress_error.hpp"

#include <algorithm>
#include <array>

#include "fem/cell_loop.hpp"
#include "fem/cell_stress.hpp"
#include "fem/patch_recovery.hpp"

namespace dygita {

namespace {

// 1/2 of the integral of d : C^-1 : d over a cell, d interpolated from its nodes.
template <class Cell>
double cell_energy(const ElasticTensor& tensor, const Nodes<Cell::n_nodes>& x, const CornerStress<Cell::n_nodes>& d) {
  const auto& shapes = Cell::mass_shapes();  // a quadratic, as products of shape functions are
  double energy = 0.0;
  for (int i = 0; i < shapes.n_points; ++i)
    energy += point_in_cell(shapes, x, i).volume * tensor.energy_density(d.lazyProduct(shapes.values.col(i)));
  return energy;
}

template <int n>
CornerStress<n> gather_stress(const Tensors& values, const int* nodes) {
  CornerStress<n> gathered;
  for (int a = 0; a < n; ++a) gathered.col(a) = values.col(nodes[a]);
  return gathered;
}

// 1/2 of the integral of (s* - s) : C^-1 : (s* - s) over a cell, s* interpolated from its nodes, s of the displacement.
template <class Cell>
double energy_against(const ElasticTensor& tensor, const Nodes<Cell::n_nodes>& x,
                      const Nodes<Cell::n_nodes>& displacement, const CornerStress<Cell::n_nodes>& smooth) {
  const auto& shapes = Cell::mass_shapes();
  double energy = 0.0;
  for (int i = 0; i < shapes.n_points; ++i) {
    const auto point = point_in_cell(shapes, x, i);
    energy += point.volume * tensor.energy_density(smooth.lazyProduct(shapes.values.col(i)) -
                                                   tensor.stress(displacement.lazyProduct(point.gradient)));
  }
  return energy;
}

// The stress of every cell at its nodes, column by column in the order of the block's nodes.
template <class Cell>
Tensors cell_stresses(const Mesh& mesh, const CellBlock& block, const Elastic& material, const Points& displacement) {
  constexpr int n = Cell::n_nodes, at_once = 8;
  Tensors stress(6, static_cast<Eigen::Index>(block.nodes.size()));
  const auto compute = [&](int batch) {
    const int first = at_once * batch, count = std::min(at_once, block.n_cells() - first);
    std::array<const int*, at_once> nodes{};
    std::array<CornerStress<n>, at_once> of_cell;
    for (int i = 0; i < count; ++i) nodes[i] = block.cell(first + i);
    stresses_of<Cell>({mesh.nodes, displacement, material, block}, {nodes.data(), static_cast<size_t>(count)},
                      of_cell.data());
    for (int i = 0; i < count; ++i) stress.middleCols<n>(n * (first + i)) = of_cell[i];
  };
  parallel_for((block.n_cells() + at_once - 1) / at_once, compute, Schedule::evenly);
  return stress;
}

}  // namespace

double StressError::energy() const {
  double sum = 0.0;
  for (const Vec& of_block : of_cells) sum += of_block.sum();
  for (const Vec& of_block : at_surface) sum += of_block.sum();
  return sum;
}

StressError stress_error(const Mesh& mesh, const Elastic& material, const Points& displacement,
                         const std::vector<FreeCell>& free) {
  const bool of_order_two = is_of_order_two(mesh);
  std::vector<Tensors> of_cells;
  Tensors smooth = Tensors::Zero(6, mesh.n_nodes());
  Vec n_cells = Vec::Zero(mesh.n_nodes());
  for (const CellBlock& block : mesh.blocks) {
    with_cell(block.type, [&](auto cell) {
      of_cells.push_back(cell_stresses<decltype(cell)>(mesh, block, material, displacement));
    });
    for (size_t i = 0; i < block.nodes.size(); ++i) {
      smooth.col(block.nodes[i]) += of_cells.back().col(static_cast<Eigen::Index>(i));
      n_cells[block.nodes[i]] += 1;
    }
  }
  smooth *= n_cells.cwiseInverse().asDiagonal();
  if (of_order_two) smooth = recovered_stress(mesh, material, displacement);

  StressError error{{}, {}, Vec::Zero(mesh.n_nodes())};
  const SurfaceErrors left = surface_errors(mesh, material, free, of_cells);
  for (const CellBlock& block : mesh.blocks) error.at_surface.emplace_back(Vec::Zero(block.n_cells()));
  for (size_t i = 0; i < free.size(); ++i)
    error.at_surface[static_cast<size_t>(free[i].block)][free[i].cell] = left.energies[static_cast<Eigen::Index>(i)];
  for (size_t b = 0; b < mesh.blocks.size(); ++b)
    with_cell(mesh.blocks[b].type, [&](auto cell) {
      using Cell = decltype(cell);
      constexpr int n = Cell::n_nodes;
      const CellBlock& block = mesh.blocks[b];
      Vec energy(block.n_cells());
      const auto compute = [&](int i) {
        auto difference = of_cells[b].middleCols<n>(n * i);
        for (int a = 0; a < n; ++a) difference.col(a) = smooth.col(block.cell(i)[a]) - difference.col(a);
        const auto x = gather<n>(mesh.nodes, block.cell(i));
        const ElasticTensor tensor = tensor_in(material, block, i);
        energy[i] = of_order_two ? energy_against<Cell>(tensor, x, gather<n>(displacement, block.cell(i)),
                                                        gather_stress<n>(smooth, block.cell(i)))
                                 : cell_energy<Cell>(tensor, x, difference);
      };
      parallel_for(block.n_cells(), compute, Schedule::evenly);
      error.of_cells.push_back(std::move(energy));
      Vec corners = von_mises(of_cells[b]);
      for (size_t i = 0; i < free.size(); ++i) {
        if (free[i].block != static_cast<int>(b)) continue;
        auto of_cell = corners.segment<n>(n * free[i].cell);
        of_cell = (of_cell.cwiseAbs2() + von_mises(left.at_nodes[i]).cwiseAbs2()).cwiseSqrt().eval();
      }
      for (size_t i = 0; i < block.nodes.size(); ++i) {
        double& at_node = error.at_nodes[block.nodes[i]];
        at_node = std::max(at_node, corners[static_cast<Eigen::Index>(i)]);
      }
    });
  return error;
}

}  // namespace dygita
