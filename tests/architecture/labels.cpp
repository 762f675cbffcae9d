#include "architecture/labels.hpp"

#include <cctype>
#include <regex>
#include <sstream>

namespace dygita::architecture {

namespace {

bool is_equation(const std::string& line) { return line.starts_with("    "); }

std::string without_code(const std::string& line) {
  std::string prose;
  bool is_code = false;
  for (const char c : line) {
    if (c == '`') is_code = !is_code;
    prose += is_code ? ' ' : c;
  }
  return prose;
}

// What of a line a reader takes for text.
std::string prose_of(const std::string& line, Prose prose) {
  if (prose == Prose::markdown) return is_equation(line) ? "" : without_code(line);
  const char* mark = prose == Prose::cpp_comments ? "//" : prose == Prose::lua_comments ? "--" : "#";
  const size_t begin = line.find(mark);
  return begin == std::string::npos ? "" : line.substr(begin);
}

bool continues_a_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '.'; }

}  // namespace

std::vector<std::string> defined_labels(const std::string& method) {
  static const std::regex at_head("^    ([A-Z][1-9][0-9]?)  +\\S"), at_end("^    .*\\s\\(([A-Z][1-9][0-9]?)\\)$");
  std::vector<std::string> labels;
  std::istringstream lines(method);
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_search(line, match, at_head)) labels.push_back(match[1]);
    if (std::regex_search(line, match, at_end)) labels.push_back(match[1]);
  }
  return labels;
}

std::vector<std::string> cited_labels(const std::string& text, Prose prose, const std::set<char>& families) {
  static const std::regex label("[A-Z][1-9][0-9]?");
  std::vector<std::string> labels;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::string words = prose_of(line, prose);
    for (std::sregex_iterator it(words.begin(), words.end(), label), end; it != end; ++it) {
      const size_t begin = static_cast<size_t>(it->position()), after = begin + static_cast<size_t>(it->length());
      if (begin > 0 && continues_a_word(words[begin - 1])) continue;
      if (after < words.size() && continues_a_word(words[after]) && words[after] != '.') continue;
      const bool is_announced = begin >= 4 && words.compare(begin - 4, 4, "eq. ") == 0;
      if (is_announced || families.contains(words[begin])) labels.push_back(it->str());
    }
  }
  return labels;
}

}  // namespace dygita::architecture
