#include "signal/specification.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.hpp"
#include "base/log.hpp"
#include "signal/text_table.hpp"

namespace dygita {

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
  TextTable table(path, "specification");
  Specification s;
  s.source = path;
  std::vector<std::string> where;
  const std::vector<Title>& titles = table.titles();
  double factors[2] = {1.0, 1.0};
  for (size_t i = 0; i < 2 && titles.size() == 2; ++i) {
    doubt_name(titles[i], table.title_origin());
    const std::optional<Unit> unit = unit_of(titles[i], table.title_origin(), i == 0 ? "Hz" : "m/s^2");
    if (unit) factors[i] = unit->factor;
    if (unit && i == 1) s.unit = *titles[i].unit;
  }
  for (TableRow row; table.next(row);) {
    const auto number = [&](size_t i) { return table.number(row.cells[i], row.origin).value_or(NAN); };
    const bool are_two = row.cells.size() == 2;
    if (!are_two || !std::isfinite(number(0)) || !std::isfinite(number(1)))
      throw InputError(row.origin, fmt::format("'{}' is not a frequency (Hz) and a level{}", row.text,
                                               are_two ? doubt_of_number(row.cells[1]) : ""));
    s.frequency.push_back(factors[0] * number(0));
    s.level.push_back(factors[1] * number(1));
    where.push_back(fmt::format("{}:{}", path, row.origin.line));
  }
  if (s.unit.empty())
    warn(
        fmt::format("{} gives no unit: its levels are assumed to be in m/s^2\n    its first line may give another: "
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
