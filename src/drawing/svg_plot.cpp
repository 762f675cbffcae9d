#include "drawing/svg_plot.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/error.hpp"
#include "base/log.hpp"
#include "drawing/plot_attributes.hpp"
#include "drawing/plot_legend.hpp"
#include "drawing/plot_scale.hpp"
#include "drawing/svg_text.hpp"

namespace dygita {

namespace {

constexpr double text_height = 12.0;  // px
constexpr const char* ink = "#222222";
constexpr const char* grey = "#666666";

std::string text_at(double x, double y, const std::string& text, const char* anchor, const char* color = ink,
                    const std::string& more = "") {
  return fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"{}\" fill=\"{}\"{}>{}</text>\n", coordinate(x),
                     coordinate(y), anchor, color, more, escaped(text));
}

struct Sides {
  double left, right, top, bottom;
};

std::vector<double> filled(size_t n, double value) { return std::vector<double>(n, value); }

// Upper edges of stacked areas, the first at the bottom.
std::vector<PlotLine> cumulated(const std::vector<PlotLine>& stacked) {
  std::vector<PlotLine> edges = stacked;
  for (size_t k = 1; k < edges.size(); ++k)
    for (size_t i = 0; i < edges[k].y.size(); ++i) edges[k].y[i] += edges[k - 1].y[i];
  return edges;
}

class Chart {
 public:
  explicit Chart(const Plot& plot)
      : plot_(plot),
        edges_(cumulated(plot.stacked)),
        x_(plot.x, extent_x(plot), 8),
        y_(plot.y, extent_y(plot, edges_), 5),
        legend_(plot) {
    double label_width = 0.0;
    for (const PlotScale::Tick& tick : y_.ticks()) label_width = std::max(label_width, text_width(tick.label));
    frame_ = {label_width + 34.0, plot.width - 14.0,
              10.0 + legend_row * legend_.n_rows() + (plot.spans.empty() ? 0.0 : legend_row), plot.height - 42.0};
    x_.set_pixels(frame_.left, frame_.right);
    y_.set_pixels(frame_.bottom, frame_.top);
  }

  std::string text() {
    open();
    draw_spans();
    draw_grid();
    draw_bands();
    draw_stacked();
    draw_levels();
    draw_lines();
    draw_marks();
    draw_axes();
    text_ += legend_.text();
    text_ += "</svg>\n";
    return std::move(text_);
  }

 private:
  template <class... Values>
  void put(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
  }

  void open() {
    put("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\" "
        "aria-label=\"{2}\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"{3}\">\n<title>{2}</title>\n",
        plot_.width, plot_.height, escaped(plot_.title), text_height);
    if (!plot_.description.empty()) put("<desc>{}</desc>\n", escaped(plot_.description));
    put("<rect width=\"{}\" height=\"{}\" fill=\"#ffffff\"/>\n", plot_.width, plot_.height);
    put("<svg class=\"plot\" x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{3}\" viewBox=\"{0} {1} {2} {3}\"{4}{5}>\n",
        coordinate(frame_.left), coordinate(frame_.top), coordinate(frame_.right - frame_.left),
        coordinate(frame_.bottom - frame_.top), axis_data("x", x_), axis_data("y", y_));
  }

  // The inner svg clips what it holds to the frame, without an id that would have to be unique in a page.
  void draw_spans() {
    for (const PlotSpan& span : plot_.spans)
      put("<rect class=\"span\"{} x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"#f0ede4\"/>\n", named(span.label),
          coordinate(x_.pixel(span.from)), coordinate(frame_.top),
          coordinate(std::max(1.0, x_.pixel(span.to) - x_.pixel(span.from))), coordinate(frame_.bottom - frame_.top));
    for (const PlotSpan& span : plot_.missed)
      put("<rect class=\"missed\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"#d55e00\" "
          "fill-opacity=\"0.22\"/>\n",
          coordinate(x_.pixel(span.from)), coordinate(frame_.top),
          coordinate(std::max(1.0, x_.pixel(span.to) - x_.pixel(span.from))), coordinate(frame_.bottom - frame_.top));
  }

  void draw_grid() {
    for (const bool is_minor : {true, false}) {
      std::string path;
      for (const PlotScale::Tick& tick : x_.ticks())
        if (tick.is_minor == is_minor)
          path += fmt::format("M{} {}V{}", coordinate(x_.pixel(tick.value)), coordinate(frame_.top),
                              coordinate(frame_.bottom));
      for (const PlotScale::Tick& tick : y_.ticks())
        if (tick.is_minor == is_minor)
          path += fmt::format("M{} {}H{}", coordinate(frame_.left), coordinate(y_.pixel(tick.value)),
                              coordinate(frame_.right));
      if (!path.empty())
        put("<path class=\"grid\" d=\"{}\" stroke=\"{}\" fill=\"none\" stroke-width=\"0.7\"/>\n", path,
            is_minor ? "#efefef" : "#dcdcdc");
    }
    if (y_.low() < 0.0 && y_.high() > 0.0 && !plot_.y.is_log)
      put("<path d=\"M{} {}H{}\" stroke=\"#999999\" stroke-width=\"0.8\"/>\n", coordinate(frame_.left),
          coordinate(y_.pixel(0.0)), coordinate(frame_.right));
  }

  // "M1 2L3 4...": a gap where a value cannot be drawn. Answers single points as well, which a line would not show.
  std::string line_path(const std::vector<double>& x, const std::vector<double>& y, std::string* dots = nullptr) const {
    CHECK(x.size() == y.size(), "a line has as many x as y");
    const auto [xs, ys] = thinned(x, y, plot_.width);
    std::string path;
    int n_in_piece = 0;
    for (size_t i = 0; i <= xs.size(); ++i) {
      const bool is_drawn = i < xs.size() && x_.shows(xs[i]) && y_.shows(ys[i]);
      if (!is_drawn) {
        if (n_in_piece == 1 && dots) *dots += dot(xs[i - 1], ys[i - 1]);
        n_in_piece = 0;
        continue;
      }
      path += n_in_piece == 0 ? "M" : n_in_piece == 1 ? "L" : " ";
      path += coordinate(x_.pixel(xs[i])) + " " + coordinate(clamped(y_.pixel(ys[i])));
      ++n_in_piece;
    }
    return path;
  }

  std::string dot(double x, double y) const {
    return fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"2.5\"/>", coordinate(x_.pixel(x)),
                       coordinate(clamped(y_.pixel(y))));
  }

  // Far outside the frame nothing is seen, and renderers lose precision.
  double clamped(double pixel) const { return std::clamp(pixel, -10.0 * plot_.height, 10.0 * plot_.height); }

  // The area between two curves, where both can be drawn. On a logarithmic axis zero is the bottom.
  std::string area_path(const std::vector<double>& x, const std::vector<double>& low,
                        const std::vector<double>& high) const {
    CHECK(x.size() == low.size() && x.size() == high.size(), "an area has as many x as y");
    std::string path;
    size_t i = 0;
    const auto is_drawn = [&](size_t k) { return x_.shows(x[k]) && y_.shows(high[k]) && std::isfinite(low[k]); };
    while (i < x.size()) {
      if (!is_drawn(i)) {
        ++i;
        continue;
      }
      const size_t first = i;
      while (i < x.size() && is_drawn(i)) ++i;
      const auto range = [&](const std::vector<double>& v) {
        return std::vector<double>(v.begin() + static_cast<long>(first), v.begin() + static_cast<long>(i));
      };
      const auto [xs, highs] = thinned(range(x), range(high), plot_.width);
      auto [xs_low, lows] = thinned(range(x), range(low), plot_.width);
      path += "M";
      for (size_t k = 0; k < xs.size(); ++k) path += (k == 0 ? "" : " ") + point(xs[k], highs[k]);
      for (size_t k = xs_low.size(); k-- > 0;) path += " " + point(xs_low[k], y_.shows(lows[k]) ? lows[k] : y_.low());
      path += "z";
    }
    return path;
  }

  std::string point(double x, double y) const {
    return coordinate(x_.pixel(x)) + " " + coordinate(clamped(y_.pixel(y)));
  }

  void draw_bands() {
    for (const PlotBand& band : plot_.bands)
      put("<path d=\"{}\" fill=\"{}\" fill-opacity=\"{}\"/>\n", area_path(band.x, band.low, band.high), band.color,
          band.opacity);
  }

  void draw_stacked() {
    for (size_t k = edges_.size(); k-- > 0;) {
      const std::vector<double> floor = k == 0 ? filled(edges_[k].x.size(), 0.0) : edges_[k - 1].y;
      put("<path class=\"area\"{} d=\"{}\" fill=\"{}\" fill-opacity=\"0.75\"/>\n", named(edges_[k].name),
          area_path(edges_[k].x, floor, edges_[k].y), color_of(edges_[k], k));
    }
  }

  void draw_levels() {
    for (const PlotLevel& level : plot_.levels) {
      if (!y_.shows(level.y)) continue;
      put("<path d=\"M{} {}H{}\" stroke=\"{}\" stroke-width=\"1.2\" stroke-dasharray=\"6 3\"/>\n",
          coordinate(frame_.left), coordinate(y_.pixel(level.y)), coordinate(frame_.right), ink);
    }
  }

  void draw_lines() {
    for (size_t i = 0; i < plot_.lines.size(); ++i) {
      const PlotLine& line = plot_.lines[i];
      const std::string color = color_of(line, i);
      std::string dots;
      const std::string path = line_path(line.x, line.y, &dots);
      if (line.has_markers && line.x.size() <= 100) {
        dots.clear();
        for (size_t k = 0; k < line.x.size(); ++k)
          if (x_.shows(line.x[k]) && y_.shows(line.y[k])) dots += dot(line.x[k], line.y[k]);
      }
      if (!path.empty())
        put("<path class=\"line\"{} d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" "
            "stroke-linejoin=\"round\"{}/>\n",
            named(line.name), path, color, line.width, line.is_dashed ? " stroke-dasharray=\"6 4\"" : "");
      if (!dots.empty()) put("<g fill=\"{}\">{}</g>\n", color, dots);
    }
  }

  void draw_marks() {
    for (const PlotMark& mark : plot_.marks) {
      if (!x_.shows(mark.x) || !y_.shows(mark.y)) continue;
      const double x = x_.pixel(mark.x), y = y_.pixel(mark.y), width = text_width(mark.text);
      const bool is_left = x + width + 10.0 > frame_.right && x - width - 10.0 > frame_.left;
      const double base = std::clamp(y - 6.0, frame_.top + text_height, frame_.bottom - 4.0);
      put("<circle cx=\"{}\" cy=\"{}\" r=\"4.5\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"/>\n", coordinate(x),
          coordinate(y), ink);
      text_ += text_at(is_left ? x - 8.0 : x + 8.0, base, mark.text, is_left ? "end" : "start", ink,
                       " stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\"");
    }
    for (const PlotLevel& level : plot_.levels)
      if (y_.shows(level.y) && !level.label.empty())
        text_ +=
            text_at(frame_.right - 4.0,
                    y_.pixel(level.y) + (y_.pixel(level.y) < frame_.top + 1.5 * text_height ? text_height + 2.0 : -4.0),
                    level.label, "end", ink, " stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\"");
    if (!has_values())
      text_ += text_at(0.5 * (frame_.left + frame_.right), 0.5 * (frame_.top + frame_.bottom), "no values to draw",
                       "middle", grey);
  }

  bool has_values() const {
    const auto shows = [this](const std::vector<double>& x, const std::vector<double>& y) {
      for (size_t i = 0; i < x.size(); ++i)
        if (x_.shows(x[i]) && y_.shows(y[i])) return true;
      return false;
    };
    for (const PlotLine& line : plot_.lines)
      if (shows(line.x, line.y)) return true;
    for (const PlotLine& line : edges_)
      if (shows(line.x, line.y)) return true;
    for (const PlotBand& band : plot_.bands)
      if (shows(band.x, band.high)) return true;
    return false;
  }

  void draw_axes() {
    text_ += "</svg>\n";  // ends the clipped part
    put("<path d=\"M{0} {1}V{2}H{3}\" fill=\"none\" stroke=\"{4}\"/>\n", coordinate(frame_.left),
        coordinate(frame_.top), coordinate(frame_.bottom), coordinate(frame_.right), grey);
    double free_from = -1e9;
    for (const PlotScale::Tick& tick : x_.ticks()) {
      const double x = x_.pixel(tick.value), half = 0.5 * text_width(tick.label);
      if (tick.label.empty() || x - half < free_from || x < frame_.left - 1.0 || x > frame_.right + 1.0) continue;
      text_ += text_at(std::min(x, plot_.width - half - 2.0), frame_.bottom + 16.0, tick.label, "middle", grey,
                       " class=\"tick\"");
      free_from = x + half + 6.0;
    }
    double free_below = 1e9;
    for (const PlotScale::Tick& tick : y_.ticks()) {
      const double y = y_.pixel(tick.value);
      if (tick.label.empty() || y > free_below || y < frame_.top - 1.0 || y > frame_.bottom + 1.0) continue;
      text_ += text_at(frame_.left - 6.0, y + 4.0, tick.label, "end", grey, " class=\"tick\"");
      free_below = y - text_height;
    }
    text_ += text_at(0.5 * (frame_.left + frame_.right), plot_.height - 8.0, x_.title(), "middle");
    const std::string turned =
        fmt::format(" transform=\"rotate(-90 14 {0})\"", coordinate(0.5 * (frame_.top + frame_.bottom)));
    text_ += text_at(14.0, 0.5 * (frame_.top + frame_.bottom), y_.title(), "middle", ink, turned);
    double taken_to = 0.0;  // of two labels that would meet the second is left out
    for (const PlotSpan& span : plot_.spans) {
      const double half = 0.5 * text_width(span.label);
      const double middle = 0.5 * (x_.pixel(span.from) + x_.pixel(span.to));
      const double x = std::min(std::max(middle, frame_.left + half - 20.0), plot_.width - half - 2.0);
      if (x - half < taken_to) continue;
      text_ += text_at(x, frame_.top - 5.0, span.label, "middle", grey, " class=\"tick\"");
      taken_to = x + half + 6.0;
    }
  }

  const Plot& plot_;
  std::vector<PlotLine> edges_;
  PlotScale x_, y_;
  Sides frame_{};
  PlotLegend legend_;
  std::string text_;
};

}  // namespace

std::string svg(const Plot& plot) { return Chart(plot).text(); }

}  // namespace dygita
