#include "report/stress_scale.hpp"

#include <algorithm>

namespace dygita {

StressScale::StressScale(std::vector<std::pair<double, double>> values, int n_colors) {
  std::sort(values.begin(), values.end());
  const double top =
      values.empty() ? 1.0 : std::max(1.0, values[std::min(values.size() - 1, values.size() * 199 / 200)].first);
  double all = 0.0;
  for (const auto& [value, area] : values) all += area;
  // What this share of the picture does not exceed.
  const auto quantile = [&](double share) {
    double covered = 0.0;
    for (const auto& [value, area] : values)
      if ((covered += area) >= share * all) return std::min(value, top);
    return top;
  };
  is_by_quantile_ = quantile(0.5) < 0.2 * top;
  for (int i = 0; i <= n_colors; ++i) {
    const double share = static_cast<double>(i) / n_colors;
    ends_.push_back(is_by_quantile_ ? quantile(share) : share * top);
  }
  ends_.front() = 0.0;
  ends_.back() = top;
  is_exceeded_ = !values.empty() && values.back().first > 1.01 * top;
}

int StressScale::color(double value) const {
  return static_cast<int>(std::upper_bound(ends_.begin() + 1, ends_.end() - 1, value) - ends_.begin()) - 1;
}

}  // namespace dygita
