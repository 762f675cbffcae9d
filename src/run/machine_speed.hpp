// How fast this machine is, by a measurement of about a tenth of a second, and what a step then takes.
#pragma once

#include <string>
#include <utility>

#include "step/step_needs.hpp"

namespace dygita {

// Of one thread that has its processor to itself.
struct MachineSpeed {
  double operations;  // of a sparse factor, a second
  double bytes;       // of plain reading from memory, a second
};
// Measured once.
const MachineSpeed& machine_speed();

// Seconds: at least, and at most where rounds are not known.
std::pair<double, double> time_of(const StepCost& cost, const MachineSpeed& speed, int n_threads);

// "about 12 s", "about 3 to 20 s", "about 2 min".
std::string in_words(const std::pair<double, double>& seconds);

}  // namespace dygita
