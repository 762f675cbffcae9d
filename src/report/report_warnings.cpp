// Warnings by kind: those that differ in names and numbers alone are one.
#include <algorithm>
#include <cctype>

#include "base/log.hpp"
#include "drawing/svg_text.hpp"
#include "report/html.hpp"
#include "report/report_parts.hpp"

namespace dygita {

namespace {

constexpr size_t n_in_full = 3;

// Without what stands in quotes, numbers, and the line of the deck.
std::string kind_of(const std::string& warning) {
  std::string kind;
  bool is_quoted = false;
  for (size_t i = 0; i < warning.size(); ++i) {
    const char c = warning[i];
    const bool may_open = i == 0 || !std::isalnum(static_cast<unsigned char>(warning[i - 1]));
    if (c == '\'' && (is_quoted || may_open)) {
      is_quoted = !is_quoted;
      if (is_quoted) kind += '\'';
    } else if (!is_quoted && !std::isdigit(static_cast<unsigned char>(c)) && c != '.' && c != '-' && c != '+') {
      kind += c;
    }
  }
  // A name for a kind of object that has none, as in "interface.contact 'a': 'b' and 'c'", is no other kind.
  for (size_t at = kind.find(" ':"); at != std::string::npos; at = kind.find(" ':", at)) kind.replace(at, 3, ":");
  return kind;
}

struct Kind {
  std::string key;
  std::vector<std::string> warnings;
};

std::vector<Kind> kinds_of(const Json& record) {
  std::vector<Kind> kinds;
  for (const Json& warning : record.value("warnings", Json::array())) {
    if (!warning.is_string()) continue;
    const std::string key = kind_of(warning.get<std::string>());
    auto of = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& kind) { return kind.key == key; });
    if (of == kinds.end()) of = kinds.insert(of, Kind{key, {}});
    of->warnings.push_back(warning.get<std::string>());
  }
  return kinds;
}

// A line of the log each.
std::string with_breaks(const std::string& text) {
  const size_t end = text.find("\n    ");
  return end == std::string::npos ? escaped(text)
                                  : escaped(text.substr(0, end)) + "<br/>\n" + with_breaks(text.substr(end + 5));
}

std::string item_of(const Kind& kind) {
  std::string item = with_breaks(kind.warnings.front());
  if (kind.warnings.size() == 1) return item;
  const std::vector<std::string> others(kind.warnings.begin() + 1, kind.warnings.end());
  return item + "\n" + html::folded(fmt::format("{} more of this kind", others.size()), html::list(others));
}

}  // namespace

std::string warnings_part(const Json& record) {
  const std::vector<Kind> kinds = kinds_of(record);
  if (kinds.empty()) return html::paragraph("No warnings.");
  size_t n = 0;
  std::vector<std::string> first, rest;
  for (const Kind& kind : kinds) {
    n += kind.warnings.size();
    (first.size() < n_in_full ? first : rest).push_back(item_of(kind));
  }
  const std::string title =
      n == 1              ? "1 warning"
      : kinds.size() == n ? fmt::format("{} warnings", n)
                          : fmt::format("{} warnings of {} kind{}", n, kinds.size(), kinds.size() == 1 ? "" : "s");
  const std::string more =
      rest.size() == 1 ? "1 further kind of warning" : fmt::format("{} further kinds of warnings", rest.size());
  return html::heading(title) + html::html_list(first, "warnings") +
         html::folded(more, html::html_list(rest, "warnings"));
}

}  // namespace dygita
