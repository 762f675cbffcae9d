// The functions that lua/*.lua call on the C++ side.
#include <spdlog/fmt/fmt.h>

#include <filesystem>

#include "base/log.hpp"
#include "base/names.hpp"
#include "base/warnings.hpp"
#include "deck/build_model.hpp"
#include "deck/cut_meshes.hpp"
#include "deck/deck_state.hpp"
#include "deck/embedded_lua.hpp"
#include "deck/ensembles.hpp"
#include "deck/find_interfaces.hpp"
#include "deck/histories.hpp"
#include "deck/model_files.hpp"
#include "deck/pick_places.hpp"
#include "deck/results.hpp"
#include "signal/scan.hpp"

namespace dygita {

namespace {

std::vector<std::string> names_at(lua_State* L, int index) {
  std::vector<std::string> names;
  const auto n = static_cast<lua_Integer>(lua_rawlen(L, index));
  for (lua_Integer i = 1; i <= n; ++i) {
    lua_rawgeti(L, index, i);
    names.push_back(to_text(L, -1));
    lua_pop(L, 1);
  }
  return names;
}

int push_text(lua_State* L, const std::string& text) {
  lua_pushlstring(L, text.data(), text.size());
  return 1;
}

// module(name): the result of an embedded file, loaded once.
int module(LuaState& state, lua_State* L) {
  const std::string name = luaL_checkstring(L, 1);
  const auto found = embedded_lua().find(name);
  CHECK(found != embedded_lua().end(), "lua/" + name + ".lua is not in the program");
  luaL_getsubtable(L, LUA_REGISTRYINDEX, "dygita modules");
  if (lua_getfield(L, -1, name.c_str()) != LUA_TNIL) return 1;
  lua_pop(L, 1);
  state.load(found->second, "=dygita/" + name + ".lua");
  lua_getfield(L, LUA_REGISTRYINDEX, "native");
  lua_call(L, 1, 1);
  lua_pushvalue(L, -1);
  lua_setfield(L, -3, name.c_str());
  return 1;
}

// line(): the deck's line at work. Nothing can be declared while the engine asks for a function's value.
int line(LuaState& state, lua_State* L) {
  const int found = state.line(L);
  if (state.is_paused()) {
    throw InputError(state.origin(found),
                     "a function of time may only compute: it cannot declare, read or run anything");
  }
  lua_pushinteger(L, found);
  return 1;
}

int fail(LuaState& state, lua_State* L) {
  throw InputError(state.origin(static_cast<int>(lua_tointeger(L, 1))), lua_tostring(L, 2));
}

// A value is wrong, and not a word: in a deck that is checked it may come from results that are not there.
int fail_on_value(LuaState& state, lua_State* L) {
  throw DeckScriptError(state.origin(static_cast<int>(lua_tointeger(L, 1))), lua_tostring(L, 2));
}

int warn_at(LuaState& state, lua_State* L) {
  const std::string message = state.origin(static_cast<int>(lua_tointeger(L, 1))).prefix() + lua_tostring(L, 2);
  if (lua_gettop(L) > 2)
    warn(message, {lua_tostring(L, 3), lua_tonumber(L, 4), lua_tostring(L, 5), true});
  else
    warn(message);
  return 0;
}

int refuse(LuaState&, lua_State* L) { throw InputError(lua_tostring(L, 1)); }

int did_you_mean_names(LuaState&, lua_State* L) {
  return push_text(L, did_you_mean(lua_tostring(L, 1), names_at(L, 2)));
}

int closest(LuaState&, lua_State* L) { return push_text(L, closest_name(lua_tostring(L, 1), names_at(L, 2))); }

// A search has been long: is there time left?
int check_time(LuaState& lua, lua_State*) {
  lua.check_time();
  return 0;
}

int print(LuaState& lua, lua_State* L) {
  std::string text;
  for (int i = 1; i <= lua_gettop(L); ++i) text += (i > 1 ? "\t" : "") + to_text(L, i);
  if (!DeckState::of(lua).has_read_hollow) say(text);
  return 0;
}

// kind(value): kind, constructor and name of an object, or nothing.
int kind(LuaState&, lua_State* L) {
  const Object* object = object_at(L, 1);
  if (!object) return 0;
  push_text(L, object->kind);
  push_text(L, object->path);
  push_text(L, object->name);
  return 3;
}

int arguments(LuaState&, lua_State* L) {
  the_object_at(L, 1);
  if (lua_getiuservalue(L, 1, 1) != LUA_TTABLE) lua_newtable(L);
  return 1;
}

// note_parameter(name): the deck has read it.
int note_parameter(LuaState& lua, lua_State* L) {
  DeckState::of(lua).parameters_read.insert(lua_tostring(L, 1));
  return 0;
}

int is_data(LuaState&, lua_State* L) {
  const std::string& what = the_object_at(L, 1).kind;
  lua_pushboolean(L, what == "result" || what == "data" || what == "part data" || what == "series" ||
                         is_of_ensemble(the_object_at(L, 1)));
  return 1;
}

void keep_parameters(DeckState& state, lua_State* L, int index, const Origin& origin) {
  std::map<std::string, double> sorted;
  for (lua_pushnil(L); lua_next(L, index); lua_pop(L, 1)) sorted[lua_tostring(L, -2)] = lua_tonumber(L, -1);
  state.has_parameters = true;
  state.parameters_origin = origin;
  state.parameters.assign(sorted.begin(), sorted.end());
}

// make(path, kind, arguments, line): the object that a constructor declares.
int make(LuaState& lua, lua_State* L) {
  DeckState& state = DeckState::of(lua);
  const std::string path = lua_tostring(L, 1);
  const Origin origin = state.origin(static_cast<int>(lua_tointeger(L, 4)));
  const LuaArguments values(L, 3, path, origin, state.folder);
  Object object{lua_tostring(L, 2), path, "", -1, build({state, path, origin, values})};
  if (path == "param") {
    keep_parameters(state, L, 3, origin);
  } else {
    if (values.has("name")) object.name = values.text("name");
    object.id = state.declared.add(object.label(), origin, values.ids());
  }
  push_object(L, std::move(object), 3);
  return 1;
}

// Of a CAD assembly, or of a file of another program.
std::shared_ptr<const NamedParts> parts_in(const Object& self) {
  if (self.kind == "assembly") return self.as<std::shared_ptr<const StepAssembly>>();
  return self.as<std::shared_ptr<const ForeignMeshes>>();
}

// assembly:parts: a list of meshes.
void push_parts(DeckState& state, lua_State* L, const Object& self, const std::string& pattern, const Origin& origin) {
  const std::shared_ptr<const NamedParts> assembly = parts_in(self);
  std::vector<const StepPart*> parts;
  try {
    parts = assembly->parts(pattern);
  } catch (const InputError& error) {
    throw InputError(origin, error.what());
  }
  lua_createtable(L, static_cast<int>(parts.size()), 0);
  for (size_t i = 0; i < parts.size(); ++i) {
    state.parts_taken[assembly].insert(parts[i]->name);
    push_object(L, {"mesh", "assembly:parts", parts[i]->name, self.id, parts[i]->mesh});
    lua_rawseti(L, -2, static_cast<lua_Integer>(i) + 1);
  }
}

MeshPtr part_of(DeckState& state, const Object& self, const std::string& name, const Origin& origin) {
  const std::shared_ptr<const NamedParts> assembly = parts_in(self);
  try {
    const StepPart& part = assembly->part(name);
    state.parts_taken[assembly].insert(part.name);
    return part.mesh;
  } catch (const InputError& error) {
    throw InputError(origin, error.what());
  }
}

// call(method, object, argument, line).
int call_method(LuaState& lua, lua_State* L) {
  DeckState& state = DeckState::of(lua);
  const std::string method = lua_tostring(L, 1);
  const Object& self = the_object_at(L, 2);
  const Origin origin = state.origin(static_cast<int>(lua_tointeger(L, 4)));
  if (method == "problem:run") return run_from_deck(state, L);
  if (self.kind == "history") return move_history(L, method);
  if (self.kind == "sample") return quantile_of_sample(L);
  if (method == "mesh:cut") return push_halves(state, L, origin);
  if (method == "mesh file:volume") {
    const std::string name = lua_tostring(L, 3);
    push_object(
        L, {"mesh", method, name, self.id, volume_of(*self.as<std::shared_ptr<const GmshMeshes>>(), name, origin)});
  } else if (method == "assembly:part" || method == "model file:part") {
    const std::string name = lua_tostring(L, 3);
    push_object(L, {"mesh", method, name, self.id, part_of(state, self, name, origin)});
  } else if (method == "assembly:parts" || method == "model file:parts") {
    push_parts(state, L, self, lua_tostring(L, 3), origin);
  } else if (method == "model file:material") {
    push_object(L, file_material(state, self, L, origin));
  } else if (method == "model file:report") {
    return push_text(L, self.as<std::shared_ptr<const ForeignMeshes>>()->report());
  } else if (method == "substructure:region") {
    const Region region = named_region(state, L, origin);
    push_object(L, {"region", method, self.name, self.id, region});
  } else if (method == "substructure:face" && lua_istable(L, 3)) {
    const Face face = picked_face(state.folder, self.as<SubstructurePtr>(), L, origin);
    push_object(L, {"face", method, face.label(), self.id, face});
  } else if (method == "substructure:face") {
    const Face face = face_of(self.as<SubstructurePtr>(), lua_tostring(L, 3), origin);
    push_object(L, {"face", method, face.label(), self.id, face});
  } else {
    CHECK(method == "substructure:where", "lua/schema.lua has method '" + method + "', which nothing does");
    const Region region = region_of(self.as<SubstructurePtr>(), L, origin);
    push_object(L, {"region", method, self.name, self.id, region});
  }
  return 1;
}

// scan(arguments, line): a measured face.
int scan(LuaState& lua, lua_State* L) {
  DeckState& state = DeckState::of(lua);
  const Origin origin = state.origin(static_cast<int>(lua_tointeger(L, 2)));
  const LuaArguments a(L, 1, "field.file", origin, state.folder);
  ScanOptions options{a.file("file"), {}, {}, a.number("smooth")};
  if (a.has("unit")) options.unit = a.number("unit");
  if (a.has("height_unit")) options.height_unit = a.number("height_unit");
  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(options.file, ignored);
  constexpr std::uintmax_t bytes_per_byte = 8;  // lines, points
  const auto bytes = static_cast<size_t>(bytes_per_byte * (ignored ? 0 : size));
  lua.reserve("field.file", bytes);
  std::shared_ptr<const Scan> made;
  try {
    made = std::make_shared<const Scan>(options);
  } catch (const InputError& error) {
    throw InputError(origin, error.what());
  }
  lua.hold_reserved(made, bytes);
  say(fmt::format("field.file '{}': {} points, smoothed over {:.3g} mm", made->file(), made->n_points(),
                  1e3 * made->smooth()));
  if (const std::string text = doubt_of_outliers(made->points()); !text.empty())
    warn(origin.prefix() + "field.file '" + made->file() + "': " + text);
  push_object(L, {"field", "field.file", "", -1, made});
  return 1;
}

// height_of(scan, u, v): m; nothing where there is no point near.
int height_of(LuaState& lua, lua_State* L) {
  const auto height =
      the_object_at(L, 1).as<std::shared_ptr<const Scan>>()->at(luaL_checknumber(L, 2), luaL_checknumber(L, 3));
  DeckState::of(lua).has_missed_scan = !height;
  if (!height) return 0;
  lua_pushnumber(L, *height);
  return 1;
}

// has_no_values(): the deck is only checked, and has read results.
int has_no_values(LuaState& lua, lua_State* L) {
  lua_pushboolean(L, DeckState::of(lua).has_read_hollow);
  return 1;
}

void note_reading(DeckState& state) { state.has_read_hollow = state.has_read_hollow || !state.is_solving; }

int read(LuaState& lua, lua_State* L) {
  note_reading(DeckState::of(lua));
  return read_data(L, lua.origin(lua.line(L)));
}

int at(LuaState& lua, lua_State* L) {
  note_reading(DeckState::of(lua));
  return value_at(L, lua.origin(lua.line(L)));
}

// compile(text, environment, name): a function, or nothing where the text is no Lua.
int compile(LuaState&, lua_State* L) {
  const std::string name = std::string("=") + lua_tostring(L, 3);
  if (luaL_loadbufferx(L, lua_tostring(L, 1), lua_rawlen(L, 1), name.c_str(), "t") != LUA_OK) return 0;
  lua_pushvalue(L, 2);
  lua_setupvalue(L, -2, 1);
  return 1;
}

// locals(): names of the local variables that the deck's line sees.
int locals(LuaState& state, lua_State* L) {
  lua_Debug frame;
  lua_newtable(L);
  lua_Integer n = 0;
  for (int level = 0; lua_getstack(L, level, &frame); ++level) {
    lua_getinfo(L, "S", &frame);
    if (frame.source != "@" + state.deck_name()) continue;
    for (int i = 1; const char* name = lua_getlocal(L, &frame, i); ++i) {
      lua_pop(L, 1);
      if (name[0] == '(') continue;  // Lua's own temporaries
      lua_pushstring(L, name);
      lua_rawseti(L, -2, ++n);
    }
  }
  return 1;
}

// n_parameters(function): those that it names.
int n_parameters(LuaState&, lua_State* L) {
  lua_Debug function;
  lua_pushvalue(L, 1);
  lua_getinfo(L, ">u", &function);
  lua_pushinteger(L, function.nparams);
  return 1;
}

}  // namespace

void push_native(DeckState& state) {
  static const luaL_Reg functions[] = {{"module", guarded<module>},
                                       {"line", guarded<line>},
                                       {"fail", guarded<fail>},
                                       {"fail_on_value", guarded<fail_on_value>},
                                       {"warn", guarded<warn_at>},
                                       {"refuse", guarded<refuse>},
                                       {"did_you_mean", guarded<did_you_mean_names>},
                                       {"closest_name", guarded<closest>},
                                       {"print", guarded<print>},
                                       {"check_time", guarded<check_time>},
                                       {"kind", guarded<kind>},
                                       {"arguments", guarded<arguments>},
                                       {"note_parameter", guarded<note_parameter>},
                                       {"is_data", guarded<is_data>},
                                       {"has_no_values", guarded<has_no_values>},
                                       {"make", guarded<make>},
                                       {"combine", guarded<combine_histories>},
                                       {"value_of", guarded<value_of_history>},
                                       {"extremes", guarded<extremes_of_history>},
                                       {"call", guarded<call_method>},
                                       {"scan", guarded<scan>},
                                       {"height_of", guarded<height_of>},
                                       {"touching", guarded<touching_pairs>},
                                       {"nearest_apart", guarded<nearest_parts>},
                                       {"holes", guarded<holes_of_parts>},
                                       {"sides", guarded<sides_of_interface>},
                                       {"say", guarded<say_line>},
                                       {"check_distribution", guarded<check_distribution>},
                                       {"draw", guarded<draw_members>},
                                       {"call_member", guarded<call_member>},
                                       {"difference_of_members", guarded<compare_members>},
                                       {"check_folder", guarded<check_folder_of_ensemble>},
                                       {"run_together", guarded<run_members_together>},
                                       {"let_go", guarded<let_go_of_fields>},
                                       {"conclude", guarded<conclude_ensemble>},
                                       {"read", guarded<read>},
                                       {"at", guarded<at>},
                                       {"compile", guarded<compile>},
                                       {"locals", guarded<locals>},
                                       {"n_parameters", guarded<n_parameters>},
                                       {nullptr, nullptr}};
  lua_State* L = state.raw();
  luaL_newlib(L, functions);
  push_text(L, version());
  lua_setfield(L, -2, "version");
  lua_newtable(L);
  for (size_t i = 0; i < state.options.settings.size(); ++i) {
    lua_newtable(L);
    push_text(L, state.options.settings[i].first);
    lua_setfield(L, -2, "name");
    push_text(L, state.options.settings[i].second);
    lua_setfield(L, -2, "text");
    lua_rawseti(L, -2, static_cast<lua_Integer>(i) + 1);
  }
  lua_setfield(L, -2, "settings");
  push_text(L, state.options.solver);
  lua_setfield(L, -2, "solver");
  lua_pushvalue(L, -1);
  lua_setfield(L, LUA_REGISTRYINDEX, "native");
}

}  // namespace dygita
