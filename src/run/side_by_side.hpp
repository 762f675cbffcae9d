// Members of an ensemble side by side: their linear stages are solved together (step/joint_solves.hpp).
#pragma once

#include <functional>
#include <vector>

#include "run/run_problem.hpp"

namespace dygita {

// Has the first member left all that the others share, in all passes that they may need, and in one process?
bool can_run_together(const Problem& problem, const OperatorsOfMembers& shared);

constexpr int most_together = 16;

// run(i) for i = 0 .. n - 1, which take turns, sixteen at most at a time. What each says is said once it is over. The
// first error, in their order, is thrown when all have come to an end. Returns the time (s) that each has taken, its
// share of what was solved for several included.
std::vector<double> run_together(int n, const std::function<void(int)>& run);

}  // namespace dygita
