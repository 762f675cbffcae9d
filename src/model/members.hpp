// What members of an ensemble may not differ in: all that a solver builds before laws and loads have a say.
#pragma once

#include <string>

#include "model/model.hpp"

namespace dygita {

// Empty where two problems have the same parts, places, steps, kinds of laws, loads, supports and outputs, and the same
// solver; else the first thing that differs: "the mesh of substructure 'lower'". Numbers of laws, values of loads, gaps
// and their forms, and velocities at the start may differ.
std::string difference_of_members(const Problem& first, const Problem& other);

}  // namespace dygita
