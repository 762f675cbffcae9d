#include "latin/anderson.hpp"

#include <Eigen/QR>

namespace dygita {

void Anderson::clear() {
  q_before_.resize(0);
  dq_.clear();
  df_.clear();
  best_ = 0.0;
}

void Anderson::advance(Vec& q, const Vec& image) {
  const Vec residual = (image - q).cwiseProduct(weight_);
  const Vec step = relaxation_ * (image - q);
  if (depth_ == 0) {
    q += step;
    return;
  }
  const double norm = residual.norm();
  if (q_before_.size() == q.size()) {
    if (norm > 2.0 * best_) {
      dq_.clear();
      df_.clear();
      best_ = norm;
    } else {
      dq_.push_back(q - q_before_);
      df_.push_back(residual - residual_before_);
      if (static_cast<int>(dq_.size()) > depth_) {
        dq_.pop_front();
        df_.pop_front();
      }
    }
  }
  best_ = q_before_.size() == q.size() ? std::min(best_, norm) : norm;
  q_before_ = q;
  residual_before_ = residual;
  q += step;
  if (df_.empty()) return;

  // The combination of past residuals nearest to this one; what it predicts is taken off.
  const int m = static_cast<int>(df_.size());
  Mat differences(residual.size(), m);
  for (int j = 0; j < m; ++j) differences.col(j) = df_[j];
  const Vec gamma = differences.colPivHouseholderQr().solve(residual);
  for (int j = 0; j < m; ++j) q -= gamma[j] * (dq_[j] + relaxation_ * df_[j].cwiseQuotient(weight_));
}

}  // namespace dygita
