// Spectra, with the specification that each is held against, and histories.
#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.hpp"
#include "base/log.hpp"
#include "report/html.hpp"
#include "report/report_parts.hpp"
#include "report/svg_text.hpp"
#include "report/units.hpp"

namespace dygita {

namespace {

using SpecificationPtr = std::shared_ptr<const Specification>;

// A spectrum with what it is held against.
struct Spectrum {
  std::string name, of, quantity;
  double q_factor;
  Table table;
  SpecificationPtr specification;
  Table band;  // dB, what iteration, time step and mesh leave; empty: not known

  const std::vector<double>& frequency() const { return table.columns.front(); }
  const std::vector<double>& level() const { return table.column("maximax"); }
};

SpecificationPtr specification_of(const Json& output, const ReportRequest& request) {
  if (request.specification) return request.specification;
  if (!output.contains("specification")) return nullptr;
  const Json& json = output["specification"];
  auto found = std::make_shared<Specification>();
  found->source = text(json, "source");
  found->frequency = json.at("frequency").get<std::vector<double>>();
  found->level = json.at("level").get<std::vector<double>>();
  return found;
}

std::vector<Spectrum> spectra_of(const RunFolder& run, const ReportRequest& request) {
  std::vector<Spectrum> spectra;
  for (const Json& output : run.outputs(Display::As::spectrum)) {
    Spectrum spectrum{text(output, "name"),
                      text(output, "of"),
                      text(output, "quantity"),
                      number(output, "q_factor"),
                      run.table(text(output, "file"), {"maximax", "positive", "negative"}),
                      specification_of(output, request),
                      {}};
    if (output.contains("band")) spectrum.band = run.table(text(output, "band"), {"all"});
    if (spectrum.table.n_rows() > 0) spectra.push_back(std::move(spectrum));
  }
  return spectra;
}

std::string decibels(double value) { return fmt::format("{}{:.1f}\u00a0dB", value < 0.0 ? "−" : "+", std::abs(value)); }

// "1.2 to 1.6 kHz, above 4 kHz": where a spectrum is more than `limit` dB above (sign 1) or below (sign -1) its
// specification.
std::string ranges_outside(const Spectrum& spectrum, double limit, int sign) {
  std::string result;
  const std::vector<double>& f = spectrum.frequency();
  const auto is_outside = [&](size_t i) {
    const double difference = 20.0 * std::log10(spectrum.level()[i] / spectrum.specification->level_at(f[i]));
    return std::isfinite(difference) && sign * difference > limit;
  };
  int n = 0;
  for (size_t i = 0; i < f.size(); ++i) {
    if (!is_outside(i)) continue;
    const size_t first = i;
    while (i + 1 < f.size() && is_outside(i + 1)) ++i;
    if (++n > 4) return result + " and further ranges";
    result +=
        (result.empty() ? "" : ", ") + with_unit(f[first], "Hz") + (i > first ? " to " + with_unit(f[i], "Hz") : "");
  }
  return result;
}

std::string finding(const Spectrum& s) {
  const Exceedance worst = largest_exceedance(*s.specification, s.frequency(), s.level());
  if (!worst.is_known) return fmt::format("Spectrum '{}' and its specification share no frequency.", s.name);
  const std::string where = with_unit(worst.frequency, "Hz");
  std::string line = worst.decibels > 0.0
                         ? fmt::format("Spectrum '{}' exceeds its specification by up to {} at {}", s.name,
                                       decibels(worst.decibels), where)
                         : fmt::format("Spectrum '{}' stays below its specification everywhere, nearest at {} with {}",
                                       s.name, where, decibels(worst.decibels));
  const std::string above_6 = ranges_outside(s, 6.0, 1), above_3 = ranges_outside(s, 3.0, 1),
                    below_6 = ranges_outside(s, 6.0, -1);
  if (!above_6.empty())
    line += "; above the +6 dB band at " + above_6;
  else if (!above_3.empty())
    line += "; above the +3 dB band at " + above_3;
  else if (worst.decibels > 0.0)
    line += ", within the +3 dB band";
  if (!below_6.empty()) line += "; below the −6 dB band at " + below_6;
  return line + ".";
}

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

std::string spectra_figure(const std::vector<Spectrum>& group, const TimeAxis& time) {
  Plot plot{.title = "Shock response spectra of " + group.front().quantity,
            .x = {"frequency", "Hz", true},
            .y = {"maximax " + group.front().quantity, group.front().table.units.at(1), true}};
  plot.height = 400;
  plot.width = 820;
  std::vector<SpecificationPtr> drawn;
  for (const Spectrum& s : group)
    plot.lines.push_back({s.name + (std::isfinite(s.q_factor) ? fmt::format(" (Q {:g})", s.q_factor) : " (undamped)"),
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
    const bool is_new = std::none_of(drawn.begin(), drawn.end(), [&](const SpecificationPtr& d) {
      return d->frequency == s.specification->frequency && d->level == s.specification->level;
    });
    if (is_new) add_specification(*s.specification, plot);
    if (is_new) drawn.push_back(s.specification);
    const Exceedance worst = largest_exceedance(*s.specification, s.frequency(), s.level());
    if (worst.is_known)
      plot.marks.push_back(
          {worst.frequency,
           s.level()[static_cast<size_t>(std::find(s.frequency().begin(), s.frequency().end(), worst.frequency) -
                                         s.frequency().begin())],
           decibels(worst.decibels)});
  }
  std::string caption = "Maximax response of oscillators to the acceleration of the dynamic steps";
  if (const double low = time.record() > 0.0 ? 1.0 / time.record() : 0.0; low > *plot.x.from && low < *plot.x.to) {
    plot.spans.push_back({*plot.x.from, low, "the record is too short"});
    caption += "; unreliable below " + with_unit(low, "Hz") + ", 1/record length";
  }
  if (has_uncertainty) caption += "; shaded: uncertainty from iteration, time step and mesh by the run's own estimate";
  return html::figure(svg(plot), caption + ".");
}

// What the columns are of: the output's own, or what the record tells.
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

std::string title_of(const Json& output) {
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
  return text(output, "name") + ": " + quantity_of(output) + direction + (places.empty() ? "" : ", on " + places);
}

std::string history_figure(const Json& output, const Table& table, const TimeAxis& time) {
  std::string quantity = quantity_of(output);
  std::replace(quantity.begin(), quantity.end(), '_', ' ');
  Plot plot{.title = title_of(output), .x = time.axis(), .y = {quantity, table.units.at(1)}};
  plot.spans = time.spans();
  plot.width = 530;
  plot.height = 270;
  const std::vector<double> places = time.places(table);
  const size_t n = n_drawn(output, table);
  for (size_t c = 1; c <= n; ++c)
    plot.lines.push_back({n > 1 ? table.names[c] : "", places, table.columns[c], {}, false, table.n_rows() < 30});
  return html::figure(svg(plot), title_of(output));
}

}  // namespace

std::vector<std::string> spectra_findings(const RunFolder& run, const ReportRequest& request) {
  std::vector<std::string> findings;
  for (const Spectrum& spectrum : spectra_of(run, request))
    if (spectrum.specification) findings.push_back(finding(spectrum));
  return findings;
}

std::string spectra_section(const RunFolder& run, const TimeAxis& time, const ReportRequest& request) {
  std::map<std::string, std::vector<Spectrum>> groups;
  for (Spectrum& spectrum : spectra_of(run, request)) groups[spectrum.quantity].push_back(std::move(spectrum));
  std::string body;
  for (const auto& [quantity, group] : groups) {
    body += spectra_figure(group, time);
    for (const Spectrum& spectrum : group)
      if (spectrum.specification)
        body += html::paragraph(finding(spectrum) + (spectrum.specification->source.empty()
                                                         ? ""
                                                         : " Specification: " + spectrum.specification->source + "."));
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
