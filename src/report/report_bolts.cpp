// What became of each bolt: its forces, and its loss by what took it.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "base/log.hpp"
#include "drawing/plot_data.hpp"
#include "drawing/plot_legend.hpp"
#include "drawing/plot_scale.hpp"
#include "drawing/quantities.hpp"
#include "drawing/svg_text.hpp"
#include "drawing/units.hpp"
#include "report/html.hpp"
#include "report/report_parts.hpp"

namespace dygita {

namespace {

// What takes preload, from zero outwards.
struct Taker {
  const char *name, *color;
};
constexpr Taker takers[] = {{"yielding of the bolt", "#d55e00"},
                            {"other bolts and static loads", "#56b4e9"},
                            {"the joint in the motion", "#0072b2"}};
constexpr size_t n_takers = std::size(takers);

double by_hand(const Json& bolt, const char* key) { return number(bolt.value("hand", Json::object()), key); }

// %, of what its tightening gave.
struct Loss {
  std::string name;
  double all, swing;
  std::array<double, n_takers> by;
};

// NaN in runs of earlier versions, which have no split.
Loss loss_of(const Json& bolt) {
  const double all = 100.0 * number(bolt, "loss"), yield = 100.0 * number(bolt, "loss_by_yield"),
               swing = 100.0 * std::abs(number(bolt, "swing") / number(bolt, "tightened"));
  double before = 100.0 * number(bolt, "loss_before_motion");
  if (!std::isfinite(before)) before = all - yield;  // nothing moves
  return {text(bolt, "name"), all, std::isfinite(swing) ? swing : 0.0, {yield, before, all - yield - before}};
}

std::vector<Loss> losses_of(const Json& bolts) {
  std::vector<Loss> losses;
  for (const Json& bolt : bolts)
    if (Loss loss = loss_of(bolt); std::isfinite(loss.all) && std::isfinite(loss.by[0]))
      losses.push_back(std::move(loss));
  return losses;
}

// Gains to one side of zero, losses to the other: where each begins and ends.
std::array<std::pair<double, double>, n_takers> placed(const Loss& loss) {
  std::array<std::pair<double, double>, n_takers> places;
  double gained = 0.0, lost = 0.0;
  for (size_t i = 0; i < n_takers; ++i) {
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
  explicit LossChart(const std::vector<Loss>& losses) : losses_(losses), x_({"lost", "%"}, extent(losses), 8) {
    for (const Loss& loss : losses) left_ = std::max(left_, 20.0 + text_width(loss.name));
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

  static Extent extent(const std::vector<Loss>& losses) {
    Extent extent{0.0, 0.0};
    for (const Loss& loss : losses) {
      for (const double value : {loss.all - loss.swing, loss.all + loss.swing}) extent.add(value);
      for (const auto& [from, to] : placed(loss)) extent.add(to);
    }
    if (!(*extent.high > *extent.low)) extent.high = 1.0;
    const double room = 0.04 * (*extent.high - *extent.low);
    return {*extent.low < 0.0 ? *extent.low - room : 0.0, *extent.high > 0.0 ? *extent.high + room : 0.0};
  }

  std::string bars(const Loss& loss, double y) const {
    std::string text = fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>\n", coordinate(left_ - 8.0),
                                   coordinate(y + 11.0), escaped(loss.name));
    const auto places = placed(loss);
    for (size_t i = 0; i < n_takers; ++i)
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

  const std::vector<Loss>& losses_;
  PlotScale x_;
  double left_ = 80.0;
};

std::string loss_figure(const Json& bolts) {
  const std::vector<Loss> losses = losses_of(bolts);
  const bool has_loss = std::any_of(losses.begin(), losses.end(), [](const Loss& loss) {
    return std::max({std::abs(loss.all), std::abs(loss.by[0]), loss.swing}) > 1e-3;
  });
  if (!has_loss) return "";
  return html::figure(
      LossChart(losses).svg(),
      "Preload lost at the end of the run. Yielding of the bolt: its mean plastic elongation since its own tightening, "
      "times its stiffness during tightening. Other bolts and static loads: the other loss before the motion. The "
      "joint in the motion: the rest, from slip and settling of contacts and from loads and motion remaining at the "
      "end. Black bars: swing of the force in the last tenth of the motion.");
}

// Forces after each static step.
std::string history_table(const Json& bolts, const Json& steps) {
  std::vector<std::string> header = {"after step"};
  for (const Json& bolt : bolts) header.push_back(text(bolt, "name"));
  Cells rows;
  for (const Json& step : steps) {
    if (text(step, "kind") != "static") continue;
    std::vector<Cell> row = {text(step, "name")};
    for (const Json& bolt : bolts) {
      const Json after = bolt.value("after_static", Json::array());
      row.push_back(rows.size() < after.size() && after[rows.size()].is_number()
                        ? Cell(after[rows.size()].get<double>(), "N", 4)
                        : Cell(""));
    }
    rows.push_back(std::move(row));
  }
  if (rows.size() < 2) return "";
  return html::folded("Force after each static step", html::table(header, in_common_units(rows), true));
}

// A column of the table of bolts: left out where no bolt has a value.
struct BoltColumn {
  const char *name, *unit;
  std::function<double(const Json&)> value;
  int digits = 3;
};

std::vector<BoltColumn> columns_of(bool has_motion) {
  const auto key = [](const char* name) { return [name](const Json& bolt) { return number(bolt, name); }; };
  std::vector<BoltColumn> columns = {
      {"asked for", "N", key("target"), 4},
      {"tightened to", "N", key("tightened"), 4},
      {"VDI 2230, same shortening", "N", [](const Json& bolt) { return by_hand(bolt, "force"); }, 4},
      {"shortened by", "m", key("shortening")}};
  if (has_motion) {
    columns.push_back({"lowest in motion", "N", key("lowest"), 4});
    columns.push_back({"highest in motion", "N", key("highest"), 4});
  }
  columns.push_back({"at the end", "N", key("last"), 4});
  columns.push_back({"lost", "%", [](const Json& bolt) { return 100.0 * number(bolt, "loss"); }});
  const auto by = [](size_t taker) { return [taker](const Json& bolt) { return loss_of(bolt).by[taker]; }; };
  columns.push_back({"by yielding", "%", by(0)});
  columns.push_back({"by other bolts, static loads", "%", by(1)});
  if (has_motion) columns.push_back({"by the joint in the motion", "%", by(2)});
  columns.push_back(
      {"mean stress", "Pa", [](const Json& bolt) { return number(bolt, "last") / number(bolt, "area"); }});
  columns.push_back({"residual opening", "m", key("plastic_opening")});
  return columns;
}

}  // namespace

std::string bolts_section(const RunFolder& run) {
  const Json bolts = run.record().value("bolts", Json::array());
  if (bolts.empty()) return "";
  const Json& steps = run.record().at("steps");
  const bool has_motion =
      std::any_of(steps.begin(), steps.end(), [](const Json& step) { return text(step, "kind") == "dynamic"; });
  std::vector<std::string> header = {"bolt"};
  Cells rows;
  for (const Json& bolt : bolts) rows.push_back({text(bolt, "name")});
  for (const BoltColumn& column : columns_of(has_motion)) {
    if (std::none_of(bolts.begin(), bolts.end(), [&](const Json& b) { return std::isfinite(column.value(b)); }))
      continue;
    header.push_back(column.name);
    for (size_t i = 0; i < bolts.size(); ++i) rows[i].emplace_back(column.value(bolts[i]), column.unit, column.digits);
  }
  return html::section(
      "Bolts",
      html::table(header, in_common_units(rows), true) +
          html::paragraph("Forces act through the modelled part of each bolt, tension positive. Loss: at the end, "
                          "relative to the bolt's own tightening. Mean stress: at the end, over the modelled area.") +
          loss_figure(bolts) + history_table(bolts, steps));
}

}  // namespace dygita
