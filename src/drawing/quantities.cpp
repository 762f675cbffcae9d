#include "drawing/quantities.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "drawing/units.hpp"

namespace dygita {

namespace {

constexpr double noise = 1e-9;  // of the largest force of the table

// What shares a unit: forces of a table, others of a column.
using Group = std::pair<std::string, size_t>;

Group group_of(const TableCell& cell, size_t column) { return {cell.unit(), cell.unit() == "N" ? 0 : column}; }

std::string value_text(const TableCell& cell, double largest) {
  if (!std::isfinite(cell.value())) return "";
  // A force that balances to round-off is none.
  const bool is_noise = cell.unit() == "N" && std::abs(cell.value()) < noise * largest;
  return in_unit(is_noise ? 0.0 : cell.value(), engineering_unit(cell.unit(), largest), cell.digits());
}

}  // namespace

std::vector<std::vector<std::string>> in_common_units(const Cells& rows) {
  std::map<Group, double> largest;
  for (const std::vector<TableCell>& row : rows)
    for (size_t i = 0; i < row.size(); ++i)
      if (row[i].is_value() && std::isfinite(row[i].value())) {
        double& most = largest[group_of(row[i], i)];
        most = std::max(most, std::abs(row[i].value()));
      }
  std::vector<std::vector<std::string>> texts;
  for (const std::vector<TableCell>& row : rows) {
    std::vector<std::string>& line = texts.emplace_back();
    for (size_t i = 0; i < row.size(); ++i) {
      const TableCell& cell = row[i];
      line.push_back(cell.is_value() ? value_text(cell, largest[group_of(cell, i)]) : cell.text());
    }
  }
  return texts;
}

}  // namespace dygita
