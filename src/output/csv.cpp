#include "output/csv.hpp"

#include <iterator>

#include "base/error.hpp"
#include "base/log.hpp"

namespace dygita {

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? std::string("\"\"") : std::string(1, c);
  return result + '"';
}

namespace {

void check(const Table& table, size_t n_steps) {
  const size_t n_columns = table.columns.size(), n_rows = static_cast<size_t>(table.n_rows());
  CHECK(table.names.size() == n_columns && table.units.size() == n_columns, "a name and a unit for each column");
  for (const std::vector<double>& column : table.columns) CHECK(column.size() == n_rows, "columns of one length");
  CHECK(table.step.empty() || table.step.size() == n_rows, "a step for each row or none");
  for (const int step : table.step) CHECK(step >= 0 && static_cast<size_t>(step) < n_steps, "a step of the problem");
}

}  // namespace

std::string csv_text(const Table& table, const std::vector<std::string>& step_names) {
  check(table, step_names.size());
  std::string text;
  auto out = std::back_inserter(text);
  for (size_t i = 0; i < table.names.size(); ++i) {
    const std::string& unit = table.units[i];
    fmt::format_to(out, "{}{}", i == 0 ? "" : ",",
                   quoted(unit.empty() ? table.names[i] : table.names[i] + " [" + unit + "]"));
    if (i == 0 && !table.step.empty()) text += ",step";
  }
  text += '\n';
  std::vector<std::string> steps;
  for (const std::string& name : step_names) steps.push_back(quoted(name));
  for (size_t row = 0; row < static_cast<size_t>(table.n_rows()); ++row) {
    for (size_t i = 0; i < table.columns.size(); ++i) {
      if (i > 0) text += ',';
      fmt::format_to(out, "{:.9g}", table.columns[i][row] + 0.0);  // + 0: no "-0"
      if (i == 0 && !table.step.empty()) text += ',' + steps[static_cast<size_t>(table.step[row])];
    }
    text += '\n';
  }
  return text;
}

}  // namespace dygita
