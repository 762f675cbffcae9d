#include "latin/differences.hpp"

#include <cmath>

#include "base/parallel.hpp"

namespace dygita {

namespace {

// A column of which the newer ones leave less than this (squared, of its length) is not used: below it the Gram matrix
// knows rounding errors only.
constexpr double independent = 1e-12;

}  // namespace

Differences::Differences(int depth, Eigen::Index length) : Differences(depth, length, InterfaceSums(length)) {}

Differences::Differences(int depth, Eigen::Index length, InterfaceSums sums)
    : sums_(std::move(sums)),
      dq_(length, depth),
      df_(length, depth),
      gram_(depth, depth),
      factor_(depth, depth),
      along_(depth),
      gamma_(depth) {
  newest_first_.reserve(depth + 1);
  used_.reserve(depth);
}

void Differences::clear() {
  newest_first_.clear();
  last_ = -1;
}

InterfaceSums::ToCome Differences::sums_to_project(const Vec& residual) const {
  const int n = static_cast<int>(newest_first_.size());
  return {n + 1, [this, n, &residual](Eigen::Index first, Eigen::Index size, double* to) {
            const auto own = residual.segment(first, size);
            for (int i = 0; i < n; ++i) to[i] += df_.col(newest_first_[i]).segment(first, size).dot(own);
            to[n] += own.squaredNorm();
          }};
}

double Differences::project(const double* sums) {
  const int n = static_cast<int>(newest_first_.size());
  for (int i = 0; i < n; ++i) along_[newest_first_[i]] = sums[i];
  return sums[n];
}

double Differences::project(const Vec& residual) {
  const InterfaceSums::ToCome needed = sums_to_project(residual);
  return project(sums_.add(needed.n, needed.share).data());
}

// The column is taken already; it counts once `add` has put it in front.
InterfaceSums::ToCome Differences::sums_to_add(const Vec& residual, const Vec& residual_before) {
  if (gamma_.size() == 0) return sums_to_project(residual);
  const int at = (last_ + 1) % static_cast<int>(gamma_.size());
  std::erase(newest_first_, at);
  last_ = at;
  parallel_for_ranges(residual.size(), [&](Eigen::Index first, Eigen::Index size) {
    df_.col(at).segment(first, size) = residual.segment(first, size) - residual_before.segment(first, size);
  });
  const int n = static_cast<int>(newest_first_.size());
  return {2 * n + 3, [this, n, at, &residual](Eigen::Index first, Eigen::Index size, double* to) {
            const auto own = residual.segment(first, size);
            const auto change = df_.col(at).segment(first, size);
            for (int i = 0; i < n; ++i) {
              const auto other = df_.col(newest_first_[i]).segment(first, size);
              to[2 * i] += other.dot(own);
              to[2 * i + 1] += other.dot(change);
            }
            to[2 * n] += change.dot(own);
            to[2 * n + 1] += change.squaredNorm();
            to[2 * n + 2] += own.squaredNorm();
          }};
}

double Differences::add(const Eigen::Ref<const Vec>& q, const Vec& q_before, const double* sums) {
  if (gamma_.size() == 0) return project(sums);
  const int n = static_cast<int>(newest_first_.size()), at = last_;
  const double length = std::sqrt(sums[2 * n + 1]), residual_size = sums[2 * n + 2];
  for (int i = 0; i < n; ++i) {
    along_[newest_first_[i]] = sums[2 * i];
    gram_(at, newest_first_[i]) = gram_(newest_first_[i], at) = sums[2 * i + 1] / length;
  }
  if (length == 0.0) return residual_size;
  along_[at] = sums[2 * n] / length;
  gram_(at, at) = 1.0;
  parallel_for_ranges(q.size(), [&](Eigen::Index first, Eigen::Index size) {
    df_.col(at).segment(first, size) /= length;
    dq_.col(at).segment(first, size) = (q.segment(first, size) - q_before.segment(first, size)) / length;
  });
  newest_first_.insert(newest_first_.begin(), at);
  return residual_size;
}

double Differences::add(const Eigen::Ref<const Vec>& q, const Vec& q_before, const Vec& residual,
                        const Vec& residual_before) {
  const InterfaceSums::ToCome needed = sums_to_add(residual, residual_before);
  return add(q, q_before, sums_.add(needed.n, needed.share).data());
}

// Range by range: each column is read once, what it is taken off stays in the nearest cache.
void Differences::subtract(const Mat& columns, const Vec& factors, Eigen::Ref<Vec> from) const {
  parallel_for_ranges(from.size(), [&](Eigen::Index first, Eigen::Index n) {
    auto range = from.segment(first, n);
    for (const int at : used_) range -= factors[at] * columns.col(at).segment(first, n);
  });
}

void Differences::take_off(Eigen::Ref<Vec> q, Vec& residual) {
  if (newest_first_.empty()) return;
  solve();
  subtract(df_, gamma_, residual);
  const Vec first = gamma_;
  // Once more: normal equations leave behind what their rounding errors hide. They use the same pairs.
  project(residual);
  solve();
  subtract(df_, gamma_, residual);
  subtract(dq_, first + gamma_, q);
}

// Normal equations, by Cholesky's factor built row by row.
void Differences::solve() {
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
    double entry = along_[at];
    for (int l = 0; l < row; ++l) entry -= factor_(row, l) * gamma_[used_[l]];
    gamma_[at] = entry / factor_(row, row);
  }
  for (int i = static_cast<int>(used_.size()) - 1; i >= 0; --i) {
    for (size_t l = i + 1; l < used_.size(); ++l) gamma_[used_[i]] -= factor_(l, i) * gamma_[used_[l]];
    gamma_[used_[i]] /= factor_(i, i);
  }
}

}  // namespace dygita
