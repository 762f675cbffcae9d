// What the arithmetic of histories in a deck is made of (lua/arithmetic.lua).
#pragma once

#include "deck/lua_state.hpp"
#include "model/model.hpp"

namespace dygita {

// The function of time at a stack index, which Lua keeps as long as the history needs it. Throws InputError where it
// cannot answer at t = 0.
History history_of_function(lua_State* L, int index);

// combine(operation, history, other, line): "scaled" by a number, or "sum" with a history. Either history may be a
// function of time.
int combine_histories(LuaState& lua, lua_State* L);

// history:shifted(t), history:scaled(t): the object and the number at stack indices 2 and 3.
int move_history(lua_State* L, const std::string& method);

// value_of(history, t).
int value_of_history(LuaState& lua, lua_State* L);

// extremes(history): smallest and largest value, nothing where they are not known (functions).
int extremes_of_history(LuaState& lua, lua_State* L);

}  // namespace dygita
