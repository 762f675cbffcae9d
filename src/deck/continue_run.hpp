// Goes on with a run from what it left: to a better answer, or further in time (manual, "Going on").
#pragma once

#include <optional>

#include "deck/deck.hpp"

namespace dygita {

struct ContinueOptions {
  std::filesystem::path run;  // out/<problem>/<case>
  std::optional<double> tolerance;
  int more_iterations = 0;      // at each increment; 0: as the tolerance asks
  std::optional<double> until;  // s, of the run's time
  int threads = 0;
  double time_limit = 60.0, memory_limit = 1024.0;  // of the deck, as in DeckOptions
  bool write_frames = true, write_state = true;
};

// Runs the deck that the state file keeps once more, the case of the run continued and other cases read from their
// folders. The results take the place of the old ones when they are complete; whatever fails leaves those as they were.
// Where nothing is to be done, says so. Throws InputError (no run, no state, damaged, mesh or loads changed, nothing
// asked for) and NumericalError.
DeckOutcome continue_run(const ContinueOptions& options);

}  // namespace dygita
