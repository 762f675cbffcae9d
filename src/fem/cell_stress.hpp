// Stress of several cells at once: hexahedra side by side in the processor's registers, other types one by one.
#pragma once

#include <span>

#include "fem/cells.hpp"
#include "mesh/mesh.hpp"

namespace dygita {

// Places and displacements of all nodes (3 x n_nodes, m) of a body.
struct CellFields {
  const Points& nodes;
  const Points& displacement;
  const Elastic& material;
};

// Stress (Pa) of each cell, told by its nodes, at its nodes; the same bits whichever cells come together.
template <class Cell>
void stresses_of(const CellFields& fields, std::span<const int* const> cells, CornerStress<Cell::n_nodes>* stress) {
  constexpr int n = Cell::n_nodes;
  const auto of_cell = [](const Points& values, const int* nodes) {
    Nodes<n> gathered;
    for (int a = 0; a < n; ++a) gathered.col(a) = values.col(nodes[a]);
    return gathered;
  };
  for (size_t i = 0; i < cells.size(); ++i)
    stress[i] = Cell::stress(of_cell(fields.nodes, cells[i]), fields.material, of_cell(fields.displacement, cells[i]));
}

template <>
void stresses_of<Hex8>(const CellFields& fields, std::span<const int* const> cells, CornerStress<8>* stress);

}  // namespace dygita
