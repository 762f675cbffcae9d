// Set-up of a piece: bases of its nodes, matrix, factor, interface operator. Its increments are in piece_increment.cpp.
#include "solution/piece.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"

namespace dygita {

Piece::Piece(Setup setup) : setup_(std::move(setup)) {
  const Damping& damping = setup_.body->part->material.damping;
  c0_ = setup_.scheme.c0(damping);
  c1_ = setup_.scheme.c1(damping);
  make_bases();
  factorise();
  if (setup_.is_prediction) return;
  make_couplings();
  k_ = Vec::Zero(n_rows());
}

// A node's free directions: the rows' own where they are orthonormal, so that a row is one unknown.
void Piece::make_bases() {
  const int n_nodes = setup_.body->part->mesh->n_nodes();
  special_of_.assign(n_nodes, -1);
  n_free_of_.assign(n_nodes, 3);
  std::unordered_map<int, std::vector<Vec3>> wanted;
  for (const Row& row : setup_.rows) wanted[row.node].push_back(row.direction);
  for (const auto& [node, held] : *setup_.held) wanted[node];
  for (const auto& [node, directions] : wanted) {
    Held basis;
    if (const auto it = setup_.held->find(node); it != setup_.held->end()) basis = it->second;
    const int n_held = basis.n;
    for (int j = 0; j < n_held; ++j) held_.push_back({node, basis.directions.col(j), basis.motion[j]});
    for (const Vec3& d : directions)
      if (basis.n < 3 && (basis.directions.leftCols(basis.n).transpose() * d).norm() < 1e-9)
        basis.directions.col(basis.n++) = d;
    const auto rest = basis.free_basis();
    Mat3 free;
    const int n_free = 3 - n_held;
    for (int j = 0; j < n_free; ++j)
      free.col(j) =
          n_held + j < basis.n ? Vec3(basis.directions.col(n_held + j)) : Vec3(rest.col(n_held + j - basis.n));
    special_of_[node] = static_cast<int>(bases_.size());
    n_free_of_[node] = n_free;
    bases_.push_back(free);
  }
  first_free_.resize(n_nodes);
  for (int node = 0; node < n_nodes; ++node) {
    first_free_[node] = static_cast<int>(node_of_free_.size());
    node_of_free_.insert(node_of_free_.end(), n_free_of_[node], node);
  }
  // held_ came out in hash order: reproducible sums need node order.
  std::stable_sort(held_.begin(), held_.end(), [](const auto& a, const auto& b) { return a.node < b.node; });
  held_u_.assign(held_.size(), 0.0);
  held_v_.assign(held_.size(), 0.0);
  position_.resize(node_of_free_.size());
  for (size_t i = 0; i < position_.size(); ++i) position_[i] = static_cast<int>(i);
  for (const auto& [node, impedance] : *setup_.absorbing) absorbing_.emplace_back(node, impedance);
  std::sort(absorbing_.begin(), absorbing_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
}

Piece::Trace Piece::trace(int node, const Vec3& direction) const {
  Trace trace;
  for (int j = 0; j < n_free_of_[node]; ++j) {
    const double value = special_of_[node] < 0 ? direction[j] : bases_[special_of_[node]].col(j).dot(direction);
    if (std::abs(value) < 1e-12) continue;
    trace.at[trace.n] = position_[first_free_[node] + j];
    trace.value[trace.n++] = value;
  }
  return trace;
}

// (M/dt (1 + ...) + c1 K + absorbing + rows' stiffness) on the free unknowns, before ordering.
SparseMatrix Piece::free_matrix(const Vec& row_stiffness) const {
  const SparseMatrix& k = setup_.body->matrices->stiffness;
  const Scheme& scheme = setup_.scheme;
  const int n_nodes = setup_.body->part->mesh->n_nodes();
  const int n = static_cast<int>(node_of_free_.size());
  SparseMatrix a(n, n);
  std::vector<int> count(n);
  const auto neighbours = [&](int node) {  // blocks of three columns
    const int begin = k.outerIndexPtr()[3 * node], end = k.outerIndexPtr()[3 * node + 1];
    return std::pair{begin, end};
  };
  for (int node = 0; node < n_nodes; ++node) {
    int columns = 0;
    const auto [begin, end] = neighbours(node);
    for (int e = begin; e < end; e += 3) columns += n_free_of_[k.innerIndexPtr()[e] / 3];
    for (int j = 0; j < n_free_of_[node]; ++j) count[first_free_[node] + j] = columns;
  }
  a.reserve(count);
  const double mass_factor = mass_share();
  const Mass& mass = *setup_.body->mass;
  const auto scale = [&](int at) { return is_massless(at) ? 1.0 / (1.0 - scheme.g) : 1.0; };
  for (int node = 0; node < n_nodes; ++node) {
    const auto [begin, end] = neighbours(node);
    const int rows = n_free_of_[node];
    for (int e = 0; e < end - begin; e += 3) {
      const int other = k.innerIndexPtr()[begin + e] / 3;
      Mat3 block;
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) block(r, c) = c1_ * k.valuePtr()[k.outerIndexPtr()[3 * node + r] + e + c];
      block *= scale(node) * scale(other);
      if (!scheme.is_static && mass.matrix.size() > 0)
        block.diagonal().array() += mass_factor * mass.matrix.valuePtr()[mass.matrix.outerIndexPtr()[node] + e / 3];
      else if (!scheme.is_static && other == node)
        block.diagonal().array() += mass_factor * mass.lumped[node];
      if (special_of_[node] >= 0) block = (bases_[special_of_[node]].transpose() * block).eval();
      if (special_of_[other] >= 0) block = (block * bases_[special_of_[other]]).eval();
      for (int r = 0; r < rows; ++r)
        for (int c = 0; c < n_free_of_[other]; ++c)
          a.insertBackUncompressed(first_free_[node] + r, first_free_[other] + c) = block(r, c);
    }
  }
  a.makeCompressed();
  const auto add_block = [&](int node, const Mat3& block) {
    for (int r = 0; r < n_free_of_[node]; ++r)
      for (int c = 0; c < n_free_of_[node]; ++c) {
        const Mat3 basis = special_of_[node] < 0 ? Mat3(Mat3::Identity()) : bases_[special_of_[node]];
        a.coeffRef(first_free_[node] + r, first_free_[node] + c) += basis.col(r).dot(block * basis.col(c));
      }
  };
  for (const auto& [node, impedance] : absorbing_) add_block(node, (1 - scheme.g) * impedance);
  for (int i = 0; i < row_stiffness.size(); ++i)
    if (row_stiffness[i] != 0.0)
      add_block(setup_.rows[i].node,
                row_stiffness[i] * setup_.rows[i].direction * setup_.rows[i].direction.transpose());
  return a;
}

// Bytes that an iteration reads in each form, the two condensed substitutions of a step spread over the usual number of
// iterations.
bool Piece::costs_less_in_full(const SparseMatrix& matrix, const std::vector<char>& is_interface) {
  constexpr double iterations = 6.0;
  const double n_b = n_interface_, n = static_cast<double>(node_of_free_.size());
  if (n_b < 0.3 * n || n_b < 300) return false;  // never seen to pay; saves the second ordering
  const double entry = bytes_of_operator_entry();
  const double full = Factor::predicted_bytes(matrix, node_of_free_, std::vector<char>(node_of_free_.size(), 0),
                                              setup_.precision, setup_.storage_error);
  const double interior =
      n_b < n ? Factor::predicted_bytes(matrix, node_of_free_, is_interface, setup_.precision, setup_.storage_error)
              : 0.0;
  if (iterations * 2.0 * full >= 2.0 * interior + iterations * entry * 0.5 * n_b * n_b) return false;
  predicted_factor_bytes_ = full;
  return true;
}

void Piece::factorise() {
  Vec reference(n_rows());
  for (int i = 0; i < n_rows(); ++i) reference[i] = setup_.rows[i].reference_stiffness;
  const int n = static_cast<int>(node_of_free_.size());
  if (n == 0) {
    mass_.resize(0);
    schur_diagonal_ = Vec::Zero(n_rows());
    return;
  }
  std::vector<char> is_interface(n, 0);
  for (const Row& row : setup_.rows) {
    const Trace t = trace(row.node, row.direction);
    for (int j = 0; j < t.n; ++j) is_interface[t.at[j]] = 1;
  }
  n_interface_ = static_cast<int>(std::count(is_interface.begin(), is_interface.end(), 1));
  if (setup_.is_assembled) {
    make_mass();
    for (const Row& row : setup_.rows) traces_.push_back(trace(row.node, row.direction));
    schur_diagonal_ = Vec::Zero(n_rows());
    return;
  }
  const SparseMatrix matrix = free_matrix(reference);
  if (costs_less_in_full(matrix, is_interface)) {
    is_mostly_interface_ = true;
    if (setup_.is_prediction) return;
    make_mass();
    for (const Row& row : setup_.rows) traces_.push_back(trace(row.node, row.direction));
    schur_diagonal_ = Vec::Zero(n_rows());
    return;
  }
  if (setup_.is_prediction) {
    if (!setup_.twin)
      predicted_factor_bytes_ =
          Factor::predicted_bytes(matrix, node_of_free_, is_interface, setup_.precision, setup_.storage_error);
    return;
  }
  std::unique_ptr<Factor> own;
  if (setup_.twin)
    factor_ = setup_.twin->factor_;
  else
    own = std::make_unique<Factor>(matrix, node_of_free_, is_interface, setup_.what, setup_.precision,
                                   setup_.storage_error);
  if (own) {
    Mat schur = own->interface_schur();
    own->release_interface();
    factor_ = std::move(own);
    schur_ = std::make_shared<const Mat>(std::move(schur));
  }
  for (int i = 0; i < n; ++i) position_[factor_->order()[i]] = i;
  make_mass();
  for (const Row& row : setup_.rows) traces_.push_back(trace(row.node, row.direction));
  if (setup_.twin) {
    schur_ = setup_.twin->schur_;
    schur_diagonal_ = setup_.twin->schur_diagonal_;
    return;
  }
  schur_ = std::make_shared<const Mat>(with_search_directions(*schur_, -reference));
  schur_diagonal_.resize(n_rows());
  const int n_i = factor_->n_interior();
  for (int i = 0; i < n_rows(); ++i) {
    double diagonal = 0.0;
    for (int a = 0; a < traces_[i].n; ++a)
      for (int b = 0; b < traces_[i].n; ++b)
        diagonal +=
            traces_[i].value[a] * traces_[i].value[b] * (*schur_)(traces_[i].at[a] - n_i, traces_[i].at[b] - n_i);
    schur_diagonal_[i] = diagonal / setup_.rows[i].n_sharing;
  }
}

// schur + T^T k T, with T the rows on the interface unknowns.
Mat Piece::with_search_directions(const Mat& schur, const Vec& k) const {
  Mat sum = schur;
  const int n_i = factor_->n_interior();
  for (int i = 0; i < n_rows(); ++i)
    for (int a = 0; a < traces_[i].n; ++a)
      for (int b = 0; b < traces_[i].n; ++b)
        sum(traces_[i].at[a] - n_i, traces_[i].at[b] - n_i) += k[i] * traces_[i].value[a] * traces_[i].value[b];
  return sum;
}

void Piece::set_search_directions(const Vec& k, bool plain) {
  CHECK(k.size() == n_rows(), "one search direction a row");
  k_ = k;
  if (is_mostly_interface_) {
    plain_factor_ = std::make_unique<Factor>(free_matrix(k), node_of_free_, std::vector<char>(node_of_free_.size(), 0),
                                             setup_.what, setup_.precision, setup_.storage_error);
    return;
  }
  if (!factor_) return;
  if (!plain) {
    plain_factor_.reset();
    const Piece* twin = setup_.twin;
    h_ = twin && twin->h_ && (twin->k_.array() == k.array()).all()
             ? twin->h_
             : std::make_shared<const SymmetricOperator>(inverse_spd(with_search_directions(*schur_, k), setup_.what),
                                                         setup_.precision, setup_.storage_error / 16);
    schur_.reset();
    return;
  }
  // The plain path: another matrix, another ordering, the whole solve at every iteration. It takes vectors in this
  // factor's order.
  const SparseMatrix a = free_matrix(k);
  plain_factor_ = std::make_unique<Factor>(a, node_of_free_, std::vector<char>(node_of_free_.size(), 0), setup_.what);
}

bool Piece::equals(const Setup& other) const {
  const Setup& own = setup_;
  if (own.body->matrices != other.body->matrices || own.body->mass != other.body->mass ||
      own.precision != other.precision || own.is_assembled || other.is_assembled ||
      own.rows.size() != other.rows.size() || !absorbing_.empty() || !other.absorbing->empty())
    return false;
  // Frames of places that differ by a shift agree but for rounding.
  const auto same = [](double a, double b) { return std::abs(a - b) <= 1e-12 * (std::abs(a) + std::abs(b)); };
  const auto same_direction = [](const Vec3& a, const Vec3& b) { return (a - b).norm() < 1e-12; };
  for (size_t i = 0; i < own.rows.size(); ++i) {
    const Row &a = own.rows[i], &b = other.rows[i];
    if (a.node != b.node || !same_direction(a.direction, b.direction) ||
        !same(a.reference_stiffness, b.reference_stiffness) || !same(a.n_sharing, b.n_sharing))
      return false;
  }
  size_t n_held = 0;
  for (const auto& [node, held] : *other.held) n_held += held.n;
  if (n_held != held_.size()) return false;
  for (const HeldDirection& held : held_) {
    const auto it = other.held->find(held.node);
    if (it == other.held->end()) return false;
    bool is_found = false;
    for (int j = 0; j < it->second.n; ++j) is_found |= same_direction(it->second.directions.col(j), held.direction);
    if (!is_found) return false;
  }
  return true;
}

Mat Piece::plain_row_compliance() const {
  Mat compliance(n_rows(), n_rows());
  constexpr int together = 16;
  for (int first = 0; first < n_rows(); first += together) {
    const int n = std::min(together, n_rows() - first);
    Mat x = Mat::Zero(n_free(), n);
    std::vector<int> place(n_free());
    for (int i = 0; i < n_free(); ++i) place[plain_factor_->order()[i]] = i;
    for (int c = 0; c < n; ++c)
      for (int a = 0; a < traces_[first + c].n; ++a)
        x(place[traces_[first + c].at[a]], c) += traces_[first + c].value[a];
    plain_factor_->solve(x);
    for (int c = 0; c < n; ++c)
      for (int r = 0; r < n_rows(); ++r) {
        compliance(r, first + c) = 0.0;
        for (int a = 0; a < traces_[r].n; ++a)
          compliance(r, first + c) += traces_[r].value[a] * x(place[traces_[r].at[a]], c);
      }
  }
  return compliance;
}

Mat Piece::row_compliance() const {
  if (is_mostly_interface_) return plain_row_compliance();
  const Mat h =
      h_ ? h_->lower() : inverse_spd(with_search_directions(*schur_, k_), setup_.what);  // the plain form keeps no H
  const int n_i = factor_->n_interior();
  Mat compliance = Mat::Zero(n_rows(), n_rows());
  for (int i = 0; i < n_rows(); ++i)
    for (int j = 0; j < n_rows(); ++j)
      for (int a = 0; a < traces_[i].n; ++a)
        for (int b = 0; b < traces_[j].n; ++b) {
          const int row = traces_[i].at[a] - n_i, column = traces_[j].at[b] - n_i;
          compliance(i, j) +=
              traces_[i].value[a] * traces_[j].value[b] * h(std::max(row, column), std::min(row, column));
        }
  return compliance;
}

// B^T K of a unit velocity of each motion, for what moving supports do to the free unknowns.
void Piece::make_couplings() {
  coupling_.resize(setup_.n_motions);
  mass_coupling_.resize(setup_.n_motions);
  std::vector<Points> unit(setup_.n_motions);
  for (const HeldDirection& held : held_)
    for (const auto& [motion, factor] : held.motion) {
      if (unit[motion].size() == 0) unit[motion] = Points::Zero(3, setup_.body->part->mesh->n_nodes());
      unit[motion].col(held.node) += factor * held.direction;
      has_motions_ = true;
    }
  for (int m = 0; m < setup_.n_motions; ++m) {
    if (unit[m].size() == 0) continue;
    Points force(3, unit[m].cols());
    Eigen::Map<Vec>(force.data(), force.size()) =
        setup_.body->matrices->stiffness * Eigen::Map<const Vec>(unit[m].data(), unit[m].size());
    coupling_[m] = restrict_nodal(force);
    for (const int i : massless_) coupling_[m][i] /= 1.0 - setup_.scheme.g;  // their force is that of the step's end
    if (mass_matrix_.size() > 0) mass_coupling_[m] = restrict_nodal(nodal_mass_times(unit[m]));
  }
}

Vec Piece::restrict_nodal(const Points& nodal) const {
  Vec free(mass_.size());
  for (size_t node = 0; node < n_free_of_.size(); ++node)
    for (int j = 0; j < n_free_of_[node]; ++j)
      free[position_[first_free_[node] + j]] =
          special_of_[node] < 0 ? nodal(j, node) : bases_[special_of_[node]].col(j).dot(nodal.col(node));
  return free;
}

Points Piece::expand(const Vec& free, const std::vector<double>& held) const {
  Points nodal(3, n_free_of_.size());
  for (size_t node = 0; node < n_free_of_.size(); ++node) {
    if (special_of_[node] < 0) {
      for (int j = 0; j < 3; ++j) nodal(j, node) = free[position_[first_free_[node] + j]];
      continue;
    }
    Vec3 value = Vec3::Zero();
    for (int j = 0; j < n_free_of_[node]; ++j)
      value += free[position_[first_free_[node] + j]] * bases_[special_of_[node]].col(j);
    nodal.col(node) = value;
  }
  for (size_t i = 0; i < held_.size(); ++i) nodal.col(held_[i].node) += held[i] * held_[i].direction;
  return nodal;
}

// As stored; in single precision fitted to the operators of the bolted flanges.
double Piece::bytes_of_operator_entry() const {
  return setup_.precision == Precision::double_precision ? 8.0 : 0.1 * std::log2(16.0 / setup_.storage_error) - 1.5;
}

double Piece::predicted_bytes() const {
  const double n_b = n_interface_, n = static_cast<double>(node_of_free_.size());
  const double entry = bytes_of_operator_entry();
  return predicted_factor_bytes_ + (setup_.twin || is_mostly_interface_ ? 0.0 : entry * 0.5 * n_b * n_b) +
         8.0 * 12.0 * n;
}

double Piece::bytes() const {
  const bool shares = setup_.twin != nullptr;
  return (factor_ && !shares ? factor_->bytes() : 0.0) + (plain_factor_ ? plain_factor_->bytes() : 0.0) +
         (h_ && !(shares && setup_.twin->h_ == h_) ? h_->bytes() : 0.0) + 8.0 * 12.0 * n_free();
}

}  // namespace dygita
