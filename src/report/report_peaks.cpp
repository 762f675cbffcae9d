// What matters first: what each output reached, and how near stresses come to yield.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/log.hpp"
#include "drawing/quantities.hpp"
#include "drawing/units.hpp"
#include "report/html.hpp"
#include "report/report_parts.hpp"
#include "report/spectra.hpp"
#include "result/limits.hpp"

namespace dygita {

namespace {

// The row of the largest modulus; -1: no finite value.
int row_of_largest(const std::vector<double>& values) {
  int best = -1;
  for (size_t i = 0; i < values.size(); ++i)
    if (std::isfinite(values[i]) && (best < 0 || std::abs(values[i]) > std::abs(values[static_cast<size_t>(best)])))
      best = static_cast<int>(i);
  return best;
}

// What a row rests on: an increment that has not converged, or one after such.
std::string unconverged(const Table& table, int row) {
  const auto at = table.converged.begin() + (table.converged.empty() ? 0 : row);
  if (table.converged.empty() || std::find(table.converged.begin(), at + 1, 0.0) == at + 1) return "";
  return *at == 0.0 ? "; NOT CONVERGED" : "; after increments NOT CONVERGED";
}

// "shock, 46 µs"; a static step has no time.
std::string instant(const RunFolder& run, const Table& table, int row) {
  const Json& step = run.record().at("steps").at(static_cast<size_t>(table.step[static_cast<size_t>(row)]));
  const std::string name = text(step, "name");
  return (text(step, "kind") == "static" ? name + " (static)"
                                         : name + ", " + with_unit(table.columns[0][static_cast<size_t>(row)], "s")) +
         unconverged(table, row);
}

struct NamedColumn {
  std::string name;
  std::vector<double> values;
};

// What peaks are told of: the modulus of a vector, else every column that is drawn, of many the largest.
std::vector<NamedColumn> columns_of(const Json& output, const Table& table) {
  if (table.names == std::vector<std::string>{"time", "x", "y", "z"}) {
    NamedColumn modulus{"modulus", table.columns[1]};
    for (size_t i = 0; i < modulus.values.size(); ++i)
      modulus.values[i] = std::hypot(table.columns[1][i], table.columns[2][i], table.columns[3][i]);
    return {modulus};
  }
  const OutputEntry* entry = output_entry(text(output, "kind"));
  const size_t all = table.columns.size() - 1;
  const size_t n = entry && entry->display.n_columns > 0 ? std::min<size_t>(entry->display.n_columns, all) : all;
  std::vector<NamedColumn> columns;
  for (size_t c = 1; c <= n; ++c) columns.push_back({n > 1 ? table.names[c] : "", table.columns[c]});
  const auto peak = [](const NamedColumn& column) {
    const int row = row_of_largest(column.values);
    return row < 0 ? -1.0 : std::abs(column.values[static_cast<size_t>(row)]);
  };
  if (columns.size() <= 3) return columns;
  return {*std::max_element(columns.begin(), columns.end(),
                            [&](const NamedColumn& a, const NamedColumn& b) { return peak(a) < peak(b); })};
}

void add_histories(const RunFolder& run, Cells& rows) {
  for (const Json& output : run.outputs(Display::As::curves)) {
    const Table table = run.table(text(output, "file"));
    if (table.n_rows() == 0 || table.columns.size() < 2) continue;
    for (const NamedColumn& column : columns_of(output, table)) {
      const int row = row_of_largest(column.values);
      if (row < 0) continue;
      rows.push_back({text(output, "name"), subject_of(output) + (column.name.empty() ? "" : ", " + column.name),
                      with_unit(column.values[static_cast<size_t>(row)], table.units.at(1)), instant(run, table, row)});
    }
  }
}

void add_spectra(const RunFolder& run, const TimeAxis& time, const ReportRequest& request, Cells& rows) {
  for (const Spectrum& spectrum : spectra_of(run, request)) {
    std::vector<double> level = spectrum.level();
    for (size_t i = 0; i < level.size(); ++i)
      if (!time.judged().holds(spectrum.frequency()[i])) level[i] = std::nan("");
    const int row = row_of_largest(level);
    if (row < 0) continue;
    rows.push_back(
        {spectrum.name, "spectrum of " + spectrum.of,
         with_unit(level[static_cast<size_t>(row)], spectrum.table.units.at(1)),
         with_unit(spectrum.frequency()[static_cast<size_t>(row)], "Hz") + unconverged(spectrum.table, row)});
  }
}

// The least margin first; what is not a number before all, a part without stress last.
double rank(const Json& stress) {
  const double margin = number(stress, "margin");
  if (std::isfinite(margin)) return margin;
  return stress.value("von_mises", stress.value("failure_index", Json())) == 0.0 ? std::numeric_limits<double>::max()
                                                                                 : -2.0;
}

double last_of(const Table& table, const char* column) {
  const auto at = std::find(table.names.begin(), table.names.end(), column);
  return at == table.names.end() || table.n_rows() == 0
             ? std::nan("")
             : table.columns[static_cast<size_t>(at - table.names.begin())].back();
}

}  // namespace

std::string table_of_joints(const RunFolder& run) {
  Cells rows;
  for (const Json& output : run.outputs(Display::As::joint)) {
    const Table t = run.table(text(output, "file"), {"normal", "shear", "opening", "slip", "plastic_opening"});
    if (t.n_rows() == 0) continue;
    const auto largest = [&](const char* column) {
      const std::vector<double>& values = t.column(column);
      const int row = row_of_largest(values);
      return row < 0 ? std::nan("") : values[static_cast<size_t>(row)];
    };
    const std::vector<double>& normal = t.column("normal");
    double low = 0.0, high = 0.0;
    for (const double force : normal) {
      low = std::min(low, force);
      high = std::max(high, force);
    }
    double dissipated = 0.0;
    for (const char* work : {"friction_work", "plastic_work", "damping_work"})
      if (const double value = last_of(t, work); std::isfinite(value)) dissipated += value;
    rows.push_back({text(output, "name"), TableCell(-low, "N"), TableCell(high, "N"), TableCell(largest("shear"), "N"),
                    TableCell(largest("opening"), "m"), TableCell(largest("plastic_opening"), "m"),
                    TableCell(largest("slip"), "m"), TableCell(dissipated, "J")});
  }
  if (rows.empty()) return "";
  return html::table(
      {"joint", "pressed by up to", "pulled by up to", "shear", "opening", "of it plastic", "slip", "dissipated"},
      in_common_units(rows), true);
}

std::string peaks_section(const RunFolder& run, const TimeAxis& time, const ReportRequest& request) {
  Cells rows;
  add_histories(run, rows);
  add_spectra(run, time, request, rows);
  std::string body;
  if (!rows.empty()) body = html::table({"name", "of", "largest", "when, at which frequency"}, in_common_units(rows));
  return doubted_section(run, "Peaks", body);
}

namespace {

std::string where_of(const Json& stress) {
  std::string where;
  for (const Json& x : stress.value("place", Json::array()))
    where += (where.empty() ? "" : ", ") + plain_number(1e3 * without_round_off(x.get<double>()));
  return "(" + where + ")";
}

std::string instant_of(const Json& stress) {
  const bool moves = number(stress, "time") > 0.0;
  return text(stress, "step") + (moves ? ", " + with_unit(number(stress, "time"), "s") : "");
}

// The parts whose stress has a key, the least margin first; names of the others that have cells.
std::vector<Json> watched_by(const RunFolder& run, const char* key, std::string& others) {
  std::vector<Json> watched;
  for (const Json& part : run.record().value("substructures", Json::array())) {
    if (part.contains("stress") && part["stress"].contains(key))
      watched.push_back(part);
    else if (!part.contains("stress"))
      others += (others.empty() ? "" : ", ") + text(part, "name");
  }
  std::stable_sort(watched.begin(), watched.end(),
                   [](const Json& a, const Json& b) { return rank(a["stress"]) < rank(b["stress"]); });
  return watched;
}

std::string folded_table(const std::vector<std::string>& header, const Cells& rows) {
  constexpr size_t most_open = 15;
  const std::vector<std::vector<std::string>> all = in_common_units(rows);
  const auto table = [&](auto first, auto last) { return html::table(header, {first, last}, true); };
  const auto middle = all.begin() + static_cast<long>(std::min(most_open, all.size()));
  std::string body = table(all.begin(), middle);
  if (middle != all.end())
    body += html::folded(fmt::format("The other {} parts", all.end() - middle), table(middle, all.end()));
  return body;
}

// Of materials with strengths along their axes.
std::string failure_section(const RunFolder& run) {
  Cells rows;
  std::string others;
  for (const Json& part : watched_by(run, "failure_index", others)) {
    const Json& stress = part["stress"];
    std::string how = stress.contains("ply") ? fmt::format("ply {:.0f}", number(stress, "ply")) : "";
    const std::string mode = text(stress, "mode");
    how += (how.empty() || mode.empty() ? "" : ", ") + mode;
    rows.push_back({text(part, "name"), text(part, "material"), TableCell(number(stress, "failure_index"), "", 4),
                    TableCell(100.0 * number(stress, "margin"), "%"),
                    TableCell(100.0 * number(stress, "volume_above_failure"), "%", 2), how.empty() ? "–" : how,
                    instant_of(stress), where_of(stress)});
  }
  if (rows.empty()) return "";
  return doubted_section(
      run, "Failure of composites",
      folded_table(
          {"part", "material", "largest failure index", "margin", "volume beyond", "what fails", "when", "where (mm)"},
          rows) +
          html::paragraph("The failure index grows with the load and is 1 at failure by the criterion of the material; "
                          "margin: 1 / index − 1. The material model stays elastic beyond. Stresses are nodal averages "
                          "along the axes of the material."));
}

}  // namespace

std::string margins_section(const RunFolder& run) {
  Cells rows;
  std::string unwatched;
  for (const Json& part : watched_by(run, "von_mises", unwatched)) {
    const Json& stress = part["stress"];
    rows.push_back({text(part, "name"), text(part, "material"), TableCell(number(part, "yield"), "Pa"),
                    TableCell(number(stress, "von_mises"), "Pa"), TableCell(100.0 * number(stress, "margin"), "%"),
                    TableCell(100.0 * number(stress, "volume_above_yield"), "%", 2), instant_of(stress),
                    where_of(stress)});
  }
  if (rows.empty()) return failure_section(run);
  return doubted_section(
             run, "Stress against yield",
             folded_table(
                 {"part", "material", "yield", "largest von Mises", "margin", "volume beyond", "when", "where (mm)"},
                 rows) +
                 html::paragraph(
                     "Margin: yield / von Mises − 1; the material model stays elastic beyond yield. Stresses are nodal "
                     "averages; at edges, corners and contact rims they are mesh-dependent, so check the volume beyond "
                     "yield." +
                     (unwatched.empty() ? ""
                                        : " Not monitored, since their material has no yield: " + unwatched + "."))) +
         failure_section(run);
}

}  // namespace dygita
