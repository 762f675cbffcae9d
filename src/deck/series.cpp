#include "deck/series.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <limits>

#include "result/loop_cycles.hpp"
#include "result/spectra.hpp"

namespace dygita {

namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

void check_not_empty(const Series& series, const Origin& origin) {
  if (series.values.empty()) throw InputError(origin, fmt::format("series '{}' has no row", series.name));
}

// What a check knows of a condensed joint: its columns, nan in them.
LoopSummary hollow_loop(const Table& loop) {
  LoopSummary summary = summarise_loop(loop, 0);
  for (Table* table : {&summary.cycles, &summary.backbone})
    for (std::vector<double>& column : table->columns) column.assign(1, not_known);
  summary.cycles.step.assign(1, 0);
  summary.exponent = summary.displacement_exponent = summary.stiffness = summary.secant = not_known;
  return summary;
}

std::vector<std::string> columns_of(const Output& output) {
  switch (output.kind) {
    case OutputKind::resultant:
      return {"time", "normal", "shear", "x", "y", "z"};
    case OutputKind::joint:
      return {"time",      "normal",     "shear",     "opening",       "slip",         "plastic_opening",
              "open_area", "stick_area", "slip_area", "friction_work", "plastic_work", "damping_work"};
    case OutputKind::srs:
      return {"frequency", "maximax", "positive", "negative", "primary", "residual"};
    case OutputKind::energy:
      return {"time", "kinetic", "strain", "loads", "friction", "plastic", "damping", "scheme", "balance"};
    case OutputKind::history:
      if (output.direction || output.quantity == Quantity::von_mises || output.quantity == Quantity::pressure) {
        return {"time", quantity_name(output.quantity)};
      }
      if (output.quantity == Quantity::stress) return {"time", "xx", "yy", "zz", "xy", "yz", "zx"};
      return {"time", "x", "y", "z"};
    case OutputKind::srs_field:
      return {"frequency", "highest", "mean"};
    case OutputKind::attenuation:
      return attenuation_columns(output);
    case OutputKind::loop:
      return {"time", "displacement", "force"};
    case OutputKind::superelement:
      return {"frequency", "damping"};
    case OutputKind::vtk:
      break;
  }
  return {};
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
  const Problem& problem = *series.result->problem;
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

std::shared_ptr<const RunResult> hollow_result(const Problem& problem) {
  auto result = std::make_shared<RunResult>();
  result->mean_iterations = not_known;
  for (const OutputPtr& output : problem.outputs) {
    Table table;
    table.names = columns_of(*output);
    if (table.names.empty()) continue;
    const size_t n_rows = problem.steps.size();
    table.units.resize(table.names.size());
    table.columns.assign(table.names.size(), std::vector<double>(n_rows, not_known));
    if (table.names.front() == "time") {
      for (size_t i = 0; i < n_rows; ++i) table.step.push_back(static_cast<int>(i));
    }
    if (output->kind == OutputKind::loop) result->loops[output.get()] = hollow_loop(table);
    result->tables[output.get()] = std::move(table);
  }
  return result;
}

}  // namespace dygita
