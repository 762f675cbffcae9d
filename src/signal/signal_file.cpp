#include "signal/signal_file.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>

#include "base/error.hpp"
#include "base/names.hpp"
#include "signal/unit.hpp"

namespace dygita {

namespace {

// In SI, where `factor` is one of its unit.
double finite_number(TextTable& table, const TableRow& row, size_t column, double factor) {
  const std::string& cell = row.cells[column];
  const std::optional<double> value = table.number(cell, row.origin);
  if (!value || !std::isfinite(factor * *value))
    throw InputError(row.origin, fmt::format("'{}' is not a finite number{}", cell,
                                             value && std::isfinite(*value) ? " in SI" : doubt_of_number(cell)));
  return factor * *value;
}

std::string names_of(const std::vector<Title>& titles) {
  std::string list;
  for (size_t i = 1; i < titles.size(); ++i) list += (i > 1 ? ", " : "") + titles[i].name;
  return list;
}

// The last cells of a row may be empty, as remarks are; a row that is longer than the first has been separated
// otherwise.
void require_columns(const TextTable& table, const TableRow& row, const std::string& column, size_t i_value) {
  const size_t n = row.cells.size();
  if (column.empty() ? n == 2 : n > i_value && n <= table.n_columns()) return;
  if (!column.empty())
    throw InputError(row.origin,
                     fmt::format("'{}': {} cells, where the first row has {}", row.text, n, table.n_columns()));
  const bool has_titles = n > 2 && n == table.titles().size();
  throw InputError(row.origin,
                   fmt::format("{} {} but two are expected: time (s) and value{}", n, n == 1 ? "number" : "columns",
                               has_titles ? "\n    'column' takes one: " + names_of(table.titles()) : ""));
}

std::optional<Unit> unit_in(const TextTable& table, size_t column, const std::string& si) {
  if (table.titles().empty()) return std::nullopt;
  doubt_name(table.titles()[column], table.title_origin());
  return unit_of(table.titles()[column], table.title_origin(), si);
}

}  // namespace

size_t column_named(const std::vector<Title>& titles, const std::string& name, const std::string& path) {
  std::vector<std::string> known;
  for (size_t i = 1; i < titles.size(); ++i) {
    known.push_back(titles[i].name);
    if (known.back() == name) return i;
  }
  throw InputError(fmt::format("{}: no column '{}'\n    {}", path, name, did_you_mean(name, known)));
}

SampledSignal read_signal(const std::string& path, const std::string& column) {
  TextTable table(path, "signal file");
  if (!table.has_rows()) throw InputError("'" + path + "' has no points: two columns are expected, time (s) and value");
  SampledSignal signal;
  TableRow row;
  table.next(row);
  const size_t i_value = column.empty() ? 1 : column_named(table.titles(), column, path);
  require_columns(table, row, column, i_value);
  const std::optional<Unit> time_unit = unit_in(table, 0, "s"), unit = unit_in(table, i_value, "");
  if (unit) {
    signal.has_unit = true;
    signal.unit = unit->si;
    signal.unit_written = *table.titles()[i_value].unit;
    signal.unit_factor = unit->factor;
  }
  do {
    require_columns(table, row, column, i_value);
    const double time = finite_number(table, row, 0, time_unit ? time_unit->factor : 1.0);
    const double value = finite_number(table, row, i_value, signal.unit_factor);
    if (!signal.times.empty() && time <= signal.times.back()) {
      throw InputError(row.origin, fmt::format("time {} s does not come after {} s: times must increase", time,
                                               signal.times.back()));
    }
    signal.times.push_back(time);
    signal.values.push_back(value);
  } while (table.next(row));
  return signal;
}

}  // namespace dygita
