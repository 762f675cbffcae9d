// State, energies and fields of an explicit piece (manual, eq. E3).
#include <algorithm>

#include "base/error.hpp"
#include "pieces/central_differences.hpp"

namespace dygita {

namespace {

// Three of every four numbers.
Points nodal(const std::vector<double>& field) {
  Points nodal(3, static_cast<Eigen::Index>(field.size() / 4));
  double* to = nodal.data();
  for (size_t i = 0; i < field.size(); i += 4) to = std::copy_n(&field[i], 3, to);
  return nodal;
}

// The same of some nodes alone.
Points nodal(const std::vector<double>& field, const std::vector<int>& nodes) {
  Points some(3, static_cast<Eigen::Index>(nodes.size()));
  for (size_t i = 0; i < nodes.size(); ++i)
    std::copy_n(&field[4 * static_cast<size_t>(nodes[i])], 3, some.col(static_cast<Eigen::Index>(i)).data());
  return some;
}

void put(const Points& values, std::vector<double>& field) {
  Eigen::Map<Points, 0, Eigen::OuterStride<4>>(field.data(), 3, values.cols()) = values;
}

}  // namespace

Points CentralDifferences::unknown_directions() const {
  return Mat3::Identity().replicate(1, static_cast<Eigen::Index>(inverse_.size()));
}

Points CentralDifferences::elastic_force(const Points& displacement) const {
  Points force = Points::Zero(3, displacement.cols());
  if (displacement.isZero(0.0)) return force;  // the matrix may have to be assembled
  Eigen::Map<Vec>(force.data(), force.size()) =
      *setup_.body->matrices->stiffness() * Eigen::Map<const Vec>(displacement.data(), displacement.size());
  return force;
}

Points CentralDifferences::quick_elastic_force(const Points& displacement) const {
  std::vector<double> u(d_.size(), 0.0), force(d_.size(), 0.0);
  put(displacement, u);
  op_->stiffness->add_product(u.data(), force.data());
  return nodal(force);
}

void CentralDifferences::set_state(const Points& displacement, const Points& velocity, const Points& force,
                                   const Points& /*interface_force*/) {
  const double dt = setup_.scheme.dt;
  const Points elastic = elastic_force(displacement);
  Points v = velocity;
  for (const Special& s : specials_)
    for (const auto& [direction, motions] : s.held)
      if (motions.empty()) v.col(s.node) -= direction.dot(v.col(s.node)) * direction;
  put(displacement, start_);
  put(elastic, start_force_);
  put(elastic - force, base_);
  put(v, v_);
  put(0.5 * dt * v, d_);
  start_strain_ = 0.5 * displacement.cwiseProduct(elastic).sum();
  look_back();
  relax_branches();
  start_momentum();
  has_forces_ = false;
  begin_interval();
}

// What an increment before this would have left: K X for the X half an increment before U.
void CentralDifferences::look_back() {
  const double dt = setup_.scheme.dt;
  std::vector<double> before(d_.size());
  for (size_t c = 0; c < d_.size(); ++c) before[c] = d_[c] - dt * v_[c];
  y_ = base_;
  op_->stiffness->add_product(before.data(), y_.data());
  for (size_t c = 0; c < elastic_.size(); ++c) elastic_[c] = y_[c] - base_[c];
}

void CentralDifferences::relax_branches() {
  for (OwnBranch& branch : branches_)
    for (std::vector<double>* field : {&branch.e, &branch.force}) std::fill(field->begin(), field->end(), 0.0);
  is_ahead_ = false;
  in_branches_ = 0.0;
}

// What is stored is e.K e of half an increment before and after, as in E3.
void CentralDifferences::set_elongations(const std::vector<Points>& elongation) {
  relax_branches();
  if (branches_.empty()) return;
  CHECK(elongation.size() >= branches_.size(), "an elongation a branch");
  const double half = 0.5 * setup_.scheme.dt;
  std::vector<double> pull(v_.size(), 0.0);
  op_->stiffness->add_product(v_.data(), pull.data());
  double of_motion = 0.0;
  for (size_t c = 0; c < v_.size(); ++c) of_motion += half * half * v_[c] * pull[c];
  for (size_t b = 0; b < branches_.size(); ++b) {
    OwnBranch& own = branches_[b];
    put(elongation[b], own.e);
    op_->stiffness->add_product(own.e.data(), own.force.data());
    double square = -of_motion;
    for (size_t c = 0; c < v_.size(); ++c) square += own.e[c] * own.force[c];
    in_branches_ += 0.5 * own.strength * square;
  }
}

std::vector<Points> CentralDifferences::elongations() const {
  std::vector<Points> now;
  for (const OwnBranch& branch : branches_)
    now.push_back(is_ahead_ ? Points(branch.half.left * nodal(branch.e) + branch.half.gain * nodal(v_))
                            : nodal(branch.e));
  return now;
}

const PieceState& CentralDifferences::state() const {
  const Points u = displacement(), v = velocity();
  shown_.u = u.reshaped();
  shown_.v = v.reshaped();
  shown_.branches.clear();
  for (const Points& e : elongations()) shown_.branches.push_back({e.reshaped(), {}, {}});
  return shown_;
}

void CentralDifferences::restore(const PieceState& state) {
  const Eigen::Index n = static_cast<Eigen::Index>(inverse_.size());
  const Points v = state.v.reshaped(3, n);
  put(v, v_);
  put(Points(state.u.reshaped(3, n)) - nodal(start_) + 0.5 * setup_.scheme.dt * v, d_);
  if (has_damping_of_strain()) look_back();
  std::vector<Points> elongation;
  for (const BranchState& branch : state.branches) elongation.push_back(branch.e.reshaped(3, n));
  set_elongations(elongation);
  start_momentum();
}

Points CentralDifferences::coupled(const Points& velocity) const {
  std::vector<double> from(4 * inverse_.size(), 0.0), to(from.size(), 0.0);
  put(velocity, from);
  for (const Special& s : specials_)
    if (s.has_held) {
      Eigen::Map<Vec3> own(from.data() + 4 * static_cast<size_t>(s.node));
      own = (s.free * (s.free.transpose() * own)).eval();
    }
  op_->tuning.add_product(from.data(), to.data());
  Points product = nodal(to);
  for (const Special& s : specials_)
    if (s.has_held) product.col(s.node) = (s.free * (s.free.transpose() * product.col(s.node))).eval();
  return product;
}

void CentralDifferences::set_momenta(const Points& z) {
  put(z * node_masses().asDiagonal(), p_);
  p_old_ = p_;
}

// Momenta M z of velocities V, where (M + C) z = M V on free directions: by conjugate gradients, preconditioned by M.
// Those of a translation are M V to begin with.
void CentralDifferences::start_momentum() {
  if (!is_tuned()) return;
  constexpr int most_products = 200;
  const Eigen::Index n = static_cast<Eigen::Index>(inverse_.size());
  const Vec mass = unknown_masses_;
  Points v = nodal(v_);
  for (const Special& s : specials_)
    if (s.has_held) v.col(s.node) = (s.free * (s.free.transpose() * v.col(s.node))).eval();
  const auto times_c = [&](const Vec& x) { return Vec(coupled(x.reshaped(3, n)).reshaped()); };
  Vec z = v.reshaped(), residual = -times_c(z), along = residual.cwiseQuotient(mass);
  double size = residual.dot(along);
  const double enough = 1e-30 * z.cwiseProduct(mass).dot(z);
  for (int i = 0; i < most_products && size > enough; ++i) {
    const Vec image = mass.cwiseProduct(along) + times_c(along);
    const double step = size / along.dot(image);
    z += step * along;
    residual -= step * image;
    const Vec next = residual.cwiseQuotient(mass);
    const double next_size = residual.dot(next);
    along = next + next_size / size * along;
    size = next_size;
  }
  set_momenta(z.reshaped(3, n));
}

// E3: of the middles before and after U, from the product that the step has made.
IncrementEnergy CentralDifferences::stored_energy() const {
  const double dt = setup_.scheme.dt;
  const Vec& mass = node_masses();
  const bool is_damped = has_damping_of_strain();
  double kinetic = 0.0, strain = 0.0;
  for (size_t i = 0; i < inverse_.size(); ++i) {
    double v2 = 0.0, pv = 0.0;
    for (size_t c = 4 * i; c < 4 * i + 3; ++c) {
      v2 += v_[c] * v_[c];
      strain += start_force_[c] * (2.0 * d_[c] - dt * v_[c]) + (is_damped ? elastic_[c] : y_[c] - base_[c]) * d_[c];
    }
    if (has_momentum(i))
      for (size_t c = 4 * i; c < 4 * i + 3; ++c) pv += p_[c] * v_[c];
    kinetic += has_momentum(i) ? pv : mass[static_cast<Eigen::Index>(i)] * v2;
  }
  IncrementEnergy energy;
  energy.kinetic = 0.5 * kinetic;
  energy.strain = start_strain_ + 0.5 * strain + in_branches_;
  return energy;
}

double CentralDifferences::damping_work() {
  const Damping& damping = setup_.body->part->material.damping;
  const double dt = setup_.scheme.dt, alpha = setup_.scheme.alpha(damping);
  const Vec& mass = node_masses();
  double by_mass = 0.0, by_stiffness = 0.0;
  for (size_t i = 0; i < inverse_.size() && alpha > 0.0; ++i) {
    double v2 = 0.0;
    if (has_momentum(i))
      for (size_t c = 4 * i; c < 4 * i + 3; ++c) by_mass += (v_old_[c] + v_[c]) * (p_old_[c] + p_[c]);
    else
      for (size_t c = 4 * i; c < 4 * i + 3; ++c) v2 += (v_old_[c] + v_[c]) * (v_old_[c] + v_[c]);
    by_mass += mass[static_cast<Eigen::Index>(i)] * v2;
  }
  if (const double beta = setup_.scheme.beta(damping); beta > 0.0)
    for (size_t c = 0; c < v_.size(); ++c) by_stiffness += beta / dt * (v_old_[c] + v_[c]) * pull_of_motion_[c];
  return dt * (0.25 * alpha * by_mass + 0.5 * by_stiffness) + branch_work();
}

// What has been done on the branches in the increment, less what they store more (manual, eq. S16).
double CentralDifferences::branch_work() {
  const double dt = setup_.scheme.dt, before = in_branches_;
  double work = 0.0;
  in_branches_ = 0.0;
  for (const OwnBranch& branch : branches_) {
    double own = 0.0, square = 0.0;
    for (size_t c = 0; c < v_.size(); ++c) {
      own += (v_old_[c] + v_[c]) * branch.force[c];
      square += (branch.whole.left * branch.e[c] + branch.whole.gain * v_[c]) * branch.force[c];
    }
    work += 0.5 * dt * branch.strength * own;
    in_branches_ += 0.5 * branch.strength * square;
  }
  return work - (in_branches_ - before);
}

// What non-reflecting supports take and moving ones give, and the sums that means over the deck's time step need.
void CentralDifferences::book_special(Special& s, IncrementEnergy& energy) {
  const double dt = setup_.scheme.dt;
  const double mass = node_masses()[s.node], alpha = setup_.scheme.alpha(setup_.body->part->material.damping);
  const Vec3 v = velocity_of(s.node), mean = 0.5 * (s.v_old + v);
  const Vec3 pull = pull_on(s.node);
  s.pull += dt * pull;
  s.moved += dt * mean;
  if (s.absorbs) {
    const Vec3 own = s.free * (s.free.transpose() * mean);
    energy.damping += dt * own.dot(s.impedance * own);
  }
  if (!has_motions_ || !s.has_held) return;
  const Vec3 reaction = mass * ((v - s.v_old) / dt + alpha * mean) + pull - s.held_force;
  for (const auto& [direction, motions] : s.held)
    if (!motions.empty()) energy.loads += dt * direction.dot(mean) * direction.dot(reaction);
}

void CentralDifferences::begin_interval() {
  v_interval_ = v_;
  interval_ = 0.0;
  for (Special& s : specials_) {
    s.pull.setZero();
    s.moved.setZero();
  }
}

Points CentralDifferences::displacement() const {
  Points u(3, static_cast<Eigen::Index>(inverse_.size()));
  double* to = u.data();
  const double half = 0.5 * setup_.scheme.dt;
  for (size_t i = 0; i < d_.size(); i += 4)
    for (size_t c = i; c < i + 3; ++c) *to++ = start_[c] + d_[c] - half * v_[c];
  return u;
}

Points CentralDifferences::velocity() const { return nodal(v_); }

Points CentralDifferences::acceleration() const {
  if (interval_ == 0.0) return Points::Zero(3, static_cast<Eigen::Index>(inverse_.size()));
  return (nodal(v_) - nodal(v_interval_)) / interval_;
}

Points CentralDifferences::displacement(const std::vector<int>& nodes) const {
  return nodal(start_, nodes) + nodal(d_, nodes) - 0.5 * setup_.scheme.dt * nodal(v_, nodes);
}

Points CentralDifferences::velocity(const std::vector<int>& nodes) const { return nodal(v_, nodes); }

Points CentralDifferences::acceleration(const std::vector<int>& nodes) const {
  if (interval_ == 0.0) return Points::Zero(3, static_cast<Eigen::Index>(nodes.size()));
  return (nodal(v_, nodes) - nodal(v_interval_, nodes)) / interval_;
}

// Of the increment's start: it has begun when the laws ask.
Vec CentralDifferences::row_displacements() const {
  Vec values(n_rows());
  for (const Special& s : specials_) {
    if (s.rows.empty()) continue;
    const Vec3 u = start_displacement_of(s.node, s.v_old);
    for (const int i : s.rows) values[i] = at_row(i, u);
  }
  return values;
}

Points CentralDifferences::reactions(const Points& interface_force) const {
  const double alpha = setup_.scheme.alpha(setup_.body->part->material.damping);
  Points force = Points::Zero(3, static_cast<Eigen::Index>(inverse_.size()));
  if (interval_ == 0.0) return force;
  for (const Special& s : specials_) {
    const Vec3 change =
        velocity_of(s.node) - Eigen::Map<const Vec3>(v_interval_.data() + 4 * static_cast<size_t>(s.node));
    const Vec3 all =
        (node_masses()[s.node] * (change + alpha * s.moved) + s.pull) / interval_ - interface_force.col(s.node);
    for (const auto& [direction, motions] : s.held) force.col(s.node) += direction.dot(all) * direction;
  }
  return force;
}

Points CentralDifferences::absorbing_force() const {
  Points force = Points::Zero(3, static_cast<Eigen::Index>(inverse_.size()));
  if (interval_ == 0.0) return force;
  for (const Special& s : specials_)
    if (s.absorbs) force.col(s.node) = -s.impedance * s.moved / interval_;
  return force;
}

double explicit_bytes(const PieceSetup& setup, bool shares) {
  const double n = setup.n_nodes(), pairs = setup.body->matrices->n_pairs();
  const bool is_tuned = setup.tuned_speed > 0.0;
  return 8.0 * (is_tuned ? 45.0 : 29.0) * n +
         (shares ? 0.0 : 4.0 * n + 40.0 * pairs + (is_tuned ? MassEdges::bytes_of(n) : 0.0));
}

PieceFigures CentralDifferences::figures() const {
  PieceFigures figures;
  figures.bytes = op_->stiffness->bytes() + (is_tuned() ? op_->tuning.bytes() : 0.0) +
                  8.0 *
                      (29.0 + (is_damped() ? 4.0 : 0.0) + (has_damping_of_strain() ? 8.0 : 0.0) +
                       8.0 * static_cast<double>(branches_.size()) + (is_tuned() ? 16.0 : 0.0)) *
                      inverse_.size();
  return figures;
}

}  // namespace dygita
