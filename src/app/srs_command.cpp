#include "app/srs_command.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <vector>

#include "base/error.hpp"
#include "base/log.hpp"
#include "base/names.hpp"
#include "output/csv.hpp"
#include "signal/unit.hpp"

namespace dygita {

namespace {

constexpr double uneven_sampling = 0.01;  // of the mean step

struct Signal {
  std::vector<double> time, values;
  std::string unit;
  int n_rows = 0, n_missed = -1;       // rows, and those whose increment has not converged; -1: the file does not tell
  bool starts_in_static_step = false;  // time stood still at its first instant, or another step follows it
};

std::string trimmed(const std::string& text) {
  const size_t first = text.find_first_not_of(" \t\r\""), last = text.find_last_not_of(" \t\r\"");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::vector<std::string> cells_of(const std::string& line) {
  char separator = ' ';
  for (const char other : {'\t', ';', ','})
    if (line.find(other) != std::string::npos) separator = other;
  std::vector<std::string> cells;
  size_t start = 0;
  while (start <= line.size()) {
    const size_t end = std::min(line.find(separator, start), line.size());
    const std::string cell = trimmed(line.substr(start, end - start));
    if (separator != ' ' || !cell.empty()) cells.push_back(cell);
    start = end + 1;
  }
  return cells;
}

std::optional<double> number_in(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

// "acceleration [m/s^2]", "acceleration (g)" without its unit, and the unit.
std::string name_in(const std::string& header) { return trimmed(header.substr(0, header.find_first_of("[("))); }

std::string unit_in(const std::string& header) {
  const size_t open = header.find_first_of("[("), close = header.find_first_of("])");
  return open < close && close != std::string::npos ? trimmed(header.substr(open + 1, close - open - 1)) : "";
}

// The column of values, from the header and the first row of numbers.
size_t column_of(const SrsCommand& command, const std::vector<std::string>& header,
                 const std::vector<std::string>& row) {
  if (command.column.empty()) {
    for (size_t i = 1; i < row.size(); ++i) {
      if (number_in(row[i])) return i;
    }
    throw InputError(fmt::format("{}: no second column of numbers", command.signal));
  }
  std::vector<std::string> known;
  for (size_t i = 1; i < header.size(); ++i) {
    known.push_back(name_in(header[i]));
    if (known.back() == command.column) return i;
  }
  throw InputError(
      fmt::format("{}: no column '{}'\n    {}", command.signal, command.column, did_you_mean(command.column, known)));
}

double seconds_of(const std::string& title, const Origin& origin) {
  const std::optional<Unit> unit = unit_of({name_in(title), unit_in(title)}, origin, "s");
  return unit ? unit->factor : 1.0;
}

// As spectra name it: what is an acceleration in m/s^2 or g stays so, another unit is told.
std::string value_unit(const std::string& title, const Origin& origin) {
  const std::optional<Unit> unit = unit_of({name_in(title), unit_in(title)}, origin);
  if (unit && unit->si != "m/s^2")
    throw InputError(origin,
                     fmt::format("'{}' is in {}: a shock response spectrum is taken of an acceleration, in m/s^2 or g",
                                 name_in(title), unit_in(title)));
  return unit_in(title);
}

// The signal without a column's name, where the file has several.
void say_choice(const SrsCommand& command, const std::vector<std::string>& header, size_t column) {
  std::vector<std::string> others;
  for (size_t i = 1; i < header.size(); ++i)
    if (i != column && name_in(header[i]) != "step" && name_in(header[i]) != "converged")
      others.push_back(name_in(header[i]));
  if (!command.column.empty() || others.empty()) return;
  std::string list;
  for (const std::string& name : others) list += (list.empty() ? "" : ", ") + name;
  warn(fmt::format("{}: the spectrum is of column '{}'; --column takes another: {}", command.signal,
                   name_in(header[column]), list));
}

// A table of a run tells of each row whether its increment has converged.
void note_convergence(const std::vector<std::string>& header, const std::vector<std::string>& cells, Signal& signal) {
  ++signal.n_rows;
  if (header.empty() || header.back() != "converged" || cells.size() != header.size()) return;
  signal.n_missed = std::max(signal.n_missed, 0) + (cells.back() == "0" ? 1 : 0);
}

bool has_units(const std::vector<std::string>& titles) {
  return std::any_of(titles.begin(), titles.end(), [](const std::string& title) { return !unit_in(title).empty(); });
}

Signal read_signal(const SrsCommand& command) {
  std::ifstream file(command.signal);
  if (!file) throw InputError(fmt::format("no file '{}'", command.signal));
  Signal signal;
  std::vector<std::string> header, comment;  // comment: written as a header, which counts where there is no other
  size_t column = 0;
  std::string line, first_step;
  double seconds = 1.0;  // of the unit of time
  for (int n = 1; std::getline(file, line); ++n) {
    if (n == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // byte order mark of spreadsheets
    if (line.starts_with('#') && signal.time.empty()) comment = cells_of(line.substr(line.find_first_not_of('#')));
    const auto cells = cells_of(line);
    if (cells.empty() || trimmed(line).empty() || line[0] == '#') continue;
    auto time = number_in(cells[0]);
    if (time && signal.time.empty() && header.empty() && has_units(comment) && comment.size() == cells.size()) {
      header = comment;
      seconds = seconds_of(header[0], {command.signal, n});
    }
    if (time) *time *= seconds;
    if (!time && signal.time.empty() && header.empty()) {
      header = cells;
      seconds = seconds_of(cells[0], {command.signal, n});
      continue;
    }
    if (signal.time.empty()) {
      column = column_of(command, header, cells);
      if (column < header.size()) signal.unit = value_unit(header[column], {command.signal, n});
      if (column < header.size()) say_choice(command, header, column);
    }
    const auto value = column < cells.size() ? number_in(cells[column]) : std::nullopt;
    if (!time || !value) throw InputError(fmt::format("{}:{}: no numbers in '{}'", command.signal, n, line));
    if (!signal.time.empty() && *time < signal.time.back()) {
      throw InputError(
          fmt::format("{}:{}: time {:g} s comes after {:g} s", command.signal, n, *time, signal.time.back()));
    }
    note_convergence(header, cells, signal);
    const bool has_steps = std::find(header.begin(), header.end(), "step") != header.end();
    if (!signal.time.empty() && *time == signal.time.back() && !has_steps)
      throw InputError(fmt::format("{}:{}: time {:g} s comes twice", command.signal, n, *time));
    if (!signal.time.empty() && *time == signal.time.back()) {
      signal.values.back() = *value;  // time stands still in static steps
      signal.starts_in_static_step |= signal.time.size() == 1;
      continue;
    }
    const auto names_step = std::find(header.begin(), header.end(), "step");
    if (const auto i = static_cast<size_t>(names_step - header.begin());
        i < cells.size() && names_step != header.end()) {
      const std::string& step = cells[i];
      if (signal.time.empty()) first_step = step;
      signal.starts_in_static_step |= signal.time.size() == 1 && step != first_step;
    }
    signal.time.push_back(*time);
    signal.values.push_back(*value);
  }
  // Means over a step start half a step after the static rows: those are no sample of the signal.
  if (signal.starts_in_static_step && signal.time.size() > 3) {
    const double first = signal.time[1] - signal.time[0], dt = signal.time[2] - signal.time[1];
    if (std::abs(first - dt) > uneven_sampling * dt) {
      signal.time.erase(signal.time.begin());
      signal.values.erase(signal.values.begin());
    }
  }
  if (signal.time.size() < 2)
    throw InputError(fmt::format("{}: fewer than two instants (decimals take a point)", command.signal));
  return signal;
}

// Even samples by linear interpolation; answers the time step. Several to the shortest of the signal's, so that its
// corners are at samples or next to them, unless that makes too many.
double make_even(Signal& signal, const std::string& file) {
  constexpr double most_samples = 5e6, to_shortest = 16.0;
  const size_t n = signal.time.size();
  const double start = signal.time.front(), span = signal.time.back() - start, mean = span / static_cast<double>(n - 1);
  double worst = 0.0, shortest = mean;
  for (size_t i = 1; i < n; ++i) {
    const double step = signal.time[i] - signal.time[i - 1];
    worst = std::max(worst, std::abs(step - mean) / mean);
    shortest = std::min(shortest, step);
  }
  if (worst < uneven_sampling) return mean;
  const double n_steps =
      std::max(std::min(std::ceil(to_shortest * span / shortest * (1.0 - 1e-6)), most_samples), double(n - 1));
  const double dt = span / n_steps;
  warn(fmt::format(
      "{}: the time steps differ by up to {:.0f} % of their mean; values are interpolated along straight lines, every "
      "{:g} s{}",
      file, 100.0 * worst, dt,
      dt > 1.01 * shortest ? fmt::format(", the shortest step is {:g} s: shorter pulses are lost", shortest) : ""));
  std::vector<double> even(static_cast<size_t>(n_steps) + 1);
  size_t j = 0;
  for (size_t i = 0; i < even.size(); ++i) {
    const double t = start + static_cast<double>(i) * dt;
    while (j + 2 < n && signal.time[j + 1] < t) ++j;
    const double share = (t - signal.time[j]) / (signal.time[j + 1] - signal.time[j]);
    even[i] = signal.values[j] + std::min(share, 1.0) * (signal.values[j + 1] - signal.values[j]);
  }
  signal.values = std::move(even);
  return dt;
}

const std::map<std::string, SrsQuantity>& quantities() {
  static const std::map<std::string, SrsQuantity> by_name = {
      {"absolute_acceleration", SrsQuantity::absolute_acceleration},
      {"relative_displacement", SrsQuantity::relative_displacement},
      {"pseudo_velocity", SrsQuantity::pseudo_velocity}};
  return by_name;
}

SrsQuantity quantity_named(const std::string& name) {
  if (const auto found = quantities().find(name); found != quantities().end()) return found->second;
  throw InputError(fmt::format("--quantity {}: no such quantity\n    {}", name, did_you_mean(name, srs_quantities())));
}

}  // namespace

std::vector<std::string> srs_quantities() {
  std::vector<std::string> names;
  for (const auto& [name, quantity] : quantities()) names.push_back(name);
  return names;
}

void write_srs(const SrsCommand& command) {
  std::error_code ignored;
  if (!command.out.empty() && std::filesystem::equivalent(command.out, command.signal, ignored))
    throw InputError(fmt::format("--out {}: that is the signal itself, which would be overwritten", command.out));
  SrsSettings settings = command.settings;
  settings.quantity = quantity_named(command.quantity);
  if (command.damping) settings.q_factor = q_factor_of(*command.damping);
  Signal signal = read_signal(command);
  const double dt = make_even(signal, command.signal);
  const Srs srs = shock_response_spectrum(signal.values, dt, settings);
  const std::string unit = srs_unit(settings.quantity, signal.unit);
  Table table{{"frequency", "maximax", "positive", "negative", "primary", "residual"},
              {"Hz", unit, unit, unit, unit, unit},
              {srs.frequency, srs.maximax, srs.positive, srs.negative, srs.primary, srs.residual},
              {}};
  if (signal.n_missed >= 0) table.mark(signal.n_missed == 0);
  if (signal.n_missed > 0)
    warn(fmt::format("{}: {} of {} rows come from increments that have NOT CONVERGED, and the spectrum rests on them",
                     command.signal, signal.n_missed, signal.n_rows));
  std::FILE* file = command.out.empty() ? stdout : std::fopen(command.out.c_str(), "w");
  if (!file) throw InputError(fmt::format("cannot write '{}'", command.out));
  const bool is_written = std::fputs(csv_text(table, {}).c_str(), file) >= 0;
  const bool is_closed = file == stdout ? std::fflush(file) == 0 : std::fclose(file) == 0;
  if (!is_written || !is_closed) throw InputError(fmt::format("cannot write all of '{}'", command.out));
}

}  // namespace dygita
