#include "deck/arguments.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <string_view>

namespace dygita {

int LuaArguments::type(const char* key) const {
  push(key);
  const int found = lua_type(L_, -1);
  lua_pop(L_, 1);
  return found;
}

bool LuaArguments::has(const char* key) const { return type(key) != LUA_TNIL; }
bool LuaArguments::is_number(const char* key) const { return type(key) == LUA_TNUMBER; }
bool LuaArguments::is_table(const char* key) const { return type(key) == LUA_TTABLE; }
bool LuaArguments::is_function(const char* key) const { return type(key) == LUA_TFUNCTION; }

double LuaArguments::number(const char* key) const {
  CHECK(is_number(key), std::string("argument '") + key + "' is not a number");
  push(key);
  const double value = lua_tonumber(L_, -1);
  lua_pop(L_, 1);
  return value;
}

bool LuaArguments::boolean(const char* key) const {
  push(key);
  const bool value = lua_toboolean(L_, -1) != 0;
  lua_pop(L_, 1);
  return value;
}

std::string LuaArguments::text(const char* key) const {
  CHECK(type(key) == LUA_TSTRING, std::string("argument '") + key + "' is not text");
  push(key);
  size_t length = 0;
  const char* characters = lua_tolstring(L_, -1, &length);
  std::string value(characters, length);
  lua_pop(L_, 1);
  return value;
}

std::vector<double> LuaArguments::numbers(const char* key) const {
  std::vector<double> values;
  push(key);
  const auto n = static_cast<lua_Integer>(lua_rawlen(L_, -1));
  for (lua_Integer i = 1; i <= n; ++i) {
    lua_rawgeti(L_, -1, i);
    values.push_back(lua_tonumber(L_, -1));
    lua_pop(L_, 1);
  }
  lua_pop(L_, 1);
  return values;
}

std::map<std::string, double> LuaArguments::plain_numbers() const {
  std::map<std::string, double> values;
  for (lua_pushnil(L_); lua_next(L_, index_); lua_pop(L_, 1)) {
    if (lua_type(L_, -1) == LUA_TNUMBER) values[lua_tostring(L_, -2)] = lua_tonumber(L_, -1);
    if (lua_isboolean(L_, -1)) values[lua_tostring(L_, -2)] = lua_toboolean(L_, -1) != 0 ? 1.0 : 0.0;
  }
  return values;
}

std::array<int, 3> LuaArguments::counts(const char* key) const {
  const Vec3 values = vector(key);
  return {static_cast<int>(values[0]), static_cast<int>(values[1]), static_cast<int>(values[2])};
}

std::vector<std::string> LuaArguments::texts(const char* key) const {
  std::vector<std::string> values;
  push(key);
  const auto n = static_cast<lua_Integer>(lua_rawlen(L_, -1));
  for (lua_Integer i = 1; i <= n; ++i) {
    lua_rawgeti(L_, -1, i);
    values.emplace_back(lua_tostring(L_, -1));
    lua_pop(L_, 1);
  }
  lua_pop(L_, 1);
  return values;
}

std::map<std::string, double> LuaArguments::settings(const char* key) const {
  std::map<std::string, double> values;
  push(key);
  if (lua_istable(L_, -1)) {
    for (lua_pushnil(L_); lua_next(L_, -2); lua_pop(L_, 1))
      values[lua_tostring(L_, -2)] = lua_isboolean(L_, -1) ? lua_toboolean(L_, -1) : lua_tonumber(L_, -1);
  }
  lua_pop(L_, 1);
  return values;
}

void LuaArguments::each(const char* key, const std::function<void(const LuaArguments&)>& visit) const {
  push(key);
  const auto n = static_cast<lua_Integer>(lua_rawlen(L_, -1));
  for (lua_Integer i = 1; i <= n; ++i) {
    lua_rawgeti(L_, -1, i);
    visit(LuaArguments(L_, -1, fmt::format("{}[{}]", key, i), origin_, folder_));
    lua_pop(L_, 1);
  }
  lua_pop(L_, 1);
}

std::array<Vec3, 2> LuaArguments::two_vectors_at(const char* key, const Vec3& x) const {
  push(key);
  for (const double coordinate : x) lua_pushnumber(L_, coordinate);
  lua_call(L_, 3, 2);
  std::array<Vec3, 2> vectors;
  bool is_right = true;
  for (int i = 0; i < 2; ++i)
    for (int d = 0; d < 3; ++d) {
      if (!lua_istable(L_, i - 2)) {
        is_right = false;
        continue;
      }
      is_right &= lua_geti(L_, i - 2, d + 1) == LUA_TNUMBER;  // a frame's, too
      vectors[static_cast<size_t>(i)][d] = lua_tonumber(L_, -1);
      lua_pop(L_, 1);
    }
  lua_pop(L_, 2);
  if (!is_right || !vectors[0].allFinite() || !vectors[1].allFinite())
    throw InputError(
        fmt::format("'{}': the function must answer two axes at ({:g}, {:g}, {:g}) m\n    as in return "
                    "{{ 1, 0, 0 }}, {{ 0, 1, 0 }}",
                    key, x[0], x[1], x[2]));
  return vectors;
}

double LuaArguments::number_at(const char* key, const Vec3& x, const bool& has_none) const {
  push(key);
  for (const double coordinate : x) lua_pushnumber(L_, coordinate);
  if (lua_pcall(L_, 3, 1, 0) != LUA_OK) {
    if (!has_none) lua_error(L_);
    lua_pop(L_, 1);
    return NAN;
  }
  const bool is_right = lua_type(L_, -1) == LUA_TNUMBER && std::isfinite(lua_tonumber(L_, -1));
  const double value = lua_tonumber(L_, -1);
  lua_pop(L_, 1);
  if (!is_right)
    throw InputError(
        fmt::format("'{}': the function must answer a finite number at ({:g}, {:g}, {:g}) m", key, x[0], x[1], x[2]));
  return value;
}

const Object& LuaArguments::object(const char* key) const {
  push(key);
  const Object& object = the_object_at(L_, -1);
  lua_pop(L_, 1);  // the table of arguments keeps it alive
  return object;
}

std::vector<const Object*> LuaArguments::objects(const char* key) const {
  std::vector<const Object*> items;
  push(key);
  if (const Object* single = object_at(L_, -1)) {
    items.push_back(single);
  } else if (lua_istable(L_, -1)) {
    const auto n = static_cast<lua_Integer>(lua_rawlen(L_, -1));
    for (lua_Integer i = 1; i <= n; ++i) {
      lua_rawgeti(L_, -1, i);
      items.push_back(&the_object_at(L_, -1));
      lua_pop(L_, 1);
    }
  }
  lua_pop(L_, 1);
  return items;
}

std::string LuaArguments::file(const char* key) const {
  const std::string written = text(key);
  const std::filesystem::path path = folder_ / written;  // an absolute one stands for itself
  std::error_code ignored;
  if (std::filesystem::is_regular_file(path, ignored)) return path.string();
  const std::string who = std::string_view(key) == "file" ? path_ : fmt::format("{}: '{}'", path_, key);
  throw InputError(origin_, fmt::format("{}: no file '{}'\n    looked for {}", who, written, path.string()));
}

std::vector<int> LuaArguments::ids() const {
  std::vector<int> found;
  // Lists, and lists of tables: plies of a laminate.
  const std::function<void(int, int)> note_all = [&](int table, int deeper) {
    for (lua_pushnil(L_); lua_next(L_, table); lua_pop(L_, 1)) {
      if (const Object* object = object_at(L_, -1); object && object->id >= 0) found.push_back(object->id);
      if (deeper > 0 && lua_istable(L_, -1)) note_all(lua_gettop(L_), deeper - 1);
    }
  };
  note_all(index_, 2);
  return found;
}

}  // namespace dygita
