#include "drawing/plot_data.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "drawing/svg_plot.hpp"

namespace dygita {

namespace {

std::vector<double> shown(std::vector<double> values, const PlotAxis& axis) {
  if (axis.is_log) std::erase_if(values, [](double v) { return !(v > 0.0); });
  return values;
}

}  // namespace

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
  const auto column = [&](size_t i) {
    return std::isfinite(x[i]) && span > 0.0 ? std::floor(n_pixels * (x[i] - low) / span) : -1.0;
  };
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

Extent extent_x(const Plot& plot) {
  Extent extent;
  for (const PlotLine& line : plot.lines) extent.add(shown(line.x, plot.x));
  for (const PlotLine& line : plot.stacked) extent.add(shown(line.x, plot.x));
  for (const PlotBand& band : plot.bands) extent.add(shown(band.x, plot.x));
  for (const PlotSpan& span : plot.spans) extent.add({span.from, span.to});
  if (extent.low && !plot.marks.empty() && !plot.x.is_log) {  // room for rings
    const double margin = 0.02 * (*extent.high - *extent.low);
    extent = {*extent.low - margin, *extent.high + margin};
  }
  return extent;
}

Extent extent_y(const Plot& plot, const std::vector<PlotLine>& edges) {
  Extent extent;
  for (const PlotLine& line : plot.lines) extent.add(shown(line.y, plot.y));
  for (const PlotLine& line : edges) extent.add(shown(line.y, plot.y));
  if (!edges.empty() && !plot.y.is_log) extent.add(0.0);
  for (const PlotBand& band : plot.bands) {
    extent.add(shown(band.low, plot.y));
    extent.add(shown(band.high, plot.y));
  }
  for (const PlotLevel& level : plot.levels) extent.add(shown({level.y}, plot.y));
  if (!extent.low) return extent;
  if (plot.y.is_log) {
    const double factor = std::pow(*extent.high / *extent.low, 0.05);
    return {*extent.low / factor, *extent.high * factor};
  }
  const double span = *extent.high - std::min(*extent.low, plot.y.from.value_or(*extent.low));
  const double margin = 0.05 * (span > 0.0 ? span : std::abs(*extent.high));
  if (*extent.high != 0.0) extent.high = *extent.high + margin;
  if (*extent.low != 0.0) extent.low = *extent.low - margin;
  if (*extent.low > 0.0 && *extent.low < 0.5 * *extent.high) extent.low = 0.0;
  return extent;
}

}  // namespace dygita
