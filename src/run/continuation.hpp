// Continuing a run from what it left: where it was stopped or killed, to a tighter tolerance, or further in time
// (manual, "Resume a stopped run").
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "mesh/mesh_limits.hpp"
#include "run/run_problem.hpp"

namespace dygita {

struct ContinueOptions {
  std::filesystem::path run;  // out/<problem>/<case>; out/<problem>: the case of it that is unfinished
  std::optional<double> tolerance;
  int more_iterations = 0;      // at each increment; 0: as the tolerance asks
  std::optional<double> until;  // s, of the run's time
  int threads = 0;
  double time_limit = 60.0, memory_limit = 1024.0;  // of the deck, as in DeckOptions
  MeshLimits meshes;
  bool write_frames = true, write_state = true;
  double checkpoint_every = 180.0;  // s; 0: none
};

// Takes the place of run_problem while the deck of the run runs once more: the continued case resumes from its state,
// other cases are read from their folders, and computed where a run that was stopped had not come to them.
class Continuation {
 public:
  // Reads the state of the run; collective. Throws InputError (no run, no state, damaged).
  explicit Continuation(const ContinueOptions& options);

  const RunState& state() const { return *state_; }
  // The run was stopped or killed, and is to go on as it was asked for.
  bool resumes() const { return resumed_.has_value(); }
  // What there is not to do, or nothing where there is something. Throws InputError where nothing was asked for.
  std::string idle() const;
  // Throws InputError where --until is no later time.
  void check_until() const;

  // Throws InputError (another problem, mesh or loads changed, results of another case missing) and NumericalError.
  std::shared_ptr<const RunResult> run(const Problem& problem, const RunRequest& request);
  // The folder out/ of the run.
  std::filesystem::path out() const;
  // Is its folder called as the run was, <problem>/<case>? Only then is anything written beside it.
  bool is_in_its_place() const;
  bool has_frames() const { return !resumed_ || resumed_->has_frames; }
  bool is_done() const { return is_done_; }
  bool ends_early() const { return ends_early_; }

 private:
  Problem changed(Problem problem) const;
  StepPtr extended(const Step& step, double duration) const;
  std::shared_ptr<const RunResult> resume(const Problem& problem, const RunRequest& request);
  void open();
  void share();
  void take_folder(RunRequest& request) const;
  std::shared_ptr<const RunResult> result_of_other(const Problem& problem, const RunRequest& request);

  ContinueOptions options_;
  std::shared_ptr<RunLock> lock_;
  std::shared_ptr<CheckpointFile> checkpoint_;  // rank 0's
  std::optional<CheckpointIdentity> resumed_;   // null: the state file is gone on from
  bool has_record_ = false;
  std::shared_ptr<const RunState> state_;
  bool is_done_ = false, ends_early_ = false;
};

}  // namespace dygita
