// What a run says of its condensed joints and assemblies.
#pragma once

#include <string>
#include <vector>

#include "result/result.hpp"

namespace dygita {

// One line an output.loop and an output.superelement, in the problem's order.
std::vector<std::string> condensed_lines(const Problem& problem, const RunResult& result);

}  // namespace dygita
