// Arguments that become parts of the model: values in time, targets, steps, outputs, specifications.
#include <spdlog/fmt/fmt.h>

#include "deck/arguments.hpp"
#include "deck/lua_state.hpp"

namespace dygita {

namespace {

// A function of time of the deck, kept by Lua as long as a history needs it.
class DeckFunction {
 public:
  // Takes the function on top of the stack.
  explicit DeckFunction(LuaState& lua) : lua_(lua), alive_(lua.alive()) {
    lua_Debug info;
    lua_pushvalue(lua.raw(), -1);
    lua_getinfo(lua.raw(), ">S", &info);
    declared_at_ = info.linedefined;
    reference_ = luaL_ref(lua.raw(), LUA_REGISTRYINDEX);
  }
  ~DeckFunction() {
    if (*alive_) luaL_unref(lua_.raw(), LUA_REGISTRYINDEX, reference_);
  }
  DeckFunction(const DeckFunction&) = delete;
  DeckFunction& operator=(const DeckFunction&) = delete;

  double value(double t) const {
    CHECK(*alive_, "a history asks its deck's function after the deck has ended");
    return lua_.value_of_function(reference_, declared_at_, t);
  }

 private:
  LuaState& lua_;
  std::shared_ptr<const bool> alive_;
  int reference_ = LUA_NOREF, declared_at_ = 0;
};

Target target_of(const Object& object) {
  if (object.kind == "face") return object.as<Face>();
  if (object.kind == "region") return object.as<Region>();
  if (object.kind == "interface") return object.as<InterfacePtr>();
  return object.as<SupportPtr>();
}

}  // namespace

TimeValue LuaArguments::function(const char* key) const {
  push(key);
  const auto function = std::make_shared<const DeckFunction>(LuaState::of(L_));
  function->value(0.0);  // what cannot answer at all is told where it is declared
  return {History::function([function](double t) { return function->value(t); }), false};
}

TimeValue LuaArguments::value(const char* key) const {
  if (is_number(key)) return {History::constant(number(key)), true};
  if (is_function(key)) return function(key);
  return {*object(key).as<std::shared_ptr<const History>>(), false};
}

std::vector<Target> LuaArguments::targets(const char* key) const {
  std::vector<Target> targets;
  for (const Object* object : objects(key)) targets.push_back(target_of(*object));
  return targets;
}

std::vector<SubstructurePtr> LuaArguments::substructures(const char* key) const { return list<SubstructurePtr>(key); }

StepPtr LuaArguments::step(const char* key) const { return has(key) ? object(key).as<StepPtr>() : nullptr; }

std::vector<StepPtr> LuaArguments::steps(const char* key) const { return list<StepPtr>(key); }

OutputPtr LuaArguments::output(const char* key) const { return has(key) ? object(key).as<OutputPtr>() : nullptr; }

std::shared_ptr<const Specification> LuaArguments::specification(const char* key) const {
  if (!has(key)) return nullptr;
  auto specification = std::make_shared<Specification>();
  if (!is_table(key)) {
    *specification = read_specification(file(key));
    specification->source = text(key);
    return specification;
  }
  specification->source = "deck";
  std::vector<std::string> where;
  const std::vector<double> flat = numbers(key);  // as lua/check.lua leaves the pairs: one after the other
  for (size_t i = 0; i + 1 < flat.size(); i += 2) {
    specification->frequency.push_back(flat[i]);
    specification->level.push_back(flat[i + 1]);
    where.push_back(fmt::format("'{}[{}]'", key, i / 2 + 1));
  }
  check_specification(*specification, where);
  return specification;
}

}  // namespace dygita
