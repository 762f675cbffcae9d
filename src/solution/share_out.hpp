// Which rank has which piece of the cut: about the same work each, and few interface points between them.
#pragma once

#include <map>

#include "solution/cut.hpp"
#include "solution/surfaces.hpp"

namespace dygita {

// Gives every piece its rank, by an estimate of what it costs and by the points that it shares with others (METIS); the
// same on all ranks. Throws InputError where there are fewer pieces than ranks.
void share_out(const Problem& problem, const std::vector<Surface>& surfaces, Cut& cut);

// Points that two pieces share, the first of which has the lower number.
std::map<std::pair<int, int>, int> shared_points(const std::vector<Surface>& surfaces, const Cut& cut);

}  // namespace dygita
