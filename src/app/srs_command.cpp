#include "app/srs_command.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <vector>

#include "base/error.hpp"
#include "base/log.hpp"
#include "base/names.hpp"
#include "files/csv.hpp"
#include "signal/signal_doubts.hpp"
#include "signal/signal_file.hpp"

namespace dygita {

namespace {

constexpr double uneven_sampling = 0.01;  // of the mean step

struct Signal {
  std::vector<double> time, values;
  std::string unit;
  int n_rows = 0, n_missed = -1;       // rows, and those whose increment has not converged; -1: the file does not tell
  bool starts_in_static_step = false;  // time stood still at its first instant, or another step follows it
  std::string first_step;
};

// The column of values, from the titles and the first row of numbers.
size_t column_of(const SrsCommand& command, TextTable& table, const TableRow& row) {
  if (!command.column.empty()) return column_named(table.titles(), command.column, command.signal);
  for (size_t i = 1; i < row.cells.size(); ++i) {
    if (table.number(row.cells[i], row.origin)) return i;
  }
  throw InputError(fmt::format("{}: no second column of numbers", command.signal));
}

// As spectra name it: what is an acceleration in m/s^2 or g stays so, another unit is told.
std::string value_unit(const Title& title, const Origin& origin) {
  const std::optional<Unit> unit = unit_of(title, origin);
  if (unit && unit->si != "m/s^2")
    throw InputError(origin,
                     fmt::format("'{}' is in {}: a shock response spectrum requires an acceleration, in m/s^2 or g",
                                 title.name, *title.unit));
  return title.unit.value_or("");
}

// The signal without a column's name, where the file has several.
void say_choice(const SrsCommand& command, const std::vector<Title>& titles, size_t column) {
  std::string others;
  for (size_t i = 1; i < titles.size(); ++i)
    if (i != column && titles[i].name != "step" && titles[i].name != "converged")
      others += (others.empty() ? "" : ", ") + titles[i].name;
  if (!command.column.empty() || others.empty()) return;
  warn(fmt::format("{}: the spectrum is of column '{}'; --column selects another: {}", command.signal,
                   titles[column].name, others));
}

// A table of a run tells of each row whether its increment has converged.
void note_convergence(const std::vector<Title>& titles, const TableRow& row, Signal& signal) {
  ++signal.n_rows;
  if (titles.empty() || titles.back().name != "converged" || row.cells.size() != titles.size()) return;
  signal.n_missed = std::max(signal.n_missed, 0) + (row.cells.back() == "0" ? 1 : 0);
}

std::optional<size_t> column_of_steps(const std::vector<Title>& titles) {
  for (size_t i = 0; i < titles.size(); ++i)
    if (titles[i].name == "step") return i;
  return std::nullopt;
}

// Of rows of the same time the last counts: time does not advance in static steps. step: the row's; none: it has none.
void take_sample(double time, double value, const std::optional<std::string>& step, const Origin& origin,
                 Signal& signal) {
  if (!signal.time.empty() && time < signal.time.back())
    throw InputError(origin, fmt::format("time {:g} s comes after {:g} s", time, signal.time.back()));
  if (!signal.time.empty() && time == signal.time.back()) {
    if (!step) throw InputError(origin, fmt::format("time {:g} s comes twice", time));
    signal.values.back() = value;
    signal.starts_in_static_step |= signal.time.size() == 1;
    return;
  }
  if (signal.time.empty()) signal.first_step = step.value_or("");
  signal.starts_in_static_step |= signal.time.size() == 1 && step.value_or("") != signal.first_step;
  signal.time.push_back(time);
  signal.values.push_back(value);
}

// Means over a step start half a step after the static rows: those are no sample of the signal.
void drop_static_rows(Signal& signal) {
  if (!signal.starts_in_static_step || signal.time.size() <= 3) return;
  const double first = signal.time[1] - signal.time[0], dt = signal.time[2] - signal.time[1];
  if (std::abs(first - dt) <= uneven_sampling * dt) return;
  signal.time.erase(signal.time.begin());
  signal.values.erase(signal.values.begin());
}

std::pair<double, double> numbers_in(TextTable& table, const TableRow& row, size_t column) {
  if (row.cells.size() > table.n_columns())
    throw InputError(row.origin, fmt::format("'{}': {} cells, where the first row has {}", row.text, row.cells.size(),
                                             table.n_columns()));
  const auto number = [&](size_t i) {
    return i < row.cells.size() ? table.number(row.cells[i], row.origin).value_or(NAN) : NAN;
  };
  const std::pair<double, double> both{number(0), number(column)};
  if (!std::isfinite(both.first) || !std::isfinite(both.second))
    throw InputError(row.origin, fmt::format("no numbers in '{}'{}", row.text, doubt_of_number(row.cells.back())));
  return both;
}

Signal read_signal(const SrsCommand& command) {
  TextTable table(command.signal, "signal", true);
  const std::vector<Title>& titles = table.titles();
  const std::optional<size_t> steps = column_of_steps(titles);
  Signal signal;
  size_t column = 0;
  double seconds = 1.0;  // of the unit of time
  for (TableRow row; table.next(row);) {
    if (signal.n_rows == 0) {
      column = column_of(command, table, row);
      if (!titles.empty()) {
        if (const std::optional<Unit> unit = unit_of(titles[0], table.title_origin(), "s")) seconds = unit->factor;
        signal.unit = value_unit(titles[column], table.title_origin());
        say_choice(command, titles, column);
      }
    }
    const auto [time, value] = numbers_in(table, row, column);
    note_convergence(titles, row, signal);
    std::optional<std::string> step;
    if (steps) step = *steps < row.cells.size() ? row.cells[*steps] : "";
    take_sample(seconds * time, value, step, row.origin, signal);
  }
  drop_static_rows(signal);
  if (signal.time.size() < 2) throw InputError(fmt::format("{}: fewer than two time points", command.signal));
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
      "{}: the time steps differ by up to {:.0f} % of their mean; values are interpolated linearly, every "
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
    throw InputError(fmt::format("--out {}: this would overwrite the signal itself", command.out));
  SrsSettings settings = command.settings;
  settings.quantity = quantity_named(command.quantity);
  if (command.damping) settings.q_factor = q_factor_of(*command.damping);
  Signal signal = read_signal(command);
  const double dt = make_even(signal, command.signal);
  for (const std::string& doubt : doubts_of_signal(signal.values, dt, settings.to))
    warn(fmt::format("{}: the signal {}", command.signal, doubt));
  const Srs srs = shock_response_spectrum(signal.values, dt, settings);
  const std::string unit = srs_unit(settings.quantity, signal.unit);
  Table table{{"frequency", "maximax", "positive", "negative", "primary", "residual"},
              {"Hz", unit, unit, unit, unit, unit},
              {srs.frequency, srs.maximax, srs.positive, srs.negative, srs.primary, srs.residual},
              {}};
  if (signal.n_missed >= 0) table.mark(signal.n_missed == 0);
  if (signal.n_missed > 0)
    warn(fmt::format("{}: {} of {} rows come from increments that have NOT CONVERGED, and the spectrum depends on them",
                     command.signal, signal.n_missed, signal.n_rows));
  std::FILE* file = command.out.empty() ? stdout : std::fopen(command.out.c_str(), "w");
  if (!file) throw InputError(fmt::format("cannot write '{}'", command.out));
  const bool is_written = std::fputs(csv_text(table, {}).c_str(), file) >= 0;
  const bool is_closed = file == stdout ? std::fflush(file) == 0 : std::fclose(file) == 0;
  if (!is_written || !is_closed) throw InputError(fmt::format("cannot write all of '{}'", command.out));
}

}  // namespace dygita
