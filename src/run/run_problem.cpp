#include "run/run_problem.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <new>
#include <optional>

#include "base/log.hpp"
#include "base/memory.hpp"
#include "base/name_list.hpp"
#include "base/progress.hpp"
#include "base/team.hpp"
#include "checks/check_problem.hpp"
#include "files/bolt_table.hpp"
#include "files/files.hpp"
#include "files/replacement.hpp"
#include "marching/solve.hpp"
#include "model/own_files.hpp"
#include "numerics/blas_buffers.hpp"
#include "recording/collector.hpp"
#include "recording/part_watch.hpp"
#include "reduction/lumped_inertia.hpp"
#include "reference/explicit.hpp"
#include "reference/monolithic.hpp"
#include "result/limits.hpp"
#include "run/checkpoints.hpp"
#include "run/earlier_run.hpp"
#include "run/error_lines.hpp"
#include "run/frame_files.hpp"
#include "run/keep_state.hpp"
#include "run/part_lines.hpp"
#include "run/passes.hpp"
#include "run/run_files.hpp"
#include "run/run_warnings.hpp"
#include "run/share_plan.hpp"
#include "run/shared_result.hpp"
#include "step/rank_observer.hpp"
#include "step/step_model.hpp"
#include "watch/joint_scene_recorder.hpp"
#include "watch/part_frames.hpp"
#include "watch/penetration_watch.hpp"
#include "watch/scene_recorder.hpp"

namespace dygita {

namespace {

void summarise(const Problem& problem, const SolverFigures& figures, RunResult& result) {
  int increments = 0;
  for (size_t i = 0; i < figures.steps.size(); ++i) {
    const StepFigures& f = figures.steps[i];
    const Step& step = *problem.steps[i];
    result.steps.push_back({step.name, step.is_static, f.increments, f.not_converged, f.iterations, f.worst_indicator,
                            f.seconds, f.missed, f.explicit_parts, f.substeps, f.stable_step, f.diagonal_parts,
                            f.tuned_parts, f.phases});
    result.iterations += f.iterations;
    increments += f.increments;
    if (f.not_converged > 0) result.converged = false;
  }
  result.mean_iterations = increments ? static_cast<double>(result.iterations) / increments : 0.0;
  result.interrupted = figures.interrupted;
  result.stopped_by = figures.stopped_by;
  result.n_dofs = figures.n_dofs;
  result.n_interface_unknowns = figures.n_interface_unknowns;
  result.seconds = figures.seconds;
  result.pieces = figures.pieces;
  result.sharing = figures.sharing;
  result.free = figures.free;
  static_cast<OwnFigures&>(result.figures) = figures.own;
  result.figures.factor_memory = figures.factor_bytes / 1e6;
  result.figures.gap_difference = figures.gap_difference;
}

// A balance that is open by this much makes every figure doubtful, though each increment has converged.
bool can_be_relied_on(const Figures& figures) {
  return std::max(figures.energy_imbalance.value_or(0.0), figures.static_imbalance.value_or(0.0)) <=
         limit::open_balance;
}

// What is not lumped of explicit substructures.
std::string mass_of(const StepSummary& step) {
  std::string text;
  if (!step.tuned_parts.empty())
    text = step.tuned_parts.size() == step.explicit_parts.size() ? ", tuned mass"
                                                                 : ", tuned mass in " + list_of_names(step.tuned_parts);
  return step.diagonal_parts.empty() ? text : text + ", diagonal mass in cells of order two";
}

std::string what_is_free(const FreeStep& step) {
  const auto vector = [](const Vec3& v) { return fmt::format("({:.4g}, {:.4g}, {:.4g})", v[0], v[1], v[2]); };
  if (step.relief)
    return fmt::format("; accelerated by {} m/s^2 and {} rad/s^2", vector(step.relief->linear),
                       vector(step.relief->angular));
  return step.is_whole ? "; nothing holds the assembly" : "";
}

void say_summary(const Problem& problem, const RunResult& result, const std::filesystem::path& directory,
                 double seconds) {
  if (const std::string pieces = list_pieces(problem, result.pieces); !pieces.empty())
    say("  cut into pieces: " + pieces);
  warn_of_uncut(problem, result.pieces);
  for (const StepSummary& step : result.steps) {
    std::string line =
        fmt::format("  {} '{}': {} increment{}, {:.1f} {} each, {:.2f} s", step.is_static ? "static" : "dynamic",
                    step.name, step.increments, step.increments == 1 ? "" : "s",
                    step.increments ? double(step.iterations) / step.increments : 0.0,
                    problem.explicit_dynamics && !step.is_static ? "substeps" : "iterations", step.seconds);
    if (!step.explicit_parts.empty())
      line += fmt::format("; explicit{}: {}, {} substep{} of each dt", mass_of(step),
                          list_of_names(step.explicit_parts), step.substeps, step.substeps == 1 ? "" : "s");
    if (const auto i = static_cast<size_t>(&step - result.steps.data()); i < result.free.size())
      line += what_is_free(result.free[i]);
    if (step.increments_not_converged > 0)
      line +=
          fmt::format("; {} NOT CONVERGED ({})", step.increments_not_converged,
                      std::isfinite(step.worst_indicator) ? fmt::format("worst indicator {:.1e}", step.worst_indicator)
                                                          : "parts have moved too far");
    say(line);
  }
  for (const std::string& line : bolt_lines(problem, result)) say(line);
  if (const std::string line = stress_line(problem, result); !line.empty()) say(line);
  const Figures& figures = result.figures;
  const double lost = figures.numerical_dissipation.value();
  say(fmt::format("  energy balance closes within {:.3g} %, ", figures.energy_imbalance.value()) +
      (problem.explicit_dynamics
           ? fmt::format("penalty springs hold up to {:.3g} %", lost)
           : fmt::format("numerical dissipation {:.3g} %, energy gain {:.3g} %", lost, figures.energy_gain.value())));
  if (figures.static_imbalance)
    say(fmt::format("  that of static steps within {:.3g} %, numerical dissipation {:.3g} %, energy gain {:.3g} %",
                    *figures.static_imbalance, figures.static_dissipation.value(), figures.static_gain.value()));
  for (const std::string& line : error_lines(problem, result)) say(line);
  for (const OutputPtr& output : problem.outputs)
    for (const std::string& line : result.findings_of(*output).lines) say("  " + line);
  if (!directory.empty()) say(fmt::format("  {:.2f} s in all; results in {}", seconds, directory.string()));
}

// Set aside while a run computes; what each thread takes in BLAS, where OpenBLAS retries without limit if it cannot
// have it.
constexpr std::size_t memory_for_results = 4 * heap_growth, memory_of_thread = std::size_t{136} << 20;

// What LATIN is given besides the problem.
struct Given {
  StartFields start_from;
  Trail* trail;
  Setting setting;
};

// Solves all steps once; tables and figures; scenes for the report where `keeps_scenes`. Of several ranks the first has
// them.
std::shared_ptr<RunResult> sweep(const Problem& problem, const Given& given, FrameFiles* files, bool keeps_scenes) {
  PartWatch parts(problem);
  PartFrames frames(problem, parts.views(), [&](const Frame& frame) { files->write(frame); });
  Collector collector(problem, parts, files ? FrameSink([&](const Frame& frame) { frames.begin(frame); }) : nullptr);
  SceneRecorder scenes(problem, parts.views(), parts.stresses());
  JointSceneRecorder joint_scenes(problem);
  PenetrationWatch watch(problem);
  Observers here({&collector, &watch});
  if (keeps_scenes) here.add(joint_scenes);
  RankObserver first(here);
  Observers observers({&parts, &first});
  if (files) observers.add(frames);
  if (keeps_scenes) observers.add(scenes);
  auto result = std::make_shared<RunResult>();
  require_memory(memory_for_results + static_cast<std::size_t>(thread_limit()) * memory_of_thread);
  take_blas_buffers(thread_limit());
  MemoryReserve reserve(memory_for_results);
  const SolverFigures figures = problem.explicit_dynamics ? solve_explicit(problem, observers)
                                : problem.monolithic
                                    ? solve_monolithic(problem, observers)
                                    : solve(problem, observers, given.start_from, given.trail, given.setting);
  reserve.release();
  parts.settle();
  result->interface_fields = figures.interface_fields;
  if (keeps_scenes) scenes.finish(joint_scenes.take(), *result);
  if (!ranks::is_first()) return result;
  summarise(problem, figures, *result);
  collector.finish(*result);
  result->converged &= can_be_relied_on(result->figures);
  watch.finish();
  return result;
}

// Where a run's files go, and the command that resumes it if it is stopped.
struct RunSite {
  RunSite(const Problem& problem, const RunRequest& request)
      : directory(request.replaces.empty() ? request.out / problem.name / request.case_name : request.replaces),
        lock(request.lock || !request.write_files ? request.lock : own_lock(problem, request)) {
    if (!request.replaces.empty() && !request.is_in_place)
      replacement.emplace(request.replaces, std::vector<std::string>{own_file::checkpoint, own_file::going_on},
                          ranks::is_first());
    work = replacement ? replacement->work() : directory;
  }

  std::filesystem::path directory, work;
  std::shared_ptr<RunLock> lock;
  std::optional<Replacement> replacement;
  std::shared_ptr<CheckpointFile> checkpoint;  // rank 0's
  std::shared_ptr<Trail> part;                 // another's part of it
  std::unique_ptr<RunWriter> writer;           // null: nothing is written
  std::optional<EarlierRun> earlier;           // whose static steps these start from
  SharePlan plan;
  Unwritten unwritten;
  bool is_kept = true;  // false: what is in the folder reaches further

  // In a folder from somebody else these would lead to a third one.
  std::shared_ptr<RunLock> own_lock(const Problem& problem, const RunRequest& request) const {
    if (request.replaces.empty()) refuse_links(request.out, std::filesystem::path(problem.name) / request.case_name);
    return std::make_shared<RunLock>(directory);
  }

  // Does its checkpoint stay, to go on from?
  bool can_go_on(const RunResult& result) const {
    return checkpoint && checkpoint->has_entries() && (result.interrupted || !unwritten.is_empty());
  }
};

// A new writer takes away the frames of the pass before; the first of several is never the last.
void open_files(const Problem& declared, const RunRequest& request, bool is_first_pass, RunSite& site) {
  site.writer.reset();
  if (!request.write_files) return;
  if (is_first_pass && !request.checkpoint && !site.replacement) remove_checkpoint(site.work);
  site.writer = std::make_unique<RunWriter>(site.work, declared.name);
  if (is_first_pass) site.checkpoint = checkpoint_of(declared, request, site.work);
}

SharedOperators* shared_operators(const RunRequest& request, double tolerance) {
  if (!request.shared) return nullptr;
  std::shared_ptr<SharedOperators>& of_pass = (*request.shared)[tolerance];
  if (!of_pass) of_pass = std::make_shared<SharedOperators>();
  return of_pass.get();
}

// All passes over the steps; what is written meanwhile are frames.
std::shared_ptr<RunResult> compute(const Problem& declared, const RunRequest& request, Problem& problem,
                                   RunSite& site) {
  const bool has_frames = ranks::any(request.write_files && request.write_frames);
  const std::vector<double> tolerances = pass_tolerances(declared);
  std::shared_ptr<RunResult> result, before;
  for (size_t pass = 0; pass < tolerances.size(); ++pass) {
    problem.solver.tolerance = tolerances[pass];
    open_files(declared, request, pass == 0, site);
    if (pass == 0) site.part = part_of_checkpoint(site.checkpoint.get(), request.checkpoint_every);
    std::optional<FrameFiles> files;
    if (has_frames && (pass > 0 || tolerances.size() == 1)) files.emplace(site.writer.get(), site.unwritten);
    const StartFields start = before         ? StartFields(before->interface_fields.get())
                              : site.earlier ? site.earlier->fields_for(declared)
                                             : StartFields(start_of(request));
    const Given given{start, ranks::is_first() ? site.checkpoint.get() : site.part.get(),
                      Setting{site.plan, shared_operators(request, tolerances[pass])}};
    result = sweep(problem, given, files ? &*files : nullptr, ranks::any(site.writer != nullptr));
    share_result(problem, *result);
    if (before) add_pass(*before, *result);
    if (result->interrupted || (before && have_settled(problem, *before, *result))) break;
    before = result;
  }
  return result;
}

// State, tables, pictures, report and, last of all, the record.
void write_results(const Problem& problem, const RunRequest& request, RunSite& site, RunResult& result) {
  RunState state =
      (site.writer && request.write_state) || request.continues ? state_of(problem, request, result) : RunState{};
  if (request.continues) {
    long earlier = 0;
    for (const Effort& effort : request.continues->efforts) earlier += effort.iterations;
    result.figures.earlier_iterations = static_cast<double>(earlier);
    site.is_kept = reaches_as_far(state, *request.continues);
  } else if (site.replacement && site.checkpoint) {
    site.is_kept = site.checkpoint->n_left() == 0;
  }
  const bool keeps_state = site.writer && request.write_state && site.is_kept;  // of the first rank
  KeptParts parts = keep_parts(state, keeps_state ? site.writer.get() : nullptr, result);
  collect_warnings();
  if (!ranks::is_first()) return;
  if (keeps_state)
    site.unwritten.attempt([&] { keep_state(state, std::move(parts), *site.writer, site.can_go_on(result), result); });
  warn_of_run(problem, result, keeps_state ? site.directory : std::filesystem::path());
  warn_of_stresses(problem, result);
  const std::vector<std::string> warnings = take_warnings();
  RunIdentity identity = request.identity;
  identity.threads = thread_limit();
  identity.case_name = request.case_name;
  if (!site.writer) return;
  site.unwritten.attempt([&] { write_run_files(*site.writer, problem, result, identity, warnings); });
  site.unwritten.attempt([&] { write_view(*site.writer, problem, site.directory); });
}

// The new results take their place; a run that has come to its end needs no checkpoint, another keeps its own.
void settle(const RunRequest& request, const RunResult& result, RunSite& site) {
  if (site.checkpoint && result.interrupted) site.checkpoint->sync();
  site.unwritten.finish(site.directory, site.replacement.has_value(),
                        site.can_go_on(result)
                            ? fmt::format("\n    once there is space, continue with: dygita continue {}",
                                          shell_word(site.directory.string()))
                            : "");
  if (site.replacement && site.is_kept) {
    if (request.continues) remove_checkpoint(site.work);
    if (request.checkpoint && result.interrupted) share_checkpoint(site.directory, site.work);
    site.replacement->commit();
  } else if (!site.replacement && site.checkpoint && !result.interrupted) {
    remove_checkpoint(site.directory);
  }
}

void start_from_earlier(const Problem& problem, RunRequest& request, RunSite& site) {
  site.earlier.emplace(request.from, site.directory);
  request.from = site.earlier->folder();
  request.identity.from = request.from.string();
  if (request.pieces.empty()) request.pieces = site.earlier->pieces_for(problem);
}

// What the user is to know of a run that did not come to its end. Throws the error that ended it.
void tell_stop(const RunResult& result, const RunSite& site) {
  const std::string folder = site.directory.string();
  if (!site.is_kept)
    say(fmt::format("  stopped before reaching the results already in '{}', which are unchanged", folder));
  if (result.stopped_by) {
    withdraw_interrupt();
    rethrow(result.stopped_by, !site.writer    ? ""
                               : !site.is_kept ? "\n    the results in " + folder + " are unchanged"
                                               : "\n    earlier results are in " + folder);
  }
  if (result.interrupted && site.checkpoint)
    say(fmt::format("  stopped; continue with:\n    dygita continue {}", shell_word(folder)));
}

// Not even the results found room: what the checkpoint has is not lost.
[[noreturn]] void tell_lack_of_memory(RunSite& site) {
  std::string text = "not enough memory on this machine; dygita check reports what a problem needs";
  if (site.checkpoint && site.checkpoint->has_entries()) {
    site.checkpoint->sync();
    text += fmt::format("\n    results so far are kept; with more memory, continue with: dygita continue {}",
                        shell_word(site.directory.string()));
  }
  throw NumericalError(text);
}

}  // namespace

std::shared_ptr<const RunResult> run_problem(const Problem& declared, const RunRequest& asked) {
  const auto start = std::chrono::steady_clock::now();
  if (asked.threads > 0) set_thread_limit(asked.threads);
  check_ranks(declared);
  check_problem(declared);
  check_ranks_agree(declared);
  doubt_slow_turning(declared);
  say(fmt::format("problem '{}', case '{}': {} substructures, {} interfaces, {} steps", declared.name, asked.case_name,
                  declared.substructures.size(), declared.interfaces.size(), declared.steps.size()));
  for (const std::string& line : base_lines(declared)) say(line);
  RunSite site(declared, asked);
  RunRequest request = asked;
  if (!asked.from.empty()) start_from_earlier(declared, request, site);
  site.plan = plan_of(declared, request, site.directory);
  request.pieces = site.plan.n_pieces;
  Problem problem = declared;  // with the tolerance of the pass
  std::shared_ptr<RunResult> result;
  double seconds = 0.0;
  try {
    result = compute(declared, request, problem, site);
    result->seconds["all"] = seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    write_results(problem, request, site, *result);
  } catch (const std::bad_alloc&) {
    tell_lack_of_memory(site);
  }
  if (!ranks::is_first()) {
    ranks::any(false);  // what the deck does next may end all: not before rank 0 has written
    return result;
  }
  settle(request, *result, site);
  ranks::any(false);
  if (request.continues) say(continuation_line(*request.continues, *result));
  say_summary(problem, *result, site.writer && site.is_kept ? site.directory : std::filesystem::path(), seconds);
  tell_stop(*result, site);
  return result;
}

}  // namespace dygita
