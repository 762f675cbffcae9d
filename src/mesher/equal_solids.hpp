// Solids of CAD that are one solid, turned and moved: meshed once.
#pragma once

#include <optional>
#include <vector>

#include "intake/mesher_task.hpp"

namespace dygita {

struct SolidFaces {
  int tag = 0;
  std::vector<int> surfaces;  // in the order of the file
};

// Of each solid of gmsh's current OpenCASCADE model the first one before it that it is a copy of, if there is one:
// faces of the same areas in the same order, and centres of faces, corners, the centre of mass and the tensor of
// inertia at the same places once turned and moved (1e-5 of the size). A mirrored solid is none. unit: m, of the model.
std::vector<std::optional<SolidCopy>> equal_solids(const std::vector<SolidFaces>& solids, double unit);

}  // namespace dygita
