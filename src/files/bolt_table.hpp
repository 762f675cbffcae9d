// The bolts of a run as text: bolts.csv, and the table of the summary.
#pragma once

#include <string>
#include <vector>

#include "result/result.hpp"

namespace dygita {

// One line of `name [unit]`, then one per bolt, SI, nine significant digits; empty where there is nothing. The force
// after each static step has a column of the step's name.
std::string bolts_csv(const Problem& problem, const RunResult& result);

// Lines for people: forces in kN, steps by their names. Empty without bolts.
std::vector<std::string> bolt_lines(const Problem& problem, const RunResult& result);

}  // namespace dygita
