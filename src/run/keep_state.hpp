// What a run leaves for `dygita continue`, and how it starts from what another left.
#pragma once

#include "run/run_problem.hpp"

namespace dygita {

// The state in a run's folder. Throws InputError: none, or damaged.
RunState state_in(const std::filesystem::path& run);

// Interface fields that the iteration starts from: of the run continued, or of the case to start from; null: none.
const InterfaceFields* start_of(const RunRequest& request);

// Values of every load at even instants of its step, one after the other, `steps` having the durations: where they
// differ, so do files that the deck reads.
std::vector<double> load_samples(const Problem& problem, const std::vector<StateStep>& steps);

// "of step 'shock'", whose loads are not those of the state; empty: all are. Each load is compared with itself.
std::string changed_load(const Problem& problem, const RunState& state);

// What tells the run from others: deck, settings, meshes, loads, steps; nothing of what it comes to.
RunState identity_of_run(const Problem& problem, const RunRequest& request);

// The state that a run ends with; no fields where the solver keeps none.
RunState state_of(const Problem& problem, const RunRequest& request, const RunResult& result);

// Are as many increments of every step known as before?
bool reaches_as_far(const RunState& state, const RunState& before);

// What several ranks have written of a state's fields, or why they could not.
struct KeptParts {
  StateParts parts;
  std::string error;
};

// Collective. Of several ranks each writes its fields; the first gets what all have written. writer: the first rank's;
// null: nothing is kept.
KeptParts keep_parts(const RunState& state, RunWriter* writer, const RunResult& result);

// Writes the state file; where that fails the run continues, with a warning. has_checkpoint: it can be continued all
// the same.
void keep_state(RunState& state, KeptParts parts, RunWriter& writer, bool has_checkpoint, RunResult& result);

// "  continued: 812 iterations more; ..."
std::string continuation_line(const RunState& before, const RunResult& result);

}  // namespace dygita
