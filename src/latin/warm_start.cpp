#include "latin/warm_start.hpp"

#include <algorithm>

namespace dygita {

WarmStart::WarmStart(const InterfaceFields* fields, size_t i_step, Vec weight)
    : fields_(fields), i_step_(i_step), weight_(std::move(weight)) {}

bool WarmStart::predict(int increment, Vec& q) {
  constexpr double memory = 0.5;
  if (!fields_) return true;
  if (has_guessed_)
    for (int i = 0; i < n_guesses; ++i)
      error_[i] = memory * error_[i] + (guess_[i] - q).cwiseProduct(weight_).squaredNorm();
  kept_before_.swap(kept_);
  has_guessed_ = fields_->read(i_step_, static_cast<size_t>(increment), q.size(), kept_);
  if (!has_guessed_) {
    kept_.resize(0);
    return false;
  }
  if (kept_before_.size() != q.size()) {  // the first increment: what was before is not known
    q = kept_;
    has_guessed_ = false;
    return true;
  }
  guess_ = {q, kept_, q + kept_ - kept_before_};
  const auto least = std::min_element(error_.begin(), error_.end()) - error_.begin();
  // The second increment has no hindsight yet.
  q = guess_[error_ == std::array<double, n_guesses>{} ? n_guesses - 1 : static_cast<size_t>(least)];
  return true;
}

}  // namespace dygita
