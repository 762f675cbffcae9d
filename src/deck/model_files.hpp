// What decks ask of files of other programs: materials, named regions.
#pragma once

#include <lua.hpp>

#include "deck/deck_state.hpp"

namespace dygita {

// file:material: a name, or checked arguments, at stack index 3.
Object file_material(DeckState& state, const Object& self, lua_State* L, const Origin& origin);

// Named regions of a mesh; null where it is of no file that has sets.
const std::map<std::string, std::vector<int>>* regions_of(const DeckState& state, const MeshPtr& mesh);

// part:region: the part at stack index 2, the name at 3.
Region named_region(const DeckState& state, lua_State* L, const Origin& origin);

}  // namespace dygita
