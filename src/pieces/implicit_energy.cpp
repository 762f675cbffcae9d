// Energies and reactions of an increment of the implicit scheme (manual, eq. E1-E2).
#include <algorithm>

#include "pieces/implicit_piece.hpp"

namespace dygita {

IncrementEnergy ImplicitPiece::stored_energy() const {
  const PieceState& s = state_;
  const PieceMass& mass = op_.mass();
  IncrementEnergy energy;
  energy.strain = 0.5 * (s.u.dot(s.p) - (mass.has_massless() ? s.u.dot(mass.end_factor().cwiseProduct(s.z))
                                                             : op_.c0() / op_.c1() * s.u.dot(s.w)));
  if (std::any_of(s.held_u.begin(), s.held_u.end(), [](double u) { return u != 0.0; })) {
    const std::vector<double> held = op_.stiffness_times_held(displacement());
    for (size_t i = 0; i < held.size(); ++i) energy.strain += 0.5 * s.held_u[i] * held[i];
  }
  for (size_t b = 0; b < s.branches.size(); ++b) energy.strain += 0.5 * branches()[b].strength * square(s.branches[b]);
  if (!op_.scheme().is_static) energy.kinetic = kinetic_energy();
  return energy;
}

std::vector<double> ImplicitPiece::held_mean_velocities() const {
  std::vector<double> mean(state_.held_v.size());
  for (size_t i = 0; i < mean.size(); ++i) mean[i] = held_mean_velocity(i);
  return mean;
}

double ImplicitPiece::kinetic_energy() const {
  if (!op_.has_motions()) return 0.5 * state_.v.dot(state_.momentum);
  const Points nodal = velocity();
  return 0.5 * nodal.cwiseProduct(op_.mass().times_nodal(nodal)).sum();
}

IncrementEnergy ImplicitPiece::static_works(const Vec& v_mean) {
  IncrementEnergy energy;
  energy.loads = op_.scheme().dt * v_mean.dot(state_.force);
  energy.scheme = -state_.v.dot(state_.imbalance);
  energy.scheme *= 0.5;
  state_.imbalance.setZero();
  state_.force = op_.unknowns().restrict_nodal(work_.nodal_force);
  return energy;
}

IncrementEnergy ImplicitPiece::dynamic_works(const Vec& v_mean) {
  const TimeScheme& scheme = op_.scheme();
  const PieceMass& mass = op_.mass();
  const double dt = scheme.dt;
  const double alpha = scheme.alpha(op_.damping()), beta = scheme.beta(op_.damping());
  PieceState& s = state_;
  IncrementEnergy energy;
  energy.loads = dt * v_mean.dot(s.force);
  // What has no mass is in balance at both ends of the step, and its forces work with their mean.
  for (const int i : mass.massless()) energy.loads += 0.5 * dt * s.v[i] * (work_.force_old[i] - s.force[i]);
  const double flow =
      beta > 0.0 || scheme.dissipates() ? v_mean.dot(scheme.mean(work_.w_old, s.w)) / op_.c1() : 0.0;  // V_g . K V_g
  if (alpha > 0.0) energy.damping += dt * alpha * v_mean.dot(mass.times(v_mean));
  energy.damping += dt * beta * flow;
  if (op_.has_motions() && alpha + beta > 0.0) energy.damping = damped_energy(v_mean);
  if (op_.has_damping_matrix()) {
    const Points nodal = op_.unknowns().expand(v_mean, held_mean_velocities());
    energy.damping += dt * nodal.cwiseProduct(op_.damping_force(nodal)).sum();
  }
  if (op_.absorbs()) {
    Vec drag = Vec::Zero(s.v.size());
    op_.apply_absorbing(v_mean, 1.0, drag);
    energy.damping += dt * v_mean.dot(drag);
  }
  if (scheme.dissipates() && op_.has_motions()) {
    energy.scheme = scheme.loss(change_with_motions(v_mean));
  } else if (scheme.dissipates()) {
    const Vec dv = s.v - work_.v_old;
    const double stiffness = mass.has_massless() ? dt * massive_flow(v_mean) : dt * dt * flow;
    energy.scheme = scheme.loss(stiffness + dv.dot(mass.times(dv)));
  }
  // A support or a wall that was there before the step leaves what has no mass out of balance.
  for (const int i : mass.massless()) {
    energy.scheme -= 0.5 * dt * s.v[i] * s.imbalance[i];
    s.imbalance[i] = 0.0;
  }
  return energy;
}

// Energy (J) that the material's damping takes in an increment, of mean velocity v of the free unknowns; moving
// supports count.
double ImplicitPiece::damped_energy(const Vec& v) const {
  const TimeScheme& scheme = op_.scheme();
  const double alpha = scheme.alpha(op_.damping()), beta = scheme.beta(op_.damping());
  const std::vector<double> held = held_mean_velocities();
  const Points nodal = op_.unknowns().expand(v, held);
  const auto dot = [&](const Points& force) { return nodal.cwiseProduct(force).sum(); };
  double power = 0.0;
  if (alpha > 0.0) power += alpha * dot(op_.mass().times_nodal(nodal));
  if (beta > 0.0) {
    const Points force = op_.elastic_force(nodal);
    power +=
        beta * Eigen::Map<const Vec>(nodal.data(), nodal.size()).dot(Eigen::Map<const Vec>(force.data(), force.size()));
  }
  return scheme.dt * power;
}

// Power (W) of the last increment's change of the elastic forces on what has mass.
double ImplicitPiece::massive_flow(const Vec& v_mean) const {
  double flow = v_mean.dot(work_.change);
  for (const int i : op_.mass().massless()) flow -= v_mean[i] * work_.change[i];
  return flow;
}

// dU.K dU + dV.M dV (J) of the last increment, dU of mean velocity v of the free unknowns, where supports move; rows of
// what has no mass are left out.
double ImplicitPiece::change_with_motions(const Vec& v) const {
  const FreeUnknowns& unknowns = op_.unknowns();
  const double dt = op_.scheme().dt;
  const std::vector<double> held = held_mean_velocities();
  const Points moved = dt * unknowns.expand(v, held), force = op_.elastic_force(moved);
  double sum = moved.cwiseProduct(force).sum();
  if (op_.mass().has_massless()) {
    const Vec on_free = unknowns.restrict_nodal(force);
    for (const int i : op_.mass().massless()) sum -= dt * v[i] * on_free[i];
  }
  const Points change = velocity() - unknowns.expand(work_.v_old, work_.held_v_old);
  return sum + change.cwiseProduct(op_.mass().times_nodal(change)).sum();
}

// Adds the work (J) of what moves supports in the increment; what holds them now is where the next static one starts.
void ImplicitPiece::add_work_of_motions(const Points& interface_force, double& work) {
  const double dt = op_.scheme().dt;
  const std::vector<HeldDirection>& held = op_.held();
  const std::vector<double> reaction = held_forces(interface_force, means_of_increment());
  for (size_t i = 0; i < held.size(); ++i) {
    work += dt * held_mean_velocity(i) * op_.scheme().working(state_.held_reaction[i], reaction[i]);
    work += dt * held_mean_velocity(i) * work_.held_load[i];
  }
  state_.held_reaction = reaction;
}

ImplicitPiece::Means ImplicitPiece::means_of_increment() const {
  const TimeScheme& scheme = op_.scheme();
  // The displacement that K multiplies in the equation of the increment: U0 + c0 V0 + c1 V1, and what branches recall.
  const double old_share = op_.c0() - scheme.from_start(scheme.dt), new_share = op_.c1() - scheme.from_end(scheme.dt);
  const FreeUnknowns& unknowns = op_.unknowns();
  std::vector<double> held(op_.held().size()), change(held.size(), 0.0);
  for (size_t i = 0; i < held.size(); ++i)
    held[i] = state_.held_u[i] + old_share * work_.held_v_old[i] + new_share * state_.held_v[i];
  Vec there = state_.u + old_share * work_.v_old + new_share * state_.v;
  for (const int i : op_.mass().massless()) there[i] = state_.u[i] - scheme.from_start(scheme.dt) * state_.v[i];
  if (!branches().empty()) {
    there += work_.recalled.e;
    for (size_t i = 0; i < held.size(); ++i) held[i] += work_.recalled.held[i];
  }
  Means means{unknowns.expand(there, held), work_.nodal_force, {}, {}};
  if (scheme.is_static) return means;
  for (size_t i = 0; i < held.size(); ++i) change[i] = (state_.held_v[i] - work_.held_v_old[i]) / scheme.dt;
  means.acceleration = unknowns.expand((state_.v - work_.v_old) / scheme.dt, change);
  means.velocity = unknowns.expand(mean_velocity(), held_mean_velocities());
  return means;
}

void ImplicitPiece::begin_interval() {
  interval_ = {};
  interval_.has_begun = true;
}

void ImplicitPiece::add_to_interval() {
  if (!interval_.has_begun) return;
  const Means means = means_of_increment();
  if (interval_.n++ == 0) {
    interval_.sum = means;
    return;
  }
  Means& sum = interval_.sum;
  sum.displacement += means.displacement;
  sum.force += means.force;
  sum.acceleration += means.acceleration;
  sum.velocity += means.velocity;
}

ImplicitPiece::Means ImplicitPiece::means() const {
  if (interval_.n < 2) return means_of_increment();
  const Means& sum = interval_.sum;
  const double share = 1.0 / interval_.n;
  return {share * sum.displacement, share * sum.force, share * sum.acceleration, share * sum.velocity};
}

// Force of whatever holds each direction: inertia + stiffness - external - interfaces.
std::vector<double> ImplicitPiece::held_forces(const Points& interface_force, const Means& means) const {
  const std::vector<HeldDirection>& directions = op_.held();
  std::vector<double> values = op_.stiffness_times_held(means.displacement);
  if (!op_.scheme().is_static) {
    const std::vector<double> inertia =
        op_.mass().times_held(means.acceleration + op_.scheme().alpha(op_.damping()) * means.velocity, directions);
    for (size_t i = 0; i < values.size(); ++i) values[i] += inertia[i];
    if (op_.has_damping_matrix()) {
      const Points drag = op_.damping_force(means.velocity);
      for (size_t i = 0; i < values.size(); ++i) values[i] += directions[i].direction.dot(drag.col(directions[i].node));
    }
  }
  for (size_t i = 0; i < values.size(); ++i)
    values[i] -=
        directions[i].direction.dot(means.force.col(directions[i].node) + interface_force.col(directions[i].node));
  return values;
}

}  // namespace dygita
