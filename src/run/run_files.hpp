// All files of a finished run but its frames and state: tables, pictures, the report, and the run record at the end.
#pragma once

#include "files/run_writer.hpp"

namespace dygita {

// A report that fails costs no result: a warning tells. Throws InputError where the rest cannot be written.
void write_run_files(RunWriter& writer, const Problem& problem, const RunResult& result, const RunIdentity& identity,
                     const std::vector<std::string>& warnings);

// view.py, where frames were written; `folder` is where the run's files are in the end.
void write_view(RunWriter& writer, const Problem& problem, const std::filesystem::path& folder);

}  // namespace dygita
