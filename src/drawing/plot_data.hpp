// What the data of a chart span.
#pragma once

#include <optional>
#include <vector>

#include "drawing/svg_plot.hpp"

namespace dygita {

// Smallest and largest finite value so far.
struct Extent {
  std::optional<double> low, high;
  void add(double value);
  void add(const std::vector<double>& values);
};

// What the axes of a chart must show, with some room; `edges` are the upper edges of its stacked areas.
Extent extent_x(const Plot& plot);
Extent extent_y(const Plot& plot, const std::vector<PlotLine>& edges);

}  // namespace dygita
