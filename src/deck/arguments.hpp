// Reads a table of arguments that lua/check.lua has checked: types are right, defaults are filled in.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <lua.hpp>
#include <string>
#include <vector>

#include "deck/object.hpp"
#include "model/arguments.hpp"

namespace dygita {

class LuaArguments : public ModelArguments {
 public:
  // path: the constructor's or method's; folder: the deck's, where its relative paths start.
  LuaArguments(lua_State* L, int index, std::string path, Origin origin, std::filesystem::path folder)
      : L_(L),
        index_(lua_absindex(L, index)),
        path_(std::move(path)),
        origin_(std::move(origin)),
        folder_(std::move(folder)) {}

  const std::string& path() const override { return path_; }
  const Origin& origin() const override { return origin_; }

  bool has(const char* key) const override;
  bool is_number(const char* key) const override;
  bool is_table(const char* key) const override;
  bool is_function(const char* key) const;

  double number(const char* key) const override;
  bool boolean(const char* key) const override;
  std::string text(const char* key) const override;
  std::vector<double> numbers(const char* key) const override;
  std::vector<std::string> texts(const char* key) const override;
  std::map<std::string, double> settings(const char* key) const override;

  TimeValue value(const char* key) const override;
  std::vector<Target> targets(const char* key) const override;
  std::vector<SubstructurePtr> substructures(const char* key) const override;
  StepPtr step(const char* key) const override;
  std::vector<StepPtr> steps(const char* key) const override;
  OutputPtr output(const char* key) const override;
  std::shared_ptr<const Specification> specification(const char* key) const override;

  std::array<int, 3> counts(const char* key) const;
  std::map<std::string, double> plain_numbers() const;  // every argument that is a number, or true (1) or false (0)
  // What the deck's function answers at a place (m). Throws InputError where it is not two lists of three numbers.
  std::array<Vec3, 2> two_vectors_at(const char* key, const Vec3& x) const;
  // The same of one number, finite; NaN where the function fails and has set has_none.
  double number_at(const char* key, const Vec3& x, const bool& has_none) const;
  const Object& object(const char* key) const;
  std::vector<const Object*> objects(const char* key) const;  // one alone counts as a list
  // The file that an argument names; relative paths start at the deck's folder. Throws InputError if there is none.
  // Each table of a list.
  void each(const char* key, const std::function<void(const LuaArguments&)>& visit) const;
  std::string file(const char* key) const;

  // The objects of a list as what they hold.
  template <class T>
  std::vector<T> list(const char* key) const {
    std::vector<T> items;
    for (const Object* object : objects(key)) items.push_back(object->as<T>());
    return items;
  }

  // Declaration ids of every object in the table or in its lists.
  std::vector<int> ids() const;

 private:
  int type(const char* key) const;
  void push(const char* key) const { lua_getfield(L_, index_, key); }
  TimeValue function(const char* key) const;

  lua_State* L_;
  int index_;
  std::string path_;
  Origin origin_;
  std::filesystem::path folder_;
};

}  // namespace dygita
