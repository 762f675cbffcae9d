// Element matrices of any type of cells. Cells are those of a mesh that passed check_mesh: an inverted one throws
// ContractError.
#pragma once

#include "material/elastic.hpp"
#include "mesh/mesh.hpp"

namespace dygita {

constexpr int most_cell_dofs = 3 * most_cell_nodes;
using CellNodes = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, most_cell_nodes>;  // 3 x n, metres
// 3n x 3n, dof = 3 node + axis
using CellMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, most_cell_dofs, most_cell_dofs>;

// Stiffness (N/m), exactly symmetric, of a material along the axes. hex8: 12 enhanced strain modes condensed in the
// cell, passes the patch test on distorted cells, locks neither in bending nor near incompressibility. Others: plain,
// linear ones lock in both.
CellMatrix element_stiffness(CellType type, const CellNodes& x, const Elastic& material);

// Lumped mass of each node (kg), as the type's row says: positive, with exact total.
Eigen::VectorXd element_mass(CellType type, const CellNodes& x, double density);

// Stress (Pa) at each node of the cell from the nodal displacements (3 x n): that of the quadrature points, internal
// modes included, interpolated. Exact for constant strain and, in a hex8 box, for pure bending.
Tensors element_stress(CellType type, const CellNodes& x, const Elastic& material, const CellNodes& displacement);

}  // namespace dygita
