#include "signal/unit.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <utility>

#include "base/log.hpp"

namespace dygita {

namespace {

constexpr double inch = 0.0254, pound = 4.4482216152605;

struct KnownUnit {
  const char* text;  // without blanks, asterisks and middle dots
  double factor;
  const char* si;
};

// The first of each dimension is SI's own; the order is that of messages.
constexpr KnownUnit known[] = {{"s", 1, "s"},
                               {"ms", 1e-3, "s"},
                               {"us", 1e-6, "s"},
                               {"ns", 1e-9, "s"},
                               {"sec", 1, "s"},
                               {"msec", 1e-3, "s"},
                               {"usec", 1e-6, "s"},
                               {"min", 60, "s"},
                               {"Hz", 1, "Hz"},
                               {"kHz", 1e3, "Hz"},
                               {"MHz", 1e6, "Hz"},
                               {"m/s^2", 1, "m/s^2"},
                               {"mm/s^2", 1e-3, "m/s^2"},
                               {"g", standard_gravity, "m/s^2"},
                               {"gn", standard_gravity, "m/s^2"},
                               {"g0", standard_gravity, "m/s^2"},
                               {"G", standard_gravity, "m/s^2"},
                               {"ms^-2", 1, "m/s^2"},
                               {"in/s^2", inch, "m/s^2"},
                               {"m/s", 1, "m/s"},
                               {"mm/s", 1e-3, "m/s"},
                               {"cm/s", 1e-2, "m/s"},
                               {"in/s", inch, "m/s"},
                               {"m", 1, "m"},
                               {"mm", 1e-3, "m"},
                               {"um", 1e-6, "m"},
                               {"cm", 1e-2, "m"},
                               {"in", inch, "m"},
                               {"N", 1, "N"},
                               {"kN", 1e3, "N"},
                               {"MN", 1e6, "N"},
                               {"lbf", pound, "N"},
                               {"Nm", 1, "N m"},
                               {"kNm", 1e3, "N m"},
                               {"Nmm", 1e-3, "N m"},
                               {"Pa", 1, "Pa"},
                               {"kPa", 1e3, "Pa"},
                               {"MPa", 1e6, "Pa"},
                               {"GPa", 1e9, "Pa"},
                               {"bar", 1e5, "Pa"},
                               {"N/mm^2", 1e6, "Pa"},
                               {"N/m^2", 1, "Pa"},
                               {"psi", pound / (inch * inch), "Pa"},
                               {"ksi", 1e3 * pound / (inch * inch), "Pa"},
                               {"-", 1, ""},
                               {"1", 1, ""}};

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

// As the table writes it: m/s², m/s2, m/s**2 and m / s^2 are one; µ is u, in either encoding.
std::string plain(std::string text) {
  for (const auto& [what, by] : {std::pair{"\xC2\xB5", "u"},
                                 {"\xCE\xBC", "u"},
                                 {"\xC2\xB2", "^2"},
                                 {"\xE2\x81\xBB", "^-"},
                                 {"\xC2\xB7", ""},
                                 {"\xE2\x8B\x85", ""},
                                 {"**", "^"},
                                 {"*", ""},
                                 {" ", ""}})
    text = replaced(std::move(text), what, by);
  if (text.ends_with("s2")) text.insert(text.size() - 1, "^");
  if (text.ends_with("s-2")) text.insert(text.size() - 2, "^");
  return text;
}

std::string known_units(const std::string& si) {
  std::string list;
  for (const KnownUnit& unit : known)
    if (unit.si[0] != '\0' && (si.empty() || si == unit.si))
      list += (list.empty() ? "" : ", ") + std::string(unit.text);
  return list;
}

std::string without_quotes(const std::string& text) {
  const size_t first = text.find_first_not_of(" \t\r\"'#"), last = text.find_last_not_of(" \t\r\"'");
  return first == std::string::npos || last < first ? "" : text.substr(first, last - first + 1);
}

// "acceleration, g", "acceleration in g": a known unit behind the name.
Title title_without_bracket(const std::string& text) {
  for (const char* between : {", ", ",", " in "}) {
    const size_t at = text.rfind(between);
    if (at == std::string::npos || at == 0) continue;
    const std::string unit = without_quotes(text.substr(at + std::string(between).size()));
    if (unit_named(unit)) return {without_quotes(text.substr(0, at)), unit};
  }
  return {text, std::nullopt};
}

// The last bracket of a text, or rather the last that holds a known unit.
Title title_of(const std::string& text) {
  Title title{without_quotes(text), std::nullopt};
  bool is_known = false;
  for (size_t open = text.find_first_of("[({"); open != std::string::npos; open = text.find_first_of("[({", open + 1)) {
    const size_t close = text.find(text[open] == '[' ? ']' : text[open] == '(' ? ')' : '}', open);
    if (close == std::string::npos) break;
    const std::string inside = without_quotes(text.substr(open + 1, close - open - 1));
    if (is_known && !unit_named(inside)) continue;
    is_known = unit_named(inside).has_value();
    title = {without_quotes(text.substr(0, open)), inside};
  }
  return title.unit ? title : title_without_bracket(title.name);
}

// Pieces of a line between separators that stand outside of brackets and straight quotes.
std::vector<std::string> split(const std::string& line, const std::string& separators) {
  std::vector<std::string> pieces(1);
  int depth = 0;
  bool is_quoted = false;
  for (const char c : line) {
    is_quoted ^= c == '"';
    depth += c == '[' || c == '(' || c == '{' ? 1 : c == ']' || c == ')' || c == '}' ? -1 : 0;
    if (depth <= 0 && !is_quoted && separators.find(c) != std::string::npos)
      pieces.emplace_back();
    else
      pieces.back() += c;
  }
  while (pieces.size() > 1 && without_quotes(pieces.back()).empty()) pieces.pop_back();
  return pieces;
}

// Words; where brackets are used, those up to a bracket are one title.
std::vector<Title> titles_between_blanks(const std::string& line) {
  const bool has_units = line.find_first_of("[({") != std::string::npos;
  std::vector<Title> titles;
  std::string words;
  const auto close = [&] {
    if (!without_quotes(words).empty()) titles.push_back(title_of(words));
    words.clear();
  };
  for (const std::string& word : split(line, " \t\r")) {
    words += (words.empty() ? "" : " ") + word;
    if (!has_units || word.ends_with(']') || word.ends_with(')') || word.ends_with('}')) close();
  }
  close();
  return titles;
}

// "time, s, acceleration, g": units between the same commas as their names.
std::vector<Title> with_units_behind(const std::vector<Title>& pieces) {
  std::vector<Title> titles;
  for (const Title& piece : pieces) {
    const bool is_unit = !piece.unit && unit_named(piece.name) && !titles.empty() && !titles.back().unit;
    if (is_unit)
      titles.back().unit = piece.name;
    else
      titles.push_back(piece);
  }
  return titles;
}

}  // namespace

std::optional<Unit> unit_named(const std::string& text) {
  const std::string wanted = plain(text);
  for (const KnownUnit& unit : known)
    if (wanted == unit.text) return Unit{unit.factor, unit.si};
  return std::nullopt;
}

std::vector<Title> titles_of(const std::string& line, size_t n_columns, char separator) {
  std::vector<Title> first;
  for (const char c : {separator, ',', ';', '\t'}) {
    if (c == ' ') continue;
    std::vector<Title> titles;
    for (const std::string& piece : split(line, std::string(1, c))) titles.push_back(title_of(piece));
    if (titles.size() == 1 && n_columns != 1) continue;
    if (titles.size() > n_columns && with_units_behind(titles).size() == n_columns) return with_units_behind(titles);
    if (titles.size() == n_columns) return titles;
    if (first.empty()) first = titles;
  }
  std::vector<Title> words = titles_between_blanks(line);
  return words.size() == n_columns || first.empty() ? words : first;
}

bool are_units(const std::vector<Title>& titles) {
  const auto text = [](const Title& title) { return title.unit.value_or(title.name); };
  return !titles.empty() && unit_named(text(titles.front())) &&
         std::all_of(titles.begin(), titles.end(),
                     [&](const Title& title) { return text(title).empty() || unit_named(text(title)); });
}

std::optional<Unit> unit_of(const Title& title, const Origin& origin, const std::string& si) {
  if (!title.unit || title.unit->empty()) return std::nullopt;
  const std::optional<Unit> unit = unit_named(*title.unit);
  if (!unit)
    throw InputError(origin, fmt::format("'{}' is not a known unit, in the title '{}'\n    known: {}", *title.unit,
                                         title.name, known_units(si)));
  if (!si.empty() && unit->si != si)
    throw InputError(origin,
                     fmt::format("column '{}' is in '{}', where {} is expected\n    known: {}", title.name, *title.unit,
                                 si == "s"    ? "a time"
                                 : si == "Hz" ? "a frequency"
                                              : si,
                                 known_units(si)));
  return unit;
}

std::string unit_in_name(const std::string& name) {
  const size_t at = name.find_last_of("_/ ");
  if (at == std::string::npos || at + 1 == name.size() || name.size() - at > 7) return "";
  const std::string end = name.substr(at + 1);
  const std::optional<Unit> unit = unit_named(end);
  return unit && unit->factor != 1.0 ? end : "";
}

void doubt_name(const Title& title, const Origin& origin) {
  const std::string unit = title.unit ? "" : unit_in_name(title.name);
  if (unit.empty()) return;
  warn(fmt::format("{}column '{}' is read in SI: put a unit in brackets, [{}]", origin.prefix(), title.name, unit));
}

}  // namespace dygita
