// Runs a deck once more as the record of a run tells it.
#pragma once

#include "deck/deck.hpp"

namespace dygita {

// options: all but deck, parameters and solver, which are the record's (a run.json or its folder). Throws InputError:
// no record, deck or meshes changed; and what run_deck throws.
DeckOutcome repeat_run(DeckOptions options, const std::filesystem::path& record);

}  // namespace dygita
