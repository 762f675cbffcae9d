// The mass of a piece: lumped or a matrix, and nodes without any (manual, eq. S6-S7).
#include "solution/piece.hpp"

namespace dygita {

// Masses of the free unknowns; in factor order once that is known.
void Piece::make_mass() {
  const Mass& mass = *setup_.body->mass;
  const int n = static_cast<int>(node_of_free_.size());
  mass_.resize(n);
  for (int i = 0; i < n; ++i) mass_[position_[i]] = mass.lumped[node_of_free_[i]];
  if (setup_.scheme.is_static) return;
  make_massless();
  if (mass.matrix.size() == 0) return;

  // Rows of B^T M B: a node whose axes are the global ones has one entry a neighbour and direction, others a block.
  const int* starts = mass.matrix.outerIndexPtr();
  const auto entries_with = [&](int a, int b) { return special_of_[a] < 0 && special_of_[b] < 0 ? 1 : n_free_of_[b]; };
  std::vector<int> count(n, 0);
  for (int a = 0; a < mass.matrix.rows(); ++a)
    for (int e = starts[a]; e < starts[a + 1]; ++e)
      for (int j = 0; j < n_free_of_[a]; ++j)
        count[position_[first_free_[a] + j]] += entries_with(a, mass.matrix.innerIndexPtr()[e]);
  mass_matrix_.resize(n, n);
  mass_matrix_.outerIndexPtr()[0] = 0;
  for (int i = 0; i < n; ++i) mass_matrix_.outerIndexPtr()[i + 1] = mass_matrix_.outerIndexPtr()[i] + count[i];
  mass_matrix_.resizeNonZeros(mass_matrix_.outerIndexPtr()[n]);
  for (int a = 0; a < mass.matrix.rows(); ++a)
    for (int j = 0; j < n_free_of_[a]; ++j) {
      int at = mass_matrix_.outerIndexPtr()[position_[first_free_[a] + j]];
      for (int e = starts[a]; e < starts[a + 1]; ++e) {
        const int b = mass.matrix.innerIndexPtr()[e];
        const bool is_plain = entries_with(a, b) == 1 && special_of_[a] < 0 && special_of_[b] < 0;
        for (int c = is_plain ? j : 0; c < (is_plain ? j + 1 : n_free_of_[b]); ++c) {
          mass_matrix_.innerIndexPtr()[at] = position_[first_free_[b] + c];
          mass_matrix_.valuePtr()[at++] =
              mass.matrix.valuePtr()[e] * (is_plain ? 1.0 : basis(a).col(j).dot(basis(b).col(c)));
        }
      }
    }
}

// Unknowns without mass, and their columns of K.
void Piece::make_massless() {
  const int n_nodes = setup_.body->part->mesh->n_nodes();
  std::vector<Eigen::Triplet<double>> entries;
  for (int node = 0; node < n_nodes; ++node) {
    if (!is_massless(node)) continue;
    const SparseMatrix& k = setup_.body->matrices->stiffness;
    for (int j = 0; j < n_free_of_[node]; ++j) {
      const int column = static_cast<int>(massless_.size());
      massless_.push_back(position_[first_free_[node] + j]);
      for (int e = k.outerIndexPtr()[3 * node]; e < k.outerIndexPtr()[3 * node + 1]; e += 3) {
        const int other = k.innerIndexPtr()[e] / 3, shift = e - k.outerIndexPtr()[3 * node];
        Vec3 force;  // K is symmetric: the column of a node is its rows
        for (int c = 0; c < 3; ++c) {
          force[c] = 0.0;
          for (int r = 0; r < 3; ++r)
            force[c] += k.valuePtr()[k.outerIndexPtr()[3 * node + r] + shift + c] * basis(node)(r, j);
        }
        for (int c = 0; c < n_free_of_[other]; ++c)
          entries.emplace_back(position_[first_free_[other] + c], column, basis(other).col(c).dot(force));
      }
    }
  }
  massless_columns_.resize(static_cast<Eigen::Index>(node_of_free_.size()),
                           static_cast<Eigen::Index>(massless_.size()));
  massless_columns_.setFromTriplets(entries.begin(), entries.end());
  end_factor_ = Vec::Constant(massless_columns_.rows(), 1.0 - setup_.scheme.g);
  for (const int i : massless_) end_factor_[i] = 1.0;
}

Vec Piece::mass_times(const Vec& v) const {
  if (mass_matrix_.size() > 0) return mass_matrix_ * v;
  return mass_.cwiseProduct(v);
}

Points Piece::nodal_mass_times(const Points& nodal) const {
  const Mass& mass = *setup_.body->mass;
  if (mass.matrix.size() == 0) return nodal * mass.lumped.asDiagonal();
  return (mass.matrix * nodal.transpose()).transpose();
}

Vec Piece::momentum() const {
  if (has_motions_ && mass_matrix_.size() > 0) return restrict_nodal(nodal_mass_times(expand(v_, held_v_)));
  return mass_times(v_);
}

double Piece::kinetic_energy() const {
  if (!has_motions_) return 0.5 * v_.dot(momentum_);
  const Points nodal = expand(v_, held_v_);
  return 0.5 * nodal.cwiseProduct(nodal_mass_times(nodal)).sum();
}

std::vector<double> Piece::held_mass(const Points& nodal) const {
  const Mass& mass = *setup_.body->mass;
  std::vector<double> values(held_.size(), 0.0);
  for (size_t i = 0; i < held_.size(); ++i) {
    const int node = held_[i].node;
    if (mass.matrix.size() == 0) {
      values[i] = mass.lumped[node] * held_[i].direction.dot(nodal.col(node));
      continue;
    }
    for (int e = mass.matrix.outerIndexPtr()[node]; e < mass.matrix.outerIndexPtr()[node + 1]; ++e)
      values[i] += mass.matrix.valuePtr()[e] * held_[i].direction.dot(nodal.col(mass.matrix.innerIndexPtr()[e]));
  }
  return values;
}

Vec Piece::mean_velocity() const {
  Vec mean = setup_.scheme.g * v_old_ + (1 - setup_.scheme.g) * v_;
  for (const int i : massless_) mean[i] = v_[i];
  return mean;
}

// p_ holds K U: adds what begin() expects of the velocities.
void Piece::start_massless() {
  const double g = setup_.scheme.g;
  Vec own(static_cast<Eigen::Index>(massless_.size()));
  for (size_t i = 0; i < massless_.size(); ++i) own[i] = v_[massless_[i]];
  // w_ = c1 K V with all velocities; z is without those of the massless unknowns.
  z_ = g * setup_.scheme.dt * (w_ / c1_ - massless_columns_ * own);
  p_ += end_factor_.cwiseProduct(z_);
}

// P of the next increment from W = dt D K D V1: K U1 + D Z1 with Z = dt K G V, G being g, and 0 for massless unknowns
// (manual, eq. S7).
void Piece::advance_massless() {
  const double g = setup_.scheme.g;
  Vec own(static_cast<Eigen::Index>(massless_.size()));
  for (size_t i = 0; i < massless_.size(); ++i) own[i] = v_[massless_[i]];
  const Vec end = w_.cwiseQuotient(end_factor_);  // dt K D V1
  change_ = z_ + end;                             // K (U1 - U0)
  p_ += z_ - end_factor_.cwiseProduct(z_) + end;
  z_ = g / (1 - g) * (end - setup_.scheme.dt * (massless_columns_ * own));
  p_ += end_factor_.cwiseProduct(z_);
}

// Energy (J) that the material's damping takes in an increment, of mean velocity v of the free unknowns; moving
// supports count.
double Piece::damped_energy(const Vec& v) const {
  const Scheme& scheme = setup_.scheme;
  const Damping& damping = setup_.body->part->material.damping;
  std::vector<double> held(held_.size());
  for (size_t i = 0; i < held_.size(); ++i) held[i] = scheme.g * held_v_old_[i] + (1 - scheme.g) * held_v_[i];
  const Points nodal = expand(v, held);
  const Eigen::Map<const Vec> flat(nodal.data(), nodal.size());
  double power = 0.0;
  if (scheme.alpha(damping) > 0.0) power += scheme.alpha(damping) * nodal.cwiseProduct(nodal_mass_times(nodal)).sum();
  if (scheme.beta(damping) > 0.0) power += scheme.beta(damping) * flat.dot(setup_.body->matrices->stiffness * flat);
  return scheme.dt * power;
}

// Power (W) of the last increment's change of the elastic forces on what has mass.
double Piece::massive_flow(const Vec& v_mean) const {
  double flow = v_mean.dot(change_);
  for (const int i : massless_) flow -= v_mean[i] * change_[i];
  return flow;
}

}  // namespace dygita
