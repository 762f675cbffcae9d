#include "deck/ensembles.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

#include "base/log.hpp"
#include "base/names.hpp"
#include "deck/deck_state.hpp"
#include "model/members.hpp"
#include "report/ensemble_files.hpp"
#include "report/ensemble_report.hpp"

namespace dygita {

namespace {

std::vector<double> numbers_at(lua_State* L, int index) {
  index = lua_absindex(L, index);
  std::vector<double> numbers;
  const auto n = static_cast<lua_Integer>(lua_rawlen(L, index));
  for (lua_Integer i = 1; i <= n; ++i) {
    lua_rawgeti(L, index, i);
    numbers.push_back(lua_tonumber(L, -1));
    lua_pop(L, 1);
  }
  return numbers;
}

Distribution::Kind kind_of(const std::string& name) {
  if (name == "uniform") return Distribution::Kind::uniform;
  if (name == "normal") return Distribution::Kind::normal;
  if (name == "lognormal") return Distribution::Kind::lognormal;
  if (name == "triangular") return Distribution::Kind::triangular;
  CHECK(name == "list", "lua/schema.lua has the distribution '" + name + "', which nothing draws from");
  return Distribution::Kind::list;
}

Design design_of(const std::string& method) {
  if (method == "corners") return Design::corners;
  if (method == "random") return Design::random;
  return method == "sobol" ? Design::sobol : Design::latin_hypercube;
}

std::string text_in(lua_State* L, int table, const char* key) {
  lua_getfield(L, table, key);
  const std::string text = lua_tostring(L, -1);
  lua_pop(L, 1);
  return text;
}

// Calls `take` with each item of the list `key` of the table at an index on top of the stack.
template <class Take>
void each_of(lua_State* L, int table, const char* key, Take&& take) {
  lua_getfield(L, table, key);
  const auto n = static_cast<lua_Integer>(lua_rawlen(L, -1));
  for (lua_Integer i = 1; i <= n; ++i) {
    lua_rawgeti(L, -1, i);
    take(static_cast<size_t>(i - 1));
    lua_pop(L, 1);
  }
  lua_pop(L, 1);
}

Distribution distribution_at(lua_State* L) {
  const int index = lua_gettop(L);
  Distribution d{kind_of(text_in(L, index, "kind")), {}};
  lua_getfield(L, index, "numbers");
  d.numbers = numbers_at(L, -1);
  lua_getfield(L, index, "factor");
  d.factor = lua_tonumber(L, -1);
  lua_pop(L, 2);
  return d;
}

template <class Number>
void push_list(lua_State* L, const std::vector<Number>& values) {
  lua_createtable(L, static_cast<int>(values.size()), 0);
  for (size_t i = 0; i < values.size(); ++i) {
    if constexpr (std::is_integral_v<Number>)
      lua_pushinteger(L, static_cast<lua_Integer>(values[i]));
    else
      lua_pushnumber(L, values[i]);
    lua_rawseti(L, -2, static_cast<lua_Integer>(i) + 1);
  }
}

// Tables that read as a run's: of each output that of its first column where it is a spectrum or has no other, and each
// column's beside it.
DeckResultPtr statistics_of(const EnsembleResult& of) {
  const DeckResult& first = *of.members.front();
  auto run = std::make_shared<RunResult>();
  run->converged = of.ensemble.counted().size() == of.ensemble.members.size();
  for (const EnsembleMember& member : of.ensemble.members) run->iterations += member.result->iterations;
  for (const OutputScatter& one : of.scatter) {
    if (one.columns.empty()) continue;
    Table table = one.columns.front().second;
    if (!one.is_spectrum && one.columns.size() > 1) {
      table.names.resize(1);
      table.units.resize(1);
      table.columns.resize(1);
    }
    run->tables[one.output.get()] = std::move(table);
    run->findings[one.output.get()].parts = one.columns;
  }
  return std::make_shared<const DeckResult>(
      DeckResult{of.ensemble.counted().empty() ? first.problem : of.ensemble.counted().front()->problem, std::move(run),
                 first.is_hollow, of.ensemble.name});
}

// In the order of their numbers.
void take_members(lua_State* L, EnsembleResult& found) {
  each_of(L, 2, "names", [&](size_t) { found.ensemble.parameters.emplace_back(lua_tostring(L, -1)); });
  each_of(L, 2, "rows", [&](size_t) { found.ensemble.members.push_back({"", numbers_at(L, -1), nullptr, nullptr}); });
  each_of(L, 2, "members", [&](size_t i) {
    const DeckResultPtr& result = the_object_at(L, -1).as<DeckResultPtr>();
    EnsembleMember& own = found.ensemble.members[i];
    own.name = result->case_name;
    own.problem = result->problem;
    own.result = result->run;
    found.members.push_back(result);
  });
}

// As a continued ensemble reads back those that ran before.
void count_as_written(EnsembleResult& found) {
  take_as_written(found.ensemble);
  for (size_t i = 0; i < found.members.size(); ++i) {
    DeckResult own = *found.members[i];
    own.run = found.ensemble.members[i].result;
    found.members[i] = std::make_shared<const DeckResult>(std::move(own));
  }
}

void tell(const EnsembleResult& found, const std::filesystem::path& folder, bool writes, bool keeps_members) {
  const Ensemble& ensemble = found.ensemble;
  const size_t n = ensemble.counted().size();
  say(fmt::format("ensemble '{}' of problem '{}': {} members, {} iterations", ensemble.name,
                  ensemble.members.front().problem->name, ensemble.members.size(), found.statistics->run->iterations));
  if (n == 0)
    warn(fmt::format("ensemble '{}': none of its {} members converged, so it has no statistics", ensemble.name,
                     ensemble.members.size()));
  else if (n < ensemble.members.size())
    warn(fmt::format("ensemble '{}': {} of {} members did not converge and are left out of its statistics",
                     ensemble.name, ensemble.members.size() - n, ensemble.members.size()));
  for (const std::string& line : ensemble_lines(ensemble, found.scatter)) say("  " + line);
  for (const std::string& line : ensemble_warnings(ensemble, found.scatter))
    warn(fmt::format("ensemble '{}': {}", ensemble.name, line));
  if (!writes) return;  // nor where one member alone is continued: the others are not what it has become
  drop_members_before(folder, ensemble, keeps_members);
  write_ensemble(folder, ensemble, found.scatter);
  say("  tables and charts: " + folder.string());
}

}  // namespace

int check_distribution(LuaState& state, lua_State* L) {
  const std::string kind = lua_tostring(L, 1);
  const Distribution distribution{kind_of(kind), numbers_at(L, 2)};
  const std::string complaint = distribution.complaint();
  if (!complaint.empty())
    throw InputError(state.origin(static_cast<int>(lua_tointeger(L, 3))), kind + ": " + complaint);
  return 0;
}

int draw_members(LuaState&, lua_State* L) {
  const Design design = design_of(lua_tostring(L, 1));
  std::vector<Distribution> distributions;
  const auto k = static_cast<lua_Integer>(lua_rawlen(L, 4));
  for (lua_Integer i = 1; i <= k; ++i) {
    lua_rawgeti(L, 4, i);
    distributions.push_back(distribution_at(L));
    lua_pop(L, 1);
  }
  const std::vector<std::vector<double>> points =
      design_points(design, static_cast<int>(lua_tointeger(L, 2)), static_cast<int>(k),
                    static_cast<std::uint64_t>(lua_tointeger(L, 3)));
  lua_createtable(L, static_cast<int>(points.size()), 0);
  for (size_t i = 0; i < points.size(); ++i) {
    std::vector<double> values;
    for (size_t j = 0; j < distributions.size(); ++j)
      values.push_back(design == Design::corners ? distributions[j].corner(points[i][j] > 0.5)
                                                 : distributions[j].quantile(points[i][j]));
    push_list(L, values);
    lua_rawseti(L, -2, static_cast<lua_Integer>(i) + 1);
  }
  std::vector<int> tour = short_tour(points);
  for (int& member : tour) ++member;
  push_list(L, tour);
  return 2;
}

int call_member(LuaState& state, lua_State* L) {
  const auto told = [&](const std::exception& error) {
    std::string text = error.what();
    if (lua_getfield(L, 3, "text") == LUA_TSTRING) text += std::string("\n    ") + lua_tostring(L, -1);
    lua_pop(L, 1);
    return text;
  };
  lua_pushvalue(L, 1);
  lua_pushvalue(L, 2);
  try {
    state.call(1, 1);
  } catch (const DeckScriptError& error) {
    throw DeckScriptError(told(error));
  } catch (const InputError& error) {
    throw InputError(told(error));
  }
  return 1;
}

int compare_members(LuaState&, lua_State* L) {
  using ProblemPtr = std::shared_ptr<const Problem>;
  const std::string what =
      difference_of_members(*the_object_at(L, 1).as<ProblemPtr>(), *the_object_at(L, 2).as<ProblemPtr>());
  if (what.empty()) return 0;
  lua_pushstring(L, what.c_str());
  return 1;
}

int check_folder_of_ensemble(LuaState& lua, lua_State* L) {
  const DeckState& state = DeckState::of(lua);
  const auto& problem = the_object_at(L, 1).as<std::shared_ptr<const Problem>>();
  if (state.is_solving && state.options.write_files)
    check_ensemble_folder(state.options.out,
                          std::filesystem::path(file_name_of(problem->name)) / file_name_of(lua_tostring(L, 2)));
  return 0;
}

int let_go_of_fields(LuaState&, lua_State* L) {
  Object& object = the_object_at(L, 1);
  DeckResult light = *object.as<DeckResultPtr>();
  auto run = std::make_shared<RunResult>(*light.run);
  run->interface_fields = nullptr;
  run->scenes = nullptr;
  light.run = std::move(run);
  object.content = std::make_shared<const DeckResult>(std::move(light));
  return 0;
}

int conclude_ensemble(LuaState& lua, lua_State* L) {
  DeckState& state = DeckState::of(lua);
  auto found = std::make_shared<EnsembleResult>();
  found->ensemble.name = text_in(L, 2, "case");
  found->ensemble.design = design_of(text_in(L, 2, "method"));
  lua_getfield(L, 2, "seed");
  found->ensemble.seed = lua_tointeger(L, -1);
  lua_pop(L, 1);
  take_members(L, *found);
  count_as_written(*found);
  state.n_members = 0;
  state.shared = nullptr;
  const int n_unsaid = state.say_alike_once ? state.say_alike_once->n_unsaid() : 0;
  state.say_alike_once.reset();
  state.outcome.lost_members.reset();
  ++state.outcome.n_written;
  state.declared.mark_used(the_object_at(L, 1).id);
  each_of(L, 2, "problems", [&](size_t) { state.declared.mark_used(the_object_at(L, -1).id); });
  lua_getfield(L, 2, "keeps_members");
  const bool keeps_members = lua_toboolean(L, -1) != 0;
  lua_pop(L, 1);
  const LuaState::Pause pause(state);
  found->scatter = scatter_of(found->ensemble);
  found->statistics = statistics_of(*found);
  const std::string problem = found->ensemble.members.front().problem->name;
  if (n_unsaid > 0)
    say(fmt::format("ensemble '{}': {} warnings of members that differ from those above by numbers alone are not shown",
                    found->ensemble.name, n_unsaid));
  if (state.is_solving)
    tell(*found, state.options.out / file_name_of(problem) / file_name_of(found->ensemble.name),
         state.options.write_files && state.options.is_study, keeps_members);
  push_object(L, {"ensemble result", "ensemble result", found->ensemble.name, -1, EnsembleResultPtr(std::move(found))});
  return 1;
}

}  // namespace dygita
