// What load.preload and load.shortening say of a bolt beside the load itself.
#pragma once

#include "deck/build_model.hpp"

namespace dygita {

// Reads `torque`, `friction_factor`, `diameter`, `share` and `hand` into the load. Throws InputError.
void read_bolt(const Declaration& declaration, Load& load);

}  // namespace dygita
