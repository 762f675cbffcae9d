#include "base/fair_shares.hpp"

#include <algorithm>
#include <numeric>

namespace dygita {

void FairShares::divide_evenly(int n, int n_shares) {
  n_ = n;
  bounds_.clear();
  for (long i = 0; i <= n_shares; ++i) bounds_.push_back(static_cast<int>(n * i / n_shares));
}

void FairShares::follow(const std::vector<double>& seconds) {
  constexpr double near_enough = 1.03;  // times the mean: the next run differs by as much
  const double all = std::accumulate(seconds.begin(), seconds.end(), 0.0);
  const double fair = all / static_cast<double>(seconds.size());
  if (!(*std::max_element(seconds.begin(), seconds.end()) > near_enough * fair)) return;
  const std::vector<int> before = bounds_;
  size_t share = 0;
  double until = 0.0;  // of the shares before
  for (size_t k = 1; k + 1 < bounds_.size(); ++k) {
    const double wanted = fair * static_cast<double>(k);
    while (share + 1 < seconds.size() && until + seconds[share] < wanted) until += seconds[share++];
    const double part = seconds[share] > 0.0 ? (wanted - until) / seconds[share] : 0.0;
    const double at = before[share] + part * (before[share + 1] - before[share]);
    bounds_[k] = std::clamp(static_cast<int>(0.5 * (before[k] + at) + 0.5), bounds_[k - 1], n_);
  }
}

}  // namespace dygita
