// Places of a substructure that a deck picks: nodes by a function, facets by their normal, a cylinder, a box.
#pragma once

#include <filesystem>
#include <lua.hpp>

#include "model/model.hpp"

namespace dygita {

// part:where(function): the function at stack index 3, or a table of it and of the frame that it is meant in. Throws
// InputError where it answers true for no node.
Region region_of(const SubstructurePtr& part, lua_State* L, const Origin& origin);

// part:face{ ... }: checked arguments at stack index 3. Throws InputError where no facet fits.
Face picked_face(const std::filesystem::path& folder, const SubstructurePtr& part, lua_State* L, const Origin& origin);

}  // namespace dygita
