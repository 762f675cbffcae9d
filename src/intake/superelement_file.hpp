// Bodies that come as matrices: superelements as output.superelement writes them, and matrices of other programs.
#pragma once

#include <optional>
#include <string>

#include "mesh/mesh.hpp"

namespace dygita {

// Matrices in Matrix Market format and the points that their first rows belong to.
struct MatrixFiles {
  std::string stiffness, mass;         // N/m, kg
  std::optional<std::string> damping;  // N s/m
  // A table with a line of titles: face, x, y, z (m) of each point; and rows of its displacements, counted from 1, as
  // row_x, row_y, row_z (0: something inside holds it), without which points have three rows each from the first on.
  // Rows that no point has are amplitudes.
  std::string points;
};

// The body of `<name>.json`. Throws InputError: a file that is missing or of something else, matrices that are not
// symmetric, finite or of the sizes told, of another run than the description, rows without their point, too many rows.
MeshPtr read_superelement(const std::string& file);
MeshPtr read_matrices(const MatrixFiles& files);

}  // namespace dygita
