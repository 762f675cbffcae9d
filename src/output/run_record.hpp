// What a run was, as JSON: enough to tell two runs apart and to judge one.
#pragma once

#include <string>
#include <vector>

#include "output/run_writer.hpp"

namespace dygita {

// "interrupted", "converged" or "not converged".
const char* verdict(const RunResult& result);

// The text of run.json. Numbers that are not finite become null. `files` are relative to the output directory.
std::string run_record(const Problem& problem, const RunResult& result, const RunIdentity& identity,
                       const std::vector<std::string>& warnings, const std::vector<std::string>& files);

}  // namespace dygita
