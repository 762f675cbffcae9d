// Names of what a chart draws, in rows above it.
#pragma once

#include <string>
#include <vector>

#include "drawing/svg_plot.hpp"

namespace dygita {

constexpr double legend_row = 16.0;  // px

// px, estimated: no font is at hand.
double text_width(const std::string& text);

// Its own, or that of its place in the cycle.
std::string color_of(const PlotLine& line, size_t i);

class PlotLegend {
 public:
  explicit PlotLegend(const Plot& plot);

  int n_rows() const { return n_rows_; }
  std::string text() const;  // SVG

 private:
  enum class Shape { line, dashed, area };
  struct Entry {
    std::string name, color;
    Shape shape;
    double opacity, x = 0.0;
    int row = 0;
  };
  std::vector<Entry> entries_;
  int n_rows_ = 0;
};

}  // namespace dygita
