#include "latin/step_run.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/log.hpp"
#include "latin/search_direction.hpp"
#include "solution/step_ends.hpp"

namespace dygita {

namespace {

// Defaults of the manual's table, where the deck says nothing.
int anderson_depth(const LatinSettings& s, bool is_static) {
  return s.anderson >= 0 ? s.anderson : is_static ? 40 : 10;
}
double relaxation(const LatinSettings& s, bool is_static) {
  return s.relaxation > 0.0 ? s.relaxation : is_static ? 0.8 : 0.95;
}

// Steps of a window: 1 in a static step.
int window_length(const LatinSettings& s, const Step& step) {
  const int n = step.n_increments();
  return step.is_static ? 1 : s.window == 0 ? n : std::min(s.window, n);
}

LocalStage make_local_stage(const Problem& problem, StepModel& model, const State& state) {
  const Vec k = search_directions(model, problem.solver.search_direction, window_length(problem.solver, *model.step));
  for (const bool has_twin : {false, true})  // those whose operators others share come first
    parallel_for(static_cast<int>(model.pieces.size()), [&](int i) {
      Piece& piece = *model.pieces[i];
      if ((piece.setup().twin != nullptr) == has_twin)
        piece.set_search_directions(k.segment(model.offset[i], piece.n_rows()), problem.solver.plain);
    });
  return LocalStage(model, state, k);
}

}  // namespace

StepRun::StepRun(const Problem& problem, StepModel& model, State& state, Observer& observer,
                 const InterfaceFields* start_from, InterfaceFields& kept)
    : problem_(problem),
      model_(model),
      state_(state),
      observer_(observer),
      start_from_(start_from),
      kept_(kept),
      i_step_(index_of(problem.steps, model.step)),
      local_((start_step(model, state), make_local_stage(problem, model, state))),
      warm_start_(nullptr, 0, {}),
      anderson_(0, 0, 1.0, {}),
      indicator_(0.0) {
  kept_.begin_step();
  const LatinSettings& s = problem.solver;
  const bool is_static = model.scheme.is_static;
  window_ = window_length(s, *model.step);
  max_iterations_ = s.max_iterations;
  is_going_on_ = start_from && s.more_iterations > 0;
  tolerance_ = is_static ? s.static_tolerance : s.tolerance;
  window_relaxation_ = s.relaxation > 0.0 ? s.relaxation : 0.8;
  window_depth_ = s.anderson >= 0 ? s.anderson : window_ > 20 ? 0 : 5;
  Vec k(model.n_q());
  for (size_t i = 0; i < model.pieces.size(); ++i)
    k.segment(model.offset[i], model.pieces[i]->n_rows()) = model.pieces[i]->k();
  weight_ = k.cwiseSqrt().cwiseInverse();
  if (window_ == 1 && s.anderson != 0 && needs_coarse_correction(model_)) coarse_ = CoarseCorrection(model_, k);
  if (is_static) indicator_ = Indicator(k.sum() * assembly_size() * assembly_size());
  warm_start_ = WarmStart(start_from, i_step_, weight_);
  anderson_ = Anderson(anderson_depth(s, is_static), is_static ? 0 : 20, relaxation(s, is_static), weight_);
  q_ = local_.initial_q();
  velocity_ = Vec::Zero(q_.size());
  energy_.resize(model.pieces.size());
  observer_.begin_step(instant(-1, 0, 0.0));
}

// The first iteration only hears what the kept fields are worth.
StepRun::Goal StepRun::goal_of(bool has_start) const {
  if (!is_going_on_ || !has_start) return {tolerance_, max_iterations_};
  return {round_off(), 1 + problem_.solver.more_iterations};
}

// Indicator below which iterations change rounding errors only.
double StepRun::round_off() const {
  const bool is_single = std::any_of(model_.pieces.begin(), model_.pieces.end(), [](const auto& piece) {
    return piece->setup().precision == Precision::single_precision;
  });
  return is_single ? 1e-8 : 1e-13;
}

StepRun::Start StepRun::remember() const {
  Start start{{}, local_};
  for (const auto& piece : model_.pieces) start.pieces.push_back(piece->snapshot());
  return start;
}

void StepRun::go_back(const Start& start) {
  for (size_t i = 0; i < start.pieces.size(); ++i) model_.pieces[i]->restore(start.pieces[i]);
  local_ = start.local;
}

void StepRun::accept_increment(int increment, int iterations, double eta) {
  {
    const Stopwatch watch(seconds_.accept);
    local_.accept(&state_);
  }
  Energies& energies = state_.energies;
  book_increment(energy_, energies);
  if (!std::isfinite(energies.kinetic + energies.strain + energies.loads))
    throw NumericalError(fmt::format(
        "step '{}', increment {} (t = {:.6g} s): the energies are not finite; likely cause: a load out of proportion",
        model_.step->name, increment + 1, state_.time));
  if (has_flown_off()) eta = std::numeric_limits<double>::infinity();
  indicator_.raise_floor(energies.kinetic + energies.strain + std::abs(energies.loads), model_.scheme.dt);
  if (!model_.scheme.is_static) state_.time += model_.scheme.dt;
  ++figures_.increments;
  kept_.append(q_);
  figures_.iterations += iterations;
  figures_.worst_indicator = std::max(figures_.worst_indicator, eta);
  if (eta > tolerance_) ++figures_.not_converged;
  const Stopwatch watch(seconds_.output);
  observer_.accept(instant(increment, iterations, eta));
}

// A static increment that moves bodies by many times the assembly's size has found no equilibrium, whatever the
// indicator says.
bool StepRun::has_flown_off() const {
  if (!model_.scheme.is_static || velocity_.size() == 0) return false;
  const double moved = velocity_.cwiseAbs().maxCoeff(), size = assembly_size();
  if (moved <= 10.0 * size) return false;
  warn(fmt::format(
      "static step '{}': an increment moves a substructure by {:.3g} m, {:.0f} times the size of the assembly: it is "
      "unconstrained, a limit load is exceeded, or the iteration failed to converge",
      model_.step->name, moved, moved / size));
  return true;
}

// Length of the diagonal of the box around all substructures, m.
double StepRun::assembly_size() const {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const SubstructurePtr& part : problem_.substructures) {
    low = low.cwiseMin(part->mesh->nodes.rowwise().minCoeff() + part->place);
    high = high.cwiseMax(part->mesh->nodes.rowwise().maxCoeff() + part->place);
  }
  return (high - low).norm();
}

void StepRun::check_finite(const Outcome& outcome, int increment) const {
  if (std::isfinite(outcome.eta)) return;
  throw NumericalError(
      fmt::format("step '{}', increment {} (t = {:.6g} s): the iteration has diverged; likely cause: a "
                  "search direction, stiffness or density out of proportion, or a time step far too large",
                  model_.step->name, increment + 1, state_.time));
}

std::string StepRun::describe_progress() const {
  const double mean = figures_.increments ? static_cast<double>(figures_.iterations) / figures_.increments : 0.0;
  return model_.scheme.is_static ? fmt::format("{} iterations", figures_.iterations)
                                 : fmt::format("t = {:.4g} us, {:.1f} iterations per step", state_.time * 1e6, mean);
}

Instant StepRun::instant(int increment, int iterations, double eta) const {
  return {model_,     state_, i_step_,           increment,
          iterations, eta,    eta <= tolerance_, model_.scheme.dt * sums_.force_distance};
}

void StepRun::leave_state() { end_step(model_, state_); }

void StepRun::add_to(SolverFigures& figures) const {
  figures.n_dofs = 0;
  for (const SubstructurePtr& part : problem_.substructures) figures.n_dofs += 3 * part->mesh->n_nodes();
  double bytes = 0.0;
  for (const auto& piece : model_.pieces) bytes += piece->bytes();
  figures.factor_bytes = std::max(figures.factor_bytes, bytes);
  for (const auto& piece : model_.pieces) {
    figures.n_solved += piece->n_solved();
    figures.n_spared += piece->n_spared();
    figures.n_in_full += piece->is_mostly_interface();
    figures.n_equal += piece->shares_factor();
  }
  figures.n_interface_unknowns = model_.n_q();
  figures.gap_difference = std::max(figures.gap_difference, local_.gap_difference());
  figures.seconds["forward"] += seconds_.forward;
  figures.seconds["interface operator"] += seconds_.interface;
  figures.seconds["local stage"] += seconds_.local;
  figures.seconds["acceleration"] += seconds_.accelerate;
  figures.seconds["backward"] += seconds_.backward;
  figures.seconds["laws and energies"] += seconds_.accept;
  figures.seconds["output"] += seconds_.output;
}

}  // namespace dygita
