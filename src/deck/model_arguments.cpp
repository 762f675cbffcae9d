// Arguments that become parts of the model: values in time, targets, steps, outputs, specifications.
#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "base/log.hpp"
#include "deck/arguments.hpp"
#include "deck/deck_state.hpp"
#include "deck/histories.hpp"
#include "model/point_faces.hpp"
#include "signal/unit.hpp"

namespace dygita {

namespace {

// What the file holds, for the eye: a unit read wrongly shows.
void tell(DeckState& state, const Specification& s) {
  const Unit unit = unit_named(s.unit).value_or(Unit{1.0, "m/s^2"});
  const auto [low, high] = std::minmax_element(s.level.begin(), s.level.end());
  const std::string text =
      fmt::format("specification '{}': {} points from {:.4g} to {:.4g} Hz, levels from {:.4g} to {:.4g} {}{}", s.source,
                  s.frequency.size(), s.frequency.front(), s.frequency.back(), *low / unit.factor, *high / unit.factor,
                  s.unit.empty() ? "m/s^2" : s.unit, s.unit.empty() ? " (its header gives no unit)" : "");
  if (state.signals_told.insert(text).second) say(text);
}

Target target_of(const Object& object) {
  if (object.kind == "face") {
    const Face& face = object.as<Face>();
    if (is_of_points(face)) return region_of_points(face);
    return face;
  }
  if (object.kind == "region") return object.as<Region>();
  if (object.kind == "interface") return object.as<InterfacePtr>();
  return object.as<SupportPtr>();
}

}  // namespace

TimeValue LuaArguments::function(const char* key) const {
  push(key);
  History history = history_of_function(L_, -1);
  lua_pop(L_, 1);
  return {std::move(history), false};
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
    tell(DeckState::of(LuaState::of(L_)), *specification);
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
