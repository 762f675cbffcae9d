// How a layup lies in hexahedra: through which of a cell's directions, and whether it fills it.
#pragma once

#include "mesh/mesh.hpp"

namespace dygita {

// The direction of a reference cell through the thickness.
struct Through {
  int direction = 2;
  double sign = 1.0;       // along axis 3, or against it
  double cosine = 0.0;     // between both
  double thickness = 0.0;  // m, at the middle of the cell
};
// Of the Jacobian at the middle in the axes of the layup, the third of which is across the plies.
Through through(const Mat3& jacobian);

// Throws InputError where a cell is no hexahedron, or where plies of a thickness (m) do not lie in it from face to face
// along axis 3.
void check_layers(const Mesh& mesh, double thickness);

}  // namespace dygita
