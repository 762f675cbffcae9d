#include "run/keep_state.hpp"

#include <spdlog/fmt/fmt.h>

#include <chrono>
#include <cmath>

#include "base/log.hpp"
#include "base/plain_file.hpp"
#include "model/load.hpp"
#include "ranks/ranks.hpp"
#include "run/share_plan.hpp"

namespace dygita {

namespace {

constexpr int n_load_samples = 256;  // of a step

// A deck's function may have no value where the solver never asked for one.
double sample(const History& history, double t) {
  try {
    return history.value(t);
  } catch (const InputError&) {
    return 0.0;
  }
}

// The digests have them, where they are not the usual ones.
void note_pieces(const Problem& problem, const std::vector<int>& pieces, RunState& state) {
  const std::vector<int> usual = usual_pieces(problem);
  for (auto& [name, digest] : state.mesh_digests)
    for (size_t i = 0; i < pieces.size(); ++i)
      if (problem.substructures[i]->name == name) digest = digest_and_pieces(digest, pieces[i], usual[i]);
}

std::string list_efforts(const std::vector<Effort>& efforts) {
  std::string list;
  for (const Effort& effort : efforts)
    list += fmt::format("{}{} (tolerance {:g})", list.empty() ? "" : ", ", effort.iterations, effort.tolerance);
  return list;
}

}  // namespace

RunState state_in(const std::filesystem::path& run) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(run, ignored))
    throw InputError(fmt::format("no folder '{}'\n    a run's folder is out/<problem>/<case>", run.string()));
  if (std::filesystem::exists(run / state_file_name, ignored)) {
    RunState state = read_state(run / state_file_name);
    if (state.steps.empty() || state.efforts.empty())
      throw InputError(fmt::format("'{}' describes no step: it is damaged\n    run the deck again",
                                   (run / state_file_name).string()));
    return state;
  }
  const auto recorded = read_run_record(run);
  if (!recorded)
    throw InputError(
        fmt::format("'{}' is not the folder of a run: there is no {} in it\n    a run's folder is out/<problem>/<case>",
                    run.string(), state_file_name));
  throw InputError(
      recorded->solver == "latin"
          ? fmt::format(
                "'{}' keeps no {}: the run used --no-state, or an earlier version wrote it\n    run the deck again",
                run.string(), state_file_name)
          : fmt::format("'{}' was computed by solver.{}, which stores nothing to continue from\n    run the deck again",
                        run.string(), recorded->solver));
}

const InterfaceFields* start_of(const RunRequest& request) {
  if (request.continues) return request.continues->fields.get();
  if (!request.start_from) return nullptr;
  if (request.start_from->converged) return request.start_from->interface_fields.get();
  warn(
      fmt::format("case '{}': the initial case has not converged, so its fields are not used as an initial guess: the "
                  "iteration starts from scratch",
                  request.case_name));
  return nullptr;
}

std::vector<double> load_samples(const Problem& problem, const std::vector<StateStep>& steps) {
  std::vector<double> samples;
  for (size_t i_step = 0; i_step < problem.steps.size() && i_step < steps.size(); ++i_step) {
    const double end = steps[i_step].is_static ? 1.0 : steps[i_step].duration;  // a static step's loads run from 0 to 1
    for (const LoadPtr& load : problem.steps[i_step]->loads) {
      for (const auto& value : load->values) {
        if (!value) continue;
        for (int i = 0; i <= n_load_samples; ++i) samples.push_back(sample(value->history, end * i / n_load_samples));
      }
    }
  }
  return samples;
}

std::string changed_load(const Problem& problem, const RunState& state) {
  const std::vector<double> now = load_samples(problem, state.steps), &then = state.loads;
  if (now.size() != then.size()) return "of its steps";
  size_t at = 0;
  for (size_t i_step = 0; i_step < problem.steps.size() && i_step < state.steps.size(); ++i_step)
    for (const LoadPtr& load : problem.steps[i_step]->loads)
      for (const auto& value : load->values) {
        if (!value) continue;
        double size = 0.0, difference = 0.0;
        for (int i = 0; i <= n_load_samples; ++i, ++at) {
          size = std::max(size, std::abs(then[at]));
          difference = std::max(difference, std::abs(now[at] - then[at]));
        }
        if (!(difference <= 1e-6 * size)) return fmt::format("of step '{}'", problem.steps[i_step]->name);
      }
  return "";
}

RunState identity_of_run(const Problem& problem, const RunRequest& request) {
  RunState state;
  const RunIdentity& identity = request.identity;
  std::error_code ignored;
  state.program = program_version();
  state.problem = problem.name;
  state.case_name = request.case_name;
  state.deck_path = std::filesystem::absolute(identity.deck_path, ignored).string();
  state.deck_text = request.deck_text;
  state.solver = identity.solver;
  state.settings = request.settings;
  state.mesh_digests = identity.mesh_digests;
  if (!request.pieces.empty()) note_pieces(problem, request.pieces, state);
  for (size_t i = 0; i < problem.steps.size(); ++i) {
    const Step& step = *problem.steps[i];
    state.steps.push_back({step.name, step.is_static, step.n_increments(), step.is_static ? 0.0 : step.duration, 0.0});
  }
  state.loads = load_samples(problem, state.steps);
  return state;
}

RunState state_of(const Problem& problem, const RunRequest& request, const RunResult& result) {
  if (!result.interface_fields) return {};
  RunState state = identity_of_run(problem, request);
  for (size_t i = 0; i < state.steps.size() && i < result.steps.size(); ++i)
    state.steps[i].worst_indicator = result.steps[i].worst_indicator;
  if (request.continues) state.efforts = request.continues->efforts;
  state.efforts.push_back({problem.solver.tolerance, problem.solver.static_tolerance, problem.solver.more_iterations,
                           result.iterations, result.seconds.at("all")});
  state.converged = result.converged;
  state.interrupted = result.interrupted;
  state.fields = result.interface_fields;
  return state;
}

bool reaches_as_far(const RunState& state, const RunState& before) {
  for (size_t i = 0; i < before.fields->n_steps(); ++i)
    if (state.fields->n_increments(i) < before.fields->n_increments(i)) return false;
  return true;
}

namespace {

// The state must not take the room of the results, which come after it.
void check_room(const RunState& state, const std::filesystem::path& folder, const RunResult& result) {
  double bytes = 0.0, results = 4e6;  // report and pictures
  for (size_t i = 0; i < state.fields->n_steps(); ++i)
    bytes +=
        8.0 * static_cast<double>(state.fields->n_increments(i)) * static_cast<double>(result.n_interface_unknowns);
  for (const auto& [output, table] : result.tables)
    results += 16.0 * static_cast<double>(table.n_rows()) * static_cast<double>(table.columns.size() + 2);
  std::error_code error;
  const std::filesystem::space_info space = std::filesystem::space(folder, error);
  if (!error && static_cast<double>(space.available) < bytes + results)
    throw InputError(fmt::format("no room for {} ({:.3g} MB; {:.3g} MB are free): the space is reserved for results",
                                 state_file_name, bytes / 1e6, static_cast<double>(space.available) / 1e6));
}

// Increments of each step that all ranks have, and their unknowns.
FieldSizes common_sizes(const InterfaceFields& fields) {
  FieldSizes sizes;
  for (size_t s = 0; s < fields.n_steps(); ++s) {
    const double n = -ranks::largest(-static_cast<double>(fields.n_increments(s)));
    sizes.emplace_back(static_cast<size_t>(n), fields.runs(s).n_all);
  }
  return sizes;
}

double bytes_of_files(const std::filesystem::path& folder) {
  double bytes = 0.0;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(folder, ignored))
    if (entry.is_regular_file(ignored)) bytes += static_cast<double>(entry.file_size(ignored));
  return bytes;
}

// Where the parts go, as the first rank says; nothing: none are written.
std::filesystem::path folder_of_parts(const RunState& state, RunWriter* writer, const RunResult& result,
                                      std::string& error) {
  if (!writer || !state.fields) return {};
  try {
    check_room(state, writer->directory(), result);
    return writer->folder_of(state_parts_folder(state_file_name).string(), ranks::count());
  } catch (const InputError& failed) {
    error = failed.what();
    return {};
  }
}

}  // namespace

KeptParts keep_parts(const RunState& state, RunWriter* writer, const RunResult& result) {
  KeptParts kept;
  if (ranks::is_alone()) return kept;
  const std::filesystem::path folder = ranks::shared(folder_of_parts(state, writer, result, kept.error).string());
  if (folder.empty()) return kept;
  kept.parts.sizes = common_sizes(*result.interface_fields);
  std::string part, error;
  try {
    part = bytes_of(write_state_part(folder / std::to_string(ranks::me()), *result.interface_fields, kept.parts.sizes));
  } catch (const InputError& failed) {
    error = failed.what();
  }
  const std::vector<std::string> errors = ranks::gathered(error);
  for (const std::string& bytes : ranks::gathered(part))
    if (!bytes.empty()) kept.parts.of_ranks.push_back(state_part_of(bytes));
  for (const std::string& one : errors)
    if (kept.error.empty()) kept.error = one;
  return kept;
}

void keep_state(RunState& state, KeptParts kept, RunWriter& writer, bool has_checkpoint, RunResult& result) {
  if (!state.fields) return;
  const auto start = std::chrono::steady_clock::now();
  const std::filesystem::path path = writer.path_of(state_file_name), parts = state_parts_folder(path);
  try {
    if (!kept.error.empty()) throw InputError(kept.error);
    state.parts = std::move(kept.parts);
    if (state.parts.is_empty()) check_room(state, writer.directory(), result);
    write_state(path, state);
    result.figures.state_file = (static_cast<double>(std::filesystem::file_size(path)) + bytes_of_files(parts)) / 1e6;
  } catch (const InputError& error) {
    remove_parts(parts);
    warn(fmt::format(
        "{}\n    {}; its results are not touched", error.what(),
        has_checkpoint ? "the run can be continued from its checkpoint" : "this run cannot be continued later"));
  }
  result.seconds["state file"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string continuation_line(const RunState& before, const RunResult& result) {
  return fmt::format("  continued with {} iterations; before: {}", result.iterations, list_efforts(before.efforts));
}

}  // namespace dygita
