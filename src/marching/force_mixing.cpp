#include "marching/force_mixing.hpp"

#include "numerics/dense.hpp"

namespace dygita {

Vec ForceMixing::next(const Vec& f, const Vec& g, const Vec& weight) {
  constexpr double ridge = 1e-14;
  Vec change = g - f;
  const auto squared = [&](const Vec& a) { return a.cwiseAbs2().dot(weight); };
  if (!before_.empty() && squared(change) > too_bad * too_bad * squared(before_.front().change)) before_.clear();
  Vec mixed = g;
  if (const auto n = static_cast<Eigen::Index>(before_.size()); n > 0) {
    Mat differences(g.size(), n);
    for (Eigen::Index i = 0; i < n; ++i) differences.col(i) = change - before_[static_cast<size_t>(i)].change;
    const Mat weighted = weight.asDiagonal() * differences;
    Mat gram = differences.transpose() * weighted;
    gram.diagonal() *= 1.0 + ridge;
    const Vec shares = solve_dense(gram, weighted.transpose() * change);
    if (shares.allFinite())
      for (Eigen::Index i = 0; i < n; ++i) mixed -= shares[i] * (g - before_[static_cast<size_t>(i)].result);
  }
  before_.push_front({g, std::move(change)});
  if (before_.size() > depth) before_.pop_back();
  return mixed;
}

}  // namespace dygita
