// Charts of spectra, with the specification that each is held against, and of histories.
#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.hpp"
#include "base/log.hpp"
#include "drawing/svg_text.hpp"
#include "drawing/units.hpp"
#include "report/html.hpp"
#include "report/report_parts.hpp"
#include "report/spectra.hpp"
#include "result/limits.hpp"

namespace dygita {

namespace {

std::vector<double> scaled(const std::vector<double>& values, double factor) {
  std::vector<double> result = values;
  for (double& value : result) value *= factor;
  return result;
}

void add_specification(const Specification& s, Plot& plot) {
  for (const double band : {6.0, 3.0}) {
    const double factor = std::pow(10.0, band / 20.0);
    plot.bands.push_back({fmt::format("±{:.0f} dB", band), s.frequency, scaled(s.level, 1.0 / factor),
                          scaled(s.level, factor), "#555555", 0.16});
  }
  plot.lines.push_back({"specification", s.frequency, s.level, "#000000", true, false, 1.8});
}

constexpr size_t most_shaded = 3;  // spectra in one figure

bool add_uncertainty(const Spectrum& s, int i_line, Plot& plot) {
  if (s.band.n_rows() != s.table.n_rows()) return false;
  PlotBand band{"", s.frequency(), s.level(), s.level(), series_color(i_line), 0.18};
  for (size_t i = 0; i < band.low.size(); ++i) {
    const double factor = std::pow(10.0, s.band.column("all")[i] / 20.0);
    band.low[i] /= factor;
    band.high[i] *= factor;
  }
  plot.bands.push_back(std::move(band));
  return true;
}

// A ring at each range above the specification; at the nearest place where there is none.
void mark_worst(const Spectrum& s, const FrequencyRange& judged, Plot& plot) {
  constexpr size_t most_marks = 3;
  std::vector<Excursion> marked = excursions(s, judged, limit::specification, 1);
  if (marked.size() > most_marks) marked.resize(most_marks);
  if (marked.empty())
    if (const Exceedance worst = largest_exceedance(*s.specification, s.frequency(), s.level(), judged); worst.is_known)
      marked.push_back({worst.frequency, worst.frequency, worst.decibels, worst.frequency});
  for (const Excursion& range : marked) {
    const auto at = std::find(s.frequency().begin(), s.frequency().end(), range.at) - s.frequency().begin();
    plot.marks.push_back({range.at, s.level()[static_cast<size_t>(at)], decibels(range.worst)});
  }
}

std::string spectra_figure(const std::vector<Spectrum>& group, const TimeAxis& time) {
  Plot plot{.title = "Shock response spectra of " + group.front().quantity,
            .x = {"frequency", "Hz", true},
            .y = {"maximax " + group.front().quantity, group.front().table.units.at(1), true}};
  plot.height = 400;
  plot.width = 820;
  std::vector<std::shared_ptr<const Specification>> drawn;
  for (const Spectrum& s : group)
    plot.lines.push_back({s.name + (std::isfinite(s.q_factor) ? fmt::format(" (Q {:g})", s.q_factor) : " (undamped)") +
                              (s.judged == "maximax" ? "" : ", " + s.judged),
                          s.frequency(), s.level()});
  bool has_uncertainty = false;
  if (group.size() <= most_shaded)
    for (size_t i = 0; i < group.size(); ++i) has_uncertainty |= add_uncertainty(group[i], static_cast<int>(i), plot);
  if (group.size() == 1)
    for (const char* side : {"positive", "negative"})
      plot.lines.push_back({side, group[0].frequency(), group[0].table.column(side), {}, true, false, 1.0});
  plot.x.from = group.front().frequency().front();
  plot.x.to = group.front().frequency().back();
  for (const Spectrum& s : group) {
    plot.x.from = std::min(*plot.x.from, s.frequency().front());
    plot.x.to = std::max(*plot.x.to, s.frequency().back());
    if (!s.specification) continue;
    const bool is_new = std::none_of(drawn.begin(), drawn.end(), [&](const auto& d) {
      return d->frequency == s.specification->frequency && d->level == s.specification->level;
    });
    if (is_new) add_specification(*s.specification, plot);
    if (is_new) drawn.push_back(s.specification);
    mark_worst(s, time.judged(), plot);
  }
  std::string caption = "Maximax response of oscillators to the acceleration of the dynamic steps";
  if (time.record() > 0.0) caption += shade_unreliable(time.judged(), plot);
  if (has_uncertainty)
    caption +=
        "; shaded: uncertainty from iteration, time step and mesh, and from where the record ends, by the run's own "
        "estimate";
  return html::figure(svg(plot), caption + ".");
}

// What the columns are of: the output's own, or what the record states.
std::string quantity_of(const Json& output) {
  const OutputEntry* entry = output_entry(text(output, "kind"));
  return entry && !entry->display.quantity.empty() ? entry->display.quantity : text(output, "quantity");
}

// How many are drawn.
size_t n_drawn(const Json& output, const Table& table) {
  const OutputEntry* entry = output_entry(text(output, "kind"));
  const size_t all = table.columns.size() - 1;
  return entry && entry->display.n_columns > 0 ? std::min<size_t>(entry->display.n_columns, all) : all;
}

std::string title_of(const Json& output) { return text(output, "name") + ": " + subject_of(output); }

std::string history_figure(const Json& output, const Table& table, const TimeAxis& time) {
  std::string quantity = quantity_of(output);
  std::replace(quantity.begin(), quantity.end(), '_', ' ');
  Plot plot{.title = title_of(output), .x = time.axis(), .y = {quantity, table.units.at(1)}};
  time.shade(plot);
  plot.width = 530;
  plot.height = 270;
  const std::vector<double> places = time.places(table);
  const size_t n = n_drawn(output, table);
  for (size_t c = 1; c <= n; ++c)
    plot.lines.push_back({n > 1 ? table.names[c] : "", places, table.columns[c], {}, false, table.n_rows() < 30});
  return html::figure(svg(plot), title_of(output));
}

}  // namespace

std::string subject_of(const Json& output) {
  const Json on = output.value("on", Json::array());
  std::string places;
  for (const Json& place : on)
    if (place.is_string()) places += (places.empty() ? "" : ", ") + place.get<std::string>();
  std::string direction;
  if (output.contains("direction") && output["direction"].size() == 3) {
    const double d[3] = {output["direction"][0].get<double>(), output["direction"][1].get<double>(),
                         output["direction"][2].get<double>()};
    for (int axis = 0; axis < 3; ++axis)
      if (std::abs(std::abs(d[axis]) - 1.0) < 1e-9)
        direction = std::string(" along ") + (d[axis] < 0.0 ? "−" : "") + "xyz"[axis];
    if (direction.empty()) direction = fmt::format(" along ({:.3g}, {:.3g}, {:.3g})", d[0], d[1], d[2]);
  }
  return quantity_of(output) + direction + (places.empty() ? "" : ", on " + places);
}

std::string spectra_section(const RunFolder& run, const TimeAxis& time, const ReportRequest& request) {
  std::map<std::string, std::vector<Spectrum>> groups;
  for (Spectrum& spectrum : spectra_of(run, request)) groups[spectrum.quantity].push_back(std::move(spectrum));
  std::string body;
  for (const auto& [quantity, group] : groups) {
    body += spectra_figure(group, time);
    for (const Spectrum& spectrum : group)
      if (spectrum.specification)
        body += html::paragraph(
            verdict_of(spectrum, time.judged()).sentence +
            (spectrum.specification->source.empty() ? "" : " Specification: " + spectrum.specification->source + "."));
  }
  return html::section("Shock response spectra", body);
}

std::string histories_section(const RunFolder& run, const TimeAxis& time) {
  std::vector<std::string> figures;
  // Quantities that decks choose first, then what other outputs are of.
  std::vector<Json> outputs = run.outputs(Display::As::curves);
  std::stable_partition(outputs.begin(), outputs.end(), [](const Json& output) {
    return output_entry(text(output, "kind"))->display.quantity.empty();
  });
  for (const Json& output : outputs) {
    const Table table = run.table(text(output, "file"));
    if (table.n_rows() > 0 && table.columns.size() > 1) figures.push_back(history_figure(output, table, time));
  }
  return html::section("Histories", html::row(figures));
}

}  // namespace dygita
