// Tables whose numbers can be compared at a glance: one unit a column, and one for all forces of a table.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace dygita {

// A text, or a value (SI) with its unit. An empty text where a value is not known.
class TableCell {
 public:
  TableCell(std::string text) : text_(std::move(text)) {}
  TableCell(const char* text) : text_(text) {}
  TableCell(double value, std::string si_unit, int digits = 3)
      : unit_(std::move(si_unit)), value_(value), digits_(digits), is_value_(true) {}

  bool is_value() const { return is_value_; }
  double value() const { return value_; }
  const std::string& text() const { return text_; }
  const std::string& unit() const { return unit_; }
  int digits() const { return digits_; }

 private:
  std::string text_, unit_;
  double value_ = 0.0;
  int digits_ = 3;
  bool is_value_ = false;
};

using Cells = std::vector<std::vector<TableCell>>;

// Rows as texts: values of one unit are written in that of the largest of them, in their column or, for forces, in the
// table. What is not finite is left empty.
std::vector<std::vector<std::string>> in_common_units(const Cells& rows);

}  // namespace dygita
