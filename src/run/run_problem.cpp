#include "run/run_problem.hpp"

#include <omp.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "base/log.hpp"
#include "base/progress.hpp"
#include "latin/latin.hpp"
#include "output/bolt_table.hpp"
#include "output/replacement.hpp"
#include "reference/explicit.hpp"
#include "reference/monolithic.hpp"
#include "result/collector.hpp"
#include "result/lumped_inertia.hpp"
#include "result/penetration_watch.hpp"
#include "result/scene_recorder.hpp"
#include "run/keep_state.hpp"
#include "run/part_lines.hpp"
#include "run/passes.hpp"
#include "run/run_files.hpp"
#include "run/run_warnings.hpp"
#include "solution/step_model.hpp"

namespace dygita {

namespace {

// "'flange' 4, 'plate' 16": the substructures that were cut.
std::string list_pieces(const Problem& problem, const std::vector<int>& pieces) {
  std::string list;
  for (size_t i = 0; i < pieces.size(); ++i)
    if (pieces[i] > 1)
      list += fmt::format("{}'{}' {}", list.empty() ? "" : ", ", problem.substructures[i]->name, pieces[i]);
  return list;
}

std::string list_names(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "'" : ", '") + name + "'";
  return list;
}

void summarise(const Problem& problem, const SolverFigures& figures, RunResult& result) {
  int increments = 0;
  for (size_t i = 0; i < figures.steps.size(); ++i) {
    const StepFigures& f = figures.steps[i];
    const Step& step = *problem.steps[i];
    result.steps.push_back({step.name, step.is_static, f.increments, f.not_converged, f.iterations, f.worst_indicator,
                            f.seconds, f.missed, f.explicit_parts, f.substeps, f.stable_step});
    result.iterations += f.iterations;
    increments += f.increments;
    if (f.not_converged > 0) result.converged = false;
  }
  result.mean_iterations = increments ? static_cast<double>(result.iterations) / increments : 0.0;
  result.interrupted = figures.interrupted;
  result.n_dofs = figures.n_dofs;
  result.n_interface_unknowns = figures.n_interface_unknowns;
  result.seconds = figures.seconds;
  result.pieces = figures.pieces;
  static_cast<OwnFigures&>(result.figures) = figures.own;
  result.figures.factor_memory = figures.factor_bytes / 1e6;
  result.figures.gap_difference = figures.gap_difference;
}

void say_summary(const Problem& problem, const RunResult& result, const std::filesystem::path& directory,
                 double seconds) {
  if (const std::string pieces = list_pieces(problem, result.pieces); !pieces.empty())
    say("  cut into pieces: " + pieces);
  for (const StepSummary& step : result.steps) {
    std::string line =
        fmt::format("  {} '{}': {} increments, {:.1f} {} each, {:.2f} s", step.is_static ? "static" : "dynamic",
                    step.name, step.increments, step.increments ? double(step.iterations) / step.increments : 0.0,
                    problem.explicit_dynamics && !step.is_static ? "substeps" : "iterations", step.seconds);
    if (!step.explicit_parts.empty())
      line += fmt::format("; explicit: {}, {} substep{} of each dt", list_names(step.explicit_parts), step.substeps,
                          step.substeps == 1 ? "" : "s");
    if (step.increments_not_converged > 0)
      line += fmt::format("; {} NOT CONVERGED (worst indicator {:.1e})", step.increments_not_converged,
                          step.worst_indicator);
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
  if (figures.mesh_error)
    say(fmt::format(
        "  estimated errors (energy norm, {:.3g} kHz on average): {} {:.2g} %, time step {:.2g} %, mesh {:.2g} %",
        figures.mean_frequency.value() / 1e3, figures.penalty_error ? "penalty" : "iteration",
        (figures.penalty_error ? figures.penalty_error : figures.iteration_error).value(),
        figures.time_step_error.value(), *figures.mesh_error));
  if (figures.static_mesh_error)
    say(fmt::format("  estimated errors of static steps: iteration {:.2g} %, mesh {:.2g} %",
                    figures.static_iteration_error.value(), *figures.static_mesh_error));
  for (const OutputPtr& output : problem.outputs)
    for (const std::string& line : result.findings_of(*output).lines) say("  " + line);
  if (!directory.empty()) say(fmt::format("  {:.2f} s in all; results in {}", seconds, directory.string()));
}

// Solves all steps once; tables and figures; scenes for the report where `keeps_scenes`.
std::shared_ptr<RunResult> sweep(const Problem& problem, const InterfaceFields* start_from, const FrameSink& sink,
                                 bool keeps_scenes) {
  Collector collector(problem, sink);
  SceneRecorder scenes(problem);
  PenetrationWatch watch(problem);
  Observers observers({&collector, &watch});
  if (keeps_scenes) observers.add(scenes);
  auto result = std::make_shared<RunResult>();
  const SolverFigures figures = problem.explicit_dynamics ? solve_explicit(problem, observers)
                                : problem.monolithic      ? solve_monolithic(problem, observers)
                                                          : solve(problem, observers, start_from);
  result->interface_fields = figures.interface_fields;
  summarise(problem, figures, *result);
  collector.finish(*result);
  watch.finish();
  if (keeps_scenes) scenes.finish(*result);
  return result;
}

// The first file that cannot be written. A frame ends the run after its increment, and whatever else can be written is:
// what has been computed is worth more than what would follow.
class Unwritten {
 public:
  void attempt(const std::function<void()>& write) {
    try {
      write();
    } catch (const InputError& error) {
      if (error_.empty()) error_ = error.what();
    }
  }
  void attempt_frame(RunWriter& writer, const Frame& frame) {
    if (!error_.empty()) return;
    attempt([&] { writer.write_frame(frame); });
    if (!error_.empty()) request_interrupt();
  }
  // Throws what went wrong, once everything else is written.
  void finish(const std::filesystem::path& directory, bool is_replacing) const {
    if (error_.empty()) return;
    withdraw_interrupt();
    throw InputError(error_ + (is_replacing
                                   ? "\n    the results in " + directory.string() + " are as they were"
                                   : "\n    what was computed and could be written is in " + directory.string()));
  }

 private:
  std::string error_;
};

}  // namespace

std::shared_ptr<const RunResult> run_problem(const Problem& declared, const RunRequest& request) {
  const auto start = std::chrono::steady_clock::now();
  if (request.threads > 0) omp_set_num_threads(request.threads);
  check_problem(declared);
  say(fmt::format("problem '{}', case '{}': {} substructures, {} interfaces, {} steps", declared.name,
                  request.case_name, declared.substructures.size(), declared.interfaces.size(), declared.steps.size()));
  std::optional<Replacement> replacement;
  if (!request.replaces.empty()) replacement.emplace(request.replaces);
  const std::filesystem::path directory =
      replacement ? request.replaces : request.out / declared.name / request.case_name;
  std::unique_ptr<RunWriter> writer;
  FrameSink sink;
  Unwritten unwritten;
  if (request.write_files && request.write_frames)
    sink = [&](const Frame& frame) { unwritten.attempt_frame(*writer, frame); };
  const std::vector<double> tolerances = pass_tolerances(declared);
  Problem problem = declared;  // with the tolerance of the pass
  std::shared_ptr<RunResult> result, before;
  for (size_t pass = 0; pass < tolerances.size(); ++pass) {
    problem.solver.tolerance = tolerances[pass];
    // A new writer takes away the frames of the pass before; the first of several is never the last.
    writer.reset();
    if (request.write_files)
      writer = std::make_unique<RunWriter>(replacement ? replacement->work() : directory, problem.name);
    result = sweep(problem, before ? before->interface_fields.get() : start_of(request),
                   pass > 0 || tolerances.size() == 1 ? sink : nullptr, writer != nullptr);
    if (before) add_pass(*before, *result);
    if (result->interrupted || (before && have_settled(problem, *before, *result))) break;
    before = result;
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result->seconds["all"] = seconds;
  const RunState state =
      (writer && request.write_state) || request.continues ? state_of(problem, request, *result) : RunState{};
  if (request.continues) {
    long earlier = 0;
    for (const Effort& effort : request.continues->efforts) earlier += effort.iterations;
    result->figures.earlier_iterations = static_cast<double>(earlier);
  }
  const bool is_kept = !request.continues || reaches_as_far(state, *request.continues);
  if (writer && request.write_state && is_kept) unwritten.attempt([&] { keep_state(state, *writer, *result); });
  warn_of_run(problem, *result, writer && request.write_state && is_kept ? directory : std::filesystem::path());
  warn_of_stresses(problem, *result);
  const std::vector<std::string> warnings = take_warnings();
  RunIdentity identity = request.identity;
  identity.threads = omp_get_max_threads();
  identity.case_name = request.case_name;
  if (writer)
    unwritten.attempt([&] {
      write_view(*writer, problem, directory);
      write_run_files(*writer, problem, *result, identity, warnings);
    });
  unwritten.finish(directory, replacement.has_value());
  if (replacement && is_kept) replacement->commit();
  if (request.continues) say(continuation_line(*request.continues, *result));
  say_summary(problem, *result, writer && is_kept ? directory : std::filesystem::path(), seconds);
  if (!is_kept)
    say(fmt::format("  stopped before it reached what '{}' holds already: that is as it was", directory.string()));
  return result;
}

std::string check_report(const Problem& problem) {
  check_problem(problem);
  const std::vector<Surface> surfaces = make_surfaces(problem);
  doubt_neighbours(problem, surfaces);
  doubt_lumped_inertia(problem);
  State state = initial_state(problem, surfaces);
  long n_dofs = 0;
  std::string text = fmt::format("problem '{}'\n", problem.name);
  for (const SubstructurePtr& part : problem.substructures) {
    check_mesh(*part->mesh, part->name);
    n_dofs += 3L * part->mesh->n_nodes();
    text += part_line(*part);
  }
  text += mass_line(problem);
  for (const Surface& surface : surfaces) text += surface_line(surface);
  long increments = 0;
  double bytes = 0.0;
  const bool is_latin = !problem.monolithic && !problem.explicit_dynamics;
  const CutPtr cut = is_latin ? make_cut(problem, surfaces) : no_cut(problem);
  if (const std::string pieces = list_pieces(problem, cut->counts()); !pieces.empty())
    text += "  cut into pieces: " + pieces + "\n";
  const std::vector<Body> bodies = make_bodies(problem, surfaces, *cut);
  for (const StepPtr& step : problem.steps) {
    if (problem.explicit_dynamics && !step->is_static) {
      const ExplicitSize size = predict_explicit(problem, *step, surfaces, bodies, state);
      text += fmt::format(
          "  dynamic step '{}': {} increments of {:.4g} us in {} substeps each (critical time step {:.4g} us), {:.4g} "
          "MB\n",
          step->name, step->n_increments(), step->dt * 1e6, size.n_substeps, size.critical * 1e6, size.bytes / 1e6);
      increments += step->n_increments();
      bytes = std::max(bytes, size.bytes);
      continue;
    }
    const StepSize size = predict_step(problem, *step, surfaces, bodies, state, cut);
    text += fmt::format("  {} step '{}': {} increments{}, {} interface unknowns, {:.4g} MB\n",
                        step->is_static ? "static" : "dynamic", step->name, step->n_increments(),
                        step->is_static ? "" : fmt::format(" of {:.4g} us", step->dt * 1e6), size.n_unknowns,
                        size.bytes / 1e6);
    if (const std::string how = describe(size.integration, problem, *step); !how.empty()) text += "    " + how + "\n";
    increments += step->n_increments();
    bytes = std::max(bytes, size.bytes);
  }
  double matrices = 0.0;
  for (const Body& body : bodies) matrices += 12.0 * static_cast<double>(body.matrices->stiffness.nonZeros());
  return text + fmt::format(
                    "  {} degrees of freedom, {} increments in all, {:.4g} MB for factors and interface operators, "
                    "{:.4g} MB for "
                    "matrices; nothing was solved\n",
                    n_dofs, increments, bytes / 1e6, matrices / 1e6);
}

}  // namespace dygita
