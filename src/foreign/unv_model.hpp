// Universal files of Salome, NX, I-DEAS and gmsh: nodes, cells, groups and the unit of length. Source: the datasets
// 164, 2411, 2412, 2467 and 2477 as the Structural Dynamics Research Lab of the University of Cincinnati describes
// them.
#pragma once

#include <optional>

#include "foreign/foreign_model.hpp"

namespace dygita {

struct UnvOptions {
  std::string file;
  std::optional<double> unit;     // m; none: as the file says, else 1
  std::vector<std::string> skip;  // numbers of types of elements that are left out
};

// Groups of solid elements become parts, of elements of surfaces faces, of nodes sets; a group may have all of them.
// Throws InputError with file, line and dataset.
ForeignModel unv_model(const UnvOptions& options);

}  // namespace dygita
