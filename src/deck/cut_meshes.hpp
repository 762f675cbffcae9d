// mesh:cut.
#pragma once

#include <lua.hpp>

#include "deck/deck_state.hpp"

namespace dygita {

// Pushes the list of both halves of the mesh at stack index 2; the name of a surface, or checked arguments, at 3.
int push_halves(DeckState& state, lua_State* L, const Origin& origin);

}  // namespace dygita
