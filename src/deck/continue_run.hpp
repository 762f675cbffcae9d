// Goes on with a run whose deck its state file keeps.
#pragma once

#include "deck/deck.hpp"
#include "run/continuation.hpp"

namespace dygita {

// Runs the deck that the state file keeps once more, the case of the run continued and other cases read from their
// folders. The results take the place of the old ones when they are complete; whatever fails leaves those as they were.
// Where nothing is to be done, says so. Throws InputError (no run, no state, damaged, mesh or loads changed, nothing
// asked for) and NumericalError.
DeckOutcome continue_run(const ContinueOptions& options);

}  // namespace dygita
