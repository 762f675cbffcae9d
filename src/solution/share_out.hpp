// Which rank has which piece of the cut: about the same work each, and few interface points between them.
#pragma once

#include "solution/cut.hpp"
#include "solution/surfaces.hpp"

namespace dygita {

// Gives every piece its rank, by an estimate of what it costs and by the points that it shares with others (METIS); the
// same on all ranks. Throws InputError where there are fewer pieces than ranks.
void share_out(const Problem& problem, const std::vector<Surface>& surfaces, Cut& cut);

// Heaviest rank over the mean, of the estimates.
double imbalance_of(const Problem& problem, const Cut& cut);

}  // namespace dygita
