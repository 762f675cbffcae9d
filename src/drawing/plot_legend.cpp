#include "drawing/plot_legend.hpp"

#include <algorithm>

#include "base/log.hpp"
#include "drawing/svg_text.hpp"

namespace dygita {

namespace {

constexpr double character = 6.4, symbol = 26.0, gap = 6.0, indent = 8.0;  // px; `character`: mean width of one

}  // namespace

double text_width(const std::string& text) {
  const auto n =
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; });
  return character * static_cast<double>(n);
}

std::string color_of(const PlotLine& line, size_t i) {
  return line.color.empty() ? series_color(static_cast<int>(i)) : line.color;
}

PlotLegend::PlotLegend(const Plot& plot) {
  const auto add = [this](const std::string& name, const std::string& color, Shape shape, double opacity) {
    if (!name.empty()) entries_.push_back({name, color, shape, opacity});
  };
  for (size_t i = 0; i < plot.lines.size(); ++i)
    add(plot.lines[i].name, color_of(plot.lines[i], i), plot.lines[i].is_dashed ? Shape::dashed : Shape::line, 1.0);
  for (size_t i = 0; i < plot.stacked.size(); ++i)
    add(plot.stacked[i].name, color_of(plot.stacked[i], i), Shape::area, 0.75);
  for (const PlotBand& band : plot.bands) add(band.name, band.color, Shape::area, band.opacity);
  double x = indent;
  for (Entry& entry : entries_) {
    const double width = symbol + gap + text_width(entry.name) + 2.0 * gap;
    if (x > indent && x + width > plot.width) {
      x = indent;
      ++n_rows_;
    }
    entry.x = x;
    entry.row = n_rows_;
    x += width;
  }
  if (!entries_.empty()) ++n_rows_;
}

std::string PlotLegend::text() const {
  std::string text;
  for (const Entry& entry : entries_) {
    const double y = 12.0 + legend_row * entry.row;
    if (entry.shape == Shape::area)
      text += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"10\" fill=\"{}\" fill-opacity=\"{}\"/>\n",
                          coordinate(entry.x), coordinate(y - 5.0), symbol, entry.color, entry.opacity);
    else
      text += fmt::format("<path d=\"M{} {}h{}\" stroke=\"{}\" stroke-width=\"2\"{}/>\n", coordinate(entry.x),
                          coordinate(y), symbol, entry.color,
                          entry.shape == Shape::dashed ? " stroke-dasharray=\"6 4\"" : "");
    text += fmt::format("<text x=\"{}\" y=\"{}\" fill=\"#222222\">{}</text>\n", coordinate(entry.x + symbol + gap),
                        coordinate(y + 4.0), escaped(entry.name));
  }
  return text;
}

}  // namespace dygita
