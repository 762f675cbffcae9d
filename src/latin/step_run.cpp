#include "latin/step_run.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>

#include "latin/search_direction.hpp"

namespace dygita {

namespace {

// Defaults of the manual's table, where the deck says nothing.
int anderson_depth(const LatinSettings& s, bool is_static) { return s.anderson >= 0 ? s.anderson : is_static ? 20 : 5; }
double relaxation(const LatinSettings& s, bool is_static) { return s.relaxation > 0.0 ? s.relaxation : is_static ? 0.8 : 0.95; }

LocalStage make_local_stage(const Problem& problem, StepModel& model, const State& state) {
  const Vec k = search_directions(model, problem.solver.search_direction);
  const int n = static_cast<int>(model.pieces.size());
  std::exception_ptr failure;
#pragma omp parallel for schedule(dynamic)
  for (int i = 0; i < n; ++i) {
    prepare_thread();
    try {
      model.pieces[i]->set_search_directions(k.segment(model.offset[i], model.pieces[i]->n_rows()), problem.solver.plain);
    } catch (...) {
#pragma omp critical
      failure = std::current_exception();
    }
  }
  if (failure) std::rethrow_exception(failure);
  return LocalStage(model, state, k);
}

}  // namespace

StepRun::StepRun(const Problem& problem, StepModel& model, State& state, Observer& observer)
    : problem_(problem), model_(model), state_(state), observer_(observer),
      i_step_(index_of(problem.steps, model.step)),
      local_((start_pieces(), make_local_stage(problem, model, state))),
      anderson_(0, 1.0, {}) {
  const LatinSettings& s = problem.solver;
  const bool is_static = model.scheme.is_static;
  const int n = model.step->n_increments();
  window_ = is_static ? 1 : s.window == 0 ? n : std::min(s.window, n);
  max_iterations_ = s.max_iterations;
  tolerance_ = is_static ? s.static_tolerance : s.tolerance;
  window_relaxation_ = s.relaxation > 0.0 ? s.relaxation : 0.8;
  window_depth_ = s.anderson >= 0 ? s.anderson : window_ > 20 ? 0 : 5;
  Vec k(model.n_q());
  for (size_t i = 0; i < model.pieces.size(); ++i) k.segment(model.offset[i], model.pieces[i]->n_rows()) = model.pieces[i]->k();
  weight_ = k.cwiseSqrt().cwiseInverse();
  anderson_ = Anderson(anderson_depth(s, is_static), relaxation(s, is_static), weight_);
  q_ = local_.initial_q();
  velocity_ = Vec::Zero(q_.size());
  energy_.resize(model.pieces.size());
  observer_.begin_step(instant(-1, 0, 0.0));
}

// Gives the pieces the state the last step left; energy that a static step or a new support takes away is the scheme's.
void StepRun::start_pieces() {
  const bool is_static = model_.scheme.is_static;
  const bool first_dynamic = !is_static && !state_.has_moved;
  for (size_t i = 0; i < model_.pieces.size(); ++i) {
    Points& velocity = state_.velocity[i];
    if (is_static) velocity.setZero();
    if (first_dynamic) velocity.colwise() += problem_.substructures[i]->velocity;
    model_.pieces[i]->set_state(state_.displacement[i], velocity, state_.force[i],
                                interface_force(*model_.surfaces, state_, static_cast<int>(i)));
    velocity = model_.pieces[i]->velocity();
  }
  // A wall that is no longer a support has let go.
  for (size_t s = 0; s < model_.surfaces->size(); ++s) {
    const Support* wall = (*model_.surfaces)[s].wall;
    if (!wall || index_of(supports_of(problem_, *model_.step), wall) >= 0) continue;
    for (LawState& point : state_.surfaces[s].points) {
      point.force.setZero();
      point.status = PointState::open;
    }
  }
  Energies& energies = state_.energies;
  const double before = energies.kinetic + energies.strain;
  energies.kinetic = energies.strain = 0.0;
  for (const auto& piece : model_.pieces) {
    const IncrementEnergy now = piece->stored_energy();
    energies.kinetic += now.kinetic;
    energies.strain += now.strain;
  }
  const double jump = energies.kinetic + energies.strain - before;
  (first_dynamic ? energies.start : energies.scheme) += first_dynamic ? jump : -jump;
  if (first_dynamic) state_.has_moved = true;
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
  energies.kinetic = energies.strain = 0.0;
  for (const IncrementEnergy& e : energy_) {
    energies.kinetic += e.kinetic;
    energies.strain += e.strain;
    energies.loads += e.loads;
    energies.damping += e.damping;
    energies.scheme += e.scheme;
  }
  indicator_.raise_floor(energies.kinetic + energies.strain + std::abs(energies.loads), model_.scheme.dt);
  if (!model_.scheme.is_static) state_.time += model_.scheme.dt;
  ++figures_.increments;
  figures_.iterations += iterations;
  figures_.worst_indicator = std::max(figures_.worst_indicator, eta);
  if (eta > tolerance_) ++figures_.not_converged;
  const Stopwatch watch(seconds_.output);
  observer_.accept(instant(increment, iterations, eta));
}

void StepRun::check_finite(const Outcome& outcome, int increment) const {
  if (std::isfinite(outcome.eta)) return;
  throw NumericalError(fmt::format("step '{}', increment {} (t = {:.6g} s): the iteration has left all bounds; likely cause: a "
                                   "search direction, stiffness or density out of proportion, or a time step far too large",
                                   model_.step->name, increment + 1, state_.time));
}

std::string StepRun::describe_progress() const {
  const double mean = figures_.increments ? static_cast<double>(figures_.iterations) / figures_.increments : 0.0;
  return model_.scheme.is_static ? fmt::format("{} iterations", figures_.iterations)
                                 : fmt::format("t = {:.4g} us, {:.1f} iterations a step", state_.time * 1e6, mean);
}

Instant StepRun::instant(int increment, int iterations, double eta) const {
  return {model_, state_, i_step_, increment, iterations, eta, eta <= tolerance_};
}

void StepRun::leave_state() {
  for (size_t i = 0; i < model_.pieces.size(); ++i) {
    const int part = static_cast<int>(i);
    state_.displacement[i] = model_.pieces[i]->displacement();
    state_.velocity[i] = model_.pieces[i]->velocity();
    if (model_.scheme.is_static) state_.velocity[i].setZero();
    state_.force[i] = model_.external_force(part, state_);
    if (!model_.scheme.is_static) continue;
    // What an absorbing support held in the static step it keeps holding while waves pass through it.
    state_.anchor[i].setZero();
    const Points reactions = model_.pieces[i]->reactions(interface_force(*model_.surfaces, state_, part));
    for (const auto& [node, held] : model_.conditions.held[i])
      if (held.n > 0 && held.support[0] && held.support[0]->kind == SupportKind::absorbing)
        state_.anchor[i].col(node) = reactions.col(node);
  }
  state_.reached = model_.loads->reached();
  if (model_.scheme.is_static) return;
  for (const LoadPtr& load : model_.step->loads)
    if (load->kind == LoadKind::base_acceleration)
      for (const Target& target : load->on)
        if (const auto* support = std::get_if<SupportPtr>(&target)) {
          auto [it, is_new] = state_.base_velocity.emplace(support->get(), Vec3::Zero());
          it->second += load->direction * load->value[0]->integral(0.0, model_.step->duration);
        }
}

void StepRun::add_to(SolverFigures& figures) const {
  figures.n_dofs = 0;
  for (const auto& piece : model_.pieces) {
    figures.n_dofs += 3 * piece->setup().body->part->mesh->n_nodes();
  }
  double bytes = 0.0;
  for (const auto& piece : model_.pieces) bytes += piece->bytes();
  figures.factor_bytes = std::max(figures.factor_bytes, bytes);
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
