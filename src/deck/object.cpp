#include "deck/object.hpp"

#include <new>

namespace dygita {

namespace {

const char* const metatable_name = "dygita object";

int destroy(lua_State* L) {
  static_cast<Object*>(lua_touserdata(L, 1))->~Object();
  return 0;
}

int describe(lua_State* L) {
  lua_pushstring(L, the_object_at(L, 1).label().c_str());
  return 1;
}

}  // namespace

void set_object_metatable(lua_State* L, int read, int write, int operators, lua_CFunction length) {
  luaL_newmetatable(L, metatable_name);
  for (lua_pushnil(L); lua_next(L, operators);) {
    lua_pushvalue(L, -2);
    lua_insert(L, -2);  // event, event, operator
    lua_settable(L, -4);
  }
  lua_pushvalue(L, read);
  lua_setfield(L, -2, "__index");
  lua_pushvalue(L, write);
  lua_setfield(L, -2, "__newindex");
  lua_pushcfunction(L, length);
  lua_setfield(L, -2, "__len");
  lua_pushcfunction(L, destroy);
  lua_setfield(L, -2, "__gc");
  lua_pushcfunction(L, describe);
  lua_setfield(L, -2, "__tostring");
  lua_pushboolean(L, 0);
  lua_setfield(L, -2, "__metatable");
  lua_pop(L, 1);
}

void push_object(lua_State* L, Object object, int arguments) {
  if (arguments != 0) arguments = lua_absindex(L, arguments);
  new (lua_newuserdatauv(L, sizeof(Object), 1)) Object(std::move(object));
  luaL_setmetatable(L, metatable_name);
  if (arguments == 0) return;
  lua_pushvalue(L, arguments);
  lua_setiuservalue(L, -2, 1);
}

Object* object_at(lua_State* L, int index) { return static_cast<Object*>(luaL_testudata(L, index, metatable_name)); }

Object& the_object_at(lua_State* L, int index) {
  Object* object = object_at(L, index);
  CHECK(object, "an object of the deck was expected");
  return *object;
}

}  // namespace dygita
