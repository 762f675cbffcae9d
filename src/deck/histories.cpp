#include "deck/histories.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>

#include "base/log.hpp"
#include "deck/deck_state.hpp"
#include "deck/object.hpp"
#include "signal/unit.hpp"

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
  // A run asks for an instant as often as it needs it, on several MPI ranks each as often as it has use for it.
  void check_answers_the_same() const {
    const double first = value(0.0), again = value(0.0);
    if (first == again) return;
    throw InputError(
        DeckState::of(lua_).origin(declared_at_),
        fmt::format(
            "a function of time must return the same value for the same time, but this one returned {:g} and then "
            "{:g} at t = 0\n    keep math.random and counters outside: tabulate the values once and use "
            "history.piecewise",
            first, again));
  }

 private:
  LuaState& lua_;
  std::shared_ptr<const bool> alive_;
  int reference_ = LUA_NOREF, declared_at_ = 0;
};

using HistoryPtr = std::shared_ptr<const History>;

History history_at(lua_State* L, int index) {
  if (lua_isfunction(L, index)) return history_of_function(L, index);
  return *the_object_at(L, index).as<HistoryPtr>();
}

int id_at(lua_State* L, int index) {
  const Object* object = object_at(L, index);
  return object ? object->id : -1;
}

void push_history(lua_State* L, History history, int id) {
  push_object(L, {"history", "history", "", id, HistoryPtr(std::make_shared<const History>(std::move(history)))});
}

// A record that gives its unit has been read in SI already.
void doubt_factor(const History& history, double factor, const Origin& origin) {
  if (history.unit() != "m/s^2" || std::abs(std::abs(factor) / standard_gravity - 1.0) > 0.01) return;
  warn(origin.prefix() +
       "the signal file states a unit of acceleration, so its values are already in m/s^2: multiplying by g0 makes "
       "them 9.8 times too large");
}

// What is wrong with a history that is made of others is told at the line that makes it.
template <class Make>
History made_at(const Origin& origin, const Make& make) {
  try {
    return make();
  } catch (const InputError& error) {
    throw InputError(origin, error.what());
  }
}

}  // namespace

History history_of_function(lua_State* L, int index) {
  lua_pushvalue(L, index);
  const auto function = std::make_shared<const DeckFunction>(LuaState::of(L));
  function->check_answers_the_same();  // what cannot answer at all is told where it is declared
  return History::function([function](double t) { return function->value(t); });
}

int combine_histories(LuaState& lua, lua_State* L) {
  DeckState& state = DeckState::of(lua);
  const std::string operation = lua_tostring(L, 1);
  const Origin origin = state.origin(static_cast<int>(lua_tointeger(L, 4)));
  const History history = history_at(L, 2);
  if (operation == "scaled") {
    const double factor = lua_tonumber(L, 3);
    if (!std::isfinite(factor))
      throw DeckScriptError(origin,
                            fmt::format("a history is multiplied by {}\n    was something divided by zero?", factor));
    doubt_factor(history, factor, origin);
    push_history(L, made_at(origin, [&] { return history.scaled(factor); }), id_at(L, 2));
    return 1;
  }
  CHECK(operation == "sum", "lua/arithmetic.lua asks for an operation that is not there");
  const bool is_number = lua_type(L, 3) == LUA_TNUMBER;
  const History other = is_number ? History::constant(lua_tonumber(L, 3)) : history_at(L, 3);
  if (!history.unit().empty() && !other.unit().empty() && history.unit() != other.unit())
    throw InputError(origin, fmt::format("a history in {} is added to one in {}", history.unit(), other.unit()));
  if (id_at(L, 3) >= 0) state.declared.mark_used(id_at(L, 3));
  push_history(L, made_at(origin, [&] { return history.plus(other); }), id_at(L, 2));
  return 1;
}

int move_history(lua_State* L, const std::string& method) {
  const History history = history_at(L, 2);
  const double t = lua_tonumber(L, 3);
  push_history(L, method == "history:shifted" ? history.shifted(t) : history.stretched(t), id_at(L, 2));
  return 1;
}

int value_of_history(LuaState&, lua_State* L) {
  lua_pushnumber(L, history_at(L, 1).value(lua_tonumber(L, 2)));
  return 1;
}

int extremes_of_history(LuaState&, lua_State* L) {
  const std::optional<Profile> profile = history_at(L, 1).profile();
  if (!profile) return 0;
  lua_pushnumber(L, profile->low);
  lua_pushnumber(L, profile->high);
  return 2;
}

}  // namespace dygita
