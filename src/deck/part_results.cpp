#include "deck/part_results.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <limits>

#include "base/names.hpp"

namespace dygita {

void push_part_data(lua_State* L, const DeckResultPtr& result, const Object& key, const Origin& origin) {
  const int part = index_of(result->problem->substructures, key.as<SubstructurePtr>().get());
  if (part < 0)
    throw InputError(origin,
                     fmt::format("{} is not in 'substructures' of problem '{}'", key.label(), result->problem->name));
  push_object(L, {"part data", key.path, key.name, -1, PartData{result, part}});
}

int read_part(lua_State* L, const PartData& data, const Origin& origin) {
  const Substructure& part = *data.result->problem->substructures[static_cast<size_t>(data.part)];
  const std::string key = lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : luaL_typename(L, 2);
  if (key == "mass") {
    lua_pushnumber(L, mass_of(part, volume(*part.mesh)));
    return 1;
  }
  const std::vector<std::string> of_stress = {"von_mises", "margin", "volume_above_yield", "failure_index",
                                              "volume_above_failure"};
  if (std::find(of_stress.begin(), of_stress.end(), key) == of_stress.end())
    throw InputError(origin, fmt::format("result of substructure '{}' has no '{}'\n    {}", part.name, key,
                                         did_you_mean(key, {"mass", "von_mises", "margin", "volume_above_yield",
                                                            "failure_index", "volume_above_failure"})));
  if (!part.mesh->has_cells())
    throw InputError(origin,
                     fmt::format("superelement '{}' has no '{}': without cells it has no stress", part.name, key));
  const bool is_of_index = key.ends_with("failure_index") || key.ends_with("failure");
  const bool is_known = key == "margin" ? part.yield || part.material.has_strength()
                        : is_of_index   ? part.material.has_strength()
                                        : part.yield.has_value();
  if (!is_known) {
    const bool has_axes = !part.material.is_isotropic();
    throw InputError(origin,
                     fmt::format("substructure '{}' has no '{}': {}", part.name, key,
                                 has_axes && !is_of_index && key != "margin"
                                     ? "of a material with directions a 'failure_index' is monitored"
                                 : !has_axes && is_of_index
                                     ? "of a material that is the same in all directions 'von_mises' is monitored"
                                     : fmt::format("its stress was not monitored\n    give its material '{}' a '{}'",
                                                   part.material.name, has_axes ? "strength" : "yield")));
  }
  double value = std::numeric_limits<double>::quiet_NaN();
  for (const PartStress& peak : data.result->run->stresses)
    if (peak.part == data.part)
      value = key == "margin" ? peak.margin() : key.starts_with("volume") ? peak.above : peak.largest;
  lua_pushnumber(L, value);
  return 1;
}

}  // namespace dygita
