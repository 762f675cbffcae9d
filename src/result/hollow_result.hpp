// What stands for a result where nothing was computed.
#pragma once

#include <memory>

#include "result/result.hpp"

namespace dygita {

// A result with one row of nan per step, for decks that are checked and not run.
std::shared_ptr<const RunResult> hollow_result(const Problem& problem);

}  // namespace dygita
