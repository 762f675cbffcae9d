// What frequencies the loads of a step bring into the assembly.
#pragma once

#include "model/load.hpp"

namespace dygita {

// The same load, on the same places and with this value, in another dynamic step; null: it has none.
const Load* same_load_in(const Step& step, const Load& load, size_t i_value);

// Whether the steps beside it go on with a load where it leaves off, as with :shifted(-duration).
struct Chain {
  bool before = false, after = false;
};
Chain chain_of(const Problem& problem, size_t i_step, const Load& load, size_t i_value);

// Hz, below which 95 % of the energy of a load's histories lies, over all steps that go on with it; 0: they are
// constant, or over before the step begins.
double load_frequency(const Problem& problem, size_t i_step, const Load& load);

// Hz, the highest of a dynamic step's loads; infinity where something jumps: substructures that meet at speed or
// fly towards something, an interface or a support that lets go, a force that is there or gone at once.
double brought_frequency(const Problem& problem, const Step& step);

}  // namespace dygita
