// Why a static increment has no equilibrium: parts that more force pulls than their joints can hold.
#pragma once

#include <string>
#include <vector>

#include "step/observer.hpp"

namespace dygita {

// One line for each group of connected parts whose joints all slide, yield or stand open, while the loads
// pull more than these hold: with the force, what the joints hold of it, and their names. Of a static increment.
std::vector<std::string> overloaded_joints(const Instant& instant);

}  // namespace dygita
