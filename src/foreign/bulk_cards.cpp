#include "foreign/bulk_cards.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "base/error.hpp"
#include "base/names.hpp"
#include "base/plain_file.hpp"
#include "foreign/cards.hpp"
#include "intake/matrix_market.hpp"

namespace dygita {

namespace {

namespace fs = std::filesystem;

constexpr size_t n_small = 8, n_large = 4;  // fields of a line
constexpr size_t width = 8, end_of_fields = 72;

bool next_line(std::string_view& rest, std::string_view& text, int& line) {
  if (rest.empty()) return false;
  const size_t end = std::min(rest.find('\n'), rest.size());
  text = rest.substr(0, end);
  while (!text.empty() && (text.back() == '\r' || text.back() == ' ' || text.back() == '\0')) text.remove_suffix(1);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  ++line;
  return true;
}

bool begins_with(std::string_view text, std::string_view word) {
  if (text.size() < word.size()) return false;
  return std::equal(word.begin(), word.end(), text.begin(),
                    [](char a, char b) { return a == std::toupper(static_cast<unsigned char>(b)); });
}

bool is_continuation(std::string_view first) {
  return first.empty() || first.front() == '+' || first.front() == '*' || first.front() == '&';
}
bool is_large(std::string_view first) { return !first.empty() && (first.front() == '*' || first.back() == '*'); }

// Tabs go on to the next field.
std::string without_tabs(std::string_view text) {
  std::string plain;
  const std::string_view first = without_blanks_around(text.substr(0, text.find('\t')));
  const size_t step = is_large(first) ? 2 * width : width;
  for (const char c : text) {
    if (c != '\t') {
      plain += c;
      continue;
    }
    const size_t next = plain.size() < width ? width : width + ((plain.size() - width) / step + 1) * step;
    plain.resize(next, ' ');
  }
  return plain;
}

}  // namespace

bool nastran_real(std::string_view field, double& value) {
  if (field.starts_with('+')) field.remove_prefix(1);
  const char* last = field.data() + field.size();
  auto [end, error] = std::from_chars(field.data(), last, value);
  if (error == std::errc() && end != last && (*end == 'd' || *end == 'D' || *end == '+' || *end == '-')) {
    std::string plain(field.substr(0, static_cast<size_t>(end - field.data())));
    const bool is_letter = *end == 'd' || *end == 'D';
    std::string_view exponent = field.substr(plain.size() + (is_letter ? 1 : 0));
    if (exponent.starts_with('+')) exponent.remove_prefix(1);
    plain += "e" + std::string(exponent);
    const auto again = std::from_chars(plain.data(), plain.data() + plain.size(), value);
    if (again.ec != std::errc() || again.ptr != plain.data() + plain.size()) return false;
    end = last;
  }
  return error == std::errc() && end == last && std::isfinite(value);
}

std::string BulkFile::where(int file, int line) const {
  return fmt::format("{}:{}", files_[static_cast<size_t>(file)], line);
}

void BulkFile::fail(const BulkCard& card, const std::string& what) const {
  throw InputError(fmt::format("{}: {}: {}", where(card), shown(card.name), what));
}

std::string_view BulkFile::kept(std::string text) { return texts_.emplace_back(std::move(text)); }

BulkFile::BulkFile(const std::string& file) {
  add_lines(file, "", 0);
  size_t first = 0;
  for (size_t i = 0; i < lines_.size(); ++i) {
    const std::string line = in_capitals(without_blanks_around(lines_[i].text));
    if (!line.starts_with("BEGIN")) continue;
    const std::string_view what = without_blanks_around(std::string_view(line).substr(5));
    if (!what.empty() && !what.starts_with("BULK"))
      throw InputError(fmt::format("{}: BEGIN {}: superelements are not read: write the model as one",
                                   where(lines_[i].file, lines_[i].line), shown(what)));
    first = i + 1;
    break;
  }
  for (size_t i = 0; i + 1 < first; ++i) control_.push_back(lines_[i]);
  read_cards(first);
  lines_.clear();
}

void BulkFile::add_lines(const std::string& file, const std::string& asked_at, int depth) {
  if (depth > deepest_include || files_.size() >= most_files)
    throw InputError(fmt::format("{}: files include each other, more than {} deep, or more than {} of them", asked_at,
                                 deepest_include, most_files));
  std::error_code error;
  if (!fs::exists(file, error))
    throw InputError(asked_at.empty() ? fmt::format("mesh file '{}' does not exist (looked for {})", file,
                                                    fs::absolute(file).lexically_normal().string())
                                      : fmt::format("{}: the file '{}' does not exist", asked_at, file));
  std::string_view rest = kept(text_of_file(file)), text;
  files_.push_back(file);
  const int own = static_cast<int>(files_.size()) - 1;
  for (int line = 0; next_line(rest, text, line);) {
    if (add_included(text, own, line, rest, line, depth)) continue;
    if (text.find('\t') != std::string_view::npos) text = kept(without_tabs(text));
    if (!text.empty()) lines_.push_back({text, own, line});
  }
}

// INCLUDE 'file': the name may go on in the lines below until its quote ends.
bool BulkFile::add_included(std::string_view text, int file, int line, std::string_view& rest, int& at, int depth) {
  const std::string_view trimmed = without_blanks_around(text);
  if (!begins_with(trimmed, "INCLUDE")) return false;
  const std::string asked_at = where(file, line);
  std::string name(without_blanks_around(trimmed.substr(7)));
  if (name.starts_with('=')) name.erase(0, 1);
  const char quote = name.empty() ? '\0' : name.front();
  if (quote == '\'' || quote == '"') {
    std::string_view more;
    while (name.find(quote, 1) == std::string::npos && next_line(rest, more, at)) name += without_blanks_around(more);
    const size_t end = name.find(quote, 1);
    if (end == std::string::npos) throw InputError(fmt::format("{}: INCLUDE: the quote does not end", asked_at));
    name = name.substr(1, end - 1);
  } else {
    name = std::string(without_blanks_around(std::string_view(name).substr(0, name.find('$'))));
  }
  if (name.empty()) throw InputError(fmt::format("{}: INCLUDE: 'FILE' is expected", asked_at));
  std::replace(name.begin(), name.end(), '\\', '/');
  const fs::path given(name), beside = fs::path(files_[static_cast<size_t>(file)]).parent_path() / given,
                              of_root = fs::path(files_[0]).parent_path() / given;
  std::error_code error;
  const fs::path found = given.is_absolute() ? given : fs::exists(beside, error) ? beside : of_root;
  add_lines(found.string(), asked_at, depth + 1);
  return true;
}

void BulkFile::read_cards(size_t first) {
  for (size_t i = first; i < lines_.size(); ++i) {
    BulkLine line = lines_[i];
    const size_t dollar = line.text.find('$');
    if (dollar != std::string_view::npos) {
      if (without_blanks_around(line.text.substr(0, dollar)).empty())
        comments_.push_back({line.text.substr(dollar), cards_.size()});
      line.text = line.text.substr(0, dollar);
    }
    if (without_blanks_around(line.text).empty()) continue;
    if (begins_with(without_blanks_around(line.text), "ENDDATA")) break;
    take(line);
  }
}

void BulkFile::take(const BulkLine& line) {
  const size_t comma = line.text.find(',');
  const bool is_free = comma != std::string_view::npos;
  const std::string_view first = without_blanks_around(line.text.substr(0, is_free ? comma : width));
  const auto place = [&] { return where(line.file, line.line); };
  if (first.starts_with('='))
    throw InputError(fmt::format("{}: '=' repeats the card above: write the cards out", place()));
  if (is_continuation(first)) {
    if (cards_.empty())
      throw InputError(fmt::format("{}: the line continues no card: '{}'", place(), shown(line.text)));
    if (!is_large(first)) pad(n_small);
    return append(line, first, is_free);
  }
  std::string_view name = first;
  if (name.back() == '*') name = without_blanks_around(name.substr(0, name.size() - 1));
  if (std::any_of(name.begin(), name.end(), [](char c) { return c >= 'a' && c <= 'z'; }))
    name = kept(in_capitals(name));
  if (name.empty() || name.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") != std::string_view::npos)
    throw InputError(fmt::format("{}: the name of a card is expected, as GRID, not '{}'", place(), shown(first)));
  cards_.push_back({name, fields_.size(), 0, line.file, line.line});
  append(line, first, is_free);
}

// Empty fields up to a whole number of lines.
void BulkFile::pad(size_t to_multiple) {
  BulkCard& card = cards_.back();
  while (static_cast<size_t>(card.n_fields) % to_multiple != 0) {
    fields_.emplace_back();
    ++card.n_fields;
  }
}

void BulkFile::append(const BulkLine& line, std::string_view first, bool is_free) {
  const size_t n = is_large(first) ? n_large : n_small;
  BulkCard& card = cards_.back();
  if (!is_free) {
    const size_t wide = width * (n_small / n);
    for (size_t at = width; at < end_of_fields; at += wide, ++card.n_fields)
      fields_.push_back(at < line.text.size() ? without_blanks_around(line.text.substr(at, wide)) : std::string_view());
    return;
  }
  std::string_view rest = line.text.substr(line.text.find(',') + 1);
  for (size_t i = 0; i < n; ++i, ++card.n_fields) {
    const size_t end = std::min(rest.find(','), rest.size());
    fields_.push_back(without_blanks_around(rest.substr(0, end)));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  const std::string_view more = without_blanks_around(rest.substr(0, rest.find(',')));
  if (!is_continuation(more))
    throw InputError(fmt::format("{}: {}: a line has {} fields, '{}' is one more", where(line.file, line.line),
                                 shown(card.name), n, shown(more)));
}

int BulkFields::size() const {
  int n = card_.n_fields;
  while (n > 0 && text(n).empty()) --n;
  return n;
}

std::string BulkFields::word(int i) const { return in_capitals(text(i)); }

long BulkFields::whole(int i, const char* what) const {
  std::string_view field = text(i);
  if (field.empty()) fail(fmt::format("{} is expected, not an empty field", what));
  if (field.starts_with('+')) field.remove_prefix(1);
  long value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size())
    fail(fmt::format("{} is expected, not '{}'", what, shown(text(i))));
  return value;
}

double BulkFields::real(int i, const char* what) const {
  double value = 0.0;
  if (!has(i)) fail(fmt::format("{} is expected, not an empty field", what));
  if (!nastran_real(text(i), value)) fail(fmt::format("{} is expected, not '{}'", what, shown(text(i))));
  return value;
}

std::vector<std::array<long, 3>> BulkFields::ranges_from(int i, const char* what) const {
  std::vector<std::array<long, 3>> ranges;
  for (const int n = size(); i <= n; ++i) {
    if (!has(i)) continue;
    const long from = whole(i, what);
    int next = i + 1;
    while (next <= n && !has(next)) ++next;
    if (next > n || word(next) != "THRU") {
      ranges.push_back({from, from, 1});
      continue;
    }
    i = next + 1;
    const long to = whole(i, what);
    long by = 1;
    if (i + 1 <= n && word(i + 1) == "BY") by = whole(i += 2, "a step");
    if (to < from || by < 1) fail(fmt::format("from {} to {} by {} is no range of numbers", from, to, by));
    ranges.push_back({from, to, by});
  }
  return ranges;
}

}  // namespace dygita
