#include "report/bolt_charts.hpp"

#include <algorithm>
#include <cmath>

#include "base/log.hpp"
#include "drawing/plot_data.hpp"
#include "drawing/plot_legend.hpp"
#include "drawing/plot_scale.hpp"
#include "drawing/svg_text.hpp"

namespace dygita {

namespace {

// What takes preload, from zero outwards.
struct Taker {
  const char *name, *color;
};
constexpr Taker takers[] = {{"yielding of the bolt", "#d55e00"},
                            {"other bolts and static loads", "#56b4e9"},
                            {"the joint in the motion", "#0072b2"}};
static_assert(std::size(takers) == n_preload_takers);

// Gains to one side of zero, losses to the other: where each begins and ends.
std::array<std::pair<double, double>, n_preload_takers> placed(const BoltLoss& loss) {
  std::array<std::pair<double, double>, n_preload_takers> places;
  double gained = 0.0, lost = 0.0;
  for (size_t i = 0; i < n_preload_takers; ++i) {
    double& end = loss.by[i] < 0.0 ? gained : lost;
    places[i] = {end, end + loss.by[i]};
    end += loss.by[i];
  }
  return places;
}

std::string bar(double from, double to, double y, const char* color) {
  return fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"13\" fill=\"{}\"/>\n",
                     coordinate(std::min(from, to)), coordinate(y), coordinate(std::abs(to - from)), color);
}

// Bars from zero, on a scale that ends where the losses do.
class LossChart {
 public:
  explicit LossChart(const std::vector<BoltLoss>& losses) : losses_(losses), x_({"lost", "%"}, extent(losses), 8) {
    for (const BoltLoss& loss : losses) left_ = std::max(left_, 20.0 + text_width(loss.name));
    left_ = std::min(left_, 300.0);
    x_.set_pixels(left_, width - 20.0);
  }

  std::string svg() const {
    const double bottom = top + row * static_cast<double>(losses_.size()), height = bottom + 40.0;
    std::string text = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\" "
        "aria-label=\"Loss of preload\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"12\" "
        "fill=\"#222222\">\n<title>Loss of preload</title>\n",
        coordinate(width), coordinate(height));
    for (const PlotScale::Tick& tick : x_.ticks())
      text += fmt::format(
          "<path d=\"M{0} {1}V{2}\" stroke=\"#dcdcdc\"/><text x=\"{0}\" y=\"{3}\" "
          "text-anchor=\"middle\" fill=\"#666666\">{4}</text>\n",
          coordinate(x_.pixel(tick.value)), coordinate(top - 4.0), coordinate(bottom), coordinate(bottom + 14.0),
          escaped(tick.label));
    for (size_t i = 0; i < losses_.size(); ++i) text += bars(losses_[i], top + row * static_cast<double>(i));
    text += fmt::format("<path d=\"M{} {}V{}\" stroke=\"#222222\"/>\n", coordinate(x_.pixel(0.0)),
                        coordinate(top - 4.0), coordinate(bottom));
    return text +
           fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">loss (% of what the tightening gave)</text>\n",
                       coordinate(0.5 * (left_ + width - 20.0)), coordinate(bottom + 32.0)) +
           legend() + "</svg>\n";
  }

 private:
  static constexpr double width = 820.0, top = 30.0, row = 22.0;

  static Extent extent(const std::vector<BoltLoss>& losses) {
    Extent extent{0.0, 0.0};
    for (const BoltLoss& loss : losses) {
      for (const double value : {loss.all - loss.swing, loss.all + loss.swing}) extent.add(value);
      for (const auto& [from, to] : placed(loss)) extent.add(to);
    }
    if (!(*extent.high > *extent.low)) extent.high = 1.0;
    const double room = 0.04 * (*extent.high - *extent.low);
    return {*extent.low < 0.0 ? *extent.low - room : 0.0, *extent.high > 0.0 ? *extent.high + room : 0.0};
  }

  std::string bars(const BoltLoss& loss, double y) const {
    std::string text = fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>\n", coordinate(left_ - 8.0),
                                   coordinate(y + 11.0), escaped(loss.name));
    const auto places = placed(loss);
    for (size_t i = 0; i < n_preload_takers; ++i)
      text += bar(x_.pixel(places[i].first), x_.pixel(places[i].second), y, takers[i].color);
    if (loss.swing > 0.0)
      text += fmt::format("<path d=\"M{0} {2}H{1}M{0} {3}v7M{1} {3}v7\" stroke=\"#222222\" stroke-width=\"1.3\"/>\n",
                          coordinate(x_.pixel(loss.all - loss.swing)), coordinate(x_.pixel(loss.all + loss.swing)),
                          coordinate(y + 6.5), coordinate(y + 3.0));
    return text;
  }

  std::string legend() const {
    std::string text;
    double x = left_;
    for (const Taker& taker : takers) {
      text += fmt::format(
          "<rect x=\"{}\" y=\"6\" width=\"14\" height=\"11\" fill=\"{}\"/><text x=\"{}\" y=\"16\">{}</text>\n",
          coordinate(x), taker.color, coordinate(x + 20.0), taker.name);
      x += 40.0 + text_width(taker.name);
    }
    return text;
  }

  const std::vector<BoltLoss>& losses_;
  PlotScale x_;
  double left_ = 80.0;
};

// How far a bolt's force is from what its tightening gave, a bar each: what it swings between in the motion, and where
// it ends.
class ForceChart {
 public:
  explicit ForceChart(const std::vector<BoltForce>& rows) : rows_(rows), x_({"force", "%"}, extent(rows), 8) {
    for (const BoltForce& row : rows) left_ = std::max(left_, 20.0 + text_width(row.name));
    left_ = std::min(left_, 300.0);
    x_.set_pixels(left_, width - 70.0);
  }

  std::string svg() const {
    const double bottom = top + row_height * static_cast<double>(rows_.size());
    std::string text = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\" "
        "aria-label=\"Bolt forces\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"12\" "
        "fill=\"#222222\">\n<title>Bolt forces</title>\n",
        coordinate(width), coordinate(bottom + 40.0));
    for (const PlotScale::Tick& tick : x_.ticks())
      text += fmt::format(
          "<path d=\"M{0} {1}V{2}\" stroke=\"#dcdcdc\"/><text x=\"{0}\" y=\"{3}\" text-anchor=\"middle\" "
          "fill=\"#666666\">{4}</text>\n",
          coordinate(x_.pixel(tick.value)), coordinate(top - 4.0), coordinate(bottom), coordinate(bottom + 14.0),
          escaped(tick.label));
    text += fmt::format("<path d=\"M{} {}V{}\" stroke=\"#222222\" stroke-dasharray=\"4 3\"/>\n",
                        coordinate(x_.pixel(100.0)), coordinate(top - 4.0), coordinate(bottom));
    for (size_t i = 0; i < rows_.size(); ++i) text += bar_of(rows_[i], top + row_height * static_cast<double>(i));
    return text + fmt::format(
                      "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">force (% of what the tightening gave)"
                      "</text>\n</svg>\n",
                      coordinate(0.5 * (left_ + width - 70.0)), coordinate(bottom + 32.0));
  }

 private:
  static constexpr double width = 820.0, top = 12.0, row_height = 20.0;

  static Extent extent(const std::vector<BoltForce>& rows) {
    Extent extent{0.0, 100.0};
    for (const BoltForce& row : rows)
      for (const double value : {row.lowest, row.highest, row.last}) extent.add(value);
    return {*extent.low, 1.02 * *extent.high};
  }

  std::string bar_of(const BoltForce& row, double y) const {
    std::string text = fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>\n", coordinate(left_ - 8.0),
                                   coordinate(y + 11.0), escaped(row.name));
    text += bar(x_.pixel(0.0), x_.pixel(row.last), y, "#cfe3f1");
    if (row.highest > row.lowest) text += bar(x_.pixel(row.lowest), x_.pixel(row.highest), y, "#0072b2");
    return text + fmt::format(
                      "<path d=\"M{0} {1}v17\" stroke=\"#222222\" stroke-width=\"2\"/><text x=\"{2}\" "
                      "y=\"{3}\">{4:.1f} %</text>\n",
                      coordinate(x_.pixel(row.last)), coordinate(y - 2.0), coordinate(width - 58.0),
                      coordinate(y + 11.0), row.last);
  }

  const std::vector<BoltForce>& rows_;
  PlotScale x_;
  double left_ = 80.0;
};

}  // namespace

std::string loss_chart(const std::vector<BoltLoss>& losses) { return LossChart(losses).svg(); }

std::string force_chart(const std::vector<BoltForce>& forces) { return ForceChart(forces).svg(); }

}  // namespace dygita
