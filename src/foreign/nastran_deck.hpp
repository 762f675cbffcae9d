// A deck that says what a Nastran file says: ready to run where it can, with a comment by line where it cannot.
#pragma once

#include "foreign/imported_deck.hpp"

namespace dygita {

// Lua. Throws InputError as NastranModel does.
std::string deck_of_nastran(const ImportOptions& options);

}  // namespace dygita
