#include "result/hollow_result.hpp"

#include <limits>

#include "model/output.hpp"

namespace dygita {

std::shared_ptr<const RunResult> hollow_result(const Problem& problem) {
  constexpr double not_known = std::numeric_limits<double>::quiet_NaN();
  auto result = std::make_shared<RunResult>();
  result->mean_iterations = not_known;
  for (const OutputPtr& output : problem.outputs) {
    const Columns columns = output->columns();
    if (columns.empty()) continue;
    Table table = empty_table(columns);
    for (std::vector<double>& column : table.columns) column.assign(problem.steps.size(), not_known);
    if (table.names.front() == "time")
      for (size_t i = 0; i < problem.steps.size(); ++i) table.step.push_back(static_cast<int>(i));
    table.converged.assign(problem.steps.size(), 1.0);
    output->hollow(table, result->findings[output.get()]);
    result->tables[output.get()] = std::move(table);
  }
  return result;
}

}  // namespace dygita
