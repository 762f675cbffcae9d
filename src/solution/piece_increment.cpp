// One increment of a piece: right-hand side without a product by K, forward, interface, backward, update (manual, eq.
// S1-S5).
#include <algorithm>

#include "base/error.hpp"
#include "solution/piece.hpp"

namespace dygita {

// K times a nodal field, on the free unknowns.
Vec Piece::stiffness_times(const Points& nodal) const {
  Points result(3, nodal.cols());
  Eigen::Map<Vec>(result.data(), result.size()) =
      setup_.body->matrices->stiffness * Eigen::Map<const Vec>(nodal.data(), nodal.size());
  return restrict_nodal(result);
}

// P and W by products with K, where the recurrence has followed the stiffness of a factor in single precision.
void Piece::resynchronise() {
  w_ = c1_ * stiffness_times(velocity());
  p_ = stiffness_times(displacement()) + c0_ / c1_ * w_;
}

void Piece::set_state(const Points& displacement, const Points& velocity, const Points& force,
                      const Points& interface_force) {
  u_ = restrict_nodal(displacement);
  v_ = restrict_nodal(velocity);
  force_ = restrict_nodal(force);
  for (size_t i = 0; i < held_.size(); ++i) {
    held_u_[i] = held_[i].direction.dot(displacement.col(held_[i].node));
    held_v_[i] = held_[i].motion.empty() ? 0.0 : held_[i].direction.dot(velocity.col(held_[i].node));
  }
  const Points held_velocity = expand(v_, held_v_);
  w_ = c1_ * stiffness_times(held_velocity);
  p_ = stiffness_times(displacement);
  start_imbalance_ = p_ - force_ - restrict_nodal(interface_force);
  if (massless_.empty()) {
    p_ += c0_ / c1_ * w_;
  } else {
    start_massless();
  }
  momentum_ = momentum();
  q_before_ = Vec::Zero(n_rows());
  held_pull_ = Vec();
  if (has_motions_) {
    const Points held = expand(Vec::Zero(v_.size()), held_v_);
    held_pull_ = c1_ * stiffness_times(held);
    if (mass_matrix_.size() > 0) held_pull_ += mass_share() * restrict_nodal(nodal_mass_times(held));
  }
  nodal_force_ = force;
  held_reaction_ = held_stiffness(displacement);
  for (size_t i = 0; i < held_.size(); ++i)
    held_reaction_[i] -= held_[i].direction.dot(force.col(held_[i].node) + interface_force.col(held_[i].node));
}

void Piece::restore(const Snapshot& s) {
  u_ = s.u;
  v_ = s.v;
  p_ = s.p;
  w_ = s.w;
  z_ = s.z;
  force_ = s.force;
  held_pull_ = s.held_pull;
  q_before_ = s.q_before;
  n_since_product_ = s.n_since_product;
  held_u_ = s.held_u;
  held_v_ = s.held_v;
  momentum_ = momentum();
}

void Piece::apply_absorbing(const Vec& v, double factor, Vec& out) const {
  for (const auto& [node, impedance] : absorbing_) {
    const Mat3 basis = special_of_[node] < 0 ? Mat3(Mat3::Identity()) : bases_[special_of_[node]];
    Vec3 nodal = Vec3::Zero();
    for (int j = 0; j < n_free_of_[node]; ++j) nodal += v[position_[first_free_[node] + j]] * basis.col(j);
    const Vec3 force = factor * (impedance * nodal);
    for (int j = 0; j < n_free_of_[node]; ++j) out[position_[first_free_[node] + j]] += basis.col(j).dot(force);
  }
}

void Piece::begin(const Points& force, const std::vector<double>& motion_velocity, double quiet) {
  const Scheme& scheme = setup_.scheme;
  const double mass_factor = scheme.inverse_dt() - scheme.g * scheme.alpha(setup_.body->part->material.damping);
  nodal_force_ = force;
  v_old_ = v_;
  w_old_ = w_;
  const Vec new_force = restrict_nodal(force);
  residual_ = new_force - p_;
  if (!scheme.is_static) {
    residual_ += mass_factor * momentum_;
    apply_absorbing(v_, -scheme.g, residual_);
  }
  // Loads work with the mean force of the increment: that of the step in dynamics, of both ends in statics.
  force_old_ = massless_.empty() ? Vec() : force_;
  force_ = scheme.is_static ? Vec(0.5 * (force_ + new_force)) : new_force;
  x_ = residual_;
  if (solves_for_change()) {  // less A V0, known without a product: W0 is c1 K V0
    x_ -= w_ + mass_share() * momentum_;
    apply_absorbing(v_, -(1 - scheme.g), x_);
    if (has_motions_) x_ += held_pull_;
  }
  held_v_old_ = held_v_;
  held_v_new_.assign(held_.size(), 0.0);
  for (size_t i = 0; i < held_.size(); ++i)
    for (const auto& [motion, factor] : held_[i].motion) held_v_new_[i] += factor * motion_velocity[motion];
  if (has_motions_) {
    held_pull_ = Vec::Zero(v_.size());
    for (size_t m = 0; m < coupling_.size(); ++m) {
      if (coupling_[m].size() > 0) held_pull_ += c1_ * motion_velocity[m] * coupling_[m];
      if (mass_coupling_[m].size() > 0) held_pull_ += mass_share() * motion_velocity[m] * mass_coupling_[m];
    }
    x_ -= held_pull_;
  }
  start_force_ = Vec::Zero(n_rows());
  is_moved_ = is_forward_due_ = false;
  if (!factor_ && !plain_factor_) return;
  if (solves_for_change()) {
    for (int i = 0; i < n_rows(); ++i) start_force_[i] = q_before_[i] - k_[i] * at_row(i, v_);
    for (int i = 0; i < n_rows(); ++i)
      for (int a = 0; a < traces_[i].n; ++a) x_[traces_[i].at[a]] += traces_[i].value[a] * start_force_[i];
  }
  if (plain_factor_) return;
  // A support that moves never rests: what its velocity brings would be left out of W.
  quiet_ = solves_for_change() && !has_motions_ ? quiet : 0.0;
  is_forward_due_ = true;
  const bool is_quiet = quiet_ > 0.0 && scheme.dt * x_.cwiseAbs2().cwiseQuotient(mass_).sum() <= quiet_;
  is_moved_ = !is_quiet;
}

namespace {

// f on one vector where there is one piece, on the columns of a matrix where there are several.
template <class Function>
void together(const std::vector<Vec*>& vectors, Function&& f) {
  if (vectors.size() == 1) return f(*vectors.front());
  Mat columns(vectors.front()->size(), static_cast<Eigen::Index>(vectors.size()));
  for (size_t i = 0; i < vectors.size(); ++i) columns.col(static_cast<Eigen::Index>(i)) = *vectors[i];
  f(columns);
  for (size_t i = 0; i < vectors.size(); ++i) *vectors[i] = columns.col(static_cast<Eigen::Index>(i));
}

}  // namespace

void Piece::forward(const std::vector<Piece*>& equal) {
  std::vector<Vec*> vectors;
  std::vector<Piece*> moved;
  for (Piece* piece : equal)
    if (piece->is_condensed() && piece->is_forward_due_ && piece->is_moved_) moved.push_back(piece);
  if (moved.empty()) return;
  for (Piece* piece : moved) vectors.push_back(&piece->x_);
  together(vectors, [&](auto& x) { moved.front()->factor_->forward(x); });
  for (Piece* piece : moved) {
    piece->is_forward_due_ = false;
    piece->b_ = piece->x_.tail(piece->factor_->n_interface());
    ++piece->n_solved_;
  }
}

void Piece::backward(const std::vector<Piece*>& equal) {
  std::vector<Vec*> vectors;
  std::vector<Piece*> moved;
  for (Piece* piece : equal) {
    if (!piece->is_condensed()) continue;
    if (!piece->is_moved_) {
      piece->n_spared_ += 2;
      continue;
    }
    if (piece->n_rows() > 0) piece->x_.tail(piece->dv_b_.size()) = piece->dv_b_;
    moved.push_back(piece);
    vectors.push_back(&piece->x_);
    ++piece->n_solved_;
  }
  if (!moved.empty()) together(vectors, [&](auto& x) { moved.front()->factor_->backward(x); });
}

void Piece::interface_velocity(Eigen::Ref<const Vec> q, Eigen::Ref<Vec> velocity) {
  if (!factor_ && !plain_factor_) return;
  const bool for_change = solves_for_change();
  if (plain_factor_) {
    // x_ keeps the right-hand side; residual order is the condensed factor's, the plain one has its own.
    v_ = x_;
    for (int i = 0; i < n_rows(); ++i)
      for (int a = 0; a < traces_[i].n; ++a)
        v_[traces_[i].at[a]] += traces_[i].value[a] * (for_change ? q[i] - q_before_[i] : q[i]);
    Vec ordered(v_.size());
    for (int i = 0; i < v_.size(); ++i) ordered[i] = v_[position_[plain_factor_->order()[i]]];
    plain_factor_->solve(ordered);
    for (int i = 0; i < v_.size(); ++i) v_[position_[plain_factor_->order()[i]]] = ordered[i];
    if (for_change) v_ += v_old_;
    for (int i = 0; i < n_rows(); ++i) velocity[i] = at_row(i, v_);
    return;
  }
  if (!is_moved_) {
    const double change = (q - q_before_).cwiseAbs2().cwiseQuotient(k_).sum();
    if (change <= quiet_) {
      for (int i = 0; i < n_rows(); ++i) velocity[i] = at_row(i, v_old_);
      return;
    }
    is_moved_ = true;
    forward({this});
  }
  const int n_i = factor_->n_interior();
  thread_local Vec rhs;
  rhs = b_;
  for (int i = 0; i < n_rows(); ++i)
    for (int a = 0; a < traces_[i].n; ++a)
      rhs[traces_[i].at[a] - n_i] += traces_[i].value[a] * (for_change ? q[i] - q_before_[i] : q[i]);
  h_->multiply(rhs, dv_b_);
  for (int i = 0; i < n_rows(); ++i) {
    velocity[i] = for_change ? at_row(i, v_old_) : 0.0;
    for (int a = 0; a < traces_[i].n; ++a) velocity[i] += traces_[i].value[a] * dv_b_[traces_[i].at[a] - n_i];
  }
}

IncrementEnergy Piece::finish(Eigen::Ref<const Vec> q, const Points* interface_force) {
  const Scheme& scheme = setup_.scheme;
  const Damping& damping = setup_.body->part->material.damping;
  const double g = scheme.g, dt = scheme.dt;
  const bool rests = is_condensed() && !is_moved_;  // as it was: neither velocity nor what follows from it has changed
  if (is_condensed() && is_moved_) {
    v_ = x_;
    if (solves_for_change()) v_ += v_old_;
  }
  if (solves_for_change()) q_before_ = q;
  held_v_ = held_v_new_;

  // W1 from the solved equation itself, then P by recurrence: no product by K.
  w_ = rests ? w_old_ : residual_;
  for (int i = 0; i < n_rows() && !rests; ++i) {
    const double force = q[i] - k_[i] * at_row(i, v_);
    for (int a = 0; a < traces_[i].n; ++a) w_[traces_[i].at[a]] += traces_[i].value[a] * force;
  }
  if (!scheme.is_static && !rests) {
    momentum_ = momentum();
    w_ -= mass_share() * momentum_;
    apply_absorbing(v_, -(1 - g), w_);
  }
  if (massless_.empty())
    p_ += ((dt * g - c0_) / c1_) * w_old_ + ((dt * (1 - g) + c0_) / c1_) * w_;
  else
    advance_massless();
  const Vec v_mean = mean_velocity();
  u_ += dt * v_mean;
  for (size_t i = 0; i < held_.size(); ++i) held_u_[i] += dt * (g * held_v_old_[i] + (1 - g) * held_v_[i]);

  constexpr int n_between =
      8;  // increments: products cost little beside their solves, and what drifts in between is below the tolerance
  if (setup_.precision == Precision::single_precision && ++n_since_product_ >= n_between && !rests) {
    resynchronise();
    n_since_product_ = 0;
  }

  IncrementEnergy energy = stored_energy();
  energy.loads = dt * v_mean.dot(force_);
  // What has no mass is in balance at both ends of the step, and its forces work with their mean.
  for (const int i : massless_) energy.loads += 0.5 * dt * v_[i] * (force_old_[i] - force_[i]);
  if (scheme.is_static) {
    energy.scheme = -v_.dot(start_imbalance_);
    energy.scheme *= 0.5;
    start_imbalance_.setZero();
    force_ = restrict_nodal(nodal_force_);
  } else {
    const double alpha = scheme.alpha(damping), beta = scheme.beta(damping);
    const double flow = beta > 0.0 || g != 0.5 ? v_mean.dot(g * w_old_ + (1 - g) * w_) / c1_ : 0.0;  // V_g . K V_g
    if (alpha > 0.0) energy.damping += dt * alpha * v_mean.dot(mass_times(v_mean));
    energy.damping += dt * beta * flow;
    if (has_motions_ && alpha + beta > 0.0) energy.damping = damped_energy(v_mean);
    if (!absorbing_.empty()) {
      Vec drag = Vec::Zero(v_.size());
      apply_absorbing(v_mean, 1.0, drag);
      energy.damping += dt * v_mean.dot(drag);
    }
    if (g != 0.5) {
      const Vec dv = v_ - v_old_;
      const double stiffness = massless_.empty() ? dt * dt * flow : dt * massive_flow(v_mean);
      energy.scheme = (0.5 - g) * (stiffness + dv.dot(mass_times(dv)));
    }
    // A support or a wall that was there before the step leaves what has no mass out of balance.
    for (const int i : massless_) {
      energy.scheme -= 0.5 * dt * v_[i] * start_imbalance_[i];
      start_imbalance_[i] = 0.0;
    }
  }
  if (has_motions_) {
    CHECK(interface_force, "moving supports need the interface force on them");
    const std::vector<double> reaction = held_forces(*interface_force);
    for (size_t i = 0; i < held_.size(); ++i) {
      const double mean = scheme.is_static ? 0.5 * (held_reaction_[i] + reaction[i]) : reaction[i];
      energy.loads += dt * (g * held_v_old_[i] + (1 - g) * held_v_[i]) * mean;
      energy.loads +=
          dt * (g * held_v_old_[i] + (1 - g) * held_v_[i]) * held_[i].direction.dot(nodal_force_.col(held_[i].node));
    }
    held_reaction_ = reaction;
  }
  return energy;
}

IncrementEnergy Piece::stored_energy() const {
  IncrementEnergy energy;
  energy.strain =
      0.5 * (u_.dot(p_) - (massless_.empty() ? c0_ / c1_ * u_.dot(w_) : u_.dot(end_factor_.cwiseProduct(z_))));
  if (std::any_of(held_u_.begin(), held_u_.end(), [](double u) { return u != 0.0; })) {
    const std::vector<double> held = held_stiffness(displacement());
    for (size_t i = 0; i < held_.size(); ++i) energy.strain += 0.5 * held_u_[i] * held[i];
  }
  if (!setup_.scheme.is_static) {
    energy.kinetic = kinetic_energy();
  }
  return energy;
}

Points Piece::acceleration() const {
  if (setup_.scheme.is_static || v_old_.size() != v_.size() || held_v_old_.size() != held_v_.size())
    return Points::Zero(3, n_free_of_.size());
  std::vector<double> held(held_.size());
  for (size_t i = 0; i < held_.size(); ++i) held[i] = (held_v_[i] - held_v_old_[i]) / setup_.scheme.dt;
  return expand((v_ - v_old_) / setup_.scheme.dt, held);
}

Vec Piece::row_values(const Points& nodal) const {
  Vec values(n_rows());
  for (int i = 0; i < n_rows(); ++i) values[i] = setup_.rows[i].direction.dot(nodal.col(setup_.rows[i].node));
  return values;
}

Vec Piece::row_displacements() const {
  Vec values = Vec::Zero(n_rows());
  for (size_t i = 0; i < traces_.size(); ++i)
    for (int a = 0; a < traces_[i].n; ++a) values[i] += traces_[i].value[a] * u_[traces_[i].at[a]];
  return values;
}

std::vector<double> Piece::held_stiffness(const Points& nodal) const {
  const SparseMatrix& k = setup_.body->matrices->stiffness;
  const Eigen::Map<const Vec> flat(nodal.data(), nodal.size());
  std::vector<double> values(held_.size(), 0.0);
  for (size_t i = 0; i < held_.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      if (held_[i].direction[axis] != 0.0)
        values[i] += held_[i].direction[axis] * k.row(3 * held_[i].node + axis).dot(flat);
  return values;
}

// Force of whatever holds each direction over the last increment: inertia + stiffness - external - interfaces.
std::vector<double> Piece::held_forces(const Points& interface_force) const {
  const Scheme& scheme = setup_.scheme;
  const Damping& damping = setup_.body->part->material.damping;
  // The displacement that K multiplies in the equation of the increment: U0 + c0 V0 + c1 V1.
  const double back = scheme.dt * scheme.g, back_new = scheme.dt * (1 - scheme.g);
  std::vector<double> held(held_.size());
  for (size_t i = 0; i < held_.size(); ++i)
    held[i] = held_u_[i] + (c0_ - back) * held_v_old_[i] + (c1_ - back_new) * held_v_[i];
  Vec there = u_ + (c0_ - back) * v_old_ + (c1_ - back_new) * v_;
  for (const int i : massless_) there[i] = u_[i] - scheme.g * scheme.dt * v_[i];
  std::vector<double> values = held_stiffness(expand(there, held));
  if (!scheme.is_static) {
    std::vector<double> held_mean(held_.size());
    for (size_t i = 0; i < held_.size(); ++i) held_mean[i] = scheme.g * held_v_old_[i] + (1 - scheme.g) * held_v_[i];
    const std::vector<double> inertia =
        held_mass(acceleration() + scheme.alpha(damping) * expand(mean_velocity(), held_mean));
    for (size_t i = 0; i < held_.size(); ++i) values[i] += inertia[i];
  }
  for (size_t i = 0; i < held_.size(); ++i)
    values[i] -= held_[i].direction.dot(nodal_force_.col(held_[i].node) + interface_force.col(held_[i].node));
  return values;
}

Points Piece::absorbing_force() const {
  Points force = Points::Zero(3, n_free_of_.size());
  if (v_old_.size() != v_.size()) return force;
  const Points mean = expand(setup_.scheme.g * v_old_ + (1 - setup_.scheme.g) * v_, held_v_);
  for (const auto& [node, impedance] : absorbing_) force.col(node) = -impedance * mean.col(node);
  return force;
}

Points Piece::reactions(const Points& interface_force) const {
  Points result = Points::Zero(3, n_free_of_.size());
  if (v_old_.size() != v_.size()) return result;
  const std::vector<double> forces = held_forces(interface_force);
  for (size_t i = 0; i < held_.size(); ++i) result.col(held_[i].node) += forces[i] * held_[i].direction;
  return result;
}

}  // namespace dygita
