// Unconstrained rigid motions of the substructures in a static step.
#pragma once

#include <string>
#include <vector>

#include "exchange/exchange.hpp"

namespace dygita {

// Does the substructure have a rigid motion that its own supports leave free?
bool is_floating(const Substructure& part, const std::unordered_map<int, Held>& held);

// Holds one direction of one node for each rigid motion of the assembly that neither supports nor laws hold, and warns;
// the motion is left at zero and the answer is not changed, since nothing loads it. Throws InputError, naming the
// substructures and the motion, when `force` (one 3 x n_nodes a substructure, N) does load it. Contact counts as
// holding in its normal direction.
void pin_free_motions(const Problem& problem, const Step& step, const Exchange& exchange,
                      const std::vector<Points>& force, Conditions& conditions);

}  // namespace dygita
