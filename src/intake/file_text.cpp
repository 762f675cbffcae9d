#include "intake/file_text.hpp"

#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <set>

#include "base/plain_file.hpp"

namespace dygita {

namespace {

// Of a file that has an end: "" of a device or a pipe.
std::string text_of(const std::string& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return "";
  return text_of_file(file);
}

// End of the string that opens at `at`, one past its closing quote.
size_t past_string(const std::string& text, size_t at) {
  const size_t close = text.find('"', at + 1);
  return close == std::string::npos ? text.size() : close + 1;
}

std::string without_comments(const std::string& text) {
  std::string kept;
  for (size_t i = 0; i < text.size();) {
    if (text[i] == '"') {
      const size_t end = past_string(text, i);
      kept += text.substr(i, end - i);
      i = end;
    } else if (text.compare(i, 2, "//") == 0) {
      i = std::min(text.find('\n', i), text.size());
    } else if (text.compare(i, 2, "/*") == 0) {
      const size_t close = text.find("*/", i + 2);
      i = close == std::string::npos ? text.size() : close + 2;
      kept += ' ';
    } else {
      kept += text[i++];
    }
  }
  return kept;
}

bool is_name_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == ':'; }

size_t past_spaces(const std::string& text, size_t at) {
  while (at < text.size() && std::isspace(static_cast<unsigned char>(text[at]))) ++at;
  return at;
}

// Names on the left of '=' in the list that opens at `at`: [ size = 1, n = {3, Name "cells"} ].
void add_names(const std::string& text, size_t at, std::set<std::string>& names) {
  int depth = 0;
  bool expects_name = false;
  while (at < text.size()) {
    const char c = text[at];
    if (c == '"') {
      at = past_string(text, at);
      continue;
    }
    if (c == '[' || c == '(' || c == '{') ++depth;
    if (c == ']' || c == ')' || c == '}') --depth;
    if (depth == 0) return;
    if (depth == 1 && (c == '[' || c == '(' || c == ',')) {
      expects_name = true;
    } else if (expects_name && is_name_character(c)) {
      const size_t start = at;
      while (at < text.size() && is_name_character(text[at])) ++at;
      names.insert(text.substr(start, at - start));
      expects_name = false;
      continue;
    }
    ++at;
  }
}

struct Collected {
  std::set<std::string> names, visited, unfinished;
};

void collect(const std::filesystem::path& file, Collected& collected) {
  if (!collected.visited.insert(file.lexically_normal().string()).second) return;
  const std::string raw = text_of(file.string()), text = without_comments(raw);
  if (!raw.empty() && raw.back() != '\n') collected.unfinished.insert(file.lexically_normal().string());
  for (size_t i = 0; i < text.size();) {
    if (text[i] == '"') {
      i = past_string(text, i);
      continue;
    }
    const size_t start = i;
    while (i < text.size() && is_name_character(text[i])) ++i;
    const std::string word = text.substr(start, i - start);
    const size_t next = past_spaces(text, i);
    if (word == "DefineConstant" && next < text.size()) add_names(text, next, collected.names);
    if (word == "Include" && next < text.size() && text[next] == '"') {
      i = past_string(text, next);
      collect(file.parent_path() / text.substr(next + 1, i - next - 2), collected);
    }
    if (i == start) ++i;
  }
}

// The first name of an entity at or after `at`: "#24"; empty where there is none.
std::string entity_name(const std::string& text, size_t at) {
  const size_t start = text.find('#', at);
  if (start == std::string::npos) return "";
  size_t end = start + 1;
  while (end < text.size() && std::isdigit(static_cast<unsigned char>(text[end]))) ++end;
  return text.substr(start, end - start);
}

// What a STEP file says of an entity: "#24 = ( LENGTH_UNIT() ... );" without name and end.
std::string entity_called(const std::string& text, const std::string& name) {
  for (size_t found = text.find(name); !name.empty() && found != std::string::npos;
       found = text.find(name, found + 1)) {
    const size_t next = past_spaces(text, found + name.size());
    if (next < text.size() && text[next] == '=') return text.substr(next + 1, text.find(';', next) - next - 1);
  }
  return "";
}

// m, of the metre with a prefix; none of what is no SI unit of length.
std::optional<double> si_length(const std::string& entity) {
  const size_t metre = entity.find(".METRE."), open = entity.rfind('(', metre);
  if (metre == std::string::npos || open == std::string::npos) return {};
  const std::string prefix = entity.substr(open + 1, metre - open - 1);
  if (prefix.find('$') != std::string::npos) return 1.0;
  for (const auto& [word, length] :
       {std::pair{".MICRO.", 1e-6}, {".MILLI.", 1e-3}, {".CENTI.", 1e-2}, {".DECI.", 0.1}, {".KILO.", 1e3}})
    if (prefix.find(word) != std::string::npos) return length;
  return {};
}

// m, of a unit of length: an inch is a number of others.
std::optional<double> length_of(const std::string& text, const std::string& entity, int depth = 0) {
  constexpr int deepest = 3;
  if (entity.find("LENGTH_UNIT") == std::string::npos || depth > deepest) return {};
  const size_t converted = entity.find("CONVERSION_BASED_UNIT");
  if (converted == std::string::npos) return si_length(entity);
  const std::string measure = entity_called(text, entity_name(entity, converted)), word = "LENGTH_MEASURE(";
  const size_t number = measure.find(word);
  if (number == std::string::npos) return {};
  const std::optional<double> unit = length_of(text, entity_called(text, entity_name(measure, number)), depth + 1);
  if (!unit) return {};
  return *unit * std::strtod(measure.c_str() + number + word.size(), nullptr);
}

}  // namespace

GeoFacts geo_facts(const std::string& file) {
  Collected collected;
  collect(std::filesystem::absolute(file), collected);
  return {{collected.names.begin(), collected.names.end()}, {collected.unfinished.begin(), collected.unfinished.end()}};
}

std::optional<double> step_unit(const std::string& file) {
  const std::string text = text_of(file);
  // The units of a context, that of length among them.
  const size_t at = text.find("GLOBAL_UNIT_ASSIGNED_CONTEXT"), end = text.find("))", at);
  if (at == std::string::npos) return {};
  for (size_t i = text.find('#', at); i < end; i = text.find('#', i + 1))
    if (const std::optional<double> length = length_of(text, entity_called(text, entity_name(text, i)))) return length;
  return {};
}

}  // namespace dygita
