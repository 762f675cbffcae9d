// All figures of a run as its record states them: the run's own and those of its outputs.
#pragma once

#include "result/result.hpp"

namespace dygita {

// By label, with unit: "energy imbalance [%]", "spectrum 'above', mean band, mesh [dB]".
std::map<std::string, double> recorded_figures(const RunResult& result);

}  // namespace dygita
