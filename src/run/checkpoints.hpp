// The checkpoint of a run: begun with it, gone over where it continues, gone with its end.
#pragma once

#include "persistence/checkpoint_file.hpp"
#include "run/run_problem.hpp"

namespace dygita {

// The one that the run continues with, or a new one in `folder`; null where none is asked for or none can be written
// (with a warning).
std::shared_ptr<CheckpointFile> checkpoint_of(const Problem& problem, const RunRequest& request,
                                              const std::filesystem::path& folder);

// Collective. Of another rank than the first: its part of the first's checkpoint (null: there is none); every: s.
std::shared_ptr<Trail> part_of_checkpoint(const CheckpointFile* checkpoint, double every);

// The file is gone, with what says how to continue: the run has come to its end, or another begins.
void remove_checkpoint(const std::filesystem::path& folder);
// It is in both folders, so that no instant has it in neither.
void share_checkpoint(const std::filesystem::path& from, const std::filesystem::path& to);

// A path as a shell takes it.
std::string shell_word(const std::string& text);

// Throws the error that ended a run, with a line on what there is of it.
[[noreturn]] void rethrow(const std::exception_ptr& error, const std::string& line);

}  // namespace dygita
