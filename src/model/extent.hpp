// The box around substructures where they are placed.
#pragma once

#include "mesh/box_grid.hpp"
#include "model/model.hpp"

namespace dygita {

Box extent_of(const Substructure& part);
Box extent_of(const std::vector<SubstructurePtr>& parts);  // of all of them
// How many times P waves cross a part in dt (s), its size being the cube root of its box's volume.
double crossings(const Substructure& part, double dt);

}  // namespace dygita
