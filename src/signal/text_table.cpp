#include "signal/text_table.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/plain_file.hpp"

namespace dygita {

namespace {

constexpr const char* blanks = " \t\r";

std::string trimmed(const std::string& text) {
  const size_t first = text.find_first_not_of(" \t\r\""), last = text.find_last_not_of(" \t\r\"");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

// Between straight quotes no character separates.
std::vector<std::string> split(const std::string& line, char separator) {
  const bool joins = separator == ' ';
  std::vector<std::string> cells(1);
  bool is_quoted = false;
  for (const char c : line) {
    is_quoted ^= c == '"';
    const bool ends = !is_quoted && (c == separator || (joins && (c == '\t' || c == '\r')));
    if (!ends)
      cells.back() += c;
    else if (!joins || !cells.back().empty())
      cells.emplace_back();
  }
  for (std::string& cell : cells) cell = trimmed(cell);
  while (cells.size() > 1 && cells.back().empty()) cells.pop_back();
  return cells;
}

// With a decimal point, or with a comma in its place.
std::optional<double> plain_number(std::string cell) {
  const size_t comma = cell.find(',');
  if (comma != std::string::npos) {
    const bool has_digits = comma + 1 < cell.size() && cell[comma + 1] >= '0' && cell[comma + 1] <= '9';
    if (!has_digits || cell.find('.') != std::string::npos) return std::nullopt;
    cell[comma] = '.';
  }
  if (cell.size() > 1 && cell.front() == '+' && cell[1] != '-') cell.erase(0, 1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size()) return std::nullopt;
  return value;
}

bool are_numbers(const std::vector<std::string>& cells) {
  return std::all_of(cells.begin(), cells.end(), [](const std::string& cell) { return plain_number(cell); });
}

// A comma beside a blank, or at the end, separates columns: "0, 1".
bool has_comma_beside_blank(const std::string& line) {
  for (size_t i = line.find(','); i != std::string::npos; i = line.find(',', i + 1)) {
    const bool ends = line.find_first_not_of(blanks, i + 1) == std::string::npos;
    if (ends || line[i + 1] == ' ' || line[i + 1] == '\t' || (i > 0 && (line[i - 1] == ' ' || line[i - 1] == '\t')))
      return true;
  }
  return false;
}

char separator_in(const std::string& line) {
  const auto separates = [&](char c) { return split(line, c).size() > 1; };
  if (separates(';')) return ';';
  if (has_comma_beside_blank(trimmed(line)) && separates(',')) return ',';
  if (separates('\t')) return '\t';
  if (!separates(',')) return ' ';
  const std::vector<std::string> words = split(trimmed(line), ' ');
  return words.size() > 1 && are_numbers(words) ? ' ' : ',';
}

bool is_empty_or_comment(const std::string& line) {
  const std::string text = trimmed(line);
  return text.empty() || text.front() == '#';
}

bool has_unit(const Title& title) { return title.unit.has_value(); }

std::vector<std::string> lines_of(const std::string& path, const std::string& what, bool may_be_pipe) {
  std::error_code error;
  if (!may_be_pipe || std::filesystem::is_regular_file(path, error)) require_readable(path);
  std::ifstream file(path, std::ios::binary);
  if (!file || !(may_be_pipe || std::filesystem::is_regular_file(path, error)))
    throw InputError("cannot read the " + what + " '" + path + "'");
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    if (lines.empty() && (line.starts_with("\xFF\xFE") || line.starts_with("\xFE\xFF") ||
                          line.substr(0, 4).find('\0') != std::string::npos))
      throw InputError(
          "'" + path +
          "' is text in UTF-16\n    save it as UTF-8 (in spreadsheets: 'CSV UTF-8'; in editors: encoding)");
    if (lines.empty() && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);  // byte order mark of spreadsheets
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace

std::string doubt_of_number(const std::string& cell) {
  for (const char* quote : {"\xE2\x80\x98", "\xE2\x80\x99", "\xE2\x80\x9A", "\xE2\x80\x9C", "\xE2\x80\x9D",
                            "\xE2\x80\x9E", "\xC2\xAB", "\xC2\xBB"})
    if (cell.find(quote) != std::string::npos) return ": it has typographic quotes, use straight quotes or none";
  for (const char* sign : {"\xE2\x88\x92", "\xE2\x80\x93", "\xE2\x80\x90", "\xE2\x80\x91"})
    if (cell.find(sign) != std::string::npos) return ": its minus sign is not the plain '-'";
  for (const char* blank : {"\xC2\xA0", "\xE2\x80\xAF", "\xE2\x80\x89"})
    if (cell.find(blank) != std::string::npos) return ": it contains a typographic space";
  std::string digits = cell;
  std::erase_if(digits, [](char c) { return c == '.' || c == ',' || c == '\''; });
  return digits.size() + 1 < cell.size() && plain_number(digits) ? ": do not separate thousands" : "";
}

TextTable::TextTable(const std::string& path, const std::string& what, bool may_be_pipe)
    : path_(path), lines_(lines_of(path, what, may_be_pipe)) {
  find_first_row();
  if (has_rows()) {
    choose_separator();
    refuse_doubtful_commas();
  }
  find_titles();
  at_ = first_row_;
}

void TextTable::find_first_row() {
  for (first_row_ = 0; first_row_ < lines_.size(); ++first_row_) {
    const std::string& line = lines_[first_row_];
    if (is_empty_or_comment(line)) {
      if (!trimmed(line).empty()) comments_.push_back(first_row_);
      continue;
    }
    separator_ = separator_in(line);
    if (plain_number(split(trimmed(line), separator_).front())) return;
    head_.push_back(first_row_);
  }
}

// A text in a row may have any character: what separates as many titles counts. Tabs may be there to align.
void TextTable::choose_separator() {
  const std::string& row = lines_[first_row_];
  bool is_titled = false;
  if (!head_.empty())
    for (const char c : {separator_, ',', ';', '\t'}) {
      const size_t n = split(row, c).size();
      is_titled = n > 1 && split(lines_[head_.front()], c).size() == n;
      if (!is_titled) continue;
      separator_ = c;
      break;
    }
  const std::vector<std::string> cells = split(row, separator_);
  if (separator_ == '\t' && !is_titled &&
      std::any_of(cells.begin(), cells.end(), [](const auto& c) { return c.empty(); }))
    separator_ = ' ';
  n_columns_ = cells_of(row).size();
}

std::vector<std::string> TextTable::cells_of(const std::string& line) const {
  std::vector<std::string> cells = split(separator_ == ' ' ? trimmed(line) : line, separator_);
  if (n_columns_ != 0 && cells.size() != n_columns_) {  // lines may differ in how they separate
    const char own = separator_in(line);
    std::vector<std::string> other = split(own == ' ' ? trimmed(line) : line, own);
    if (other.size() == n_columns_) return other;
  }
  return cells;
}

// 0,0,85: three columns of whole numbers, or two of which one has decimals? Titles that are as many as the cells tell.
void TextTable::refuse_doubtful_commas() const {
  if (separator_ != ',' || n_columns_ < 3) return;
  const auto has = [&](size_t i) { return split(lines_[i], ',').size() == n_columns_; };
  if (!head_.empty() && has(head_.front())) return;
  const auto are_titles = [&](size_t i) {
    const std::vector<Title> titles = titles_in(i);
    return titles.size() == n_columns_ && std::any_of(titles.begin(), titles.end(), has_unit);
  };
  if (std::any_of(comments_.begin(), comments_.end(), are_titles)) return;
  for (size_t i = first_row_; i < lines_.size(); ++i) {
    if (is_empty_or_comment(lines_[i])) continue;
    for (const std::string& cell : split(lines_[i], ','))
      if (cell.find_first_of(".,") != std::string::npos || !plain_number(cell)) return;
  }
  throw InputError({path_, static_cast<int>(first_row_) + 1},
                   fmt::format("'{}': commas may separate columns or decimals, which is ambiguous\n    write "
                               "decimals with a point, or separate columns by semicolons or tabs, or add a header line "
                               "with a title for each of {} columns",
                               trimmed(lines_[first_row_]), n_columns_));
}

std::vector<Title> TextTable::titles_in(size_t i_line) const {
  return titles_of(lines_[i_line], n_columns_, separator_);
}

void TextTable::find_titles() {
  if (!head_.empty()) {
    title_line_ = static_cast<int>(head_.front()) + 1;
    titles_ = titles_in(head_.front());
  }
  if (has_rows() && titles_.size() != n_columns_) {
    if (std::any_of(titles_.begin(), titles_.end(), has_unit))
      throw InputError(
          title_origin(),
          fmt::format("{} title{} with units where there are {} columns: separate them by a comma", titles_.size(),
                      titles_.size() == 1 ? "" : "s", n_columns_ == 2 ? "two" : std::to_string(n_columns_)));
    titles_.clear();  // words
  }
  if (are_units(titles_))
    for (Title& title : titles_) title.unit = title.unit.value_or(title.name);
  take_units_below();
  take_units_of_comment();
}

void TextTable::take_units_below() {
  for (size_t i = 1; i < head_.size(); ++i) {
    const std::vector<Title> units = titles_in(head_[i]);
    const Origin origin{path_, static_cast<int>(head_[i]) + 1};
    if (i > 1 || std::any_of(titles_.begin(), titles_.end(), has_unit) || units.size() != titles_.size() ||
        !are_units(units)) {
      const std::string cell = cells_of(lines_[head_[i]]).front();
      throw InputError(origin, fmt::format("'{}' is not a finite number{}", cell, doubt_of_number(cell)));
    }
    for (size_t k = 0; k < units.size(); ++k) {
      const std::string unit = units[k].unit.value_or(units[k].name);
      if (!unit.empty()) titles_[k].unit = unit;
    }
    title_line_ = origin.line;
  }
}

void TextTable::take_units_of_comment() {
  const auto is_known = [](const Title& title) { return !title.unit || unit_named(*title.unit); };
  for (auto i = comments_.rbegin(); i != comments_.rend(); ++i) {
    if (std::any_of(titles_.begin(), titles_.end(), has_unit)) return;
    const std::vector<Title> titles = titles_in(*i);
    if (titles.size() != n_columns_ || std::none_of(titles.begin(), titles.end(), has_unit) ||
        !std::all_of(titles.begin(), titles.end(), is_known))
      continue;
    if (titles_.empty()) titles_ = titles;
    for (size_t k = 0; k < titles.size(); ++k) titles_[k].unit = titles[k].unit;
    title_line_ = static_cast<int>(*i) + 1;
  }
}

bool TextTable::next(TableRow& row) {
  while (at_ < lines_.size() && is_empty_or_comment(lines_[at_])) ++at_;
  if (at_ >= lines_.size()) return false;
  row.origin = {path_, static_cast<int>(at_) + 1};
  row.text = trimmed(lines_[at_]);
  row.cells = cells_of(lines_[at_]);
  ++at_;
  return true;
}

std::optional<double> TextTable::number(const std::string& cell, const Origin& origin) {
  const bool has_comma = cell.find(',') != std::string::npos, has_point = cell.find('.') != std::string::npos;
  const std::optional<double> value = plain_number(cell);
  if (!value) return value;
  if (has_comma && comma_line_ == 0) comma_line_ = origin.line;
  if (has_point && point_line_ == 0) point_line_ = origin.line;
  if ((has_comma && point_line_ != 0) || (has_point && comma_line_ != 0))
    throw InputError(origin, fmt::format("'{}' has a decimal {}, and a number in line {} a decimal {}", cell,
                                         has_comma ? "comma" : "point", has_comma ? point_line_ : comma_line_,
                                         has_comma ? "point" : "comma"));
  return value;
}

}  // namespace dygita
