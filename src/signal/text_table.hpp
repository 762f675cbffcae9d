// Tables of numbers as others write them: signals, specifications.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "signal/unit.hpp"

namespace dygita {

struct TableRow {
  Origin origin;
  std::string text;  // of the line
  std::vector<std::string> cells;
};

// Columns are separated by semicolons, tabs, commas or blanks; decimals take a point or, where commas do not separate
// columns, a comma. Empty lines and comments (#) are passed over. Above the numbers may stand a line of titles, and one
// of units below it; a comment that is written as titles gives units where there are no others.
class TextTable {
 public:
  // Reads the file. Throws InputError: no such file, which the message calls `what`; text in UTF-16; commas that may
  // separate columns as well as decimals; titles with units that are not as many as the columns; a line above the
  // numbers that is neither titles nor units.
  TextTable(const std::string& path, const std::string& what, bool may_be_pipe = false);

  bool has_rows() const { return first_row_ < lines_.size(); }
  size_t n_columns() const { return n_columns_; }  // of the first row

  // One for each column of the first row, or none; and where their units stand.
  const std::vector<Title>& titles() const { return titles_; }
  Origin title_origin() const { return {path_, title_line_}; }

  // The next row, from the first of numbers on; false at the end.
  bool next(TableRow& row);

  // The cell's, where it is one. Throws InputError where one number of the table has a decimal comma, another a point.
  std::optional<double> number(const std::string& cell, const Origin& origin);

 private:
  std::vector<std::string> cells_of(const std::string& line) const;
  std::vector<Title> titles_in(size_t i_line) const;
  void find_first_row();
  void choose_separator();
  void refuse_doubtful_commas() const;
  void find_titles();
  void take_units_below();
  void take_units_of_comment();

  std::string path_;
  std::vector<std::string> lines_;
  std::vector<size_t> head_, comments_;  // lines above the numbers
  std::vector<Title> titles_;
  char separator_ = ' ';  // of the first row
  size_t first_row_ = 0, at_ = 0, n_columns_ = 0;
  int title_line_ = 0;
  int comma_line_ = 0, point_line_ = 0;  // of the first number with a decimal comma, with a point
};

// What a message adds of a cell that is no number: it has a quote or a sign of typography, or separates thousands.
std::string doubt_of_number(const std::string& cell);

}  // namespace dygita
