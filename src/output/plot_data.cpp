#include "output/plot_data.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "output/svg_plot.hpp"

namespace dygita {

void Extent::add(double value) {
  if (!std::isfinite(value)) return;
  low = std::min(low.value_or(value), value);
  high = std::max(high.value_or(value), value);
}

void Extent::add(const std::vector<double>& values) {
  for (const double value : values) add(value);
}

std::pair<std::vector<double>, std::vector<double>> thinned(const std::vector<double>& x, const std::vector<double>& y,
                                                            int n_pixels) {
  CHECK(x.size() == y.size() && n_pixels > 0, "as many x as y, and room to draw");
  if (x.size() <= 4 * static_cast<size_t>(n_pixels)) return {x, y};
  Extent extent;
  extent.add(x);
  const double low = extent.low.value_or(0.0), span = extent.high.value_or(1.0) - low;
  const auto column = [&](size_t i) { return std::isfinite(x[i]) && span > 0.0 ? std::floor(n_pixels * (x[i] - low) / span) : -1.0; };
  std::pair<std::vector<double>, std::vector<double>> kept;
  for (size_t i = 0; i < x.size();) {
    size_t last = i, lowest = i, highest = i, gap = x.size();
    for (size_t k = i; k < x.size() && column(k) == column(i); ++k) {
      last = k;
      if (!std::isfinite(y[k])) gap = k;
      if (y[k] < y[lowest] || !std::isfinite(y[lowest])) lowest = k;
      if (y[k] > y[highest] || !std::isfinite(y[highest])) highest = k;
    }
    std::vector<size_t> chosen = {i, lowest, highest, last};
    if (gap < x.size()) chosen.push_back(gap);
    std::sort(chosen.begin(), chosen.end());
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    for (const size_t k : chosen) {
      kept.first.push_back(x[k]);
      kept.second.push_back(y[k]);
    }
    i = last + 1;
  }
  return kept;
}

}  // namespace dygita
