#include "latin/differences.hpp"

#include <cmath>

namespace dygita {

namespace {

// A column of which the newer ones leave less than this (squared, of its length) is not used: below it the Gram matrix
// knows rounding errors only.
constexpr double independent = 1e-12;

}  // namespace

Differences::Differences(int depth, Eigen::Index length)
    : dq_(length, depth), df_(length, depth), gram_(depth, depth), factor_(depth, depth), gamma_(depth) {
  newest_first_.reserve(depth + 1);
  used_.reserve(depth);
}

void Differences::clear() {
  newest_first_.clear();
  last_ = -1;
}

void Differences::add(const Vec& q, const Vec& q_before, const Vec& residual, const Vec& residual_before) {
  if (gamma_.size() == 0) return;
  const int at = (last_ + 1) % static_cast<int>(gamma_.size());
  std::erase(newest_first_, at);
  last_ = at;
  auto df = df_.col(at);
  df = residual - residual_before;
  const double length = df.norm();
  if (length == 0.0) return;
  df /= length;
  dq_.col(at) = (q - q_before) / length;
  newest_first_.insert(newest_first_.begin(), at);
  for (const int other : newest_first_) gram_(at, other) = gram_(other, at) = df_.col(other).dot(df);
}

void Differences::take_off(Vec& q, Vec& residual) {
  // Twice: normal equations leave behind what their rounding errors hide.
  for (int pass = 0; pass < 2; ++pass) {
    solve(residual);
    for (const int at : used_) {
      q -= gamma_[at] * dq_.col(at);
      residual -= gamma_[at] * df_.col(at);
    }
  }
}

// Normal equations, by Cholesky's factor built row by row.
void Differences::solve(const Vec& residual) {
  used_.clear();
  for (const int at : newest_first_) {
    const int row = static_cast<int>(used_.size());
    double rest = gram_(at, at);
    for (int i = 0; i < row; ++i) {
      double entry = gram_(at, used_[i]);
      for (int l = 0; l < i; ++l) entry -= factor_(row, l) * factor_(i, l);
      factor_(row, i) = entry / factor_(i, i);
      rest -= factor_(row, i) * factor_(row, i);
    }
    if (!(rest > independent)) continue;
    factor_(row, row) = std::sqrt(rest);
    used_.push_back(at);
    double entry = df_.col(at).dot(residual);
    for (int l = 0; l < row; ++l) entry -= factor_(row, l) * gamma_[used_[l]];
    gamma_[at] = entry / factor_(row, row);
  }
  for (int i = static_cast<int>(used_.size()) - 1; i >= 0; --i) {
    for (size_t l = i + 1; l < used_.size(); ++l) gamma_[used_[i]] -= factor_(l, i) * gamma_[used_[l]];
    gamma_[used_[i]] /= factor_(i, i);
  }
}

}  // namespace dygita
