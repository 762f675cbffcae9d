#include "pieces/piece_mass.hpp"

#include <Eigen/IterativeLinearSolvers>

namespace dygita {

PieceMass::PieceMass(const Body& body, const TimeScheme& scheme, const FreeUnknowns& unknowns)
    : mass_(body.mass), lumped_(unknowns.size()) {
  for (int i = 0; i < unknowns.size(); ++i)
    lumped_[unknowns.position(i)] = mass_->lumped[unknowns.node_of_unknown()[i]];
  if (scheme.is_static) return;
  make_massless(body, scheme, unknowns);
  if (mass_->full.size() > 0)
    matrix_ = unknowns.restrict_matrix(mass_->full);
  else if (mass_->matrix.size() > 0)
    make_matrix(unknowns);
}

// Rows of B^T M B: nodes with the same axes have one entry a neighbour and direction, others a block.
void PieceMass::make_matrix(const FreeUnknowns& unknowns) {
  const SparseMatrix& nodal = mass_->matrix;
  const int n = unknowns.size();
  const int* starts = nodal.outerIndexPtr();
  const auto are_plain = [&](int a, int b) { return unknowns.share_axes(a, b); };
  std::vector<int> count(n, 0);
  for (int a = 0; a < nodal.rows(); ++a)
    for (int e = starts[a]; e < starts[a + 1]; ++e) {
      const int b = nodal.innerIndexPtr()[e];
      for (int j = 0; j < unknowns.count(a); ++j) count[unknowns.at(a, j)] += are_plain(a, b) ? 1 : unknowns.count(b);
    }
  matrix_.resize(n, n);
  matrix_.outerIndexPtr()[0] = 0;
  for (int i = 0; i < n; ++i) matrix_.outerIndexPtr()[i + 1] = matrix_.outerIndexPtr()[i] + count[i];
  matrix_.resizeNonZeros(matrix_.outerIndexPtr()[n]);
  for (int a = 0; a < nodal.rows(); ++a)
    for (int j = 0; j < unknowns.count(a); ++j) {
      int at = matrix_.outerIndexPtr()[unknowns.at(a, j)];
      for (int e = starts[a]; e < starts[a + 1]; ++e) {
        const int b = nodal.innerIndexPtr()[e];
        const bool is_plain = are_plain(a, b);
        for (int c = is_plain ? j : 0; c < (is_plain ? j + 1 : unknowns.count(b)); ++c) {
          matrix_.innerIndexPtr()[at] = unknowns.at(b, c);
          matrix_.valuePtr()[at++] =
              nodal.valuePtr()[e] * (is_plain ? 1.0 : unknowns.basis(a).col(j).dot(unknowns.basis(b).col(c)));
        }
      }
    }
}

void PieceMass::make_massless(const Body& body, const TimeScheme& scheme, const FreeUnknowns& unknowns) {
  const StiffnessPtr stiffness = body.matrices->stiffness();
  const SparseMatrix& k = *stiffness;
  std::vector<Eigen::Triplet<double>> entries;
  for (int node = 0; node < unknowns.n_nodes(); ++node) {
    if (mass_->is_massless.empty() || !mass_->is_massless[node]) continue;
    for (int j = 0; j < unknowns.count(node); ++j) {
      const int column = static_cast<int>(massless_.size());
      massless_.push_back(unknowns.at(node, j));
      for (int e = k.outerIndexPtr()[3 * node]; e < k.outerIndexPtr()[3 * node + 1]; e += 3) {
        const int other = k.innerIndexPtr()[e] / 3, shift = e - k.outerIndexPtr()[3 * node];
        Vec3 force;  // K is symmetric: the column of a node is its rows
        for (int c = 0; c < 3; ++c) {
          force[c] = 0.0;
          for (int r = 0; r < 3; ++r)
            force[c] += k.valuePtr()[k.outerIndexPtr()[3 * node + r] + shift + c] * unknowns.basis(node)(r, j);
        }
        for (int c = 0; c < unknowns.count(other); ++c)
          entries.emplace_back(unknowns.at(other, c), column, unknowns.basis(other).col(c).dot(force));
      }
    }
  }
  massless_columns_.resize(unknowns.size(), static_cast<Eigen::Index>(massless_.size()));
  massless_columns_.setFromTriplets(entries.begin(), entries.end());
  end_factor_ = Vec::Constant(unknowns.size(), scheme.from_end(1.0));
  for (const int i : massless_) end_factor_[i] = 1.0;
}

Vec PieceMass::times(const Vec& v) const {
  if (is_matrix()) return matrix_ * v;
  return lumped_.cwiseProduct(v);
}

Vec PieceMass::solve(const Vec& momentum) const {
  Eigen::ConjugateGradient<SparseMatrix, Eigen::Lower | Eigen::Upper, Eigen::DiagonalPreconditioner<double>> solver;
  solver.setTolerance(1e-14);
  solver.setMaxIterations(10 * matrix_.rows());
  solver.compute(matrix_);
  return solver.solve(momentum);
}

Points PieceMass::times_nodal(const Points& nodal) const {
  if (mass_->full.size() > 0) return mass_->times(nodal, false);
  if (mass_->matrix.size() == 0) return nodal * mass_->lumped.asDiagonal();
  return (mass_->matrix * nodal.transpose()).transpose();
}

std::vector<double> PieceMass::times_held(const Points& nodal, const std::vector<HeldDirection>& held) const {
  const SparseMatrix& matrix = mass_->matrix;
  std::vector<double> values(held.size(), 0.0);
  if (mass_->full.size() > 0) {
    const Points force = times_nodal(nodal);
    for (size_t i = 0; i < held.size(); ++i) values[i] = held[i].direction.dot(force.col(held[i].node));
    return values;
  }
  for (size_t i = 0; i < held.size(); ++i) {
    const int node = held[i].node;
    if (matrix.size() == 0) {
      values[i] = mass_->lumped[node] * held[i].direction.dot(nodal.col(node));
      continue;
    }
    for (int e = matrix.outerIndexPtr()[node]; e < matrix.outerIndexPtr()[node + 1]; ++e)
      values[i] += matrix.valuePtr()[e] * held[i].direction.dot(nodal.col(matrix.innerIndexPtr()[e]));
  }
  return values;
}

Vec PieceMass::of_massless(const Vec& v) const {
  Vec own(static_cast<Eigen::Index>(massless_.size()));
  for (size_t i = 0; i < massless_.size(); ++i) own[static_cast<Eigen::Index>(i)] = v[massless_[i]];
  return own;
}

}  // namespace dygita
