// What a chart reports about itself, beside what it shows, so that embedded/charts.js can read values off it.
#pragma once

#include <string>

#include "drawing/plot_scale.hpp"

namespace dygita {

// First and last value, whether logarithmic, unit, title and, where they are given, ticks of one axis ("x", "y") as
// data attributes. Ticks are in pixels: set_pixels comes first.
std::string axis_data(const char* axis, const PlotScale& scale);

// data-name: of a line, an area, a span.
std::string named(const std::string& name);

}  // namespace dygita
