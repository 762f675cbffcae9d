// How several ranks cut and share out a run (manual/parallel.md).
#pragma once

#include "partition/cut.hpp"
#include "run/run_problem.hpp"

namespace dygita {

// Collective. The pieces that the request names, else those for the ranks at hand, with a warning where one process
// would make others; and what they took in the run that the folder holds, if it had the same.
SharePlan plan_of(const Problem& problem, const RunRequest& request, const std::filesystem::path& folder);

// Of a substructure, as the state has it: the digest of its mesh, and the pieces where they are not the usual ones.
std::string digest_and_pieces(const std::string& digest, int n_pieces, int usual);
std::string digest_alone(const std::string& kept);
// Those of all substructures of the problem of a state.
std::vector<int> kept_pieces(const Problem& problem, const RunState& state);

}  // namespace dygita
