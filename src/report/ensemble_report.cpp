#include "report/ensemble_report.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "base/log.hpp"
#include "base/markup.hpp"
#include "drawing/svg_plot.hpp"
#include "drawing/units.hpp"
#include "model/output.hpp"
#include "report/html.hpp"
#include "result/case_summary.hpp"
#include "signal/specification.hpp"

namespace dygita {

namespace {

// What an output's record says of it, by name; null: nothing.
const Note* note_called(const Notes& notes, const char* name) {
  for (const Note& one : notes)
    if (one.name == name) return &one;
  return nullptr;
}

// A spectrum as it is judged: its column, and what it is held against.
struct Judged {
  std::string column;
  const Table* table = nullptr;
  const std::vector<double>* level = nullptr;  // P95/50; of corners the envelope
  std::string level_name;
  std::optional<Specification> specification;
  double margin = 0.0;  // dB, that is asked for
  FrequencyRange range;
};

Judged judged_spectrum(const Ensemble& ensemble, const OutputScatter& scatter) {
  const RunResult& first = *ensemble.counted().front()->result;
  const Notes notes = scatter.output->record(first.tables.at(scatter.output.get()), first.findings_of(*scatter.output));
  Judged found;
  found.column = scatter.columns.front().first;
  if (const Note* own = note_called(notes, "judge")) found.column = std::get<std::string>(own->value);
  for (const auto& [name, table] : scatter.columns)
    if (name == found.column) found.table = &table;
  CHECK(found.table, "a spectrum has the column it is judged by");
  const bool has_limit = found.table->has_column("p95_50");
  found.level = &found.table->column(has_limit ? "p95_50" : "highest");
  found.level_name = has_limit ? "P95/50" : "the envelope";
  if (const Note* against = note_called(notes, "specification")) {
    const Notes& own = std::get<Notes>(against->value);
    found.specification = Specification{std::get<std::vector<double>>(note_called(own, "frequency")->value),
                                        std::get<std::vector<double>>(note_called(own, "level")->value),
                                        std::get<std::string>(note_called(own, "source")->value)};
    if (const Note* margin = note_called(own, "margin")) found.margin = std::get<double>(margin->value);
    const auto& range = std::get<std::vector<double>>(note_called(own, "judged")->value);
    found.range = {range[0], range[1]};
  }
  return found;
}

std::string frequency_text(double hertz) {
  return hertz < 1000.0 ? fmt::format("{:.3g} Hz", hertz) : fmt::format("{:.3g} kHz", hertz / 1000.0);
}

size_t row_at(const Table& table, double frequency) {
  const std::vector<double>& x = table.columns[0];
  return static_cast<size_t>(
      std::min_element(x.begin(), x.end(),
                       [&](double a, double b) { return std::abs(a - frequency) < std::abs(b - frequency); }) -
      x.begin());
}

// What drives a spectrum at a frequency, where it stands out of what chance gives n members.
std::string drive_at(const OutputScatter& scatter, size_t row, size_t n) {
  constexpr double two_sided = 1.96;
  size_t best = 0;
  const auto value = [&](size_t j) { return std::abs(scatter.drives_at.columns[j][row]); };
  for (size_t j = 1; j < scatter.drives_at.columns.size(); ++j)
    if (std::isfinite(value(j)) && (best == 0 || value(j) > value(best))) best = j;
  if (best == 0 || n < 2 || value(best) < two_sided / std::sqrt(static_cast<double>(n) - 1.0)) return "";
  return fmt::format("; {:.0f} % of the spread there is {}", 100.0 * value(best) * value(best),
                     scatter.drives_at.names[best]);
}

// Whether the margin that is asked for is kept; empty: none is asked for.
std::string of_margin(double margin, double decibels) {
  if (!(margin > 0.0)) return "";
  return fmt::format("; {:g} dB of margin are asked for{}", margin, decibels > -margin ? ", which it misses" : "");
}

// Held against its specification, or where its spread is widest.
std::string spectrum_line(const Ensemble& ensemble, const OutputScatter& scatter) {
  const Judged of = judged_spectrum(ensemble, scatter);
  const size_t n = ensemble.counted().size();
  const std::string who = "spectrum '" + scatter.output->name + "': ";
  if (of.specification) {
    const Exceedance worst = largest_exceedance(*of.specification, of.table->columns[0], *of.level, of.range);
    if (worst.is_known)
      return fmt::format("{}{} {} its specification by {:.1f} dB at {}{}{}", who, of.level_name,
                         worst.decibels > 0.0 ? "exceeds" : "stays below", std::abs(worst.decibels),
                         frequency_text(worst.frequency), of_margin(of.margin, worst.decibels),
                         drive_at(scatter, row_at(*of.table, worst.frequency), n));
  }
  const std::vector<double>& spread = of.table->column("spread");
  size_t at = 0;
  for (size_t i = 1; i < spread.size(); ++i)
    if (spread[i] > spread[at] || std::isnan(spread[at])) at = i;
  return fmt::format("{}its level spreads by {:.2g} dB (standard deviation) at most, at {}{}", who, spread[at],
                     frequency_text(of.table->columns[0][at]), drive_at(scatter, at, n));
}

// The frequency at which two groups of members lie furthest apart, and the range in which there are two.
struct Regimes {
  size_t at = 0, first = 0, last = 0;
  TwoGroups groups;
};

std::optional<Regimes> regimes_of(const Ensemble& ensemble, const OutputScatter& scatter, const Judged& of) {
  const double least = std::log(2.0);  // 6 dB
  std::optional<Regimes> found;
  for (size_t row = 0; row < static_cast<size_t>(of.table->n_rows()); ++row) {
    std::vector<double> levels = values_at(ensemble, scatter.output->name, of.column, row);
    for (double& level : levels) level = std::log(level);
    const std::optional<TwoGroups> groups = two_groups(std::move(levels));
    if (!groups || groups->gap < least) continue;
    if (!found) found = Regimes{row, row, row, *groups};
    found->last = row;
    if (groups->gap > found->groups.gap) found->at = row, found->groups = *groups;
  }
  return found;
}

std::string regimes_text(const Ensemble& ensemble, const OutputScatter& scatter) {
  const double decibels = 20.0 / std::log(10.0);
  const Judged of = judged_spectrum(ensemble, scatter);
  const std::optional<Regimes> found = regimes_of(ensemble, scatter, of);
  if (!found) return "";
  const std::vector<double>& frequency = of.table->columns[0];
  std::string text = fmt::format("spectrum '{}': {} of {} members lie {:.0f} dB or more above the others at {}",
                                 scatter.output->name, found->groups.n_upper, ensemble.counted().size(),
                                 decibels * found->groups.gap, frequency_text(frequency[found->at]));
  if (found->last > found->first)
    text += fmt::format(" (there are two groups from {} to {})", frequency_text(frequency[found->first]),
                        frequency_text(frequency[found->last]));
  text += ": two regimes, as of a joint that opens in some units and stays shut in others";
  if (!of.table->has_column("p95_50")) return text;
  const double above = 20.0 * std::log10((*of.level)[found->at] / of.table->column("highest")[found->at]);
  text += "; P95/50 takes levels as lognormal, which they are not there";
  return above > 0.5 ? text + fmt::format(": it is {:.1f} dB above all members", above) : text;
}

// One row a figure: its sample, and what drives it.
std::string figures_table(const Ensemble& ensemble, const std::vector<OutputScatter>& scatter) {
  std::map<std::string, std::vector<double>> values;
  std::vector<CaseFigure> figures;
  for (const EnsembleMember* member : ensemble.counted()) {
    const std::vector<CaseFigure> own = case_summary(*member->problem, *member->result);
    if (figures.empty()) figures = own;
    for (const CaseFigure& figure : own) values[figure.name].push_back(figure.value);
  }
  std::vector<std::vector<std::string>> rows;
  for (const CaseFigure& figure : figures) {
    const std::vector<double>& sample = values[figure.name];
    const EngineeringUnit unit = engineering_unit(figure.unit, sample_quantile(sample, 1.0));
    std::vector<std::string> row{figure.name};
    for (const double share : {0.0, 0.05, 0.5, 0.95, 1.0}) row.push_back(in_unit(sample_quantile(sample, share), unit));
    std::string drive;
    for (const OutputScatter& one : scatter)
      if (drive.empty()) drive = drive_text(one.drives, figure.name);
    row.push_back(drive);
    rows.push_back(std::move(row));
  }
  return html::table({"figure", "lowest", "5 % below", "median", "95 % below", "highest", "what drives it"}, rows,
                     true);
}

std::string members_table(const Ensemble& ensemble) {
  std::vector<std::string> header{"member"};
  header.insert(header.end(), ensemble.parameters.begin(), ensemble.parameters.end());
  header.insert(header.end(), {"iterations", "converged"});
  std::vector<std::vector<std::string>> rows;
  for (const EnsembleMember& member : ensemble.members) {
    std::vector<std::string> row{member.name};
    for (const double value : member.values) row.push_back(plain_number(value, 5));
    row.push_back(std::to_string(member.result->iterations));
    row.push_back(member.result->converged ? "yes" : "no");
    rows.push_back(std::move(row));
  }
  return html::table(header, rows, true);
}

std::string chart_caption(const Ensemble& ensemble, const OutputScatter& scatter) {
  const int n = static_cast<int>(ensemble.counted().size());
  const bool has_limit = judged_spectrum(ensemble, scatter).table->has_column("p95_50");
  return fmt::format("'{}': ", scatter.output->name) +
         (has_limit ? fmt::format("P95/50 is mean + {:.2f} deviations of the logarithms of {} members. ",
                                  tolerance_factor(n), n)
                    : "") +
         "Shown is scatter of members alone: errors of mesh, time step and iteration, which the report of a run has, "
         "are no part of it.";
}

}  // namespace

const char* name_of(Design design) {
  if (design == Design::corners) return "corners";
  if (design == Design::random) return "random";
  return design == Design::sobol ? "sobol" : "latin hypercube";
}

// Median, P95/50, the envelope and the specification over frequency.
std::string ensemble_chart(const Ensemble& ensemble, const OutputScatter& scatter) {
  const Judged of = judged_spectrum(ensemble, scatter);
  const Table& table = *of.table;
  const std::vector<double>& frequency = table.columns[0];
  Plot plot{.title = scatter.output->name, .x = {"frequency", "Hz"}, .y = {"spectrum", table.units[1]}};
  plot.x.is_log = plot.y.is_log = true;
  plot.bands.push_back({"envelope", frequency, table.column("lowest"), table.column("highest")});
  plot.lines.push_back({.name = "median", .x = frequency, .y = table.column("median")});
  if (table.has_column("p95_50")) plot.lines.push_back({.name = "P95/50", .x = frequency, .y = *of.level});
  if (of.specification) {
    PlotLine line{.name = "specification", .x = of.specification->frequency, .y = of.specification->level};
    line.is_dashed = true;
    PlotLine below = line;
    plot.lines.push_back(std::move(line));
    if (of.margin > 0.0) {
      below.name = fmt::format("specification - {:g} dB", of.margin);
      for (double& level : below.y) level *= std::pow(10.0, -of.margin / 20.0);
      plot.lines.push_back(std::move(below));
    }
  }
  return svg(plot);
}

std::vector<std::string> ensemble_lines(const Ensemble& ensemble, const std::vector<OutputScatter>& scatter) {
  std::vector<std::string> lines;
  for (const OutputScatter& one : scatter) {
    if (one.is_spectrum && ensemble.counted().size() > 1) {
      lines.push_back(spectrum_line(ensemble, one));
      continue;
    }
    std::string figure;
    for (const Drive& drive : one.drives) {
      if (drive.figure == figure) continue;
      figure = drive.figure;
      if (const std::string text = drive_text(one.drives, figure); !text.empty()) lines.push_back(figure + ": " + text);
    }
  }
  return lines;
}

std::vector<std::string> ensemble_warnings(const Ensemble& ensemble, const std::vector<OutputScatter>& scatter) {
  std::vector<std::string> warnings;
  for (const OutputScatter& one : scatter)
    if (one.is_spectrum)
      if (const std::string text = regimes_text(ensemble, one); !text.empty()) warnings.push_back(text);
  return warnings;
}

std::string ensemble_page(const Ensemble& ensemble, const std::vector<OutputScatter>& scatter) {
  const std::string problem = ensemble.members.front().problem->name;
  const size_t n = ensemble.counted().size();
  std::string spectra;
  for (const OutputScatter& one : scatter)
    if (one.is_spectrum) spectra += html::figure(ensemble_chart(ensemble, one), chart_caption(ensemble, one));
  const std::string under = fmt::format("ensemble {} · {} members ({}, seed {})", ensemble.name,
                                        ensemble.members.size(), name_of(ensemble.design), ensemble.seed) +
                            (n < ensemble.members.size() ? fmt::format(", {} of them converged and counted", n) : "");
  return html::page(problem + ", " + ensemble.name,
                    "<h1>" + escaped(problem) + "</h1>\n<p class=\"under\">" + escaped(under) + "</p>\n" +
                        html::list(ensemble_warnings(ensemble, scatter), "warnings") +
                        html::list(ensemble_lines(ensemble, scatter)) + html::section("Spectra", spectra) +
                        html::section("What the members come to", figures_table(ensemble, scatter)) +
                        html::section("Members", members_table(ensemble)));
}

}  // namespace dygita
