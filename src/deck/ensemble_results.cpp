// What a deck reads of an ensemble: statistics of outputs, samples, what drives them.
#include <spdlog/fmt/fmt.h>

#include "base/names.hpp"
#include "deck/ensembles.hpp"

namespace dygita {

namespace {

// An output of the same name: members may declare their own.
const OutputScatter* scatter_of_output(const EnsembleResult& of, const std::string& name) {
  for (const OutputScatter& one : of.scatter)
    if (one.output->name == name) return &one;
  return nullptr;
}

const OutputScatter& scatter_at_key(lua_State* L, const EnsembleResult& of, const Origin& origin) {
  const Object* key = object_at(L, 2);
  if (!key || key->kind != "output")
    throw InputError(origin, "index an ensemble's result by an output, as in result[srs], or by a member's number");
  const OutputScatter* found = scatter_of_output(of, key->name);
  const std::string name = key->as<OutputPtr>()->name;
  if (!found) found = scatter_of_output(of, name);
  if (!found && of.ensemble.counted().empty())
    throw NoStatistics(origin,
                       fmt::format("none of the {} members of ensemble '{}' converged, so it has no statistics\n"
                                   "    what a member came to is read by its number, result[1][{}]",
                                   of.members.size(), of.ensemble.name, name));
  if (!found)
    throw InputError(origin,
                     fmt::format("{} has no table in all members of ensemble '{}'", key->label(), of.ensemble.name));
  return *found;
}

int push_scatter(lua_State* L, const EnsembleResultPtr& of, const Origin& origin) {
  const OutputScatter& found = scatter_at_key(L, *of, origin);
  if (found.columns.empty())
    throw InputError(origin, fmt::format("the rows of output '{}' differ from member to member: read those of a "
                                         "member, result[1][{}]",
                                         found.output->name, found.output->name));
  push_object(L,
              {"data", "output." + found.output->word, found.output->name, -1,
               OutputData{of->statistics, found.output, &of->statistics->run->tables.at(found.output.get()), of, ""}});
  return 1;
}

int read_result(lua_State* L, const EnsembleResultPtr& of, const Origin& origin) {
  if (lua_isinteger(L, 2)) {
    const lua_Integer i = lua_tointeger(L, 2);
    const auto n = static_cast<lua_Integer>(of->members.size());
    if (i == n + 1) return 0;  // where ipairs stops
    if (i < 1 || i > n) throw InputError(origin, fmt::format("the ensemble has members 1 to {}, not {}", n, i));
    const DeckResultPtr& member = of->members[static_cast<size_t>(i - 1)];
    push_object(L, {"result", "result", member->problem->name, -1, member});
    return 1;
  }
  if (object_at(L, 2)) return push_scatter(L, of, origin);
  const std::string key = to_text(L, 2);
  if (key == "drives")
    push_object(L, {"drives", "drives", of->ensemble.name, -1, Drives{of}});
  else if (key == "converged")
    lua_pushboolean(L, of->statistics->run->converged);
  else if (key == "iterations")
    lua_pushinteger(L, of->statistics->run->iterations);
  else
    throw InputError(origin, fmt::format("an ensemble's result has no '{}'\n    {}", key,
                                         did_you_mean(key, {"drives", "converged", "iterations"})));
  return 1;
}

void set_number(lua_State* L, const char* key, double value) {
  lua_pushnumber(L, value);
  lua_setfield(L, -2, key);
}

std::string text_of(const std::vector<Drive>& drives) {
  std::string text;
  for (const Drive& d : drives)
    text += fmt::format("{}{}: {}, rank correlation {:.2f} ({:.2f} to {:.2f}), {}", text.empty() ? "" : "\n", d.figure,
                        d.parameter, d.correlation.value, d.correlation.low, d.correlation.high,
                        d.correlation.is_clear() ? fmt::format("{:.0f} % of the spread", 100.0 * d.share())
                                                 : "not distinguishable from none");
  return text.empty() ? "nothing varies" : text;
}

// The list, as text where it is printed.
int push_drives(lua_State* L, const Drives& drives, const Origin& origin) {
  const OutputScatter& found = scatter_at_key(L, *drives.of, origin);
  lua_createtable(L, static_cast<int>(found.drives.size()), 4);
  for (size_t i = 0; i < found.drives.size(); ++i) {
    const Drive& d = found.drives[i];
    lua_createtable(L, 0, 7);
    lua_pushstring(L, d.figure.c_str());
    lua_setfield(L, -2, "figure");
    lua_pushstring(L, d.parameter.c_str());
    lua_setfield(L, -2, "parameter");
    set_number(L, "correlation", d.correlation.value);
    set_number(L, "low", d.correlation.low);
    set_number(L, "high", d.correlation.high);
    set_number(L, "share", d.share());
    lua_pushboolean(L, d.correlation.is_clear());
    lua_setfield(L, -2, "clear");
    lua_rawseti(L, -2, static_cast<lua_Integer>(i) + 1);
  }
  for (size_t j = 1; j < found.drives_at.names.size(); ++j) {
    const Table& at = found.drives_at;
    Series series{drives.of->statistics->problem,
                  found.output->name + "." + at.names[j],
                  at.names[0],
                  at.columns[j],
                  at.columns[0],
                  {},
                  drives.of->statistics->is_hollow};
    push_object(L, {"series", series.name, "", -1, std::make_shared<const Series>(std::move(series))});
    lua_setfield(L, -2, at.names[j].c_str());
  }
  lua_createtable(L, 0, 1);
  lua_pushstring(L, text_of(found.drives).c_str());
  lua_pushcclosure(
      L, [](lua_State* l) { return lua_pushvalue(l, lua_upvalueindex(1)), 1; }, 1);
  lua_setfield(L, -2, "__tostring");
  lua_setmetatable(L, -2);
  return 1;
}

int read_sample(lua_State* L, const Sample& sample, const Origin& origin) {
  if (lua_isinteger(L, 2)) {
    const lua_Integer i = lua_tointeger(L, 2);
    const auto n = static_cast<lua_Integer>(sample.values.size());
    if (i == n + 1) return 0;
    if (i < 1 || i > n) throw InputError(origin, fmt::format("'{}' has members 1 to {}, not {}", sample.name, n, i));
    lua_pushnumber(L, sample.values[static_cast<size_t>(i - 1)]);
    return 1;
  }
  const std::string key = to_text(L, 2);
  const double value =
      key == "median" ? sample_quantile(sample.values, 0.5)
      : key == "min"  ? sample_quantile(sample.values, 0.0)
      : key == "max"  ? sample_quantile(sample.values, 1.0)
      : key == "mean" ? sample_mean(sample.values)
      : key == "deviation"
          ? sample_deviation(sample.values)
          : throw InputError(origin,
                             fmt::format("sample '{}' has no '{}'\n    {}", sample.name, key,
                                         did_you_mean(key, {"median", "mean", "deviation", "min", "max", "quantile"})));
  lua_pushnumber(L, value);
  return 1;
}

}  // namespace

bool is_of_ensemble(const Object& object) {
  return object.kind == "ensemble result" || object.kind == "drives" || object.kind == "sample";
}

int read_ensemble(lua_State* L, const Object& object, const Origin& origin) {
  if (object.kind == "sample") return read_sample(L, object.as<Sample>(), origin);
  if (object.kind == "drives") return push_drives(L, object.as<Drives>(), origin);
  return read_result(L, object.as<EnsembleResultPtr>(), origin);
}

lua_Integer length_in_ensemble(const Object& object, const Origin& origin) {
  if (object.kind == "sample") return static_cast<lua_Integer>(object.as<Sample>().values.size());
  if (object.kind == "drives")
    throw InputError(origin, "what drives an ensemble is told output by output: drives[output]");
  return static_cast<lua_Integer>(object.as<EnsembleResultPtr>()->members.size());
}

bool push_sample(lua_State* L, const OutputData& data, const std::string& key, const Origin& origin) {
  if (key != "last" && key != "first" && key != "max" && key != "min") return false;
  const OutputScatter* scatter = scatter_of_output(*data.members, data.output->name);
  CHECK(scatter && !scatter->columns.empty(), "data of an ensemble are of an output that all members have");
  if (data.column.empty() && scatter->columns.size() > 1 && !scatter->is_spectrum) return false;
  const std::string column = data.column.empty() ? scatter->columns.front().first : data.column;
  const std::string name = data.output->name + "." + column + "." + key;
  std::vector<double> values;
  try {
    values = sample_of(data.members->ensemble, data.output->name, column, key);
  } catch (const InputError& error) {
    throw InputError(origin, error.what());
  }
  push_object(L, {"sample", "sample", name, -1, Sample{name, std::move(values)}});
  return true;
}

int quantile_of_sample(lua_State* L) {
  lua_pushnumber(L, sample_quantile(the_object_at(L, 2).as<Sample>().values, lua_tonumber(L, 3)));
  return 1;
}

}  // namespace dygita
