// Stress of several cells at once: hexahedra side by side in the processor's registers, other types one by one.
#pragma once

#include <span>

#include "fem/cell_tensor.hpp"
#include "fem/cells.hpp"
#include "mesh/mesh.hpp"

namespace dygita {

// Places and displacements of all nodes (3 x n_nodes, m) of a body.
struct CellFields {
  const Points& nodes;
  const Points& displacement;
  const Elastic& material;
  const CellBlock& block;  // of the cells
};

template <class Cell>
void stresses_one_by_one(const CellFields& fields, std::span<const int* const> cells,
                         CornerStress<Cell::n_nodes>* stress) {
  constexpr int n = Cell::n_nodes;
  const auto of_cell = [](const Points& values, const int* nodes) {
    Nodes<n> gathered;
    for (int a = 0; a < n; ++a) gathered.col(a) = values.col(nodes[a]);
    return gathered;
  };
  for (size_t i = 0; i < cells.size(); ++i) {
    const auto cell = static_cast<int>(cells[i] - fields.block.cell(0)) / n;
    stress[i] = Cell::stress(of_cell(fields.nodes, cells[i]), tensor_in(fields.material, fields.block, cell),
                             of_cell(fields.displacement, cells[i]));
  }
}

// Stress (Pa) of each cell, told by its nodes in the block, at its nodes; the same bits whichever cells come together.
template <class Cell>
void stresses_of(const CellFields& fields, std::span<const int* const> cells, CornerStress<Cell::n_nodes>* stress) {
  stresses_one_by_one<Cell>(fields, cells, stress);
}

template <>
void stresses_of<Hex8>(const CellFields& fields, std::span<const int* const> cells, CornerStress<8>* stress);

}  // namespace dygita
