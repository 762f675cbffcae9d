// Stiffness and volumes of several cells at once, one a lane: the element kernels of cells.hpp as assembly runs them.
#pragma once

#include "fem/cells.hpp"
#include "fem/lanes.hpp"

namespace dygita {

// Matrices of n_lanes cells of n nodes. Of the stiffness the entry of dof (a, p) and (b, q), p <= q, is
// plane[plane_of(p, q)][a][b]: planes of equal axes are symmetric, the entry of (b, q) and (a, p) is the same.
template <int n>
struct CellLanes {
  Lanes plane[6][n][n];  // N/m
  Lanes volume[n];       // m^3, of each node

  static constexpr int plane_of(int p, int q) { return p == 0 ? q : p + q + 1; }  // xx xy xz yy yz zz
};

// x: coordinates (m) of the nodes. Throws ContractError where a cell is inverted.
template <class Cell>
void stiffness_in_lanes(const Lanes (&x)[Cell::n_nodes][3], const Elastic& material,
                        CellLanes<Cell::n_nodes>& matrices);

template <>
void stiffness_in_lanes<Hex8>(const Lanes (&x)[8][3], const Elastic& material, CellLanes<8>& matrices);
template <>
void stiffness_in_lanes<Prism6>(const Lanes (&x)[6][3], const Elastic& material, CellLanes<6>& matrices);
template <>
void stiffness_in_lanes<Tet4>(const Lanes (&x)[4][3], const Elastic& material, CellLanes<4>& matrices);

}  // namespace dygita
