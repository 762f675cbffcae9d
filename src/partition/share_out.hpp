// Which rank has which piece of the cut: about the same work each, and few interface points between them.
#pragma once

#include <map>

#include "interfaces/surfaces.hpp"
#include "partition/cut.hpp"

namespace dygita {

// Gives every piece its rank, by what it costs and by the points that it shares with others (METIS); the same on all
// ranks. What it costs is what it took in the run before that the plan knows of, where that had the same pieces, else
// an estimate. Throws InputError where there are fewer pieces than ranks.
void share_out(const Problem& problem, const std::vector<Surface>& surfaces, const SharePlan& plan, Cut& cut);

// Pieces of each substructure where so many ranks share them out: the usual ones, and more of a substructure where the
// heaviest rank would else have over 15 % more than the mean, or some none. Those that are surely implicit are cut for
// half as much more. None where solver.latin says how many.
std::vector<int> pieces_for_ranks(const Problem& problem, int n_ranks);

// What the most even sharing-out of costs to ranks leaves the heaviest, of the mean.
double unevenness(const std::vector<double>& costs, int n_ranks);

// Points that two pieces share, the first of which has the lower number.
std::map<std::pair<int, int>, int> shared_points(const std::vector<Surface>& surfaces, const Cut& cut);

}  // namespace dygita
