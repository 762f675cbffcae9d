#include "foreign/cards.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <filesystem>

#include "base/error.hpp"
#include "base/names.hpp"
#include "base/plain_file.hpp"
#include "intake/matrix_market.hpp"

namespace dygita {

namespace {

namespace fs = std::filesystem;

constexpr size_t longest_shown = 40;

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\0'; }

std::string without_blanks(std::string_view text) {
  std::string kept;
  for (const char c : text)
    if (!is_space(c)) kept += c;
  return kept;
}

// The value of an option as a name: quotes around it go.
std::string unquoted(std::string_view value) {
  value = without_blanks_around(value);
  if (value.size() >= 2 && value.front() == '"' && value.back() == '"') value = value.substr(1, value.size() - 2);
  return std::string(value);
}

// Comma-separated pieces of a keyword's line; commas in quotes do not count.
std::vector<std::string> pieces_of(std::string_view text) {
  std::vector<std::string> pieces(1);
  bool is_quoted = false;
  for (const char c : text) {
    if (c == '"') is_quoted = !is_quoted;
    if (c == ',' && !is_quoted)
      pieces.emplace_back();
    else
      pieces.back() += c;
  }
  return pieces;
}

}  // namespace

std::string shown(std::string_view field) { return printable(std::string(field.substr(0, longest_shown))); }

std::string few_of(const std::vector<std::string>& places) {
  constexpr size_t most = 12;
  std::string text;
  for (size_t i = 0; i < std::min(places.size(), most); ++i) text += (i == 0 ? "" : ", ") + places[i];
  return places.size() <= most ? text : text + fmt::format(" and {} more", places.size() - most);
}

std::string in_capitals(std::string_view text) {
  std::string capitals(text);
  for (char& c : capitals) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return capitals;
}

std::string_view without_blanks_around(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

bool is_whole(std::string_view field) {
  return !field.empty() && std::all_of(field.begin(), field.end(), [](char c) { return c >= '0' && c <= '9'; });
}

std::string FileCard::option(const std::string& name) const {
  const auto found = options.find(name);
  return found == options.end() ? "" : found->second;
}

// Lines of one file, one after the other.
struct CardFile::Lines {
  std::string_view rest;
  int file, line = 0;

  bool next(std::string_view& text) {
    if (rest.empty()) return false;
    const size_t end = std::min(rest.find('\n'), rest.size());
    text = without_blanks_around(rest.substr(0, end));
    rest.remove_prefix(std::min(end + 1, rest.size()));
    ++line;
    return true;
  }
  // The next that is neither empty nor a comment.
  bool next_said(std::string_view& text) {
    while (next(text))
      if (!text.empty() && !text.starts_with("**")) return true;
    return false;
  }
};

std::string CardFile::where(int file, int line) const {
  return fmt::format("{}:{}", files_[static_cast<size_t>(file)], line);
}

void CardFile::fail(const FileCard& card, const std::string& what) const {
  throw InputError(fmt::format("{}: {}: {}", where(card), card.written, what));
}

void CardFile::fail(const DataLine& line, const std::string& what) const {
  throw InputError(fmt::format("{}: {}", where(line.file, line.line), what));
}

int CardFile::load(const std::string& file, const std::string& asked_at) {
  std::error_code error;
  if (!fs::exists(file, error))
    throw InputError(asked_at.empty() ? fmt::format("mesh file '{}' does not exist (looked for {})", file,
                                                    fs::absolute(file).lexically_normal().string())
                                      : fmt::format("{}: the file '{}' does not exist", asked_at, file));
  texts_.push_back(text_of_file(file));
  files_.push_back(file);
  return static_cast<int>(files_.size()) - 1;
}

void CardFile::add_keyword(const std::string& text, int file, int line) {
  const std::vector<std::string> pieces = pieces_of(text);
  FileCard card;
  card.written = printable(std::string(without_blanks_around(pieces[0].substr(0, longest_shown))));
  card.keyword = in_capitals(without_blanks(pieces[0])).substr(1);
  card.file = file;
  card.line = line;
  for (size_t i = 1; i < pieces.size(); ++i) {
    const size_t equals = pieces[i].find('=');
    const std::string name = in_capitals(without_blanks(pieces[i].substr(0, equals)));
    if (!name.empty()) card.options[name] = equals == std::string::npos ? "" : unquoted(pieces[i].substr(equals + 1));
  }
  cards_.push_back(std::move(card));
}

void CardFile::add(const std::string& file, const std::string& asked_at, int depth) {
  if (depth > deepest_include || files_.size() >= most_files)
    throw InputError(fmt::format("{}: files include each other, more than {} deep, or more than {} of them", asked_at,
                                 deepest_include, most_files));
  Lines lines{{}, load(file, asked_at)};
  lines.rest = texts_.back();
  const fs::path folder = fs::path(files_[0]).parent_path();
  for (std::string_view text; lines.next_said(text);) {
    if (text.front() != '*') {
      if (cards_.empty())
        throw InputError(fmt::format("{}: a keyword is expected, such as *NODE, not '{}'",
                                     where(lines.file, lines.line), shown(text)));
      cards_.back().data.push_back({text, lines.file, lines.line});
      continue;
    }
    const int first = lines.line;
    std::string whole(text);
    while (whole.back() == ',' && lines.next_said(text)) whole += text;
    add_keyword(whole, lines.file, first);
    const FileCard& card = cards_.back();
    const bool is_listed = card.keyword == "NODE" || card.keyword == "ELEMENT" || card.keyword == "INCLUDE";
    const std::string input = is_listed ? card.option("INPUT") : "", at = where(card);
    if (card.keyword == "INCLUDE") {
      if (input.empty()) fail(card, "INPUT = FILE is expected");
      cards_.pop_back();  // its file is read in its place, data of the card before it too
    }
    if (!input.empty()) add((fs::path(input).is_absolute() ? fs::path(input) : folder / input).string(), at, depth + 1);
  }
}

CardFile::CardFile(const std::string& file) { add(file, "", 0); }

bool LineFields::next(std::string_view& field) {
  if (is_at_end()) return false;
  const size_t end = std::min(rest_.find(','), rest_.size());
  field = without_blanks_around(rest_.substr(0, end));
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  return true;
}

bool LineFields::is_at_end() const { return without_blanks_around(rest_).empty(); }

std::string_view LineFields::needed(const char* what) {
  std::string_view field;
  if (!next(field) || field.empty()) file_.fail(line_, fmt::format("{} is expected, not the end of the line", what));
  return field;
}

long LineFields::whole(const char* what) { return whole_of(needed(what), what); }
double LineFields::real(const char* what) { return real_of(needed(what), what); }
std::string LineFields::name(const char* what) { return unquoted(needed(what)); }

double LineFields::real_or(double otherwise) {
  std::string_view field;
  return next(field) && !field.empty() ? real_of(field, "a number") : otherwise;
}

long LineFields::whole_of(std::string_view field, const char* what) const {
  long value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc() || end != field.data() + field.size())
    file_.fail(line_, fmt::format("{} is expected, not '{}'", what, shown(field)));
  return value;
}

double LineFields::real_of(std::string_view field, const char* what) const {
  const std::string_view given = field;
  if (field.starts_with('+')) field.remove_prefix(1);
  double value = 0.0;
  const char* last = field.data() + field.size();
  auto [end, error] = std::from_chars(field.data(), last, value);
  if (error == std::errc() && end != last && (*end == 'd' || *end == 'D')) {  // Fortran's exponent
    std::string plain(field);
    plain[static_cast<size_t>(end - field.data())] = 'e';
    if (const size_t plus = plain.find('+'); plus != std::string::npos) plain.erase(plus, 1);
    const auto again = std::from_chars(plain.data(), plain.data() + plain.size(), value);
    error = again.ec;
    end = again.ptr == plain.data() + plain.size() ? last : field.data();
  }
  if (error != std::errc() || end != last || !std::isfinite(value))
    file_.fail(line_, fmt::format("{} is expected, not '{}'", what, shown(given)));
  return value;
}

}  // namespace dygita
