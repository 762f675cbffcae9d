#include "result/hollow_result.hpp"

#include <limits>

#include "result/loop_cycles.hpp"
#include "result/spectra.hpp"

namespace dygita {

namespace {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

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
