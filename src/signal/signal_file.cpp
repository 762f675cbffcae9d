#include "signal/signal_file.hpp"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>

#include "base/error.hpp"
#include "base/log.hpp"
#include "signal/unit.hpp"

namespace dygita {

namespace {

constexpr std::string_view between_numbers = " \t\r,;";

std::vector<std::string_view> fields_of(std::string_view line) {
  std::vector<std::string_view> fields;
  size_t begin = line.find_first_not_of(between_numbers);
  while (begin != std::string_view::npos) {
    const size_t end = std::min(line.find_first_of(between_numbers, begin), line.size());
    fields.push_back(line.substr(begin, end - begin));
    begin = line.find_first_not_of(between_numbers, end);
  }
  return fields;
}

std::optional<double> number(std::string_view field) {
  if (field.size() > 1 && field.front() == '+') field.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size()) return std::nullopt;
  return value;
}

// In SI, where `factor` is one of its unit.
double finite_number(const Origin& origin, std::string_view field, double factor) {
  const std::optional<double> value = number(field);
  if (!value || !std::isfinite(factor * *value))
    throw InputError(
        origin, fmt::format("'{}' is not a finite number{}", field, value && std::isfinite(*value) ? " in SI" : ""));
  return factor * *value;
}

}  // namespace

SampledSignal read_signal(const std::string& path) {
  std::error_code error;
  std::ifstream file(path);
  if (!std::filesystem::is_regular_file(path, error) || !file) {
    throw InputError("cannot read the signal file '" + path + "'");
  }
  SampledSignal signal;
  Origin origin{path, 0};
  TwoColumns columns("s", "");
  for (std::string line; std::getline(file, line);) {
    if (++origin.line == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // byte order mark of spreadsheets
    const std::vector<std::string_view> fields = fields_of(line);
    if (fields.empty()) continue;
    if (fields.front().front() == '#') {
      if (signal.times.empty()) columns.comment(line, origin);
      continue;
    }
    if (signal.times.empty() && !number(fields.front()) && columns.take(line, origin)) continue;
    if (fields.size() != 2) {
      throw InputError(origin, fmt::format("{} {} where two are expected: time (s) and value; decimals take a point",
                                           fields.size(), fields.size() == 1 ? "number" : "columns"));
    }
    const double time = finite_number(origin, fields[0], columns.factor(0));
    const double value = finite_number(origin, fields[1], columns.factor(1));
    if (!signal.times.empty() && time <= signal.times.back()) {
      throw InputError(
          origin, fmt::format("time {} s does not come after {} s: times must increase", time, signal.times.back()));
    }
    signal.times.push_back(time);
    signal.values.push_back(value);
  }
  if (signal.times.empty())
    throw InputError("'" + path + "' has no points: two columns are expected, time (s) and value");
  if (const std::optional<Unit>& unit = columns.unit(1)) {
    signal.unit = unit->si;
    signal.unit_written = columns.text(1);
    signal.unit_factor = unit->factor;
  }
  return signal;
}

}  // namespace dygita
