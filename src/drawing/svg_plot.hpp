// Charts as SVG: lines, bands, stacked areas on linear or logarithmic axes, in engineering units. A chart stands alone
// (a file) or inside a page: no style sheet, no script, nothing from elsewhere.
//
//   Plot plot{.title = "Bolt force", .x = {"time", "s"}, .y = {"force", "N"}};
//   plot.lines.push_back({"normal", time, force});
//   write_text("bolt.svg", svg(plot));
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dygita {

struct PlotAxis {
  std::string quantity;   // "time"
  std::string unit = {};  // SI, as in tables: "s", "m/s^2"; what is drawn is µs, g (see engineering_unit)
  bool is_log = false;    // values that are not above zero are left out
  std::optional<double> from = {}, to = {};                // SI; left out: what the data spans
  std::vector<std::pair<double, std::string>> ticks = {};  // place (SI) and label; empty: sensible ones
};

struct PlotLine {
  std::string name;          // in the legend; empty: not there
  std::vector<double> x, y;  // SI, equally long; what is not finite breaks the line
  std::string color = {};    // empty: the next of series_color
  bool is_dashed = false, has_markers = false;
  double width = 1.6;
};

// Between two curves.
struct PlotBand {
  std::string name;
  std::vector<double> x, low, high;
  std::string color = "#999999";
  double opacity = 0.25;
};

// A shaded range of x, labelled at its top.
struct PlotSpan {
  double from, to;
  std::string label;
};

// A horizontal line across the chart.
struct PlotLevel {
  double y;
  std::string label;
};

// A ring around a point, with a text beside.
struct PlotMark {
  double x, y;
  std::string text;
};

struct Plot {
  std::string title, description = {};  // the description is for readers who do not see the chart
  PlotAxis x, y;
  std::vector<PlotLine> lines = {};
  std::vector<PlotLine> stacked = {};  // areas on top of each other, the first at the bottom; one x for all
  std::vector<PlotBand> bands = {};
  std::vector<PlotSpan> spans = {};
  std::vector<PlotSpan> missed = {};  // what has not converged: shaded red
  std::vector<PlotLevel> levels = {};
  std::vector<PlotMark> marks = {};
  int width = 720, height = 300;  // px
};

// The chart; lines longer than its width are thinned so that every peak stays. Names and labels are escaped. A chart
// without one finite value says so. CHECKs that x and y are equally long.
std::string svg(const Plot& plot);

// The points of a line that a chart `n_pixels` wide can show: first, smallest, largest and last of each pixel, in
// order. `x` increases; a value that is not finite stays, as a gap.
std::pair<std::vector<double>, std::vector<double>> thinned(const std::vector<double>& x, const std::vector<double>& y,
                                                            int n_pixels);

}  // namespace dygita
