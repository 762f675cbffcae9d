#include "signal/specification.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "base/error.hpp"
#include "base/log.hpp"
#include "base/plain_file.hpp"
#include "signal/unit.hpp"

namespace dygita {

namespace {

std::string trimmed(const std::string& text) {
  const size_t first = text.find_first_not_of(" \t\r\""), last = text.find_last_not_of(" \t\r\"");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::vector<std::string> cells_of(const std::string& line) {
  const char separator = line.find(',') != std::string::npos ? ',' : line.find(';') != std::string::npos ? ';' : '\t';
  std::string plain = line;
  if (separator == '\t') std::replace(plain.begin(), plain.end(), ' ', '\t');
  std::vector<std::string> cells;
  for (size_t start = 0; start <= plain.size();) {
    const size_t end = std::min(plain.find(separator, start), plain.size());
    const std::string cell = trimmed(plain.substr(start, end - start));
    if (separator != '\t' || !cell.empty()) cells.push_back(cell);
    start = end + 1;
  }
  return cells;
}

bool read_number(const std::string& text, double& value) {
  char* end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0' && std::isfinite(value);
}

}  // namespace

double Specification::level_at(double f) const {
  if (frequency.empty() || !(f >= frequency.front() * (1 - 1e-9)) || f > frequency.back() * (1 + 1e-9))
    return std::numeric_limits<double>::quiet_NaN();
  size_t i = 1;
  while (i + 1 < frequency.size() && frequency[i] < f) ++i;
  const double share = std::log(f / frequency[i - 1]) / std::log(frequency[i] / frequency[i - 1]);
  return level[i - 1] * std::pow(level[i] / level[i - 1], share);
}

void check_specification(const Specification& s, const std::vector<std::string>& where) {
  CHECK(s.frequency.size() == s.level.size() && where.size() == s.level.size(),
        "a level and a place for each frequency");
  for (size_t i = 0; i < s.frequency.size(); ++i) {
    if (!(s.frequency[i] > 0.0) || !std::isfinite(s.frequency[i]))
      throw InputError(fmt::format("{}: the frequency {:g} Hz is not above zero{}", where[i], s.frequency[i],
                                   s.frequency[i] > 0.0 ? " and finite" : ""));
    if (!(s.level[i] > 0.0) || !std::isfinite(s.level[i]))
      throw InputError(fmt::format("{}: the level {:g} is not above zero{}", where[i], s.level[i],
                                   s.level[i] > 0.0 ? " and finite" : ""));
    if (i > 0 && !(s.frequency[i] > s.frequency[i - 1]))
      throw InputError(fmt::format("{}: the frequency {:g} Hz comes after {:g} Hz: frequencies must increase", where[i],
                                   s.frequency[i], s.frequency[i - 1]));
  }
  if (s.frequency.size() < 2)
    throw InputError(
        fmt::format("a specification has at least two points (frequency, level), got {}", s.frequency.size()));
}

Specification read_specification(const std::string& path) {
  require_file(path);
  std::ifstream file(path);
  if (!file) throw InputError(fmt::format("no file '{}'", path));
  Specification s;
  s.source = path;
  std::vector<std::string> where;
  TwoColumns columns("Hz", "m/s^2");
  std::string line;
  for (int n = 1; std::getline(file, line); ++n) {
    if (n == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // byte order mark of spreadsheets
    const Origin origin{path, n};
    if (trimmed(line).empty()) continue;
    if (trimmed(line).front() == '#') {
      if (where.empty()) columns.comment(line, origin);
      continue;
    }
    const std::vector<std::string> cells = cells_of(line);
    double frequency = 0.0, level = 0.0;
    const bool are_numbers = cells.size() == 2 && read_number(cells[0], frequency) && read_number(cells[1], level);
    if (where.empty() && !read_number(cells[0], frequency) && columns.take(line, origin)) continue;
    if (!are_numbers)
      throw InputError(fmt::format("{}:{}: '{}' is not a frequency (Hz) and a level", path, n, trimmed(line)));
    s.frequency.push_back(columns.factor(0) * frequency);
    s.level.push_back(columns.factor(1) * level);
    where.push_back(fmt::format("{}:{}", path, n));
  }
  s.unit = columns.text(1);
  if (s.unit.empty())
    warn(
        fmt::format("{} gives no unit: its levels are taken as m/s^2\n    its first line may say otherwise: "
                    "frequency [Hz], level [g]",
                    path));
  try {
    check_specification(s, where);
  } catch (const InputError& error) {
    if (s.frequency.size() >= 2) throw;
    throw InputError(path + ": " + error.what());
  }
  return s;
}

Exceedance largest_exceedance(const Specification& specification, const std::vector<double>& frequency,
                              const std::vector<double>& value, const FrequencyRange& judged) {
  CHECK(frequency.size() == value.size(), "a value for each frequency");
  Exceedance worst;
  for (size_t i = 0; i < frequency.size(); ++i) {
    if (!judged.holds(frequency[i])) continue;
    const double decibels = 20.0 * std::log10(value[i] / specification.level_at(frequency[i]));
    if (!std::isfinite(decibels) || (worst.is_known && decibels <= worst.decibels)) continue;
    worst = {decibels, frequency[i], true};
  }
  return worst;
}

}  // namespace dygita
