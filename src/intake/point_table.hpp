// The table of points that goes with matrices of other programs.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "numerics/types.hpp"

namespace dygita {

struct PointLine {
  std::string face;
  Vec3 place;               // as the file has it
  std::array<int, 3> rows;  // of its displacements, from 0; no_row: something inside holds it
  long node;                // 0: the table has no numbers of nodes
  int line;
};

// Throws InputError with file and line: what is missing, unknown or no number, rows beside nodes, no point at all.
std::vector<PointLine> read_points(const std::string& file);

}  // namespace dygita
