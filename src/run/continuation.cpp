#include "run/continuation.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

#include "base/log.hpp"
#include "base/name_list.hpp"
#include "base/names.hpp"
#include "files/csv.hpp"
#include "files/run_record.hpp"
#include "partition/mass_choice.hpp"
#include "ranks/ranks.hpp"
#include "result/hollow_result.hpp"
#include "run/keep_state.hpp"
#include "run/share_plan.hpp"

namespace dygita {

namespace fs = std::filesystem;

namespace {

// The folder of a problem stands for the case of it that was stopped or killed.
fs::path unfinished_case(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored) || fs::exists(folder / checkpoint_file_name, ignored) ||
      fs::exists(folder / state_file_name, ignored) || fs::exists(folder / "run.json", ignored))
    return folder;
  std::vector<fs::path> unfinished, cases;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored)) {
    if (fs::exists(entry.path() / checkpoint_file_name, ignored)) unfinished.push_back(entry.path());
    if (fs::exists(entry.path() / "run.json", ignored)) cases.push_back(entry.path());
  }
  if (unfinished.size() == 1) return unfinished.front();
  std::sort(unfinished.begin(), unfinished.end());
  std::sort(cases.begin(), cases.end());
  std::string list;
  for (const fs::path& one : unfinished.empty() ? cases : unfinished) list += "\n      " + one.string();
  if (list.empty()) return folder;
  throw InputError(
      unfinished.empty()
          ? fmt::format(
                "every case that was begun in '{}' is complete\n    name the folder of one to refine it, or run "
                "the deck again for cases that were not:{}",
                folder.string(), list)
          : fmt::format("several cases in '{}' were stopped: continue one of{}", folder.string(), list));
}

// The end of the run as it was asked for, s.
double end_of(const RunState& state) {
  double end = 0.0;
  for (const StateStep& step : state.steps) end += step.duration;
  return end;
}

double worst_of(const RunState& state, bool is_static) {
  double worst = 0.0;
  for (const StateStep& step : state.steps)
    if (step.is_static == is_static) worst = std::max(worst, step.worst_indicator);
  return worst;
}

// Static steps are asked a hundredth of the tolerance, as by default, or what they were asked.
double static_tolerance(const ContinueOptions& options, const Effort& last) {
  return options.tolerance ? std::min(last.static_tolerance, std::max(1e-14, 1e-2 * *options.tolerance))
                           : last.static_tolerance;
}

// The problem is the one that the fields belong to.
void check_problem_is_same(const Problem& problem, const RunState& state) {
  for (const SubstructurePtr& part : problem.substructures) {
    const auto kept = std::find_if(state.mesh_digests.begin(), state.mesh_digests.end(),
                                   [&](const auto& d) { return d.first == part->name; });
    if (kept == state.mesh_digests.end() || digest_alone(kept->second) != part->mesh->digest)
      throw InputError(fmt::format("the mesh of substructure '{}' ({}) has changed since the run: run the deck again",
                                   part->name, part->mesh->source));
  }
  if (const std::string which = changed_load(problem, state); !which.empty())
    throw InputError(
        fmt::format("the loads {} have changed since the run (a file that the deck reads, the results of another "
                    "case, or a function of the deck that now returns other values): run the deck "
                    "again",
                    which));
}

// A folder that was moved, or given another's name.
void check_is_result_of(const RecordedRun& recorded, const Problem& problem, const std::string& case_name,
                        const fs::path& folder) {
  if (recorded.problem == problem.name && recorded.case_name == case_name) return;
  throw InputError(
      fmt::format("'{}' holds the results of problem '{}', case '{}', not of problem '{}', case '{}'\n"
                  "    give its folders their names: {}/{}",
                  folder.string(), recorded.problem, recorded.case_name, problem.name, case_name, recorded.problem,
                  recorded.case_name));
}

// A table that grows by a row an increment and has lost some, or has them in another order.
void check_is_whole(const Table& table, const Problem& problem, const fs::path& file) {
  if (table.step.empty() || table.names.front() != "time") return;
  const std::vector<double>& time = table.columns.front();
  for (size_t k = 0; k < problem.steps.size(); ++k) {
    const auto n = std::count(table.step.begin(), table.step.end(), static_cast<int>(k));
    if (n > 0 && n < problem.steps[k]->n_increments())
      throw InputError(fmt::format("{} has {} rows of step '{}', which has {} increments: it is cut off", file.string(),
                                   n, problem.steps[k]->name, problem.steps[k]->n_increments()));
  }
  if (!std::is_sorted(time.begin(), time.end()) || !std::is_sorted(table.step.begin(), table.step.end()))
    throw InputError(fmt::format("{}: its rows are not in the order of time", file.string()));
}

}  // namespace

Continuation::Continuation(const ContinueOptions& asked) : options_(asked) {
  if (ranks::is_first()) open();
  if (!ranks::is_alone()) share();
}

void Continuation::open() {
  options_.run = unfinished_case(options_.run);
  const ContinueOptions& options = options_;
  std::error_code ignored;
  if (fs::is_directory(options.run, ignored)) lock_ = std::make_shared<RunLock>(fs::canonical(options.run));
  const fs::path checkpoint = options.run / checkpoint_file_name;
  const bool asks = options.tolerance || options.more_iterations > 0 || options.until;
  const bool is_unfinished = fs::exists(checkpoint, ignored);
  has_record_ = read_run_record(options.run).has_value();
  if (is_unfinished && asks && !(has_record_ && fs::exists(options.run / state_file_name, ignored)))
    throw InputError(
        fmt::format("'{0}': the run is not complete: `dygita continue {0}` completes it and can then extend it",
                    options.run.string()));
  if (is_unfinished && !asks) {
    checkpoint_ = std::make_shared<CheckpointFile>(checkpoint, options.checkpoint_every);
    resumed_ = checkpoint_->identity();
    state_ = std::make_shared<const RunState>(resumed_->state);
  } else {
    state_ = std::make_shared<const RunState>(state_in(options.run));
  }
}

bool Continuation::is_in_its_place() const {
  std::error_code ignored;
  return fs::equivalent(out() / state_->problem / state_->case_name, options_.run, ignored);
}

fs::path Continuation::out() const { return fs::canonical(options_.run).parent_path().parent_path(); }

// Rank 0 alone has the checkpoint, which it appends to; a state is read by all.
void Continuation::share() {
  options_.run = ranks::shared(options_.run.string());
  has_record_ = ranks::any(has_record_);
  if (ranks::any(resumes())) {
    resumed_ = checkpoint_identity_of(ranks::shared(resumed_ ? bytes_of(*resumed_) : std::string()));
    state_ = std::make_shared<const RunState>(resumed_->state);
  } else if (!ranks::is_first()) {
    state_ = std::make_shared<const RunState>(state_in(options_.run));
  }
}

// Rank 0 alone writes.
void Continuation::take_folder(RunRequest& request) const {
  if (!ranks::is_first()) return;
  request.replaces = options_.run;
  request.lock = lock_;
}

std::string Continuation::idle() const {
  const RunState& state = *state_;
  const bool is_whole = !state.interrupted && has_record_;
  if (resumes() || options_.until || options_.more_iterations > 0 || !is_whole) return "";
  if (!options_.tolerance) {
    if (!state.converged) return "";
    throw InputError(
        fmt::format("'{}': the run is complete and has converged: give --tolerance, --iterations or --until",
                    options_.run.string()));
  }
  const double reached = std::max(worst_of(state, false), 0.0), reached_static = worst_of(state, true);
  if (reached > *options_.tolerance || reached_static > static_tolerance(options_, state.efforts.back())) return "";
  return fmt::format("nothing to do: the run has reached {:.2g}, which meets the tolerance {:g}",
                     std::max(reached, reached_static), *options_.tolerance);
}

void Continuation::check_until() const {
  const RunState& state = *state_;
  if (!options_.until) return;
  const StateStep& last = state.steps.back();
  if (last.is_static)
    throw InputError(fmt::format("--until: the last step, '{}', is static and cannot be extended in time", last.name));
  const double dt = last.duration / last.increments, end = end_of(state);
  if (*options_.until < end + 0.5 * dt)
    throw InputError(
        fmt::format("--until {:g}: the run reaches {:g} s already\n    give a later time, in s or as in --until 0.4*ms",
                    *options_.until, end));
}

std::shared_ptr<const RunResult> Continuation::run(const Problem& problem, const RunRequest& request) {
  if (request.is_trial) return run_problem(problem, request);
  if (problem.name != state_->problem || request.case_name != state_->case_name)
    return result_of_other(problem, request);
  if (resumes()) return resume(problem, request);
  RunRequest going_on = request;
  going_on.continues = state_;
  going_on.pieces = kept_pieces(problem, *state_);
  going_on.start_from = nullptr;
  going_on.shared = nullptr;  // what changes may be more than members differ in
  take_folder(going_on);
  auto result = run_problem(changed(problem), going_on);
  is_done_ = true;
  return result;
}

// The same run once more: over what is known, and on.
std::shared_ptr<const RunResult> Continuation::resume(const Problem& problem, const RunRequest& request) {
  check_problem_is_same(problem, *state_);
  RunRequest going_on = request;
  take_folder(going_on);
  going_on.is_in_place = !has_record_;
  going_on.checkpoint = checkpoint_;
  going_on.pieces = kept_pieces(problem, *state_);
  const CheckpointIdentity& identity = *resumed_;
  going_on.from = identity.from;
  if (!identity.has_start) going_on.start_from = nullptr;
  if (identity.has_start && (!request.start_from || !request.start_from->interface_fields))
    throw InputError("the run started from another case's fields, which are missing: run the deck again");
  if (identity.kernels != request.identity.kernels || identity.state.program != program_version())
    warn("the run was begun on another processor or by another version of the program: its last digits may differ");
  say(problem.monolithic || problem.explicit_dynamics
          ? "  this solver stores nothing to resume from: the run starts again"
          : fmt::format("  {} increments are replayed", checkpoint_ ? checkpoint_->n_left() : 0));
  auto result = run_problem(problem, going_on);
  is_done_ = true;
  return result;
}

Problem Continuation::changed(Problem problem) const {
  if (problem.monolithic || problem.explicit_dynamics || problem.steps.size() != state_->steps.size())
    throw InputError("the deck declares another problem than that of the run");
  const Effort& last = state_->efforts.back();
  problem.solver.tolerance = options_.tolerance.value_or(last.tolerance);
  problem.solver.static_tolerance = static_tolerance(options_, last);
  problem.solver.spectra = 0.0;  // what is asked for now decides
  problem.solver.more_iterations = options_.more_iterations;
  if (problem.solver.precision == Precision::single_precision && problem.solver.tolerance < 1e-7)
    throw InputError(
        fmt::format("--tolerance {:g}: 'precision' = \"single\" of the deck allows no tolerance below 1e-7",
                    problem.solver.tolerance));
  const double duration = state_->steps.back().duration + (options_.until ? *options_.until - end_of(*state_) : 0.0);
  if (!problem.steps.back()->is_static && duration != problem.steps.back()->duration) {
    const std::vector<std::string> before = tuned_by_choice(problem);
    problem.steps.back() = extended(*problem.steps.back(), duration);
    if (const std::vector<std::string> now = tuned_by_choice(problem); now != before)
      warn(
          fmt::format("for the longer duration the automatic choice of tuned mass changes ({} instead of {}): earlier "
                      "results change within the mesh error; solver.latin{{ mass = \"tuned\" }} or "
                      "\"lumped\" in the deck fixes it",
                      now.empty() ? "none" : list_of_names(now), before.empty() ? "none" : list_of_names(before)));
  }
  check_problem_is_same(problem, *state_);
  return problem;
}

// The last step until --until, a whole number of dt.
StepPtr Continuation::extended(const Step& step, double duration) const {
  constexpr double implausible = 1000.0;
  if (duration > implausible * step.duration)
    throw InputError(
        fmt::format("--until {:g} (s) is {:.3g} times as long as step '{}' of the deck: was a unit forgotten, as "
                    "in --until 0.4*ms?",
                    *options_.until, duration / step.duration, step.name));
  auto longer = std::make_shared<Step>(step);
  longer->duration = std::round(duration / longer->dt) * longer->dt;
  if (std::abs(longer->duration - duration) > 1e-6 * longer->dt)
    say(fmt::format("  step '{}' is extended to {:g} s, a whole number of dt", longer->name,
                    end_of(*state_) + longer->duration - state_->steps.back().duration));
  if (const int more = longer->n_increments() - step.n_increments(); more > 0)
    say(fmt::format("  {} increments more than the deck's {}", more, step.n_increments()));
  return longer;
}

// Tables of a case that is not the one continued, as its folder has them.
std::shared_ptr<const RunResult> Continuation::result_of_other(const Problem& problem, const RunRequest& request) {
  const fs::path folder = out() / problem.name / request.case_name;
  const auto recorded = read_run_record(folder);
  if (!recorded && resumes()) {
    if (!is_in_its_place())  // a folder that somebody named would say what is written beside it
      throw InputError(fmt::format(
          "the deck also runs problem '{}', case '{}', whose results would be written to '{}': '{}' is not "
          "where that run was\n    give its folders their names: {}/{}",
          problem.name, request.case_name, folder.string(), options_.run.string(), state_->problem, state_->case_name));
    return run_problem(problem, request);  // what the run would have come to
  }
  if (!recorded) {
    if (!is_done_)
      throw InputError(fmt::format(
          "the deck runs problem '{}', case '{}' first, and its results are not in '{}': run the deck again",
          problem.name, request.case_name, folder.string()));
    ends_early_ = true;
    auto none = std::make_shared<RunResult>(*hollow_result(problem));
    none->interrupted = true;  // the deck stops here
    return none;
  }
  check_is_result_of(*recorded, problem, request.case_name, folder);
  auto result = std::make_shared<RunResult>();
  result->converged = recorded->converged;
  result->iterations = recorded->iterations;
  result->mean_iterations = recorded->mean_iterations;
  result->seconds["all"] = recorded->seconds;
  std::vector<std::string> steps;
  for (const StepPtr& step : problem.steps) steps.push_back(step->name);
  for (const OutputPtr& output : problem.outputs) {
    const fs::path file = folder / (file_name_of(output->name) + ".csv");
    if (output->columns().empty() || !fs::exists(file)) continue;
    const Table& table = result->tables[output.get()] = read_csv(file, steps);
    for (const Column& column : output->columns())
      if (!table.has_column(column.name))
        throw InputError(fmt::format("{} has no column '{}': it is not the table of output '{}'", file.string(),
                                     column.name, output->name));
    if (!recorded->interrupted) check_is_whole(table, problem, file);
  }
  if (resumes() && recorded->converged && fs::exists(folder / state_file_name))
    result->interface_fields = read_state(folder / state_file_name).fields;
  say(fmt::format("problem '{}', case '{}': read from {}", problem.name, request.case_name, folder.string()));
  return result;
}

}  // namespace dygita
