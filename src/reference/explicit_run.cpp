#include "reference/explicit_run.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/progress.hpp"
#include "law/law.hpp"
#include "step/finite_energies.hpp"

namespace dygita {

namespace {

// Energy from nowhere, of all that was ever put in: beyond it the step is unstable, not merely coarse.
constexpr double unstable = 1.0;

std::vector<PointRecord> start_records(const StepModel& model, const State& state) {
  std::vector<PointRecord> records;
  const std::vector<PortMotion> motions = port_motions(model, state);
  for (const Point& point : model.exchange.points) records.push_back(start_point(model, point, state, motions));
  return records;
}

}  // namespace

std::vector<char> tied_surfaces(const StepModel& model, const State& start) {
  std::vector<char> is_tied;
  for (size_t s = 0; s < model.surfaces->size(); ++s) {
    const Interface* interface = (*model.surfaces)[s].interface;
    is_tied.push_back(interface && (*model.surfaces)[s].facing.matches() && interface->law->is_tie() &&
                      !start.released[s] && !model.loads->is_released(interface, model.step->n_increments() - 1));
  }
  return is_tied;
}

ExplicitRun::ExplicitRun(StepModel& model, const std::vector<Body>& bodies, InternalForce& internal,
                         const ExplicitMemory& memory, State& state, Observer& observer)
    : model_(model),
      internal_(internal),
      state_(state),
      start_time_(state.time),
      observer_(observer),
      i_step_(index_of(model.problem->steps, model.step)),
      records_(start_records(model, state)),
      springs_(model, records_, tied_surfaces(model, state), internal),
      shared_(model, tied_surfaces(model, state), internal),
      inertial_(model, records_, internal, shared_) {
  start(bodies, memory);
  find_substeps();
  collect_loads();
  find_start_forces(memory);
  spring_energy_ = springs_.energy();
  observer_.begin_step(instant(-1));
}

// Where another explicit step was before, damping keeps resisting the velocity of its last substep.
void ExplicitRun::find_start_forces(const ExplicitMemory& memory) {
  const Vec at_start = velocity_;
  if (memory.velocity.size() > 0) velocity_ = memory.velocity;
  internal_.start_from(memory.velocity.size() > 0 ? Vec(-substep_ * memory.velocity) : moved_);
  evaluate_forces(substep_, true);
  velocity_ = at_start;
  cells_ = {};
}

void ExplicitRun::start(const std::vector<Body>& bodies, const ExplicitMemory& memory) {
  const int n = internal_.n_dofs();
  moved_ = Vec::Zero(n);
  velocity_.resize(n);
  prestress_ = memory.internal;
  if (prestress_.size() == 0) prestress_.resize(n);
  mass_.resize(n);
  anchor_.resize(n);
  for (int part = 0; part < internal_.n_parts(); ++part) {
    const int first = internal_.first(part), size = internal_.first(part + 1) - first;
    const Eigen::Map<const Vec> displacement(state_.displacement[part].data(), size);
    if (memory.internal.size() == 0)
      prestress_.segment(first, size) = *bodies[part].matrices->stiffness() * displacement;
    velocity_.segment(first, size) = Eigen::Map<const Vec>(state_.velocity[part].data(), size);
    anchor_.segment(first, size).setZero();
    for (const auto& [node, held] : state_.anchor[part]) anchor_.segment<3>(first + 3 * node) = held;
    for (int i = 0; i < size; ++i) mass_[first + i] = bodies[part].matrices->mass()[i / 3];
  }
  base_external_ = -prestress_;
  inverse_mass_ = mass_.cwiseInverse();
  for (int i = 0; i < n; ++i)
    if (shared_.is_shared(i)) inverse_mass_[i] = 0.0;
  shared_.average(velocity_);
  find_mass_damping(bodies);
  find_hourglass_force(bodies, memory);
  for (size_t b = 0; b < state_.elongation.size(); ++b)
    for (int part = 0; part < internal_.n_parts(); ++part)
      internal_.set_elongation(part, static_cast<int>(b), state_.elongation[b][static_cast<size_t>(part)]);
  stored_ = start_in_branches_ = internal_.energy_in_branches();
  if (memory.first.size() > 0) before_ = prestress_ - memory.first;
  for (const Motion& motion : model_.conditions.motions)
    motions_new_.push_back(motion.at_start ? motion.at_start(model_.step->dt) : 0.0);
  start_strain_ = state_.energies.strain;
  supplied_ = state_.energies.held();
}

void ExplicitRun::find_mass_damping(const std::vector<Body>& bodies) {
  Vec damping(internal_.n_dofs());
  for (int part = 0; part < internal_.n_parts(); ++part)
    damping.segment(internal_.first(part), internal_.first(part + 1) - internal_.first(part))
        .setConstant(bodies[part].part->material.damping.mass);
  if (damping.isZero(0.0)) return;
  shared_.average(damping);
  mass_damping_ = damping;
}

// The force that the steps before have left works on: part of it on the cells' strain, part on what the hourglass
// control holds, whose energy is booked apart.
void ExplicitRun::find_hourglass_force(const std::vector<Body>& bodies, const ExplicitMemory& memory) {
  ExplicitSettings settings = *model_.problem->explicit_dynamics;
  if (memory.moved.size() == 0 || !settings.one_point || settings.hourglass == 0.0) return;
  hourglass_ = start_hourglass_ = internal_.elastic(memory.moved, hourglass_force_).hourglass;
  settings.hourglass = 0.0;
  settings.bulk_viscosity = false;
  Vec without;
  InternalForce(bodies, settings).elastic(memory.moved, without);
  hourglass_force_ -= without;
}

void ExplicitRun::find_substeps() {
  const double frequency = highest_frequency(internal_, springs_, shared_, mass_);
  critical_ = critical_step(frequency, internal_);
  const double dt = model_.step->dt, longest = model_.problem->explicit_dynamics->safety * critical_;
  n_substeps_ = std::max(1, static_cast<int>(std::ceil(dt / longest * (1.0 - 1e-9))));
  substep_ = dt / n_substeps_;
}

void ExplicitRun::collect_loads() {
  for (const LoadPattern& pattern : model_.loads->patterns())
    for (const auto& [node, unit] : pattern.nodes)
      for (int d = 0; d < 3; ++d)
        if (unit[d] != 0.0) loaded_.push_back(internal_.first(pattern.part) + 3 * node + d);
  for (int i = 0; i < anchor_.size(); ++i)
    if (anchor_[i] != 0.0) loaded_.push_back(i);
  std::sort(loaded_.begin(), loaded_.end());
  loaded_.erase(std::unique(loaded_.begin(), loaded_.end()), loaded_.end());
  load_ = anchor_;
  external_ = base_external_ + load_;
}

void ExplicitRun::apply_loads(double from, double to) {
  if (loaded_.empty()) return;
  model_.loads->evaluate_mean(from, to);
  if (model_.loads->values() == load_values_) return;
  load_values_ = model_.loads->values();
  for (const int i : loaded_) load_[i] = anchor_[i];
  for (size_t p = 0; p < load_values_.size(); ++p) {
    const LoadPattern& pattern = model_.loads->patterns()[p];
    if (load_values_[p] == 0.0) continue;
    for (const auto& [node, unit] : pattern.nodes)
      load_.segment<3>(internal_.first(pattern.part) + 3 * node) += load_values_[p] * unit;
  }
  for (const int i : loaded_) external_[i] = base_external_[i] + load_[i];
}

// Velocities by the forces at hand over tau, then displacements over `drift`; works by the mean velocity of the kick.
void ExplicitRun::kick(double tau, double theta, double motion_share, double drift) {
  std::vector<double> motions(motions_new_.size());
  for (size_t m = 0; m < motions.size(); ++m)
    motions[m] = (1 - motion_share) * motions_old_[m] + motion_share * motions_new_[m];
  const auto count_work = [&] {
    double load = 0.0;
    for (const int i : loaded_) load += load_[i] * velocity_[i];
    load_work_ += 0.5 * tau * load;
    if (resisted_.size() > 0) internal_work_ += 0.5 * tau * resisted_.dot(velocity_);
  };
  count_work();
  damp_masses(tau);
  const Kick all{external_, tau, theta, motions};
  inertial_.add_force(all, shared_, inverse_mass_, velocity_, force_);
  shared_.kick(all, force_, velocity_);
  const int n = static_cast<int>(velocity_.size());
  double* const v = velocity_.data();
  double* const u = moved_.data();
  const double *const p = external_.data(), *const f = force_.data(), *const w = inverse_mass_.data();
#pragma omp simd
  for (int i = 0; i < n; ++i) {
    v[i] += tau * w[i] * (p[i] - f[i]);
    u[i] += drift * v[i];
  }
  inertial_.remove_force(force_);
  count_work();
}

// Decay of all velocities, held ones excepted since the kick sets them.
void ExplicitRun::damp_masses(double tau) {
  if (mass_damping_.size() == 0) return;
  const double before = velocity_.cwiseAbs2().dot(mass_);
  velocity_.array() *= (-tau * mass_damping_).array().exp();
  drag_work_ += 0.5 * (before - velocity_.cwiseAbs2().dot(mass_));
}

void ExplicitRun::evaluate_forces(double dt, bool has_energy) {
  const CellEnergy energy = internal_.damped(moved_, velocity_, dt, has_energy, force_);
  cells_ = {energy.strain, energy.hourglass, cells_.dissipated + energy.dissipated};
  if (internal_.has_damping_of_strain()) resisted_ = before_.size() > 0 ? Vec(force_ + before_) : force_;
  springs_.add_force(moved_, force_);
}

void ExplicitRun::solve_increment(int increment) {
  const double start = model_.step->dt * increment, h = substep_;
  motions_old_.swap(motions_new_);
  motions_new_ = model_.motion_velocities(increment);
  velocity_old_ = velocity_;
  state_.energies.scheme += springs_.release(model_, increment);
  inertial_.release(model_, increment);
  springs_.weigh(0.5);
  for (int i = 0; i < n_substeps_; ++i) {
    const double t = start + i * h;
    const bool is_first = i == 0, is_last = i + 1 == n_substeps_;
    apply_loads(is_first ? t : t - 0.5 * h, t + 0.5 * h);
    kick(is_first ? 0.5 * h : h, is_first ? 0.0 : 0.5, (i + 0.5) / n_substeps_, h);
    internal_.advance_branches(velocity_, h);
    evaluate_forces(h, is_last);
    springs_.weigh(is_last ? 0.5 : 1.0);
  }
  apply_loads(start + (n_substeps_ - 0.5) * h, start + n_substeps_ * h);
  if (increment + 1 == model_.step->n_increments()) last_velocity_ = velocity_;
  kick(0.5 * h, 1.0, 1.0, 0.0);
}

// What the increment did, and what is stored now (eq. X13).
void ExplicitRun::book_energies() {
  Energies& energies = state_.energies;
  double dissipated = cells_.dissipated, in_branches = 0.0;
  if (internal_.has_damping_of_strain()) {
    // Not from the damped forces: what resisted took more than what is stored.
    const double before = stored_;
    cells_ = internal_.elastic(moved_, elastic_);
    in_branches = internal_.energy_in_branches();
    stored_ = cells_.strain + cells_.hourglass + (before_.size() > 0 ? before_.dot(moved_) : 0.0) + in_branches;
    dissipated = internal_work_ - (stored_ - before);
  }
  energies.kinetic = 0.5 * velocity_.cwiseAbs2().dot(mass_);
  energies.strain = start_strain_ + prestress_.dot(moved_) + cells_.strain + in_branches - start_in_branches_;
  double hourglass = start_hourglass_ + cells_.hourglass;
  if (hourglass_force_.size() > 0) {
    const double work = hourglass_force_.dot(moved_);
    hourglass += work;
    energies.strain -= work;
  }
  energies.damping += dissipated + drag_work_ + shared_.take_absorbed_work() + hourglass - hourglass_;
  energies.loads += load_work_ + shared_.take_motion_work();
  const double in_springs = springs_.energy();
  energies.scheme += in_springs - spring_energy_;
  spring_energy_ = in_springs;
  hourglass_ = hourglass;
  cells_.dissipated = load_work_ = drag_work_ = internal_work_ = 0.0;
  const double all = energies.kinetic + energies.strain + std::abs(energies.loads);
  if (all > 0.0) hourglass_share_ = std::max(hourglass_share_, hourglass_ / all);
}

void ExplicitRun::check_stability(int increment) const {
  const Energies& e = state_.energies;
  if (!std::isfinite(e.balance())) {
    std::vector<IncrementEnergy> parts(model_.problem->substructures.size());
    for (size_t i = 0; i < parts.size(); ++i) parts[i].kinetic = velocity(static_cast<int>(i)).squaredNorm();
    check_energies(model_, state_, parts, increment);
  }
  const double created = -e.balance(), limit = unstable * (supplied_ + std::abs(e.loads));
  if (std::isfinite(created) && (created <= limit || created <= 1e-9 * e.kinetic)) return;
  throw NumericalError(fmt::format(
      "step '{}': unstable at {:.4g} s after its start: the scheme created {:.3g} J\n    the substep is {:.4g} s, "
      "{:.3f} of the critical {:.4g} s; likely cause: 'safety' above 1, take 0.9 or less",
      model_.step->name, (increment + 1) * model_.step->dt, created, substep_, substep_ / critical_, critical_));
}

void ExplicitRun::accept(int increment) {
  book_energies();
  springs_.show(model_, records_, state_);
  inertial_.show(model_, model_.step->dt, records_, state_);
  check_stability(increment);
  shared_.end_increment(velocity_old_, velocity_, model_.step->dt, state_);
  state_.time = start_time_ + (increment + 1) * model_.step->dt;
  ++figures_.increments;
  figures_.iterations += n_substeps_;
  observer_.accept(instant(increment));
}

void ExplicitRun::run() {
  const int n = model_.step->n_increments();
  Progress progress(model_.step->name, n);
  for (int i = 0; i < n && !interrupt_requested(); ++i) {
    solve_increment(i);
    accept(i);
    progress.update(i + 1, fmt::format("{} substeps each", n_substeps_));
  }
}

// The pieces take the state to the step's end as those of any solver do.
void ExplicitRun::finish(ExplicitMemory& memory) {
  springs_.keep(model_, records_, state_);
  inertial_.keep(model_, records_, state_);
  for (size_t i = 0; i < model_.pieces.size(); ++i) {
    const int part = static_cast<int>(i);
    model_.pieces[i]->set_state(displacement(part), velocity(part), model_.external_force(part, state_),
                                interface_force(*model_.problem, *model_.surfaces, state_, part));
    model_.pieces[i]->set_elongations(internal_.elongations(part));
  }
  internal_.elastic(moved_, elastic_);
  if (memory.first.size() == 0) memory.first = prestress_;
  memory.internal = prestress_ + elastic_;
  memory.velocity = last_velocity_;
  memory.moved = memory.moved.size() == 0 ? moved_ : Vec(memory.moved + moved_);
}

Points ExplicitRun::nodal(const Vec& all, int part) const {
  return Eigen::Map<const Points>(all.data() + internal_.first(part), 3, state_.displacement[part].cols());
}

Points ExplicitRun::displacement(int part) const { return state_.displacement[part] + nodal(moved_, part); }

Points ExplicitRun::acceleration(int part) const {
  if (figures_.increments == 0) return Points::Zero(3, state_.displacement[part].cols());
  return (nodal(velocity_, part) - nodal(velocity_old_, part)) / model_.step->dt;
}

Points ExplicitRun::reactions(int part) const {
  Points force = Points::Zero(3, state_.displacement[part].cols());
  shared_.add_reactions(part, force);
  return force;
}

Points ExplicitRun::absorbing_force(int part) const {
  Points force = Points::Zero(3, state_.displacement[part].cols());
  shared_.add_absorbing(part, force);
  return force;
}

Instant ExplicitRun::instant(int increment) const {
  Instant now{model_, state_, i_step_, increment};
  now.iterations = increment < 0 ? 0 : n_substeps_;
  now.fields = this;
  return now;
}

double ExplicitRun::bytes() const {
  return internal_.bytes() + springs_.bytes() + shared_.bytes() + inertial_.bytes() +
         8.0 * 11 * static_cast<double>(internal_.n_dofs());
}

}  // namespace dygita
