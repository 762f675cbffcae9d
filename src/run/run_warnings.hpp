// What a run says of itself where it is not to be trusted.
#pragma once

#include <filesystem>

#include "result/result.hpp"

namespace dygita {

// Warns of increments that have not converged, with the cure that helps, of energies, estimates, outputs and bolts.
// kept: the run's folder where `dygita continue` can go on from it; else empty.
void warn_of_run(const Problem& problem, const RunResult& result, const std::filesystem::path& kept);

}  // namespace dygita
