#include "deck/find_interfaces.hpp"

#include <algorithm>

#include "base/log.hpp"
#include "deck/deck_state.hpp"
#include "deck/object.hpp"
#include "mesh/find_holes.hpp"
#include "model/found_faces.hpp"

namespace dygita {

namespace {

template <class T>
std::vector<T> list_at(lua_State* L, int index) {
  std::vector<T> list;
  const auto n = static_cast<lua_Integer>(lua_rawlen(L, index));
  for (lua_Integer i = 1; i <= n; ++i) {
    lua_rawgeti(L, index, i);
    list.push_back(the_object_at(L, -1).as<T>());
    lua_pop(L, 1);
  }
  return list;
}

// A face as if the deck had asked the part at place i of the list for it.
void push_face(lua_State* L, const Face& face, int parts, int i) {
  lua_rawgeti(L, parts, i + 1);
  const int id = the_object_at(L, -1).id;
  lua_pop(L, 1);
  push_object(L, {"face", "substructure:face", face.label(), id, face});
}

// Faces, distance and text of a pair into the table on top; 1: the list of parts.
void push_found(lua_State* L, const TouchingPair& pair, const FoundFaces& found) {
  push_face(L, found.side_1, 1, pair.part_1);
  lua_setfield(L, -2, "face_1");
  push_face(L, found.side_2, 1, pair.part_2);
  lua_setfield(L, -2, "face_2");
  lua_pushnumber(L, found.touching.within);
  lua_setfield(L, -2, "within");
  lua_pushstring(L, describe(found.touching).c_str());
  lua_setfield(L, -2, "text");
}

void push_point(lua_State* L, const Vec3& x) {
  lua_createtable(L, 3, 0);
  for (int d = 0; d < 3; ++d) {
    lua_pushnumber(L, x[d]);
    lua_rawseti(L, -2, d + 1);
  }
}

}  // namespace

int touching_pairs(LuaState& lua, lua_State* L) {
  const auto parts = list_at<SubstructurePtr>(L, 1);
  const auto interfaces = list_at<InterfacePtr>(L, 2);
  const double within = lua_tonumber(L, 3);
  std::vector<TouchingPair> pairs;
  std::vector<GapDoubt> doubts;
  std::vector<std::optional<FoundFaces>> wide;
  {
    const LuaState::Pause pause(lua);
    pairs = all_touching(parts, interfaces, within > 0.0 ? std::optional(within) : std::nullopt);
    for (const auto& [part_1, part_2, found] : pairs) {
      doubts.push_back(doubt_of_gap(found.side_1, found.side_2, found.touching.within));
      const SubstructurePtr &one = parts[static_cast<size_t>(part_1)], &other = parts[static_cast<size_t>(part_2)];
      const bool is_first = std::none_of(interfaces.begin(), interfaces.end(), [&](const InterfacePtr& known) {
        return (known->side_1.part == one && known->side_2.part == other) ||
               (known->side_1.part == other && known->side_2.part == one);
      });
      wide.push_back(within > 0.0 || !is_first ? std::nullopt : beside_the_line(found));
    }
  }
  lua_createtable(L, static_cast<int>(pairs.size()), 0);
  for (size_t p = 0; p < pairs.size(); ++p) {
    const TouchingPair& pair = pairs[p];
    lua_createtable(L, 2, 7);
    lua_pushinteger(L, pair.part_1 + 1);
    lua_rawseti(L, -2, 1);
    lua_pushinteger(L, pair.part_2 + 1);
    lua_rawseti(L, -2, 2);
    push_found(L, pair, pair.found);
    if (wide[p]) {
      lua_createtable(L, 0, 4);
      push_found(L, pair, *wide[p]);
      lua_setfield(L, -2, "beside_the_line");
    }
    // What facets can hide is told of the interface itself, as that of faces which a deck names.
    const GapDoubt& doubt = doubts[p];
    lua_pushstring(L, doubt.is_hidden ? "" : doubt.neglected().c_str());
    lua_setfield(L, -2, "doubt");
    lua_pushboolean(L, doubt.is_known);
    lua_setfield(L, -2, "is_known");
    lua_pushnumber(L, doubt.largest);
    lua_setfield(L, -2, "largest");
    lua_rawseti(L, -2, static_cast<lua_Integer>(p) + 1);
  }
  return 1;
}

int nearest_parts(LuaState& lua, lua_State* L) {
  const auto parts = list_at<SubstructurePtr>(L, 1);
  std::vector<std::array<int, 2>> pairs(lua_rawlen(L, 2) / 2);
  for (size_t i = 0; i < 2 * pairs.size(); ++i) {
    lua_rawgeti(L, 2, static_cast<lua_Integer>(i) + 1);
    pairs[i / 2][i % 2] = static_cast<int>(lua_tointeger(L, -1)) - 1;
    lua_pop(L, 1);
  }
  std::string text;
  {
    const LuaState::Pause pause(lua);
    text = nearest_apart(parts, pairs);
  }
  lua_pushstring(L, text.c_str());
  return 1;
}

int holes_of_parts(LuaState& lua, lua_State* L) {
  const auto parts = list_at<SubstructurePtr>(L, 1);
  std::vector<std::vector<Hole>> holes;
  {
    const LuaState::Pause pause(lua);
    for (const SubstructurePtr& part : parts) holes.push_back(find_holes(*part->mesh, part->place));
  }
  lua_newtable(L);
  lua_Integer n = 0;
  for (size_t part = 0; part < parts.size(); ++part)
    for (const Hole& hole : holes[part]) {
      lua_createtable(L, 0, 4);
      lua_pushinteger(L, static_cast<lua_Integer>(part) + 1);
      lua_setfield(L, -2, "part");
      lua_pushnumber(L, hole.radius);
      lua_setfield(L, -2, "radius");
      push_point(L, hole.low);
      lua_setfield(L, -2, "low");
      push_point(L, hole.high);
      lua_setfield(L, -2, "high");
      lua_rawseti(L, -2, ++n);
    }
  return 1;
}

int sides_of_interface(LuaState&, lua_State* L) {
  const Interface& interface = *the_object_at(L, 1).as<InterfacePtr>();
  lua_settop(L, 2);  // interface, list of parts
  const auto parts = list_at<SubstructurePtr>(L, 2);
  for (const Face* face : {&interface.side_1, &interface.side_2}) {
    const auto found = std::find(parts.begin(), parts.end(), face->part);
    if (found == parts.end())
      lua_pushnil(L);
    else
      lua_rawgeti(L, 2, static_cast<lua_Integer>(found - parts.begin()) + 1);
  }
  return 2;
}

int say_line(LuaState& lua, lua_State* L) {
  if (!DeckState::of(lua).has_read_hollow) say(to_text(L, 1));
  return 0;
}

}  // namespace dygita
