#include "pieces/implicit_piece.hpp"

#include "base/error.hpp"

namespace dygita {

bool ImplicitPiece::is_massless(int node) const {
  const std::vector<char>& massless = op_.setup().body->mass->is_massless;
  return !op_.scheme().is_static && !massless.empty() && massless[node];
}

void ImplicitPiece::set_search_directions(const Vec& k) {
  CHECK(k.size() == n_rows(), "one search direction a row");
  k_ = k;
}

void ImplicitPiece::set_state(const Points& displacement, const Points& velocity, const Points& force,
                              const Points& interface_force) {
  const FreeUnknowns& unknowns = op_.unknowns();
  const std::vector<HeldDirection>& held = op_.held();
  PieceState& s = state_;
  s = {};
  s.u = unknowns.restrict_nodal(displacement);
  s.v = unknowns.restrict_nodal(velocity);
  s.force = unknowns.restrict_nodal(force);
  for (const HeldDirection& direction : held) {
    s.held_u.push_back(direction.direction.dot(displacement.col(direction.node)));
    s.held_v.push_back(direction.motion.empty() ? 0.0 : direction.direction.dot(velocity.col(direction.node)));
  }
  s.w = op_.c1() * op_.stiffness_times(this->velocity());
  s.p = op_.stiffness_times(displacement);
  s.imbalance = s.p - s.force - unknowns.restrict_nodal(interface_force);
  if (op_.mass().has_massless())
    start_massless();
  else
    s.p += op_.c0() / op_.c1() * s.w;
  s.momentum = op_.momentum(s.v, s.held_v);
  s.q = Vec::Zero(n_rows());
  s.branches.assign(branches().size(),
                    {Vec::Zero(op_.n_free()), std::vector<double>(held.size(), 0.0), Vec::Zero(op_.n_free())});
  if (op_.has_motions()) s.held_pull = op_.pull_of_held(s.held_v);
  s.held_reaction = op_.stiffness_times_held(displacement);
  for (size_t i = 0; i < held.size(); ++i)
    s.held_reaction[i] -= held[i].direction.dot(force.col(held[i].node) + interface_force.col(held[i].node));
  work_ = {};
  work_.nodal_force = force;
}

Points ImplicitPiece::velocity_of_impulse(const Points& impulse) const {
  const FreeUnknowns& unknowns = op_.unknowns();
  const PieceMass& mass = op_.mass();
  Vec v = unknowns.restrict_nodal(impulse);
  if (mass.is_matrix())
    v = mass.solve(v);
  else
    v = (mass.lumped().array() > 0.0).select(v.array() / mass.lumped().array(), 0.0);
  return unknowns.expand(v, std::vector<double>(op_.held().size(), 0.0));
}

Points ImplicitPiece::after_jump(const Points& before, const Points& held) const {
  if (!op_.mass().is_matrix()) return held;
  const FreeUnknowns& unknowns = op_.unknowns();
  const Vec pull = unknowns.restrict_nodal(op_.mass().times_nodal(before - held));
  if (pull.isZero(0.0)) return held;
  Vec free = unknowns.restrict_nodal(held) + op_.mass().solve(pull);
  std::vector<double> held_velocity;
  for (const HeldDirection& direction : op_.held())
    held_velocity.push_back(direction.direction.dot(held.col(direction.node)));
  return unknowns.expand(free, held_velocity);
}

void ImplicitPiece::begin(const Points& force, const std::vector<double>& motion_velocity, double quiet) {
  const TimeScheme& scheme = op_.scheme();
  const double mass_factor = scheme.inertia_of_start(op_.damping());
  const std::vector<HeldDirection>& held = op_.held();
  Work& work = work_;
  work.held_load.resize(held.size());
  for (size_t i = 0; i < held.size(); ++i) {
    const int node = held[i].node;
    work.held_load[i] = held[i].direction.dot(scheme.working<Vec3>(work.nodal_force.col(node), force.col(node)));
  }
  work.nodal_force = force;
  work.v_old = state_.v;
  work.w_old = state_.w;
  const Vec new_force = op_.unknowns().restrict_nodal(force);
  work.residual = new_force - state_.p;
  recall_branches();
  if (!scheme.is_static) {
    work.residual += mass_factor * state_.momentum;
    op_.apply_rates(state_.v, state_.held_v, -scheme.from_start(1.0), work.residual);
  }
  work.force_old = op_.mass().has_massless() ? state_.force : Vec();
  state_.force = scheme.working(state_.force, new_force);
  work.x = work.residual;
  if (solves_for_change()) {  // less A V0, known without a product: W0 is c1 K V0
    work.x -= state_.w + op_.mass_share() * state_.momentum;
    op_.apply_rates(state_.v, state_.held_v, -scheme.from_end(1.0), work.x);
    if (op_.has_motions()) work.x += state_.held_pull;
  }
  work.held_v_old = state_.held_v;
  work.held_v_new.assign(held.size(), 0.0);
  for (size_t i = 0; i < held.size(); ++i)
    for (const auto& [motion, factor] : held[i].motion) work.held_v_new[i] += factor * motion_velocity[motion];
  if (op_.has_motions()) {
    state_.held_pull = op_.pull_of_motions(motion_velocity);
    work.x -= state_.held_pull;
    if (op_.has_held_rows()) work.held_rows = op_.held_at_rows(work.held_v_new);
  }
  prepare(quiet);
}

void ImplicitPiece::add_start_force() {
  if (!solves_for_change()) return;
  for (int i = 0; i < n_rows(); ++i) {
    const Trace trace = op_.traces()[i];
    trace.add(state_.q[i] - k_[i] * trace.of(state_.v), work_.x);
  }
}

void ImplicitPiece::interface_velocity(Eigen::Ref<const Vec> /*q*/, Eigen::Ref<Vec> velocity) { velocity.setZero(); }

// P and W by products with K, where the recurrence has followed the stiffness of a factor in single precision.
void ImplicitPiece::resynchronise() {
  state_.w = op_.c1() * op_.stiffness_times(velocity());
  state_.p = op_.stiffness_times(displacement()) + op_.c0() / op_.c1() * state_.w;
  for (BranchState& b : state_.branches) b.force = op_.stiffness_times(op_.unknowns().expand(b.e, b.held));
}

// W1 from the solved equation itself, then P by recurrence: no product by K.
void ImplicitPiece::advance_forces(Eigen::Ref<const Vec> q, bool is_moved) {
  const TimeScheme& scheme = op_.scheme();
  const double c0 = op_.c0(), c1 = op_.c1();
  PieceState& s = state_;
  s.w = is_moved ? work_.residual : work_.w_old;
  for (int i = 0; i < n_rows() && is_moved; ++i) {
    const Trace trace = op_.traces()[i];
    trace.add(q[i] - k_[i] * trace.of(s.v), s.w);
  }
  if (!scheme.is_static && is_moved) {
    s.momentum = op_.momentum(s.v, s.held_v);
    s.w -= op_.mass_share() * s.momentum;
    op_.apply_rates(s.v, s.held_v, -scheme.from_end(1.0), s.w);
  }
  if (op_.mass().has_massless())
    advance_massless();
  else
    s.p += ((scheme.from_start(scheme.dt) - c0) / c1) * work_.w_old + ((scheme.from_end(scheme.dt) + c0) / c1) * s.w;
}

IncrementEnergy ImplicitPiece::finish(Eigen::Ref<const Vec> given, const Points* interface_force) {
  // Increments between products by K: they cost little beside the solves, and what drifts in between is below the
  // tolerance.
  constexpr int n_between = 8;
  const double dt = op_.scheme().dt;
  const bool is_moved = find_velocity();
  const Vec q = held_rows() ? Vec(given - k_.cwiseProduct(*held_rows())) : Vec(given);  // of the free unknowns' rows
  if (solves_for_change()) state_.q = q;
  state_.held_v = work_.held_v_new;
  advance_forces(q, is_moved);
  const Vec v_mean = mean_velocity();
  state_.u += dt * v_mean;
  for (size_t i = 0; i < state_.held_u.size(); ++i) state_.held_u[i] += dt * held_mean_velocity(i);
  if (op_.setup().precision == Precision::single_precision && ++state_.n_since_product >= n_between && is_moved) {
    resynchronise();
    state_.n_since_product = 0;
  }

  IncrementEnergy energy = op_.scheme().is_static ? static_works(v_mean) : dynamic_works(v_mean);
  advance_branches(v_mean, energy);
  const IncrementEnergy stored = stored_energy();
  energy.kinetic = stored.kinetic;
  energy.strain = stored.strain;
  if (op_.has_motions()) {
    CHECK(interface_force, "moving supports need the interface force on them");
    add_work_of_motions(*interface_force, energy.loads);
  }
  add_to_interval();
  return energy;
}

// Displacement and velocity are one in a static increment.
void ImplicitPiece::add_free_motion(const Points& motion) {
  const Vec free = op_.unknowns().restrict_nodal(motion);
  state_.u += free;
  state_.v += free;
  const std::vector<HeldDirection>& held = op_.held();
  for (size_t i = 0; i < held.size(); ++i) {
    const double along = held[i].direction.dot(motion.col(held[i].node));
    state_.held_u[i] += along;
    state_.held_v[i] += along;
  }
}

Vec ImplicitPiece::row_displacements() const {
  Vec u = op_.at_rows(state_.u);
  if (op_.has_held_rows()) u += op_.held_at_rows(state_.held_u);
  return u;
}

double ImplicitPiece::held_mean_velocity(size_t i) const {
  return op_.scheme().mean(work_.held_v_old[i], state_.held_v[i]);
}

Vec ImplicitPiece::mean_velocity() const {
  Vec mean = op_.scheme().mean(work_.v_old, state_.v);
  for (const int i : op_.mass().massless()) mean[i] = state_.v[i];
  return mean;
}

// P holds K U: adds what `begin` expects of the velocities. W is c1 K V with all velocities, Z is without those of the
// unknowns that have no mass.
void ImplicitPiece::start_massless() {
  const TimeScheme& scheme = op_.scheme();
  const PieceMass& mass = op_.mass();
  const Vec own = mass.of_massless(state_.v);
  state_.z = scheme.from_start(scheme.dt) * (state_.w / op_.c1() - mass.massless_columns() * own);
  state_.p += mass.end_factor().cwiseProduct(state_.z);
}

// P of the next increment from W = dt D K D V1: K U1 + D Z1 with Z = dt K G V, G being g, and 0 for massless unknowns
// (manual, eq. S7).
void ImplicitPiece::advance_massless() {
  const PieceMass& mass = op_.mass();
  PieceState& s = state_;
  const Vec end = s.w.cwiseQuotient(mass.end_factor());  // dt K D V1
  work_.change = s.z + end;
  s.p += s.z - mass.end_factor().cwiseProduct(s.z) + end;
  const Vec own = mass.of_massless(s.v);
  s.z = op_.scheme().undoing(Vec(end - op_.scheme().dt * (mass.massless_columns() * own)));
  s.p += mass.end_factor().cwiseProduct(s.z);
}

Points ImplicitPiece::acceleration() const {
  if (!has_past()) return Points::Zero(3, op_.unknowns().n_nodes());
  if (interval_.n > 1) return means().acceleration;
  return op_.unknowns().expand((state_.v - work_.v_old) / op_.scheme().dt, held_acceleration());
}

Points ImplicitPiece::acceleration(const std::vector<int>& nodes) const {
  if (!has_past()) return Points::Zero(3, static_cast<Eigen::Index>(nodes.size()));
  if (interval_.n > 1) return means().acceleration(Eigen::all, nodes);
  const FreeUnknowns& unknowns = op_.unknowns();
  const double dt = op_.scheme().dt;
  return (unknowns.expand(state_.v, state_.held_v, nodes) - unknowns.expand(work_.v_old, work_.held_v_old, nodes)) / dt;
}

// Are there velocities of the increment's start to hold its end against?
bool ImplicitPiece::has_past() const {
  return !op_.scheme().is_static && work_.v_old.size() == state_.v.size() &&
         work_.held_v_old.size() == state_.held_v.size();
}

std::vector<double> ImplicitPiece::held_acceleration() const {
  std::vector<double> held(state_.held_v.size());
  for (size_t i = 0; i < held.size(); ++i) held[i] = (state_.held_v[i] - work_.held_v_old[i]) / op_.scheme().dt;
  return held;
}

Points ImplicitPiece::absorbing_force() const {
  Points force = Points::Zero(3, op_.unknowns().n_nodes());
  if (work_.v_old.size() != state_.v.size()) return force;
  const Points mean = interval_.n > 1 ? means().velocity
                                      : op_.unknowns().expand(op_.scheme().mean(work_.v_old, state_.v), state_.held_v);
  for (const auto& [node, impedance] : op_.absorbing()) force.col(node) = -impedance * mean.col(node);
  for (const auto& [node, other, impedance] : op_.setup().absorbing_pairs)
    force.col(node) -= impedance * mean.col(other);
  return force;
}

Points ImplicitPiece::reactions(const Points& interface_force) const {
  Points result = Points::Zero(3, op_.unknowns().n_nodes());
  if (work_.v_old.size() != state_.v.size()) return result;
  const std::vector<double> forces = held_forces(interface_force, means());
  const std::vector<HeldDirection>& held = op_.held();
  for (size_t i = 0; i < held.size(); ++i) result.col(held[i].node) += forces[i] * held[i].direction;
  return result;
}

PieceFigures ImplicitPiece::figures() const {
  PieceFigures figures;
  figures.bytes = 8.0 * (12.0 + 2.0 * static_cast<double>(branches().size())) * op_.n_free();
  figures.is_in_single_precision = op_.setup().precision == Precision::single_precision;
  return figures;
}

}  // namespace dygita
