// A deck from its text to its results. One file, since the state of Lua, its limits and what a deck is given of its
// runs pass through every function here.
#include "deck/deck.hpp"

#include <spdlog/fmt/fmt.h>

#include "base/fnv1a.hpp"
#include "base/log.hpp"
#include "base/names.hpp"
#include "base/plain_file.hpp"
#include "base/team.hpp"
#include "base/threads.hpp"
#include "deck/arguments.hpp"
#include "deck/deck_state.hpp"
#include "deck/deck_text.hpp"
#include "deck/ensembles.hpp"
#include "deck/results.hpp"
#include "deck/syntax_hint.hpp"
#include "intake/mesher_process.hpp"
#include "model/own_files.hpp"
#include "numerics/factor.hpp"
#include "numerics/panel_choice.hpp"
#include "ranks/ranks.hpp"
#include "result/hollow_result.hpp"
#include "run/side_by_side.hpp"

namespace dygita {

namespace {

std::string text_of(const std::filesystem::path& path) {
  if (std::optional<std::string> text = read_deck_text(path)) return *std::move(text);
  throw InputError(fmt::format("no deck '{}'", path.string()));
}

std::string digest_of(const std::string& text) {
  Fnv1a digest;
  digest.add(text.data(), text.size());
  return digest.hexadecimal();
}

LuaLimits limits_of(const DeckOptions& options) {
  return {options.time_limit, static_cast<size_t>(options.memory_limit * (1 << 20))};
}

int length(LuaState& lua, lua_State* L) { return length_of(L, lua.origin(lua.line(L))); }

// Loads the Lua side and leaves the deck's environment on the stack.
int load_vocabulary(lua_State* L) {
  push_native(DeckState::of(LuaState::of(L)));
  lua_getfield(L, -1, "module");
  lua_pushliteral(L, "vocabulary");
  lua_call(L, 1, 1);
  lua_getfield(L, -1, "read");
  lua_getfield(L, -2, "write");
  lua_getfield(L, -3, "operators");
  set_object_metatable(L, lua_absindex(L, -3), lua_absindex(L, -2), lua_absindex(L, -1), guarded<length>);
  lua_pop(L, 3);
  lua_pushcfunction(L, load_vocabulary);  // any function: they share one metatable
  lua_getfield(L, -2, "operators_of_functions");
  lua_setmetatable(L, -2);
  lua_pop(L, 1);
  lua_getfield(L, -1, "environment");
  return 1;
}

// Values on the command line for which the deck has no place are told before anything runs without them.
void check_settings(const DeckState& state) {
  if (state.has_parameters || state.options.settings.empty()) return;
  throw InputError(fmt::format("--set {}: deck '{}' declares no parameters with param{{ ... }}",
                               state.options.settings.front().first, state.deck_name()));
}

void run_text(DeckState& state, const std::string& text) {
  lua_State* L = state.raw();
  lua_pushcfunction(L, load_vocabulary);
  state.call(0, 1);
  try {
    state.load(text, "@" + state.deck_name());
  } catch (const DeckScriptError& error) {
    throw DeckScriptError(error.what() + syntax_hint(error.what(), text));
  }
  lua_insert(L, -2);
  lua_setupvalue(L, -2, 1);  // its _ENV
  state.call(0, 0);
  check_settings(state);
}

void warn_of_unused(const DeckState& state) {
  for (const std::string& warning : state.declared.unused()) warn(warning);
  for (const auto& [name, value] : state.parameters) {
    if (state.parameters_read.count(name)) continue;
    warn(fmt::format("{}parameter '{}' is declared but never used", state.parameters_origin.prefix(), name));
  }
  for (const auto& [assembly, taken] : state.parts_taken) {
    std::string left;
    for (const StepPart& part : assembly->parts())
      if (!taken.contains(part.name)) left += (left.empty() ? "'" : ", '") + part.name + "'";
    if (!left.empty())
      warn(
          std::dynamic_pointer_cast<const StepAssembly>(assembly)
              ? fmt::format("{}: meshed and never taken: {}; parts = {{ ... }} in mesh.step meshes those that it names",
                            assembly->file(), left)
              : fmt::format("{}: read and never taken: {}", assembly->file(), left));
  }
  if (state.outcome.n_runs == 0) warn(state.deck_name() + " runs no problem: nothing was computed");
}

DeckOutcome execute(const DeckOptions& options, const Engine& engine, bool solves) {
  set_file_limit(options.memory_limit * (1 << 20));
  // All ranks run the same text.
  const std::string text =
      ranks::shared(options.text || !ranks::is_first() ? options.text.value_or("") : text_of(options.path));
  set_mesh_limits(options.meshes);
  if (options.threads > 0) set_thread_limit(options.threads);
  set_mesh_folder(options.path.parent_path().string());
  DeckState state(options, engine, solves);
  state.deck_digest = digest_of(text);
  state.deck_text = text;
  try {
    try {
      run_text(state, text);
    } catch (...) {
      state.study.finish(options.out, options.write_files);  // of the cases that are complete
      throw;
    }
    state.study.finish(options.out, options.write_files);
    warn_of_unused(state);
  } catch (const DeckStopped&) {
    state.outcome.interrupted = true;
  } catch (const NoStatistics& error) {
    warn(fmt::format("the deck ends here: {}", error.what()));
  } catch (const DeckScriptError& error) {
    if (!state.has_read_hollow) throw;
    say(fmt::format("the check ends here: the deck uses results that a check does not compute:\n    {}", error.what()));
  }
  state.outcome.parameters = state.parameters;
  return state.outcome;
}

RunRequest request_of(const DeckState& state, const Problem& problem, const std::string& case_name) {
  RunRequest request;
  request.out = state.options.out;
  request.case_name = case_name;
  request.threads = state.options.threads;
  request.write_files = state.options.write_files;
  request.write_frames = state.options.write_frames;
  request.write_state = state.options.write_state;
  request.identity.deck_path = state.options.path.string();
  request.identity.deck_digest = state.deck_digest;
  request.checkpoint_every = state.options.checkpoint_every;
  request.deck_text = state.deck_text;
  request.settings = state.options.settings;
  request.identity.parameters = state.parameters;
  request.identity.solver = state.options.solver;
  request.identity.threads = state.options.threads;
  request.identity.kernels = panel_kernels().name;
  request.identity.has_frames = request.write_frames;
  request.identity.has_state = request.write_state;
  for (const SubstructurePtr& part : problem.substructures) {
    request.identity.mesh_digests.emplace_back(part->name, part->mesh->digest);
  }
  return request;
}

// A case as problem:run{} asks for it.
struct AskedCase {
  std::string name;
  DeckResultPtr start_from;  // null: from scratch
  bool is_member = false;    // of an ensemble
  bool is_quiet = false;     // leaves no folder of its own
};

// Runs or checks one problem; the deck's clock is stopped.
DeckResultPtr compute(DeckState& state, std::shared_ptr<const Problem> problem, const AskedCase& asked) {
  if (!state.is_solving) {
    std::string report = state.n_members > 1 ? "" : state.engine.check(*problem);  // of members the first tells all
    while (!report.empty() && report.back() == '\n') report.pop_back();
    if (!report.empty()) say(report);
    return std::make_shared<const DeckResult>(DeckResult{problem, hollow_result(*problem), true, asked.name});
  }
  RunRequest request = request_of(state, *problem, asked.name);
  if (asked.is_member) request.shared = state.shared;
  if (asked.is_quiet) request.write_files = request.write_frames = request.write_state = false;
  if (asked.start_from)
    request.start_from = asked.start_from->run;
  else
    request.from = state.options.from;
  auto run = state.engine.run(*problem, request);
  return std::make_shared<const DeckResult>(DeckResult{problem, std::move(run), false, asked.name});
}

// The same case from scratch, not written, to tell what starting from another saved and whether the answers agree.
void check_cold(DeckState& state, const DeckResult& warm, StudyCase& one) {
  const LuaState::Pause pause(state);
  RunRequest request = request_of(state, *warm.problem, one.name);
  request.write_files = request.write_frames = false;
  request.is_trial = true;
  say(fmt::format("problem '{}', case '{}' again, without 'start_from':", warm.problem->name, one.name));
  const auto cold = state.engine.run(*warm.problem, request);
  if (cold->interrupted) return;
  const Difference difference = largest_difference(*warm.problem, *cold, *warm.run);
  one.cold_iterations = cold->iterations;
  one.cold_difference = difference.value;
  say(fmt::format("  {} iterations from scratch, {} from case '{}': {:.0f} % saved; answers differ by at most {:.1e}{}",
                  cold->iterations, warm.run->iterations, one.started_from,
                  100.0 * (1.0 - static_cast<double>(warm.run->iterations) / static_cast<double>(cold->iterations)),
                  difference.value, difference.where.empty() ? "" : " (" + difference.where + ")"));
}

// Notes what the case came to, for the study's table.
void note_case(DeckState& state, const DeckResult& result, const std::string& case_name, const Arguments& arguments,
               const DeckResultPtr& start_from) {
  if (!state.is_solving || !state.options.is_study || result.run->interrupted) return;
  StudyCase one;
  one.name = case_name;
  for (const auto& [name, value] : arguments.settings("at")) one.at.emplace_back(name, value);
  one.figures = case_summary(*result.problem, *result.run);
  one.iterations = result.run->iterations;
  one.mean_iterations = result.run->mean_iterations;
  one.converged = result.run->converged;
  const auto seconds = result.run->seconds.find("all");
  one.seconds = seconds == result.run->seconds.end() ? 0.0 : seconds->second;
  const bool is_warm = start_from && start_from->run->converged && start_from->run->interface_fields;
  if (is_warm) one.started_from = start_from->case_name;
  if (arguments.boolean("check_cold") && is_warm) check_cold(state, result, one);
  if (arguments.boolean("check_cold") && !is_warm)
    warn(fmt::format("case '{}': 'check_cold' compares with 'start_from', but the case ran from scratch", case_name));
  state.study.add(result.problem->name, std::move(one));
}

std::string label_of_case(const std::string& problem, const std::string& name) {
  return fmt::format("problem '{}', case '{}'", problem, name);
}

// What the engine finds wrong and has no line for is told at the line that runs it.
DeckResultPtr compute_at(const Origin& origin, DeckState& state, std::shared_ptr<const Problem> problem,
                         const AskedCase& asked) {
  try {
    return compute(state, problem, asked);
  } catch (const InputError& error) {
    const std::string message = error.what();
    if (message.rfind(state.deck_name() + ":", 0) == 0) throw;
    const std::string who = "problem '" + problem->name + "': ";
    throw InputError(origin, message.rfind("problem '", 0) == 0 ? message : who + message);
  }
}

}  // namespace

DeckState::DeckState(const DeckOptions& deck_options, const Engine& deck_engine, bool solves)
    : LuaState(deck_options.path.filename().string(), limits_of(deck_options)),
      options(deck_options),
      engine(deck_engine),
      is_solving(solves),
      folder(deck_options.path.parent_path()) {}

int run_from_deck(DeckState& state, lua_State* L) {
  check_settings(state);
  const Object& self = the_object_at(L, 2);
  const auto& problem = self.as<std::shared_ptr<const Problem>>();
  lua_getfield(L, 3, "case");
  const std::string case_name = lua_tostring(L, -1);
  const Origin origin = state.origin(static_cast<int>(lua_tointeger(L, 4)));
  const std::string label = label_of_case(problem->name, case_name);
  if (const char* what = own_file_called(file_name_of(case_name), true))
    throw InputError(origin, fmt::format("{}: its folder would overwrite {}\n    give it another name", label, what));
  if (!state.cases.emplace(problem->name, case_name).second) {
    throw InputError(origin,
                     fmt::format("{} has already run in this deck and would be overwritten\n    give each run its "
                                 "own: run{{ case = \"...\" }}",
                                 label));
  }
  state.declared.mark_used(self.id);
  ++state.outcome.n_runs;
  const LuaArguments arguments(L, 3, "run", origin, state.folder);
  const DeckResultPtr start_from =
      arguments.has("start_from") ? arguments.object("start_from").as<DeckResultPtr>() : nullptr;
  const bool is_member = arguments.has("member");
  const bool is_quiet = is_member && arguments.text("member") == "quiet";
  if (is_quiet && state.is_solving && !state.outcome.lost_members) state.outcome.lost_members = 0;
  if (is_member && state.n_members++ == 0) {
    state.shared = std::make_shared<OperatorsOfMembers>();
    state.say_alike_once.emplace();
  }
  const DeckResultPtr result = [&] {
    const LuaState::Pause pause(state);
    return compute_at(origin, state, problem, {case_name, start_from, is_member, is_quiet});
  }();
  if (!is_member) note_case(state, *result, case_name, arguments, start_from);
  if (!result->run->converged) state.outcome.not_converged.push_back(label);
  if (result->run->interrupted) throw DeckStopped();
  ++(state.outcome.lost_members ? *state.outcome.lost_members : state.outcome.n_written);
  push_object(L, {"result", "result", problem->name, -1, result});
  return 1;
}

namespace {

// A member with the others beside it: it keeps its share of the memory for fields, and no fields in the end.
DeckResultPtr compute_beside(const Origin& origin, DeckState& state, const std::shared_ptr<const Problem>& problem,
                             const AskedCase& asked, int n) {
  auto own = std::make_shared<Problem>(*problem);
  own->solver.history_memory /= n;
  DeckResult result = *compute_at(origin, state, own, asked);
  auto run = std::make_shared<RunResult>(*result.run);
  run->interface_fields = nullptr;
  run->scenes = nullptr;
  result.problem = problem;
  result.run = std::move(run);
  return std::make_shared<const DeckResult>(std::move(result));
}

struct Beside {
  std::shared_ptr<const Problem> problem;
  AskedCase asked;
};

// Members as run_together(problems, cases, first, line) has them on the stack; they count as run.
std::vector<Beside> members_beside(DeckState& state, lua_State* L) {
  const DeckResultPtr first = the_object_at(L, 3).as<DeckResultPtr>();
  std::vector<Beside> members;
  for (lua_Integer i = 1; i <= static_cast<lua_Integer>(lua_rawlen(L, 1)); ++i) {
    lua_rawgeti(L, 1, i);
    lua_rawgeti(L, 2, i);
    const Object& object = the_object_at(L, -2);
    state.declared.mark_used(object.id);
    members.push_back({object.as<std::shared_ptr<const Problem>>(), {lua_tostring(L, -1), first, true, true}});
    lua_pop(L, 2);
    state.cases.emplace(members.back().problem->name, members.back().asked.name);
    ++state.outcome.n_runs;
    ++state.n_members;
  }
  return members;
}

DeckResultPtr with_seconds(const DeckResult& result, double seconds) {
  DeckResult own = result;
  auto run = std::make_shared<RunResult>(*own.run);
  run->seconds["all"] = seconds;
  own.run = std::move(run);
  return std::make_shared<const DeckResult>(std::move(own));
}

}  // namespace

int run_members_together(LuaState& lua, lua_State* L) {
  DeckState& state = DeckState::of(lua);
  lua_rawgeti(L, 1, 1);
  const Problem& one = *the_object_at(L, -1).as<std::shared_ptr<const Problem>>();
  lua_pop(L, 1);
  if (!state.is_solving || !state.shared || !can_run_together(one, *state.shared)) return 0;
  const Origin origin = state.origin(static_cast<int>(lua_tointeger(L, 4)));
  const std::vector<Beside> members = members_beside(state, L);
  const auto n = static_cast<int>(members.size());
  std::vector<DeckResultPtr> results(members.size());
  {
    const LuaState::Pause pause(state);
    const std::vector<double> seconds = run_together(n, [&](int i) {
      const Beside& own = members[static_cast<size_t>(i)];
      DeckResultPtr& result = results[static_cast<size_t>(i)];
      result = compute_beside(origin, state, own.problem, own.asked, std::min(n, most_together));
      if (!result->run->interrupted) ++*state.outcome.lost_members;
    });
    for (size_t i = 0; i < results.size(); ++i) results[i] = with_seconds(*results[i], seconds[i]);
  }
  lua_createtable(L, n, 0);
  for (size_t i = 0; i < results.size(); ++i) {
    const std::string& name = members[i].problem->name;
    if (!results[i]->run->converged) state.outcome.not_converged.push_back(label_of_case(name, members[i].asked.name));
    if (results[i]->run->interrupted) throw DeckStopped();
    push_object(L, {"result", "result", name, -1, results[i]});
    lua_rawseti(L, -2, static_cast<lua_Integer>(i) + 1);
  }
  return 1;
}

DeckOutcome run_deck(const DeckOptions& options, const Engine& engine) { return execute(options, engine, true); }

DeckOutcome check_deck(const DeckOptions& options, const Engine& engine) { return execute(options, engine, false); }

std::pair<std::string, std::string> parse_setting(const std::string& text) {
  const size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
    throw InputError(fmt::format("--set {}: write NAME=VALUE, as in --set mu=0.3 or --set tighten=0.04*mm", text));
  }
  return {text.substr(0, equals), text.substr(equals + 1)};
}

namespace {

// Leaves what an embedded Lua file answers on the stack of a state that declares nothing.
void load_module(DeckState& state, const char* name) {
  lua_State* L = state.raw();
  lua_pushcfunction(L, [](lua_State* l) {
    push_native(DeckState::of(LuaState::of(l)));
    lua_getfield(l, -1, "module");
    lua_pushvalue(l, 1);
    lua_call(l, 1, 1);
    return 1;
  });
  lua_pushstring(L, name);
  state.call(1, 1);
}

std::string text_of_module(const char* name) {
  const DeckOptions options;
  const Engine engine;
  DeckState state(options, engine, false);
  load_module(state, name);
  return lua_tostring(state.raw(), -1);
}

}  // namespace

double parse_quantity(const std::string& what, const std::string& text) {
  const DeckOptions options;
  const Engine engine;
  DeckState state(options, engine, false);
  load_module(state, "command_line");
  lua_State* L = state.raw();
  lua_getfield(L, -1, "quantity");
  lua_pushlstring(L, what.data(), what.size());
  lua_pushlstring(L, text.data(), text.size());
  state.call(2, 1);
  return lua_tonumber(L, -1);
}

std::string deck_reference() { return text_of_module("reference"); }

std::string deck_definitions() { return text_of_module("definitions"); }

std::string version() { return program_version(); }

void prepare_process(char** argv) { set_up_process(argv, better_blas_kernels()); }

}  // namespace dygita
