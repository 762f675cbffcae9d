#include "pieces/central_differences.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "pieces/longest_step.hpp"

namespace dygita {

ExplicitOperator::ExplicitOperator(const PieceSetup& setup) : stiffness(setup.body->matrices->edges()) {
  const Substructure& part = *setup.body->part;
  if (setup.tuned_speed > 0.0)
    tuning = MassEdges(CellEdges(*part.mesh, part.material, setup.keeps_lumped), setup.tuned_speed, setup.scheme.dt);
}

CentralDifferences::CentralDifferences(PieceSetup setup, std::shared_ptr<const ExplicitOperator> op)
    : setup_(std::move(setup)), op_(std::move(op)), k_(Vec::Zero(n_rows())) {
  CHECK(!setup_.scheme.is_static && why_not_explicit(*setup_.body, setup_.scheme.numerical_damping()).empty(),
        setup_.what + " cannot be explicit");
  const Vec& mass = node_masses();
  const size_t n = static_cast<size_t>(mass.size());
  const Damping& damping = setup_.body->part->material.damping;
  const double alpha = setup_.scheme.alpha(damping);
  dt_ = setup_.scheme.dt;
  keep_ = setup_.scheme.inertia_of_start(damping) / setup_.mass_share();
  for (const double m : mass) inverse_.push_back(1.0 / (setup_.mass_share() * m));
  unknown_masses_ = mass.replicate(1, 3).transpose().reshaped();
  for (std::vector<double>* field : {&d_, &v_, &y_, &base_, &start_force_, &start_, &v_interval_})
    field->assign(4 * n, 0.0);
  if (alpha > 0.0 || damping.is_of_strain()) v_old_.assign(4 * n, 0.0);
  if (damping.is_of_strain())
    for (std::vector<double>* field : {&elastic_, &pull_of_motion_}) field->assign(4 * n, 0.0);
  for (const Branch& b : damping.branches)
    branches_.push_back({b.strength,
                         {b.rate, dt_},
                         {b.rate, 0.5 * dt_},
                         std::vector<double>(4 * n, 0.0),
                         std::vector<double>(4 * n, 0.0)});
  if (is_tuned())
    for (std::vector<double>* field : {&free_pull_, &coupled_, &p_, &p_old_}) field->assign(4 * n, 0.0);
  make_specials();
}

void CentralDifferences::make_specials() {
  const FreeUnknowns unknowns(setup_.n_nodes(), setup_.rows, setup_.held);
  std::vector<int> nodes;
  for (const InterfaceRow& row : setup_.rows) {
    CHECK(row.is_of_one_node(), "an explicit piece at an interface between two meshes");
    nodes.push_back(row.nodes[0].node);
  }
  for (const auto& [node, held] : setup_.held) nodes.push_back(node);
  for (const auto& [node, impedance] : setup_.absorbing) nodes.push_back(node);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  for (const int node : nodes) {
    index_[node] = specials_.size();
    Special special;
    special.node = node;
    special.n_free = unknowns.count(node);
    special.free = unknowns.basis(node);
    if (const auto it = setup_.absorbing.find(node); it != setup_.absorbing.end()) special.impedance = it->second;
    special.absorbs = !special.impedance.isZero(0.0);
    specials_.push_back(special);
  }
  for (const HeldDirection& held : unknowns.held()) {
    Special& special = special_at(held.node);
    special.held.emplace_back(held.direction, held.motion);
    special.has_held = true;
    has_motions_ |= !held.motion.empty();
  }
  schur_diagonal_.resize(n_rows());
  for (int i = 0; i < n_rows(); ++i) special_at(setup_.rows[i].nodes[0].node).rows.push_back(i);
  for (Special& special : specials_) {
    make_compliance(special);
    for (const int i : special.rows) {
      const Vec3 along = special.free.transpose() * setup_.rows[i].nodes[0].along;
      schur_diagonal_[i] = along.dot(special.matrix * along) / setup_.rows[i].n_sharing;
    }
  }
}

void CentralDifferences::make_compliance(Special& special) {
  const int n = special.n_free;
  for (int j = n; j < 3; ++j) special.free.col(j).setZero();
  special.matrix = 1.0 / inverse_[special.node] * Mat3::Identity();
  special.matrix += 0.5 * special.free.transpose() * special.impedance * special.free;
  Mat3 rows = Mat3::Zero();
  for (const int i : special.rows) {
    const Vec3 along = special.free.transpose() * setup_.rows[i].nodes[0].along;
    rows += k_[i] * along * along.transpose();
  }
  // Columns beyond the free ones are zero in `free`: what stands in the matrix there is of no consequence.
  special.compliance = special.free * special.matrix.inverse() * special.free.transpose();
  special.with_rows = special.free * (special.matrix + rows).inverse() * special.free.transpose();
}

void CentralDifferences::set_search_directions(const Vec& k) {
  CHECK(k.size() == n_rows(), "one search direction a row");
  k_ = k;
  for (Special& special : specials_) make_compliance(special);
}

Mat CentralDifferences::row_compliance(const std::vector<int>& columns) const {
  const auto n = static_cast<Eigen::Index>(columns.size());
  std::vector<Eigen::Index> column_of(setup_.rows.size(), -1);
  for (Eigen::Index c = 0; c < n; ++c) column_of[columns[c]] = c;
  Mat compliance = Mat::Zero(n_rows(), n);
  for (const Special& special : specials_)
    for (const int i : special.rows)
      for (const int j : special.rows)
        if (column_of[j] >= 0)
          compliance(i, column_of[j]) =
              setup_.rows[i].nodes[0].along.dot(special.with_rows * setup_.rows[j].nodes[0].along);
  return compliance;
}

Mat3 CentralDifferences::node_compliance(int node) const {
  const auto it = index_.find(node);
  return it == index_.end() ? Mat3(inverse_[node] * Mat3::Identity()) : specials_[it->second].compliance;
}

void CentralDifferences::set_loads(const Points& constant, const std::vector<PatternLoad>& loads) {
  loaded_.clear();
  patterns_.clear();
  has_forces_ = false;
  for (int node = 0; node < constant.cols(); ++node)
    if (!constant.col(node).isZero(0.0)) loaded_.push_back(node);
  for (const PatternLoad& load : loads)
    for (const auto& [node, unit] : load.nodes) loaded_.push_back(node);
  std::sort(loaded_.begin(), loaded_.end());
  loaded_.erase(std::unique(loaded_.begin(), loaded_.end()), loaded_.end());
  constant_.clear();
  for (const int node : loaded_) constant_.push_back(constant.col(node));
  loaded_v_old_.assign(loaded_.size(), Vec3::Zero());
  for (const PatternLoad& load : loads) {
    SlotLoad own{load.pattern, {}};
    for (const auto& [node, unit] : load.nodes)
      own.slots.emplace_back(std::lower_bound(loaded_.begin(), loaded_.end(), node) - loaded_.begin(), unit);
    patterns_.push_back(std::move(own));
  }
}

void CentralDifferences::update_loads(const std::vector<double>& values) {
  if (values == load_values_ && has_forces_) return;
  has_forces_ = true;
  load_values_ = values;
  load_ = constant_;
  for (const SlotLoad& pattern : patterns_)
    if (const double value = values[pattern.pattern]; value != 0.0)
      for (const auto& [slot, unit] : pattern.slots) load_[slot] += value * unit;
  base_ = start_force_;
  for (size_t i = 0; i < loaded_.size(); ++i)
    Eigen::Map<Vec3>(base_.data() + 4 * static_cast<size_t>(loaded_[i])) -= load_[i];
}

void CentralDifferences::begin(const std::vector<double>& load_values, const std::vector<double>& motion_velocity) {
  begin_pull(load_values);
  move(motion_velocity);
}

void CentralDifferences::begin_pull(const std::vector<double>& load_values) {
  update_loads(load_values);
  pull();
}

void CentralDifferences::begin(const Points& force, const std::vector<double>& motion_velocity, double /*quiet*/) {
  set_loads(force, {});
  update_loads({});
  pull();
  move(motion_velocity);
}

// The product.
void CentralDifferences::pull() {
  for (size_t i = 0; i < loaded_.size(); ++i) loaded_v_old_[i] = velocity_of(loaded_[i]);
  for (Special& s : specials_) s.v_old = velocity_of(s.node);
  if (is_damped()) v_old_ = v_;
  std::copy(base_.begin(), base_.end(), y_.begin());
  op_->stiffness->add_product(d_.data(), y_.data());
  if (has_damping_of_strain()) add_damping_of_strain();
}

// The velocities without interfaces (manual, eq. S9-S10); D goes along.
void CentralDifferences::move(const std::vector<double>& motion_velocity) {
  const double dt = setup_.scheme.dt, keep = keep_;
  const size_t n = inverse_.size();
  const double *const y = y_.data(), *const inverse = inverse_.data();
  double *const v = v_.data(), *const d = d_.data();
  if (is_tuned()) {
    take_momenta();
    op_->tuning.move_nodes({keep, dt, inverse, y, v, d}, free_pull_.data(), coupled_.data());
  } else {
    for (size_t i = 0; i < n; ++i) {
      const double w = inverse[i];
#pragma omp simd
      for (size_t c = 4 * i; c < 4 * i + 4; ++c) {
        v[c] = keep * v[c] - w * y[c];
        d[c] += dt * v[c];
      }
    }
  }
  const double mass_factor = keep_ * setup_.mass_share();
  for (Special& s : specials_) {
    const Vec3 own = s.free * (s.free.transpose() * s.v_old);
    s.rhs = mass_factor * node_masses()[s.node] * own - pull_on(s.node);
    if (s.absorbs) s.rhs -= 0.5 * s.impedance * own;
    s.held_velocity.setZero();
    s.held_force.setZero();
    for (const auto& [direction, motions] : s.held)
      for (const auto& [motion, factor] : motions) s.held_velocity += factor * motion_velocity[motion] * direction;
    set_velocity(s.node, s.compliance * s.rhs + s.held_velocity);
  }
}

// V0 is what X has moved by since the product before, so that K V0 needs none of its own (manual, eq. S14, S16).
void CentralDifferences::add_damping_of_strain() {
  const double factor = setup_.scheme.beta(setup_.body->part->material.damping) / setup_.scheme.dt;
  double *const y = y_.data(), *const elastic = elastic_.data(), *const change = pull_of_motion_.data();
  const double* const base = base_.data();
#pragma omp simd
  for (size_t c = 0; c < y_.size(); ++c) {
    const double now = y[c] - base[c];
    change[c] = now - elastic[c];
    elastic[c] = now;
    y[c] += factor * change[c];
  }
  advance_branches();
}

void CentralDifferences::advance_branches() {
  double* const y = y_.data();
  const double *const change = pull_of_motion_.data(), *const v = v_.data();
  for (OwnBranch& branch : branches_) {
    const Relaxation& over = is_ahead_ ? branch.whole : branch.half;
    const double strength = branch.strength, left = over.left, gain = over.gain,
                 of_change = over.gain / setup_.scheme.dt;
    double *const e = branch.e.data(), *const force = branch.force.data();
#pragma omp simd
    for (size_t c = 0; c < y_.size(); ++c) {
      e[c] = left * e[c] + gain * v[c];
      force[c] = left * force[c] + of_change * change[c];
      y[c] += strength * force[c];
    }
  }
  is_ahead_ = true;
}

// The inverse of a tuned mass is M^-1 + M^-1 C M^-1 (manual, eq. S13): M^-1 (K X - f), and what it takes of the
// momenta.
void CentralDifferences::take_momenta() {
  const double share = setup_.mass_share(), keep = keep_;
  if (is_damped()) p_old_ = p_;
  const double *const y = y_.data(), *const inverse = inverse_.data();
  double *const a = free_pull_.data(), *const p = p_.data();
  for (size_t i = 0; i < inverse_.size(); ++i) {
    const double w = share * inverse[i];
#pragma omp simd
    for (size_t c = 4 * i; c < 4 * i + 4; ++c) {
      a[c] = w * y[c];
      p[c] = keep * p[c] - y[c] / share;
    }
  }
  // The laws that tie these nodes give them the rest.
  for (size_t i = 0; i < sharing_.size(); ++i) {
    const int node = sharing_[i];
    const Vec3 pull = shared_pulls_.col(static_cast<Eigen::Index>(i));
    Eigen::Map<Vec3>(a + 4 * static_cast<size_t>(node)) = share * inverse[node] * pull;
    Eigen::Map<Vec3>(p + 4 * static_cast<size_t>(node)) += (pull_at(node) - pull) / share;
  }
  for (const Special& s : specials_) {
    if (!s.has_held) continue;
    Eigen::Map<Vec3> own(a + 4 * static_cast<size_t>(s.node));
    own = (s.free * (s.free.transpose() * own)).eval();
  }
}

void CentralDifferences::interface_velocity(Eigen::Ref<const Vec> q, Eigen::Ref<Vec> velocity) {
  for (const Special& s : specials_) {
    if (s.rows.empty()) continue;
    Vec3 rhs = s.rhs;
    for (const int i : s.rows) rhs += q[i] * setup_.rows[i].nodes[0].along;
    const Vec3 v = s.with_rows * rhs;
    for (const int i : s.rows) velocity[i] = at_row(i, v);
  }
}

IncrementEnergy CentralDifferences::finish(Eigen::Ref<const Vec> q, const Points* interface_force) {
  const double dt = setup_.scheme.dt;
  IncrementEnergy energy;
  for (Special& s : specials_) {
    if (!s.rows.empty()) {
      Vec3 rhs = s.rhs;
      for (const int i : s.rows) rhs += q[i] * setup_.rows[i].nodes[0].along;
      set_velocity(s.node, s.with_rows * rhs + s.held_velocity);
    }
    if (interface_force && s.has_held) s.held_force += interface_force->col(s.node);
    book_special(s, energy);
  }
  for (size_t i = 0; i < loaded_.size(); ++i)
    energy.loads += 0.5 * dt * load_[i].dot(loaded_v_old_[i] + velocity_of(loaded_[i]));
  if (is_damped()) energy.damping += damping_work();
  interval_ += dt;
  return energy;
}

Points CentralDifferences::velocity_of_impulse(const Points& impulse) const {
  Points v = impulse * node_masses().cwiseInverse().asDiagonal();
  for (const Special& special : specials_) {
    const auto free = special.free.leftCols(special.n_free);
    v.col(special.node) = (free * (free.transpose() * v.col(special.node))).eval();
  }
  return v;
}

}  // namespace dygita
