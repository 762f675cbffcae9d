// What frequencies the loads of a step bring into the assembly.
#pragma once

#include "model/load.hpp"

namespace dygita {

// Hz, below which 95 % of the energy of a load's histories lies; 0: they are constant.
double load_frequency(const Load& load, const Step& step);

// Hz, the highest of a dynamic step's loads; infinity where something jumps: substructures that meet at speed or
// fly towards something, an interface or a support that lets go, a force that is there or gone at once.
double brought_frequency(const Problem& problem, const Step& step);

}  // namespace dygita
