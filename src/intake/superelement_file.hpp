// Bodies that come as matrices: superelements as output.superelement writes them, and matrices of other programs.
#pragma once

#include <optional>
#include <string>

#include "mesh/mesh.hpp"

namespace dygita {

// Of matrices and points, in m, kg and s.
struct MatrixUnits {
  double length = 1.0, mass = 1.0, time = 1.0;
};

// Matrices in the formats of labelled_matrix.hpp, and the points that their rows belong to.
struct MatrixFiles {
  std::string stiffness, mass;
  std::optional<std::string> damping;
  // A table with a line of titles: face, x, y, z of each point. Rows of its displacements: where the matrices name them
  // by node, those of its number in the column node; else counted from 1, as row_x, row_y, row_z (0: something inside
  // holds it), or without these columns three to a point from the first on. Rows that no point has are amplitudes, or
  // rotations that nothing is attached to.
  std::string points;
  // Of the matrices, where their files have several.
  std::string stiffness_name = {}, mass_name = {}, damping_name = {};
  std::optional<MatrixUnits> units = {};  // none: SI, as Matrix Market files have it; other formats must say
  std::optional<double> total_mass = {};  // kg, that the body has to weigh, within a percent
};

// The body of `<name>.json`. Throws InputError: a file that is missing or of something else, matrices that are not
// symmetric, finite or of the sizes told, of another run than the description, rows without their point, too many rows,
// another mass than told.
MeshPtr read_superelement(const std::string& file);
MeshPtr read_matrices(const MatrixFiles& files);

}  // namespace dygita
