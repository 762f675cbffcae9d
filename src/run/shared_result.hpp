// Runs of several ranks: what they refuse, and what the others receive of rank 0's results, since the deck runs on all.
#pragma once

#include "run/run_problem.hpp"

namespace dygita {

// What several ranks cannot do is refused, not done by each of them. Throws InputError.
void check_ranks(const Problem& problem);

// Collective. Have all ranks read the same from the deck? Throws InputError, on all of them, which says what differs.
void check_ranks_agree(const Problem& problem);

// Collective. Gives the other ranks what a deck reads of rank 0's result: tables, what outputs tell beside them, peaks
// of stress, iterations and whether they have converged.
void share_result(const Problem& problem, RunResult& result);

// Collective. Rank 0 warns of what the others have met, each warning once.
void collect_warnings();

}  // namespace dygita
