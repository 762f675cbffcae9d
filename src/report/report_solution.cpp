// Energies, convergence and cost.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/log.hpp"
#include "drawing/svg_text.hpp"
#include "drawing/units.hpp"
#include "report/html.hpp"
#include "report/report_parts.hpp"

namespace dygita {

namespace {

constexpr double smallest_share = 2e-4;  // of the largest energy: what is less is not seen

double largest_of(const std::vector<double>& values) {
  double max = 0.0;
  for (const double v : values)
    if (std::isfinite(v)) max = std::max(max, std::abs(v));
  return max;
}

std::string energy_figure(const RunFolder& run, const Table& t, const TimeAxis& time) {
  Plot plot{.title = "Where the energy is", .x = time.axis(), .y = {"energy", "J"}};
  time.shade(plot);
  plot.width = 820;
  plot.height = 340;
  const std::vector<double> places = time.places(t);
  struct Term {
    const char *column, *name, *color;
  };
  static constexpr Term dissipated[] = {{"friction", "friction", "#e69f00"},
                                        {"plastic", "yielding", "#d55e00"},
                                        {"damping", "damping", "#cc79a7"},
                                        {"scheme", "scheme", "#999999"}};
  // Tables of older versions know of nothing that interfaces store.
  std::vector<Term> terms = {{"kinetic", "kinetic", "#56b4e9"}, {"strain", "strain", "#0072b2"}};
  if (std::find(t.names.begin(), t.names.end(), "stored") != t.names.end())
    terms.push_back({"stored", "stored in interfaces", "#009e73"});
  for (const Term& term : dissipated) terms.push_back(term);
  std::vector<double> all(places.size(), 0.0);
  double most = largest_of(t.column("loads"));
  for (const Term& term : terms) most = std::max(most, largest_of(t.column(term.column)));
  for (const Term& term : terms) {
    const std::vector<double>& values = t.column(term.column);
    for (size_t i = 0; i < all.size(); ++i) all[i] += values[i];
    if (largest_of(values) > smallest_share * most) plot.stacked.push_back({term.name, places, values, term.color});
  }
  // What was put in: balance = start + loads - all others.
  std::vector<double> given = all;
  for (size_t i = 0; i < given.size(); ++i) given[i] += t.column("balance")[i];
  plot.lines.push_back({"input: loads and initial velocities", places, given, "#000000", true, false, 1.6});
  return doubted_figure(
      run, svg(plot),
      "Stored and dissipated energies, stacked, against the input of loads and initial velocities. The "
      "balance closes if the dashed line follows the top of the areas.");
}

// The tolerance lines of a convergence chart.
std::vector<PlotLevel> tolerance_levels(const Json& record) {
  const Json solver = record.value("solver", Json::object());
  bool has_static = false, has_dynamic = false;
  for (const Json& step : record.at("steps")) (text(step, "kind") == "static" ? has_static : has_dynamic) = true;
  std::vector<PlotLevel> levels;
  const double dynamic = number(solver, "tolerance"), still = number(solver, "static_tolerance");
  if (std::isfinite(dynamic) && (has_dynamic || !std::isfinite(still))) levels.push_back({dynamic, "tolerance"});
  if (std::isfinite(still) && has_static && !(has_dynamic && still == dynamic))
    levels.push_back({still, has_dynamic ? "tolerance of static steps" : "tolerance"});
  return levels;
}

std::string missed_table(const Table& t, const Json& record) {
  std::vector<std::vector<std::string>> rows;
  int n = 0;
  const std::vector<double>& converged = t.column("converged");
  for (size_t i = 0; i < converged.size(); ++i) {
    if (converged[i] != 0.0) continue;
    if (++n <= 10)
      rows.push_back({text(record.at("steps").at(static_cast<size_t>(t.step[i])), "name"),
                      with_unit(t.columns[0][i], "s"), plain_number(t.column("iterations")[i]),
                      plain_number(t.column("indicator")[i])});
  }
  if (rows.empty()) return "";
  return html::heading(n == 1 ? "The increment above the tolerance"
                              : fmt::format("{} increments missed{}", n, n > 10 ? ", the first ten" : "")) +
         html::table({"step", "time", "iterations", "indicator"}, rows, true);
}

std::string bar_of_seconds(const std::vector<std::pair<std::string, double>>& phases, double all) {
  constexpr double width = 820.0;
  std::string drawing = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} 34\" width=\"{0}\" height=\"34\" role=\"img\" "
      "aria-label=\"Seconds by phase\">\n"
      "<title>Seconds by phase</title>\n",
      width);
  double x = 0.0;
  for (size_t i = 0; i < phases.size(); ++i) {
    const double wide = width * phases[i].second / all;
    drawing += fmt::format("<rect x=\"{}\" width=\"{}\" height=\"34\" fill=\"{}\" stroke=\"#ffffff\"/>\n",
                           coordinate(x), coordinate(wide), i < 7 ? series_color(static_cast<int>(i)) : "#bbbbbb");
    x += wide;
  }
  return drawing + "</svg>\n";
}

}  // namespace

std::string energy_section(const RunFolder& run, const TimeAxis& time) {
  std::string body;
  for (const Json& output : run.outputs(Display::As::energy)) {
    const Table t = run.table(text(output, "file"),
                              {"kinetic", "strain", "loads", "friction", "plastic", "damping", "scheme", "balance"});
    if (t.n_rows() == 0) continue;
    body += energy_figure(run, t, time);
    const double most = run.figure(&Figures::largest_energy);
    const auto percent = [&](Figure figure) {
      const double value = run.figure(figure);
      return value < 0.01 ? "less than 0.01 %" : with_unit(value, "%", 2);
    };
    // Records of older versions hold all against the largest energy.
    const bool has_motion = run.has_figure(&Figures::energy_of_motion),
               has_both = run.has_figure(&Figures::static_gain);
    std::string told = fmt::format("Largest energy {}: the top of the chart, stored and dissipated energy together. ",
                                   with_unit(most, "J"));
    told += has_motion ? fmt::format("The motion has {}. The balance closes within {} of that",
                                     with_unit(run.figure(&Figures::energy_of_motion), "J"),
                                     percent(&Figures::energy_imbalance))
                       : fmt::format("The balance closes within {} of it", percent(&Figures::energy_imbalance));
    told += fmt::format("; numerical dissipation {}, energy gain {}.", percent(&Figures::numerical_dissipation),
                        percent(&Figures::energy_gain));
    if (has_both)
      told += fmt::format(
          " In static steps it closes within {} of their stored energy; numerical dissipation {}, energy "
          "gain {}.",
          percent(&Figures::static_imbalance), percent(&Figures::static_dissipation), percent(&Figures::static_gain));
    body += html::paragraph(told);
  }
  return doubted_section(run, "Energy", body);
}

std::string convergence_section(const RunFolder& run) {
  const Json& record = run.record();
  const Table t = run.table("convergence.csv", {"iterations", "indicator", "converged"});
  if (t.n_rows() == 0) return "";
  const bool is_explicit = text(record.value("solver", Json::object()), "name") == "explicit";
  std::vector<double> place(static_cast<size_t>(t.n_rows()));
  for (size_t i = 0; i < place.size(); ++i) place[i] = static_cast<double>(i + 1);
  const auto chart = [&](const std::string& title, const std::string& quantity) {
    Plot plot{.title = title, .x = TimeAxis::increments(), .y = {quantity}};
    plot.spans = static_increments(record.at("steps"));
    plot.width = 530;
    plot.height = 270;
    plot.x.from = 0.5;
    plot.x.to = t.n_rows() + 0.5;
    return plot;
  };
  Plot iterations = chart(is_explicit ? "Substeps of each increment" : "Iterations of each increment",
                          is_explicit ? "substeps" : "iterations");
  iterations.lines.push_back({"", place, t.column("iterations"), {}, false, true, 1.2});
  iterations.y.from = 0.0;
  std::vector<std::string> figures = {html::figure(svg(iterations), iterations.title + ".")};
  const std::vector<double>& indicator = t.column("indicator");
  if (largest_of(indicator) > 0.0) {
    Plot plot = chart("Indicator at the end of each increment", "indicator");
    plot.y.is_log = true;
    plot.lines.push_back({"", place, indicator, {}, false, true, 1.2});
    plot.levels = tolerance_levels(record);
    // One that is far below the tolerance (nothing moves yet) would flatten the rest.
    double low = largest_of(indicator);
    for (const PlotLevel& level : plot.levels) low = std::min(low, level.y);
    double least = low;
    for (const double v : indicator)
      if (v > 0.0) least = std::min(least, v);
    plot.y.from = std::max(0.5 * least, 1e-5 * low);
    std::vector<double> missed(place.size(), std::numeric_limits<double>::quiet_NaN());
    bool has_missed = false;
    for (size_t i = 0; i < place.size(); ++i)
      if (t.column("converged")[i] == 0.0) {
        missed[i] = indicator[i];
        has_missed = true;
      }
    if (has_missed) plot.lines.push_back({"missed the tolerance", place, missed, "#d55e00", false, true, 2.0});
    figures.push_back(html::figure(svg(plot), "Indicator at the end of each increment, against the tolerance."));
  }
  return html::section("Convergence", html::row(figures) + missed_table(t, record));
}

std::string cost_section(const RunFolder& run) {
  const Json& record = run.record();
  std::vector<std::vector<std::string>> rows;
  std::string body;
  const Json seconds = record.value("seconds", Json::object());
  const double all = number(seconds, "all");
  if (all > 0.0) {
    std::vector<std::pair<std::string, double>> phases;
    double rest = all;
    for (const auto& [name, value] : seconds.items()) {
      if (name == "all" || !value.is_number()) continue;
      phases.emplace_back(name, value.get<double>());
      rest -= value.get<double>();
    }
    std::stable_sort(phases.begin(), phases.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
    if (rest > 0.005 * all) phases.emplace_back("other", rest);
    double sum = 0.0;
    for (const auto& phase : phases) sum += phase.second;
    body += html::figure(bar_of_seconds(phases, std::max(sum, all)));
    std::string legend;
    for (size_t i = 0; i < phases.size(); ++i)
      legend += fmt::format(
          "<span style=\"white-space:nowrap\"><svg width=\"12\" height=\"12\" aria-hidden=\"true\"><rect width=\"12\" "
          "height=\"12\" fill=\"{}\"/></svg> {} {}</span>&#160;&#160; ",
          i < 7 ? series_color(static_cast<int>(i)) : "#bbbbbb", escaped(phases[i].first),
          escaped(with_unit(phases[i].second, "s", 2)));
    body += "<p>" + legend + "</p>\n";
  }
  const auto row = [&](const char* name, double value, const char* unit) {
    if (std::isfinite(value) && value > 0.0)
      rows.push_back({name, unit[0] == 's' ? with_unit(value, "s")
                                           : plain_number(value, 6) + (unit[0] ? std::string("\u00a0") + unit : "")});
  };
  const Json size = record.value("size", Json::object()), iterations = record.value("iterations", Json::object());
  row("seconds in all", all, "s");
  row("threads", number(record, "threads"), "");
  if (record.contains("kernels")) rows.push_back({"kernels compiled for", text(record, "kernels")});
  row("degrees of freedom", number(size, "dofs"), "");
  row("interface unknowns", number(size, "interface_unknowns"), "");
  const bool is_explicit = text(record.value("solver", Json::object()), "name") == "explicit";
  row(is_explicit ? "substeps" : "iterations", number(iterations, "all"), "");
  if (std::isfinite(number(iterations, "mean")))
    rows.push_back({is_explicit ? "substeps per increment" : "iterations per increment",
                    plain_number(number(iterations, "mean"))});
  if (const double memory = run.figure(&Figures::factor_memory); memory > 0.0)
    rows.push_back({"memory of factors and interface operators", plain_number(memory) + "\u00a0MB"});
  return html::section("Cost", body + html::table({"", ""}, rows, true));
}

}  // namespace dygita
