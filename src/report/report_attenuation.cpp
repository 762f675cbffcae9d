// Shock attenuation across joints, band by band.
#include <algorithm>
#include <cmath>

#include "base/log.hpp"
#include "drawing/svg_plot.hpp"
#include "drawing/units.hpp"
#include "report/html.hpp"
#include "report/report_parts.hpp"
#include "report/spectra.hpp"

namespace dygita {

namespace {

std::string ratio_text(double value) {
  return std::isfinite(value) ? fmt::format("{}{:.1f} dB", value < 0.0 ? "−" : "+", std::abs(value))
         : std::isinf(value)  ? "no output"
                              : "no input";
}

// What the handbooks of pyroshock expect of the way.
std::string rule_text(const Json& output) {
  const double rule = number(output, "rule");
  if (!std::isfinite(rule)) return "; no interfaces lead from one to the other";
  const auto of = [&](const char* key, const char* name) {
    return fmt::format("{:.0f} {}{}", number(output, key), name, number(output, key) == 1.0 ? "" : "s");
  };
  return fmt::format(
      "; the rule of thumb of pyroshock handbooks, −13 dB per metre, −3 per bolted or riveted joint, −2 per bond, "
      "−20 per isolator, gives {} here ({}, {}, {}, {} between the two places)",
      ratio_text(rule), of("joints", "joint"), of("bonds", "bond"), of("isolators", "isolator"),
      with_unit(number(output, "distance"), "m"));
}

std::string attenuation_part(const RunFolder& run, const Json& output, const FrequencyRange& judged) {
  const Table table = run.table(text(output, "file"));
  if (table.n_rows() == 0 || table.columns.size() < 4) return "";
  const std::vector<double>& frequency = table.columns.front();
  Plot plot{.title = text(output, "name"), .x = {"centre of the band", "Hz", true}, .y = {"behind over before", "dB"}};
  std::vector<std::string> header = {"band"};
  std::vector<std::vector<std::string>> rows;
  std::string silent;
  plot.x.from = frequency.front() / 1.2;
  plot.x.to = 1.2 * frequency.back();
  const std::string unreliable = shade_unreliable(judged, plot);
  silent = unreliable.empty() ? "." : unreliable + " (marked * below).";
  for (const double f : frequency) rows.push_back({with_unit(f, "Hz") + (judged.holds(f) ? "" : " *")});
  for (size_t i = 1; i + 2 < table.columns.size(); i += 3) {
    const std::vector<double>& ratio = table.columns[i + 2];
    const std::string axis = table.names[i + 2].size() > 6 ? "along " + table.names[i + 2].substr(6) : "";
    if (std::none_of(ratio.begin(), ratio.end(), [](double value) { return std::isfinite(value); })) {
      silent += " Nothing enters " + axis + ".";
      continue;
    }
    PlotLine line{.name = axis, .x = frequency, .y = ratio};
    line.has_markers = true;
    plot.lines.push_back(std::move(line));
    header.insert(header.end(), {"before " + axis, "behind " + axis, "ratio " + axis});
    for (size_t row = 0; row < frequency.size(); ++row)
      rows[row].insert(rows[row].end(), {with_unit(table.columns[i][row], table.units[i]),
                                         with_unit(table.columns[i + 1][row], table.units[i]), ratio_text(ratio[row])});
  }
  if (plot.lines.empty()) return "";
  const double rule = number(output, "rule");
  plot.levels = {{0.0, ""}};
  if (std::isfinite(rule)) plot.levels.push_back({rule, "rule of thumb"});
  return html::heading(text(output, "name") + ": from " + text(output, "entering") + " to " + text(output, "leaving")) +
         doubted_figure(run, svg(plot), "Ratio of the maximax spectra" + rule_text(output) + silent) +
         html::table(header, rows, true);
}

}  // namespace

std::string attenuation_section(const RunFolder& run, const TimeAxis& time) {
  std::string body;
  for (const Json& output : run.outputs(Display::As::attenuation)) body += attenuation_part(run, output, time.judged());
  return doubted_section(run, "Through the joint", body);
}

}  // namespace dygita
