// Decks changed as a grammar allows: a value, a unit, a word, an argument, a statement.
#pragma once

#include <string>

#include "fuzz/grammar.hpp"

namespace dygita::fuzz {

std::string changed_deck(std::string deck, Random& random);

}  // namespace dygita::fuzz
