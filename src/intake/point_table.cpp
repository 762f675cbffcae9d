#include "intake/point_table.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <sstream>
#include <string_view>

#include "base/error.hpp"
#include "base/names.hpp"
#include "base/plain_file.hpp"
#include "intake/matrix_market.hpp"

namespace dygita {

namespace {

std::vector<std::string> fields_of_line(std::string_view line) {
  std::vector<std::string> fields;
  const char separator = line.find(';') != std::string_view::npos   ? ';'
                         : line.find(',') != std::string_view::npos ? ','
                                                                    : '\t';
  std::istringstream stream{std::string(line)};
  for (std::string field; std::getline(stream, field, separator);) {
    const size_t first = field.find_first_not_of(" \t\""), last = field.find_last_not_of(" \t\"");
    fields.push_back(first == std::string::npos ? "" : field.substr(first, last - first + 1));
  }
  return fields;
}

class PointTable {
 public:
  explicit PointTable(const std::string& file) : file_(file), text_(text_of_file(file)) {
    std::istringstream stream(text_);
    int number = 0;
    for (std::string line; std::getline(stream, line);) {
      ++number;
      if (!line.empty() && line.back() == '\r') line.pop_back();
      if (number == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
      if (line.find_first_not_of(" \t") == std::string::npos || line.front() == '#') continue;
      if (columns_.empty())
        read_titles(fields_of_line(line), number);
      else
        read_line(fields_of_line(line), number);
    }
    if (points_.empty()) throw InputError(fmt::format("'{}' has no point", file_));
  }

  const std::vector<PointLine>& points() const { return points_; }

 private:
  void read_titles(const std::vector<std::string>& titles, int number) {
    const std::vector<std::string> needed{"face", "x", "y", "z"}, rows{"row_x", "row_y", "row_z"};
    std::vector<std::string> known = needed;
    known.insert(known.end(), rows.begin(), rows.end());
    known.emplace_back("node");
    for (size_t i = 0; i < titles.size(); ++i) {
      const std::string title = in_lower_case(titles[i]);
      if (std::find(known.begin(), known.end(), title) == known.end())
        throw InputError(fmt::format("{}:{}: the first line must have titles, but '{}' is not one of them\n    {}",
                                     file_, number, printable(titles[i]), did_you_mean(title, known)));
      if (!columns_.emplace(title, i).second)
        throw InputError(fmt::format("{}:{}: title '{}' comes twice", file_, number, title));
    }
    for (const std::string& title : needed)
      if (!columns_.contains(title))
        throw InputError(fmt::format(
            "{}:{}: column '{}' is missing: face, x, y, z are required, row_x, row_y, row_z or node optional", file_,
            number, title));
    const auto n = std::count_if(rows.begin(), rows.end(), [&](const auto& title) { return columns_.contains(title); });
    if (n != 0 && n != 3)
      throw InputError(fmt::format("{}:{}: give all of row_x, row_y and row_z, or none", file_, number));
    if (n != 0 && columns_.contains("node"))
      throw InputError(
          fmt::format("{}:{}: 'node' and 'row_x' are mutually exclusive: rows have names or numbers", file_, number));
  }

  double number_at(const std::vector<std::string>& fields, const char* title, int line) const {
    const std::string& field = fields[columns_.at(title)];
    double value = 0.0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(value))
      throw InputError(
          fmt::format("{}:{}: '{}' of column '{}' is not a finite number", file_, line, printable(field), title));
    return value;
  }

  void read_line(const std::vector<std::string>& fields, int line) {
    if (fields.size() != columns_.size())
      throw InputError(
          fmt::format("{}:{}: {} columns, but the line of titles has {}", file_, line, fields.size(), columns_.size()));
    PointLine point{fields[columns_.at("face")],
                    {number_at(fields, "x", line), number_at(fields, "y", line), number_at(fields, "z", line)},
                    {},
                    0,
                    line};
    if (columns_.contains("node")) {
      const double node = number_at(fields, "node", line);
      if (node < 1.0 || node != std::floor(node) || node > 2e9)
        throw InputError(fmt::format("{}:{}: 'node' must be the number of a node", file_, line));
      point.node = static_cast<long>(node);
    }
    const int own = 3 * static_cast<int>(points_.size());
    for (int d = 0; d < 3; ++d) {
      const std::string title = std::string("row_") + "xyz"[d];
      if (!columns_.contains(title)) {
        point.rows[static_cast<size_t>(d)] = own + d;
        continue;
      }
      const double row = number_at(fields, title.c_str(), line);
      if (row < 0.0 || row != std::floor(row) || row > 1e9)
        throw InputError(
            fmt::format("{}:{}: '{}' must be the number of a row, from 1, or 0 for none", file_, line, title));
      point.rows[static_cast<size_t>(d)] = static_cast<int>(row) - 1;
    }
    if (point.face.empty()) throw InputError(fmt::format("{}:{}: the face has no name", file_, line));
    points_.push_back(std::move(point));
  }

  std::string file_, text_;
  std::map<std::string, size_t> columns_;
  std::vector<PointLine> points_;
};

}  // namespace

std::vector<PointLine> read_points(const std::string& file) { return PointTable(file).points(); }

}  // namespace dygita
