// The box around substructures where they are placed.
#pragma once

#include "mesh/box_grid.hpp"
#include "model/model.hpp"

namespace dygita {

Box extent_of(const Substructure& part);
Box extent_of(const std::vector<SubstructurePtr>& parts);  // of all of them
// How many times its size (the root of its box's volume) P waves go in dt (s).
double crossings(const Substructure& part, double dt);

}  // namespace dygita
