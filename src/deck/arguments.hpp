// Reads a table of arguments that lua/check.lua has checked: types are right, defaults are filled in.
#pragma once

#include <array>
#include <lua.hpp>
#include <map>
#include <string>
#include <vector>

#include "deck/object.hpp"

namespace dygita {

class Arguments {
 public:
  Arguments(lua_State* L, int index) : L_(L), index_(lua_absindex(L, index)) {}

  bool has(const char* key) const;
  bool is_number(const char* key) const;
  bool is_table(const char* key) const;
  bool is_function(const char* key) const;

  double number(const char* key) const;
  double number_or(const char* key, double otherwise) const { return has(key) ? number(key) : otherwise; }
  int integer(const char* key) const;
  bool boolean(const char* key) const;
  std::string text(const char* key) const;
  Vec3 vector(const char* key) const;
  std::array<int, 3> counts(const char* key) const;
  std::vector<double> numbers(const char* key) const;
  std::map<std::string, double> numbers() const;  // every argument that is a number, or true (1) or false (0)
  std::vector<std::string> texts(const char* key) const;
  std::map<std::string, double> settings(const char* key) const;  // empty when absent
  const Object& object(const char* key) const;
  std::vector<const Object*> objects(const char* key) const;  // one alone counts as a list

  // The objects of a list as what they hold.
  template <class T>
  std::vector<T> list(const char* key) const {
    std::vector<T> items;
    for (const Object* object : objects(key)) items.push_back(object->as<T>());
    return items;
  }

  // Declaration ids of every object in the table or in its lists.
  std::vector<int> ids() const;

  // Pushes the value of `key` on the stack.
  void push(const char* key) const { lua_getfield(L_, index_, key); }
  lua_State* raw() const { return L_; }

 private:
  int type(const char* key) const;

  lua_State* L_;
  int index_;
};

}  // namespace dygita
