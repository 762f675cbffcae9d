// What lua/interfaces.lua and lua/holes.lua ask for: pairs of parts that touch, holes of parts.
#pragma once

#include "deck/lua_state.hpp"

namespace dygita {

// touching(parts, interfaces, within, line): a list of { i, j, face_1, face_2, within, text, doubt, largest } for each
// two parts of the list that touch beside their interfaces; within (m) 0: by the facets.
int touching_pairs(LuaState& lua, lua_State* L);

// nearest_apart(parts, pairs): of pairs of their numbers, one after the other, which are nearest: where none touches.
int nearest_parts(LuaState& lua, lua_State* L);

// holes(parts): a list of { part, low, high, radius } (m), the round holes of each part (mesh/find_holes.hpp).
int holes_of_parts(LuaState& lua, lua_State* L);

// sides(interface, parts): its two substructures as they are in the list, nil where not.
int sides_of_interface(LuaState& lua, lua_State* L);

// say(text): a line on standard output, but not of a deck that continues without values.
int say_line(LuaState& lua, lua_State* L);

}  // namespace dygita
