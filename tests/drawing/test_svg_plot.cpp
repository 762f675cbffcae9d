// Charts: well-formed, escaped, in engineering units, peaks kept, sensible with little or nothing to draw.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "drawing/plot_scale.hpp"
#include "drawing/svg_plot.hpp"
#include "drawing/svg_text.hpp"
#include "drawing/units.hpp"
#include "svg_checks.hpp"

namespace dygita {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

Plot force_plot() {
  Plot plot{.title = "Bolt force", .x = {"time", "s"}, .y = {"force", "N"}};
  plot.lines.push_back({"normal", {0.0, 1e-5, 2e-5, 3e-5}, {0.0, 12e3, 31e3, 30e3}});
  return plot;
}

std::vector<std::string> labels(const PlotScale& scale) {
  std::vector<std::string> labels;
  for (const PlotScale::Tick& tick : scale.ticks())
    if (!tick.label.empty()) labels.push_back(tick.label);
  return labels;
}

PlotScale scale(const PlotAxis& axis, double low, double high, int n = 6) { return {axis, {low, high}, n}; }

TEST(Units, are_those_an_engineer_reads) {
  EXPECT_EQ(with_unit(30612.0, "N"), "30.6\u00a0kN");
  EXPECT_EQ(with_unit(-30612.0, "N"), "−30.6\u00a0kN");
  EXPECT_EQ(with_unit(120e-6, "s"), "120\u00a0µs");
  EXPECT_EQ(with_unit(2e-3, "s"), "2\u00a0ms");
  EXPECT_EQ(with_unit(25e3, "Hz"), "25\u00a0kHz");
  EXPECT_EQ(with_unit(6.01e-6, "m"), "6.01\u00a0µm");
  EXPECT_EQ(with_unit(640e6, "Pa"), "640\u00a0MPa");
  EXPECT_EQ(with_unit(100 * 9.80665, "m/s^2"), "100\u00a0g");
  EXPECT_EQ(with_unit(1.1e-4, "m^2"), "110\u00a0mm²");
  EXPECT_EQ(with_unit(0.0, "N"), "0\u00a0N");
  EXPECT_EQ(with_unit(nan, "N"), "not a number");
  EXPECT_EQ(with_unit(3.14159, "furlong"), "3.14\u00a0furlong");
  EXPECT_EQ(plain_number(1.234e-6), "1.23·10⁻⁶");
  EXPECT_EQ(plain_number(2e7), "2·10⁷");
  EXPECT_EQ(plain_number(99.96), "100");
}

TEST(PlotScale, has_round_ticks_in_the_unit_of_its_title) {
  const PlotScale time = scale({"time", "s"}, 0.0, 200e-6);
  EXPECT_EQ(time.title(), "time (µs)");
  EXPECT_EQ(labels(time), (std::vector<std::string>{"0", "50", "100", "150", "200"}));
  const PlotScale small = scale({"slip", "m"}, -0.31e-6, 0.42e-6, 5);
  EXPECT_EQ(small.title(), "slip (nm)");
  EXPECT_EQ(labels(small), (std::vector<std::string>{"−200", "0", "200", "400"}));
}

TEST(PlotScale, names_decades_and_where_they_are_few_twos_and_fives) {
  EXPECT_EQ(labels(scale({"frequency", "Hz", true}, 1e3, 1e5)),
            (std::vector<std::string>{"1", "2", "5", "10", "20", "50", "100"}));
  EXPECT_EQ(scale({"frequency", "Hz", true}, 1e3, 1e5).title(), "frequency (kHz)");
  EXPECT_EQ(labels(scale({"indicator", "", true}, 1e-9, 1e-5, 5)),
            (std::vector<std::string>{"10⁻⁹", "10⁻⁸", "10⁻⁷", "10⁻⁶", "10⁻⁵"}));
  EXPECT_LE(labels(scale({"indicator", "", true}, 1e-300, 1.0, 5)).size(), 6u);
}

TEST(PlotScale, keeps_distance_from_what_has_no_extent) {
  for (const bool is_log : {false, true}) {
    for (const double value : {0.0, 5.0, 1e-30, -7.0}) {
      PlotScale one({"x", "m", is_log}, {value, value}, 5);
      one.set_pixels(0.0, 100.0);
      EXPECT_LT(one.low(), one.high()) << value;
      EXPECT_TRUE(!one.shows(value) || std::isfinite(one.pixel(value))) << value;
    }
  }
}

TEST(Plot, is_well_formed_and_says_what_it_shows) {
  const std::string text = svg(force_plot());
  EXPECT_EQ(test::xml_fault(text), "");
  for (const char* part : {"<title>Bolt force</title>", "role=\"img\"", "time (µs)", "force (kN)", ">normal<"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
  EXPECT_EQ(text.find("href"), std::string::npos);
  EXPECT_EQ(text.find("<script"), std::string::npos);
}

TEST(Plot, escapes_names) {
  Plot plot = force_plot();
  plot.title = "\"A\" & <b>";
  plot.lines[0].name = "<script>alert(1)</script>";
  plot.levels = {{1e4, "a<b"}};
  plot.marks = {{1e-5, 12e3, "c&d"}};
  plot.spans = {{-1e-5, 0.0, "e<f"}};
  const std::string text = svg(plot);
  EXPECT_EQ(test::xml_fault(text), "");
  EXPECT_EQ(text.find("<script"), std::string::npos);
  EXPECT_NE(text.find("&lt;script&gt;"), std::string::npos);
}

TEST(Plot, breaks_lines_at_what_is_not_a_number) {
  Plot plot = force_plot();
  plot.lines[0].y = {1.0, nan, 2.0, std::numeric_limits<double>::infinity()};
  const std::string text = svg(plot);
  EXPECT_EQ(test::xml_fault(text), "");
  EXPECT_EQ(text.find("nan"), std::string::npos);
  EXPECT_EQ(text.find("inf"), std::string::npos);
  EXPECT_EQ(test::count(text, "<circle"), 2);  // two points alone, which no line would show
}

TEST(Plot, says_that_it_has_nothing_to_draw) {
  Plot plot = force_plot();
  plot.lines[0] = {"normal", {}, {}};
  EXPECT_NE(svg(plot).find("no values to draw"), std::string::npos);
  plot.lines[0] = {"normal", {0.0, 1.0}, {-1.0, 0.0}};
  plot.y.is_log = true;
  EXPECT_NE(svg(plot).find("no values to draw"), std::string::npos);
  EXPECT_EQ(svg(force_plot()).find("no values to draw"), std::string::npos);
}

TEST(Plot, refuses_unequal_columns) {
  Plot plot = force_plot();
  plot.lines[0].y.pop_back();
  EXPECT_THROW(svg(plot), ContractError);
}

TEST(Plot, stacks_areas_up_to_their_sum) {
  Plot plot{.title = "Areas", .x = {"time", "s"}, .y = {"area", "m^2"}};
  plot.stacked = {
      {"stick", {0.0, 1.0}, {3e-6, 1e-6}}, {"slip", {0.0, 1.0}, {1e-6, 2e-6}}, {"open", {0.0, 1.0}, {0.0, 1e-6}}};
  const std::string text = svg(plot);
  EXPECT_EQ(test::xml_fault(text), "");
  EXPECT_EQ(test::count(text, "fill-opacity=\"0.75\""), 6);  // three areas, three names
  EXPECT_NE(text.find(">4<"), std::string::npos);            // mm^2, the sum
}

TEST(Plot, stays_small_and_keeps_every_peak_of_a_long_line) {
  std::vector<double> x, y;
  for (int i = 0; i < 500000; ++i) {
    x.push_back(i * 1e-9);
    y.push_back(std::sin(0.001 * i));
  }
  y[123456] = 7.0;
  y[123460] = -5.0;
  y[400000] = nan;
  const auto [xs, ys] = thinned(x, y, 700);
  EXPECT_LE(xs.size(), 5u * 701u);
  EXPECT_TRUE(std::is_sorted(xs.begin(), xs.end()));
  EXPECT_EQ(std::count(ys.begin(), ys.end(), 7.0), 1);
  EXPECT_EQ(std::count(ys.begin(), ys.end(), -5.0), 1);
  EXPECT_EQ(std::count_if(ys.begin(), ys.end(), [](double v) { return std::isnan(v); }), 1);
  EXPECT_EQ(xs.front(), x.front());
  EXPECT_EQ(xs.back(), x.back());
  Plot plot = force_plot();
  plot.lines[0] = {"long", x, y};
  EXPECT_LT(svg(plot).size(), 60000u);
}

TEST(Plot, leaves_a_short_line_as_it_is) {
  const std::vector<double> x = {0.0, 1.0, 2.0}, y = {3.0, nan, 4.0};
  const auto [xs, ys] = thinned(x, y, 700);
  EXPECT_EQ(xs, x);
  EXPECT_EQ(ys.size(), 3u);
}

TEST(Svg, coordinates_are_short) {
  EXPECT_EQ(coordinate(12.0), "12");
  EXPECT_EQ(coordinate(12.34), "12.3");
  EXPECT_EQ(coordinate(-0.04), "0");
  EXPECT_EQ(coordinate(-0.26), "-0.3");
  EXPECT_EQ(coordinate(nan), "0");
}

}  // namespace
}  // namespace dygita
