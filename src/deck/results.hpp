// How a deck reads results: result[output].column.max and the rest of the access language.
#pragma once

#include "deck/lua_state.hpp"
#include "deck/object.hpp"

namespace dygita {

// Pushes what `key` (at stack index 2) answers for the result, data or series at index 1; InputError at `origin` for
// what it does not have.
int read_data(lua_State* L, const Origin& origin);

// Number of rows of the data or series at index 1.
int length_of(lua_State* L, const Origin& origin);

// Value of a series at a time (linear between rows, the last row of that time where time does not advance) or in the
// last row of a step: the object or number at stack index 2.
int value_at(lua_State* L, const Origin& origin);

}  // namespace dygita
