// Element matrices of hex8, prism6 and tet4. Cells are those of a mesh that passed check_mesh: an inverted one throws
// ContractError.
#pragma once

#include "material/elastic.hpp"
#include "mesh/mesh.hpp"

namespace dygita {

using CellNodes = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 8>;                  // 3 x n, metres
using CellMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 24, 24>;  // 3n x 3n, dof = 3 node + axis

// Stiffness (N/m), exactly symmetric. hex8: 12 enhanced strain modes condensed in the cell, passes the patch test on
// distorted cells, locks neither in bending nor near incompressibility. prism6 and tet4: plain, they lock in both.
CellMatrix element_stiffness(CellType type, const CellNodes& x, const Elastic& material);

// Lumped mass of each node (kg): row sums of the consistent mass, positive, with exact total and centre of mass.
Eigen::VectorXd element_mass(CellType type, const CellNodes& x, double density);

// Stress (Pa) at each node of the cell from the nodal displacements (3 x n): that of the quadrature points, internal
// modes included, interpolated. Exact for constant strain and, in a hex8 box, for pure bending.
Tensors element_stress(CellType type, const CellNodes& x, const Elastic& material, const CellNodes& displacement);

}  // namespace dygita
