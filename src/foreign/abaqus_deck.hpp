// A deck that says what an .inp says: ready to run where it can, with a comment by line where it cannot.
#pragma once

#include "foreign/imported_deck.hpp"

namespace dygita {

// Lua. What no deck says stands as comments, and as an error(...) that stops the deck until its reader deletes it.
// Throws InputError as AbaqusModel does.
std::string deck_of_abaqus(const ImportOptions& options);

}  // namespace dygita
