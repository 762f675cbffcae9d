#include "result/series.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace dygita {

namespace {

void check_not_empty(const Series& series, const Origin& origin) {
  if (series.values.empty()) throw InputError(origin, fmt::format("series '{}' has no row", series.name));
}

}  // namespace

std::optional<double> summary_of(const Series& series, const std::string& key, const Origin& origin) {
  const bool is_summary = key == "max" || key == "min" || key == "first" || key == "last";
  if (!is_summary) return std::nullopt;
  check_not_empty(series, origin);
  if (key == "max") return *std::max_element(series.values.begin(), series.values.end());
  if (key == "min") return *std::min_element(series.values.begin(), series.values.end());
  return key == "first" ? series.values.front() : series.values.back();
}

double value_at_abscissa(const Series& series, double x, const Origin& origin) {
  check_not_empty(series, origin);
  const auto &at = series.at, &values = series.values;
  const size_t n = at.size();
  const double first_spacing = n > 1 ? at[1] - at[0] : 0.0, last_spacing = n > 1 ? at[n - 1] - at[n - 2] : 0.0;
  const double round_off = 1e-9 * (std::abs(at.back()) + std::abs(at.front()));
  if (x < at.front() - 0.5 * first_spacing - round_off || x > at.back() + 0.5 * last_spacing + round_off) {
    throw InputError(
        origin, fmt::format("series '{}' goes from {} {:g} to {:g} {}, {:g} is outside", series.name, series.abscissa,
                            at.front(), at.back(), series.abscissa == "time" ? "s" : "Hz", x));
  }
  // The last row at or before x: a later row of the same time counts, as after a static step.
  const auto after = std::upper_bound(at.begin(), at.end(), x + round_off);
  if (after == at.begin()) return values.front();
  const size_t i = static_cast<size_t>(after - at.begin()) - 1;
  if (i + 1 == n || x <= at[i]) return values[i];
  const double share = (x - at[i]) / (at[i + 1] - at[i]);
  return values[i] + share * (values[i + 1] - values[i]);
}

double value_at_step(const Series& series, const Step& step, const Origin& origin) {
  const Problem& problem = *series.problem;
  if (series.step.empty()) throw InputError(origin, fmt::format("series '{}' has no steps", series.name));
  const int i_step = index_of(problem.steps, &step);
  if (i_step < 0) {
    throw InputError(origin, fmt::format("step '{}' is not in 'steps' of problem '{}'", step.name, problem.name));
  }
  for (size_t i = series.step.size(); i-- > 0;) {
    if (series.step[i] == i_step) return series.values[i];
  }
  throw InputError(origin, fmt::format("series '{}' has no row in step '{}'", series.name, step.name));
}

}  // namespace dygita
