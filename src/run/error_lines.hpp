// What a run tells of its estimated errors, and what to make of them.
#pragma once

#include <string>
#include <vector>

#include "result/result.hpp"

namespace dygita {

std::vector<std::string> error_lines(const Problem& problem, const RunResult& result);

}  // namespace dygita
