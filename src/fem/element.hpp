// Element matrices of hex8 (incompatible or enhanced modes), prism6 and tet4.
#pragma once

#include "material/elastic.hpp"
#include "mesh/mesh.hpp"

namespace dygita {

using CellNodes = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 8>;                  // 3 x n, metres
using CellMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 24, 24>;  // 3n x 3n, dof = 3 node + axis

// Stiffness (N/m). hex8: condensed internal modes, passes the patch test on distorted cells, no locking in bending.
CellMatrix element_stiffness(CellType type, const CellNodes& x, const Elastic& material);

// Lumped mass of each node (kg, positive, sum = density x volume).
Eigen::VectorXd element_mass(CellType type, const CellNodes& x, double density);

// Stress (Pa) at each node of the cell from the nodal displacements (3 x n), with the internal modes recovered.
Tensors element_stress(CellType type, const CellNodes& x, const Elastic& material, const CellNodes& displacement);

}  // namespace dygita
