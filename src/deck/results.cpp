#include "deck/results.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/names.hpp"
#include "deck/ensembles.hpp"
#include "deck/part_results.hpp"
#include "model/output.hpp"
#include "model/places.hpp"
#include "result/hollow_result.hpp"

namespace dygita {

namespace {

[[noreturn]] void unknown(const Origin& origin, const std::string& what, const std::string& key,
                          std::vector<std::string> known) {
  throw InputError(origin, fmt::format("{} has no '{}'\n    {}", what, key, did_you_mean(key, std::move(known))));
}

std::string key_text(lua_State* L) {
  return lua_type(L, 2) == LUA_TSTRING ? lua_tostring(L, 2) : std::string(luaL_typename(L, 2));
}

// The row asked for, where the key is a whole number.
std::optional<lua_Integer> row_asked(lua_State* L) {
  int is_whole = 0;
  const lua_Integer row = lua_type(L, 2) == LUA_TNUMBER ? lua_tointegerx(L, 2, &is_whole) : 0;
  return is_whole ? std::optional(row) : std::nullopt;
}

void push_series(lua_State* L, Series series) {
  Object object{"series", series.name, "", -1, std::make_shared<const Series>(std::move(series))};
  push_object(L, std::move(object));
}

std::vector<std::string> value_columns(const OutputData& data) {
  return {data.table->names.begin() + 1, data.table->names.end()};
}

bool is_vector(const OutputData& data) { return value_columns(data) == std::vector<std::string>{"x", "y", "z"}; }

std::string label_of(const OutputData& data) { return data.output->known_as(); }

Series series_of(const OutputData& data, const std::string& column) {
  const Table& table = *data.table;
  return {data.result->problem,  data.output->name + "." + column,
          table.names.front(),   table.column(column),
          table.columns.front(), table.step,
          data.result->is_hollow};
}

// Modulus of a vector history, row by row.
Series modulus_of(const OutputData& data) {
  Series series = series_of(data, "x");
  series.name = data.output->name;
  const auto &y = data.table->column("y"), &z = data.table->column("z");
  for (size_t i = 0; i < series.values.size(); ++i) series.values[i] = std::hypot(series.values[i], y[i], z[i]);
  return series;
}

int push_value(lua_State* L, double value) {
  lua_pushnumber(L, value);
  return 1;
}

// Spectra, and the accelerations that they are of.
bool needs_motion(const Output& output) {
  const std::optional<HistoryKind> history = output.history();
  return output.highest_frequency() || (history && history->quantity == "acceleration");
}

// What a problem without motion leaves out: nan.
OutputData left_out(const DeckResultPtr& result, const OutputPtr& output) {
  auto asked = std::make_shared<Problem>(*result->problem);
  asked->outputs = {output};
  const auto none =
      std::make_shared<const DeckResult>(DeckResult{asked, hollow_result(*asked), true, result->case_name});
  return {none, output, &none->run->tables.at(output.get())};
}

// result[output].
int push_output_data(lua_State* L, const DeckResultPtr& result, const Object& key, const Origin& origin) {
  const auto& output = key.as<OutputPtr>();
  const auto found = result->run->tables.find(output.get());
  if (found != result->run->tables.end()) {
    push_object(L, {"data", key.path, output->name, -1, OutputData{result, output, &found->second}});
    return 1;
  }
  if (output->columns().empty()) {
    throw InputError(origin,
                     "output." + output->word + " provides no data to the deck\n    its frames are ParaView files");
  }
  if (needs_motion(*output) && !has_dynamic_step(*result->problem)) {
    push_object(L, {"data", key.path, output->name, -1, left_out(result, output)});
    return 1;
  }
  const auto& listed = result->problem->outputs;
  if (index_of(listed, output.get()) >= 0) {
    throw InputError(origin, fmt::format("the run produced nothing for {}", key.label()));
  }
  throw InputError(origin, fmt::format("{} is not in 'outputs' of problem '{}'", key.label(), result->problem->name));
}

int read_result(lua_State* L, const Object& object, const Origin& origin) {
  const auto& result = object.as<DeckResultPtr>();
  if (const Object* key = object_at(L, 2)) {
    if (key->kind == "substructure") {
      push_part_data(L, result, *key, origin);
      return 1;
    }
    if (key->kind == "output") return push_output_data(L, result, *key, origin);
    throw InputError(
        origin,
        fmt::format("result[{}]: index a result by an output, as in result[bolt], or by a substructure", key->label()));
  }
  const std::string key = key_text(L);
  if (key == "iterations") {
    lua_pushinteger(L, result->run->iterations);
  } else if (key == "mean_iterations") {
    lua_pushnumber(L, result->run->mean_iterations);
  } else if (key == "converged") {
    lua_pushboolean(L, result->run->converged);
  } else if (const auto& outputs = result->problem->outputs;
             std::any_of(outputs.begin(), outputs.end(), [&](const OutputPtr& o) { return o->name == key; })) {
    throw InputError(
        origin,
        fmt::format(
            "a result has no '{}'\n    index it by the output itself, not by its name: result[{}], without quotes", key,
            key));
  } else {
    unknown(origin, "a result", key, {"converged", "iterations", "mean_iterations"});
  }
  return 1;
}

int read_series(lua_State* L, const Series& series, const Origin& origin) {
  if (const auto row = row_asked(L)) {
    const auto n = static_cast<lua_Integer>(series.values.size());
    if (*row >= 1 && *row <= n) return push_value(L, series.values[static_cast<size_t>(*row - 1)]);
    if (*row == n + 1) return 0;  // where ipairs stops
    if (*row > n && series.is_hollow) return push_value(L, series.values.empty() ? 0.0 : series.values.back());
    throw InputError(origin, fmt::format("series '{}' has rows 1 to {}, not {}", series.name, n, *row));
  }
  const std::string key = key_text(L);
  if (key == series.abscissa) {
    push_series(L, {series.problem, series.name + "." + key, key, series.at, series.at, series.step, series.is_hollow});
    return 1;
  }
  if (const auto value = summary_of(series, key, origin)) return push_value(L, *value);
  unknown(origin, fmt::format("series '{}'", series.name), key, {"at", "first", "last", "max", "min", series.abscissa});
}

// What an output reports beside its table: tables and numbers, under these names.
const Findings& findings_beside(const OutputData& data) {
  static const Findings none;
  const RunResult& run = *data.result->run;
  return data.table == &run.tables.at(data.output.get()) ? run.findings_of(*data.output) : none;
}

bool push_finding(lua_State* L, const OutputData& data, const std::string& key) {
  const Findings& findings = findings_beside(data);
  for (const auto& [part, table] : findings.parts) {
    if (part != key) continue;
    push_object(L, {"data", "output." + data.output->word, data.output->name, -1,
                    OutputData{data.result, data.output, &table, data.members, data.members ? part : ""}});
    return true;
  }
  const auto value = findings.values.find(key);
  if (value == findings.values.end()) return false;
  lua_pushnumber(L, value->second);
  return true;
}

int read_output(lua_State* L, const OutputData& data, const Origin& origin) {
  if (lua_type(L, 2) == LUA_TSTRING && key_text(L) == "converged" && data.table->has_column("converged")) {
    push_series(L, series_of(data, "converged"));
    return 1;
  }
  const std::vector<std::string> columns = value_columns(data);
  if (columns.size() == 1 && !data.members && (row_asked(L) || key_text(L) != columns[0])) {
    return read_series(L, series_of(data, columns[0]), origin);
  }
  const std::string key = key_text(L);
  if (data.members && push_sample(L, data, key, origin)) return 1;
  if (push_finding(L, data, key)) return 1;
  if (std::find(columns.begin(), columns.end(), key) != columns.end()) {
    push_series(L, series_of(data, key));
    return 1;
  }
  if (key == data.table->names.front()) {
    const auto& at = data.table->columns.front();
    push_series(L, {data.result->problem, data.output->name + "." + key, key, at, at, data.table->step,
                    data.result->is_hollow});
    return 1;
  }
  if (is_vector(data) && key == "max") return push_value(L, *summary_of(modulus_of(data), key, origin));
  std::vector<std::string> known = data.table->names;
  if (is_vector(data)) known.push_back("max");
  if (data.table->has_column("converged")) known.push_back("converged");
  for (const auto& [part, table] : findings_beside(data).parts) known.push_back(part);
  for (const auto& [value, number] : findings_beside(data).values) known.push_back(value);
  unknown(origin, label_of(data), key, std::move(known));
}

// The series that the object stands for; InputError if it has several columns.
Series series_at(lua_State* L, int index, const Origin& origin) {
  const Object& object = the_object_at(L, index);
  if (object.kind == "series") return *object.as<std::shared_ptr<const Series>>();
  const auto& data = object.as<OutputData>();
  const std::vector<std::string> columns = value_columns(data);
  if (columns.size() == 1) return series_of(data, columns[0]);
  throw InputError(origin, fmt::format("{} has several columns\n    {}", label_of(data), did_you_mean("", columns)));
}

}  // namespace

int read_data(lua_State* L, const Origin& origin) {
  const Object& object = the_object_at(L, 1);
  if (object.kind == "result") return read_result(L, object, origin);
  if (object.kind == "data") return read_output(L, object.as<OutputData>(), origin);
  if (is_of_ensemble(object)) return read_ensemble(L, object, origin);
  if (object.kind == "part data") return read_part(L, object.as<PartData>(), origin);
  return read_series(L, *object.as<std::shared_ptr<const Series>>(), origin);
}

int length_of(lua_State* L, const Origin& origin) {
  const Object& object = the_object_at(L, 1);
  if (object.kind == "series") {
    lua_pushinteger(L, static_cast<lua_Integer>(object.as<std::shared_ptr<const Series>>()->values.size()));
  } else if (object.kind == "data") {
    lua_pushinteger(L, object.as<OutputData>().table->n_rows());
  } else if (is_of_ensemble(object)) {
    lua_pushinteger(L, length_in_ensemble(object, origin));
  } else {
    throw InputError(origin, fmt::format("{} has no length", object.label()));
  }
  return 1;
}

int value_at(lua_State* L, const Origin& origin) {
  const Series series = series_at(L, 1, origin);
  if (lua_type(L, 2) == LUA_TNUMBER) return push_value(L, value_at_abscissa(series, lua_tonumber(L, 2), origin));
  const Object* object = object_at(L, 2);
  if (!object || object->kind != "step") {
    throw InputError(origin, fmt::format("series:at takes a {} or a step, got {}",
                                         series.abscissa == "time" ? "time" : series.abscissa,
                                         object ? object->label() : luaL_typename(L, 2)));
  }
  return push_value(L, value_at_step(series, *object->as<StepPtr>(), origin));
}

}  // namespace dygita
