#include "files/csv.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "base/error.hpp"
#include "base/log.hpp"
#include "base/plain_file.hpp"

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
  CHECK(table.converged.empty() || table.converged.size() == n_rows, "a mark for each row or none");
  for (const int step : table.step) CHECK(step >= 0 && static_cast<size_t>(step) < n_steps, "a step of the problem");
}

void check_names(std::vector<std::string> names) {
  std::sort(names.begin(), names.end());
  const auto twice = std::adjacent_find(names.begin(), names.end());
  if (twice != names.end()) throw InputError(fmt::format("line 1: two columns are called '{}'", *twice));
}

// The cells of a line; quotation marks taken off.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells(1);
  bool is_quoted = false;
  for (size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && is_quoted && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += line[++i];
    } else if (line[i] == '"') {
      is_quoted = !is_quoted;
    } else if (line[i] == ',' && !is_quoted) {
      cells.emplace_back();
    } else if (line[i] != '\r') {
      cells.back() += line[i];
    }
  }
  return cells;
}

}  // namespace

Table parse_csv(std::istream& stream, const std::vector<std::string>& step_names) {
  std::string line;
  if (!std::getline(stream, line)) throw InputError("is empty");
  Table table;
  const std::vector<std::string> header = cells_of(line);
  const bool has_steps = header.size() > 1 && header[1] == "step";
  for (size_t i = 0; i < header.size(); ++i) {
    if (has_steps && i == 1) continue;
    const size_t open = header[i].rfind(" [");
    const bool has_unit = open != std::string::npos && header[i].back() == ']';
    table.names.push_back(has_unit ? header[i].substr(0, open) : header[i]);
    table.units.push_back(has_unit ? header[i].substr(open + 2, header[i].size() - open - 3) : "");
  }
  check_names(table.names);
  const bool is_marked = table.names.size() > 1 && table.names.back() == "converged";
  table.columns.resize(table.names.size());
  for (int n = 2; std::getline(stream, line); ++n) {
    std::vector<std::string> cells = cells_of(line);
    if (cells.size() != header.size())
      throw InputError(fmt::format("line {} has {} cells where the header has {}", n, cells.size(), header.size()));
    if (has_steps) {
      const auto step = std::find(step_names.begin(), step_names.end(), cells[1]);
      if (step == step_names.end()) throw InputError(fmt::format("line {}: no step '{}' in the problem", n, cells[1]));
      table.step.push_back(static_cast<int>(step - step_names.begin()));
      cells.erase(cells.begin() + 1);
    }
    for (size_t i = 0; i < cells.size(); ++i) {
      char* end = nullptr;
      table.columns[i].push_back(std::strtod(cells[i].c_str(), &end));
      if (cells[i].empty() || *end != '\0') throw InputError(fmt::format("line {}: '{}' is no number", n, cells[i]));
    }
  }
  if (is_marked) {
    const std::vector<double>& marks = table.columns.back();
    const auto other = std::find_if(marks.begin(), marks.end(), [](double mark) { return mark != 0.0 && mark != 1.0; });
    if (other != marks.end())
      throw InputError(fmt::format("line {}: 'converged' is {}, not 0 or 1", other - marks.begin() + 2, *other));
    table.converged = std::move(table.columns.back());
    table.names.pop_back(), table.units.pop_back(), table.columns.pop_back();
  }
  return table;
}

Table read_csv(const std::filesystem::path& path, const std::vector<std::string>& step_names) {
  try {
    if (is_no_file(path)) throw InputError("is no file");
    require_readable(path);
    std::ifstream file(path);
    if (!file) throw InputError("is missing");
    return parse_csv(file, step_names);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{} {}", path.string(), error.what()));
  }
}

namespace {

// The time of a long record advances by far less than its ninth digit.
int digits_of(const std::string& column) { return column == "time" ? 15 : 9; }

void append_number(std::string& text, double value, int digits) {
  fmt::format_to(std::back_inserter(text), "{:.{}g}", value + 0.0, digits);  // + 0: no "-0"
}

}  // namespace

Table as_written(Table table) {
  std::string text;
  for (size_t i = 0; i < table.columns.size(); ++i)
    for (double& value : table.columns[i]) {
      text.clear();
      append_number(text, value, digits_of(table.names[i]));
      value = std::strtod(text.c_str(), nullptr);
    }
  return table;
}

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
  text += table.converged.empty() ? "\n" : ",converged\n";
  std::vector<std::string> steps;
  for (const std::string& name : step_names) steps.push_back(quoted(name));
  std::vector<int> digits;
  for (const std::string& name : table.names) digits.push_back(digits_of(name));
  for (size_t row = 0; row < static_cast<size_t>(table.n_rows()); ++row) {
    for (size_t i = 0; i < table.columns.size(); ++i) {
      if (i > 0) text += ',';
      append_number(text, table.columns[i][row], digits[i]);
      if (i == 0 && !table.step.empty()) text += ',' + steps[static_cast<size_t>(table.step[row])];
    }
    text += table.converged.empty() ? "\n" : table.converged[row] != 0.0 ? ",1\n" : ",0\n";
  }
  return text;
}

}  // namespace dygita
