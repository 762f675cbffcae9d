// result[part]: what a run says of a substructure itself.
#pragma once

#include "deck/object.hpp"

namespace dygita {

// Pushes result[part], `key` the part. Throws InputError where the part is not of the problem.
void push_part_data(lua_State* L, const DeckResultPtr& result, const Object& key, const Origin& origin);

// A field of it, named by the text at index 2: mass (kg); von_mises (Pa), margin (1), volume_above_yield (1), where its
// material has a yield. Throws InputError for others.
int read_part(lua_State* L, const PartData& data, const Origin& origin);

}  // namespace dygita
