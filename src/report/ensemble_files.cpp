#include "report/ensemble_files.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "base/log.hpp"
#include "base/names.hpp"
#include "base/plain_file.hpp"
#include "drawing/svg_plot.hpp"
#include "files/csv.hpp"
#include "files/files.hpp"
#include "files/manifest.hpp"
#include "model/output.hpp"
#include "result/case_summary.hpp"
#include "signal/specification.hpp"

namespace dygita {

namespace {

using Json = nlohmann::ordered_json;

std::string nine_digits_of(double value) { return fmt::format("{:.9g}", value); }

std::vector<std::string> names_of_steps(const Problem& problem) {
  std::vector<std::string> names;
  for (const StepPtr& step : problem.steps) names.push_back(step->name);
  return names;
}

// All columns of an output side by side: "maximax median".
Table side_by_side(const OutputScatter& scatter) {
  Table all;
  for (const auto& [column, table] : scatter.columns)
    for (size_t i = all.names.empty() ? 0 : 1; i < table.names.size(); ++i) {
      all.names.push_back(i == 0 ? table.names[0] : column + " " + table.names[i]);
      all.units.push_back(table.units[i]);
      all.columns.push_back(table.columns[i]);
      all.step = table.step;
    }
  return all;
}

std::string members_csv(const Ensemble& ensemble) {
  std::string text = "member";
  for (const std::string& parameter : ensemble.parameters) text += "," + quoted(parameter);
  bool is_headed = false;
  std::string rows;
  for (const EnsembleMember& member : ensemble.members) {
    const std::vector<CaseFigure> figures = case_summary(*member.problem, *member.result);
    for (const CaseFigure& figure : figures)
      if (!is_headed) text += "," + quoted(figure.unit.empty() ? figure.name : figure.name + " [" + figure.unit + "]");
    is_headed = true;
    rows += quoted(member.name);
    for (const double value : member.values) rows += "," + nine_digits_of(value);
    for (const CaseFigure& figure : figures) rows += "," + nine_digits_of(figure.value);
    const auto seconds = member.result->seconds.find("all");
    rows += fmt::format(",{},{},{:.3f}\n", member.result->iterations, member.result->converged ? 1 : 0,
                        seconds == member.result->seconds.end() ? 0.0 : seconds->second);
  }
  return text + ",iterations,converged,seconds [s]\n" + rows;
}

std::string drives_csv(const std::vector<OutputScatter>& scatter) {
  std::string text = "figure,parameter,rank_correlation,lowest,highest,share\n";
  for (const OutputScatter& one : scatter)
    for (const Drive& drive : one.drives)
      text += fmt::format("{},{},{},{},{},{}\n", quoted(drive.figure), quoted(drive.parameter),
                          nine_digits_of(drive.correlation.value), nine_digits_of(drive.correlation.low),
                          nine_digits_of(drive.correlation.high), nine_digits_of(drive.share()));
  return text;
}

// What an output's record says of it, by name; null: nothing.
const Note* note_called(const Notes& notes, const char* name) {
  for (const Note& one : notes)
    if (one.name == name) return &one;
  return nullptr;
}

// A spectrum as it is judged: its column, and what it is held against.
struct Judged {
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
  std::string column = scatter.columns.front().first;
  if (const Note* own = note_called(notes, "judge")) column = std::get<std::string>(own->value);
  Judged found;
  for (const auto& [name, table] : scatter.columns)
    if (name == column) found.table = &table;
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

const char* name_of(Design design) {
  if (design == Design::corners) return "corners";
  if (design == Design::random) return "random";
  return design == Design::sobol ? "sobol" : "latin hypercube";
}

std::string ensemble_record(const Ensemble& ensemble, const std::vector<OutputScatter>& scatter) {
  const auto known = [](double value) { return std::isfinite(value) ? Json(value) : Json(); };
  const auto n = static_cast<int>(ensemble.counted().size());
  Json members = Json::array(), outputs = Json::array();
  for (const EnsembleMember& member : ensemble.members) {
    Json values = Json::object();
    for (size_t i = 0; i < ensemble.parameters.size(); ++i) values[ensemble.parameters[i]] = known(member.values[i]);
    members.push_back({{"name", member.name},
                       {"values", std::move(values)},
                       {"converged", member.result->converged},
                       {"iterations", member.result->iterations}});
  }
  for (const OutputScatter& one : scatter) {
    Json drives = Json::array();
    for (const Drive& drive : one.drives)
      drives.push_back({{"figure", drive.figure},
                        {"parameter", drive.parameter},
                        {"rank_correlation", known(drive.correlation.value)},
                        {"lowest", known(drive.correlation.low)},
                        {"highest", known(drive.correlation.high)}});
    outputs.push_back({{"name", one.output->name},
                       {"kind", one.output->word},
                       {"file", one.columns.empty() ? Json() : Json(file_name_of(one.output->name) + ".csv")},
                       {"drives", std::move(drives)}});
  }
  const Json all = {
      {"problem", ensemble.members.front().problem->name},
      {"case", ensemble.name},
      {"method", name_of(ensemble.design)},
      {"seed", ensemble.seed},
      {"counted", n},
      {"tolerance_factor", ensemble.is_sample() && n > 1 ? Json(tolerance_factor(n)) : Json()},
      {"parameters", ensemble.parameters},
      {"members", std::move(members)},
      {"outputs", std::move(outputs)},
  };
  return all.dump(2) + "\n";
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

// Null: there is none, or none of ours.
Json record_before(const std::filesystem::path& folder) {
  try {
    require_file(folder / own_file::ensemble);
    return Json::parse(text_of_file((folder / own_file::ensemble).string()), nullptr, false);
  } catch (const InputError&) {
    return {};
  }
}

// "ensemble_07": no other case beside it is its own to remove, whatever the record says.
bool is_called_as_member(const Ensemble& ensemble, const std::string& name) {
  const std::string start = ensemble.name + "_";
  return name.size() > start.size() && name.starts_with(start) &&
         std::all_of(name.begin() + static_cast<long>(start.size()), name.end(),
                     [](unsigned char c) { return std::isdigit(c); });
}

}  // namespace

void check_ensemble_folder(const std::filesystem::path& out, const std::filesystem::path& folder) {
  refuse_links(out, folder);
}

void write_ensemble(const std::filesystem::path& folder, const Ensemble& ensemble,
                    const std::vector<OutputScatter>& scatter) {
  make_directory(folder);
  Manifest written(folder);
  const auto write = [&](const std::string& name, const std::string& text) {
    written.add(name);
    write_text(folder / name, text);
  };
  for (const OutputScatter& one : scatter) {
    if (one.columns.empty()) continue;
    const std::string name = file_name_of(one.output->name);
    write(name + ".csv", csv_text(side_by_side(one), names_of_steps(*ensemble.members.front().problem)));
    if (!one.is_spectrum) continue;
    write(name + "_drives.csv", csv_text(one.drives_at, {}));
    write(name + ".svg", ensemble_chart(ensemble, one));
  }
  write(own_file::members, members_csv(ensemble));
  write(own_file::drives, drives_csv(scatter));
  write(own_file::ensemble, ensemble_record(ensemble, scatter));
}

void drop_members_before(const std::filesystem::path& folder, const Ensemble& ensemble, bool keeps_members) {
  const Json before = record_before(folder);
  if (!before.is_object() || !before.contains("members") || !before["members"].is_array()) return;
  for (const Json& member : before["members"]) {
    if (!member.is_object() || !member.contains("name") || !member["name"].is_string()) continue;
    const std::string name = member["name"];
    if (!is_called_as_member(ensemble, name)) continue;
    const bool is_own = std::any_of(ensemble.members.begin(), ensemble.members.end(),
                                    [&](const EnsembleMember& own) { return own.name == name; });
    if (!(is_own && keeps_members)) Manifest::clear(folder.parent_path() / file_name_of(name));
  }
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

}  // namespace dygita
