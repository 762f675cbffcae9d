// The steps of a problem one after the other, each from the state that the last one left.
#include <chrono>
#include <optional>
#include <utility>

#include "base/aside.hpp"
#include "base/progress.hpp"
#include "base/task.hpp"
#include "latin/search_direction.hpp"
#include "marching/shared_trail.hpp"
#include "marching/sharing.hpp"
#include "marching/step_run.hpp"
#include "numerics/factor.hpp"
#include "ranks/machine_copies.hpp"
#include "step/step_ends.hpp"
#include "step/stopped_run.hpp"

namespace dygita {

namespace {

// What a run of several steps has kept and spared.
void tell_run(const std::shared_ptr<const InterfaceFields>& kept, SolverFigures& figures) {
  figures.interface_fields = kept;
  figures.own.fields_in_memory = kept->memory_bytes() / 1e6;
  figures.own.fields_in_file = kept->file_bytes() / 1e6;
  figures.own.substitutions = static_cast<double>(figures.n_solved);
  figures.own.substitutions_spared = static_cast<double>(figures.n_spared);
  figures.own.pieces_in_full = figures.n_in_full;
  figures.own.shared_factors = figures.n_equal;
}

// One process, and a deck that does not say how.
bool may_go_in_one(const Problem& problem, const StepModel& model) {
  return ranks::is_alone() && model.scheme.is_static && !model.is_assembled && fits_in_one(problem);
}

CutPtr cut_into_pieces(const Problem& problem, const std::vector<Surface>& surfaces, const SharePlan& plan) {
  const LikePages like;
  return make_cut(problem, surfaces, plan);
}

void share_on_machine(const Problem& problem, const Cut& cut) {
  const auto share = [](const MeshPtr& mesh) { share_on_machine(mesh, mesh->arrays()); };
  for (const SubstructurePtr& part : problem.substructures) share(part->mesh);
  for (const CutPiece& piece : cut.pieces()) share(piece.body->mesh);
  dygita::share_on_machine(cut.arrays());
}

void make_operators(const Problem& problem, const std::vector<Surface>& surfaces, SharedOperators& operators,
                    const SharePlan& plan) {
  if (operators.are_made()) return;
  try {
    const MayBeAbandoned may(ranks::is_alone());
    const CutPtr cut = cut_into_pieces(problem, surfaces, plan);
    share_on_machine(problem, *cut);
    operators.make_for(problem, surfaces, cut);
  } catch (const Abandoned&) {
    throw Interrupted();
  }
}

}  // namespace

SolverFigures solve(const Problem& problem, Observer& observer, StartFields start_from, Trail* kept_trail,
                    const Setting& setting) {
  using clock = std::chrono::steady_clock;
  auto start = clock::now();
  const auto lap = [&] {
    return std::chrono::duration<double>(clock::now() - std::exchange(start, clock::now())).count();
  };
  prepare_thread();
  SharedTrail shared_trail(kept_trail);
  Trail* const trail = ranks::is_alone() ? kept_trail : ranks::any(kept_trail) ? &shared_trail : nullptr;
  const ranks::Traffic traffic_before = ranks::traffic();
  const std::vector<Surface> surfaces = make_surfaces(problem, setting.shared && setting.shared->are_made());
  SharedOperators own;
  const bool shares = setting.shared && setting.shared->serve(problem, surfaces);
  SharedOperators& operators = shares ? *setting.shared : own;
  make_operators(problem, surfaces, operators, setting.plan);
  const CutPtr& cut = operators.cut();
  const std::vector<Body>& bodies = operators.bodies();
  State state = initial_state(problem, surfaces, *cut);
  auto kept = std::make_shared<InterfaceFields>(problem.solver.history_memory);
  SolverFigures figures;
  figures.pieces = cut->counts();
  figures.seconds["assemble"] = lap();
  try {
    for (const StepPtr& step : problem.steps) {
      if (ranks::any(interrupt_requested())) break;
      std::optional<MayBeAbandoned> until_it_runs(std::in_place, ranks::is_alone());
      StepModel model = make_step_model(problem, *step, surfaces, state, operators);
      if (ranks::any(interrupt_requested())) break;  // the factorisation may have taken long
      const InterfaceFields* const start_fields = start_from.of_step(figures.steps.size());
      const StepSettings settings = step_settings(problem, model, start_fields != nullptr);
      start_step(model, state);
      if (step == problem.steps.back() && !shares) give_up_matrices(bodies);
      const Vec k = search_directions(model, problem.solver.search_direction, settings.window);
      fix_search_directions(model, k);
      RunFiles files{state, observer, start_fields, *kept, trail};
      if (shares) files.coarse = &operators.coarse_of_step(figures.steps.size());
      if (may_go_in_one(problem, model))
        files.pieces_in_one = [&bodies](const StepModel& of) { return make_assembled_pieces(of, bodies); };
      StepRun run(settings, model, k, files);
      until_it_runs.reset();
      figures.seconds["factor"] += lap();
      figures.stopped_by = run_as_far_as_it_goes(run, figures);
      if (!figures.stopped_by && !run.is_left_unsolved()) end_step(model, state);
      figures.steps.push_back(run.figures());
      figures.steps.back().seconds = lap();
      figures.free.push_back(model.what_is_free());
      run.add_to(figures);
      if (figures.stopped_by) break;
      if (shares) operators.keep(figures.steps.size() - 1, model);
    }
  } catch (const Abandoned&) {  // before the step has begun
  }
  tell_run(kept, figures);
  tell_ranks(surfaces, *cut, traffic_before, figures);
  figures.interrupted = figures.stopped_by || ranks::any(interrupt_requested());
  return figures;
}

}  // namespace dygita
