// What a run was, as JSON: enough to tell two runs apart and to judge one.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "files/run_writer.hpp"

namespace dygita {

// "interrupted", "converged" or "not converged".
const char* verdict(const RunResult& result);

// What run.json in an output directory tells of the run; none where it is not there or cannot be read.
struct RecordedRun {
  std::string problem, case_name, version, solver;
  bool converged = true, interrupted = false;
  long iterations = 0;
  double mean_iterations = 0.0;
  double seconds = 0.0;
};
std::optional<RecordedRun> read_run_record(const std::filesystem::path& directory);
// What it tells of the pieces that several ranks have shared out; empty: nothing.
struct RecordedPiece {
  long unknowns = 0;
  double seconds = 0.0;  // of a processor
};
std::vector<RecordedPiece> read_recorded_pieces(const std::filesystem::path& directory);

// The text of run.json. Numbers that are not finite become null. `files` are relative to the output directory.
std::string run_record(const Problem& problem, const RunResult& result, const RunIdentity& identity,
                       const std::vector<std::string>& warnings, const std::vector<std::string>& files);

}  // namespace dygita
