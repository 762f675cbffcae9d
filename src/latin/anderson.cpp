#include "latin/anderson.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"

namespace dygita {

Anderson::Anderson(int depth, int n_problems, double relaxation, Vec weight, const InterfaceSums& sums)
    : depth_(depth),
      n_problems_(depth > 0 ? n_problems : 0),
      relaxation_(relaxation),
      weight_(std::move(weight)),
      recent_(depth, weight_.size(), sums),
      past_(n_problems_, weight_.size(), sums),
      sums_(sums) {}

void Anderson::begin() {
  recent_.clear();
  first_sums_.clear();
  has_before_ = false;
}

void Anderson::replay(const Field& q, const Field& image) {
  if (!accelerates()) return;
  q_first_ = q;
  residual_first_ = (image - q).cwiseProduct(weight_);
  has_before_ = true;
}

InterfaceSums::ToCome Anderson::first_sums(const Field& q, const Field& image) {
  if (!accelerates()) return {};
  residual_.resize(q.size());
  parallel_for_ranges(q.size(), [&](Eigen::Index first, Eigen::Index n) {
    residual_.segment(first, n) =
        (image.segment(first, n) - q.segment(first, n)).cwiseProduct(weight_.segment(first, n));
  });
  return has_before_ ? recent_.sums_to_add(residual_, residual_before_) : past_.sums_to_project(residual_);
}

void Anderson::advance(Eigen::Ref<Vec> q, const Field& image) {
  if (!accelerates()) {
    q += relaxation_ * (image - q);
    return;
  }
  if (first_sums_.empty()) {
    const InterfaceSums::ToCome needed = first_sums(q, image);
    first_sums_ = sums_.add(needed.n, needed.share);
  }
  const bool is_first = !has_before_;
  const double norm =
      std::sqrt(is_first ? past_.project(first_sums_.data()) : recent_.add(q, q_before_, first_sums_.data()));
  first_sums_.clear();
  if (is_first) {
    q_first_ = q;
    residual_first_ = residual_;
    best_ = norm;
  } else if (norm > 2.0 * best_) {
    recent_.clear();
    best_ = norm;
  } else {
    best_ = std::min(best_, norm);
  }
  has_before_ = true;
  q_before_ = q;
  residual_before_ = residual_;
  (is_first ? past_ : recent_).take_off(q, residual_);
  parallel_for_ranges(q.size(), [&](Eigen::Index first, Eigen::Index n) {
    q.segment(first, n) += relaxation_ * residual_.segment(first, n).cwiseQuotient(weight_.segment(first, n));
  });
}

void Anderson::end(const Field& q, const Field& image, bool is_solved) {
  if (!is_solved) past_.clear();
  if (!is_solved || !has_before_) return;
  residual_ = (image - q).cwiseProduct(weight_);
  past_.add(q, q_first_, residual_, residual_first_);
}

}  // namespace dygita
