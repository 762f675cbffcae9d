#include "intake/geo_script.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/plain_file.hpp"

namespace dygita {

namespace {

constexpr int deepest_merge = 16;

// Words that run programs, write files, end the process, wait, or make script out of text.
const std::set<std::string> refused_words = {"SystemCall", "NonBlockingSystemCall",
                                             "OnelabRun",  "CreateDir",
                                             "Print",      "Save",
                                             "Exit",       "Abort",
                                             "Sleep",      "Plugin",
                                             "Parse",      "Draw"};
const std::set<std::string> reading_words = {"Merge", "Include", "MergeWithBoundingBox", "NonBlockingMerge",
                                             "ShapeFromFile"};
const std::set<std::string> printing_words = {"Printf", "Error", "Warning"};
const std::set<std::string> cad_extensions = {".step", ".stp", ".brep", ".iges", ".igs", ".stl"};

struct Token {
  std::string text;  // a word, a quoted text with its quotes, or one character
  int line = 0;
};

bool is_word_character(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.'; }

std::vector<Token> tokens_of(const std::string& text) {
  std::vector<Token> tokens;
  int line = 1;
  for (size_t i = 0; i < text.size();) {
    const char c = text[i];
    size_t end = i + 1;
    if (text.compare(i, 2, "//") == 0) {
      end = std::min(text.find('\n', i), text.size());
    } else if (text.compare(i, 2, "/*") == 0) {
      const size_t close = text.find("*/", i + 2);
      end = close == std::string::npos ? text.size() : close + 2;
    } else if (c == '"') {
      const size_t close = text.find('"', i + 1);
      end = close == std::string::npos ? text.size() : close + 1;
      tokens.push_back({text.substr(i, end - i), line});
    } else if (is_word_character(c)) {
      while (end < text.size() && is_word_character(text[end])) ++end;
      tokens.push_back({text.substr(i, end - i), line});
    } else if (!std::isspace(static_cast<unsigned char>(c))) {
      tokens.push_back({std::string(1, c), line});
    }
    line +=
        static_cast<int>(std::count(text.begin() + static_cast<long>(i), text.begin() + static_cast<long>(end), '\n'));
    i = end;
  }
  return tokens;
}

[[noreturn]] void refuse(const std::filesystem::path& file, int line, const std::string& text) {
  throw InputError(fmt::format("{}:{}: {}\n    a mesh file of a deck may only describe a mesh",
                               file.filename().string(), line, text));
}

bool is_session_option(const std::string& word) {
  return word.rfind("General.", 0) == 0 &&
         (word.find("File") != std::string::npos || word.find("Save") != std::string::npos ||
          word.find("Executable") != std::string::npos);
}

bool is_refused(const std::string& word) {
  return refused_words.count(word) > 0 || word.rfind("Solver.", 0) == 0 || is_session_option(word);
}

// Those that have been checked, with all that they merge: one that is merged a hundred times is read once.
using Checked = std::set<std::filesystem::path>;

void check_file(const std::filesystem::path& file, int depth, Checked& checked);

void check_merged(const std::filesystem::path& file, const std::vector<Token>& tokens, size_t i, int depth,
                  Checked& checked) {
  size_t next = i + 1;
  while (next < tokens.size() && (tokens[next].text == "(" || tokens[next].text == "[")) ++next;
  const std::string name = next < tokens.size() ? tokens[next].text : "";
  if (name.size() < 2 || name.front() != '"') {
    refuse(file, tokens[i].line, fmt::format("'{}' must be followed by a file's name in quotes", tokens[i].text));
  }
  check_file(file.parent_path() / name.substr(1, name.size() - 2), depth + 1, checked);
}

void check_geo(const std::filesystem::path& file, int depth, Checked& checked) {
  const std::vector<Token> tokens = tokens_of(text_of_file(file.string()));
  for (size_t i = 0; i < tokens.size(); ++i) {
    const std::string& word = tokens[i].text;
    if (is_refused(word)) refuse(file, tokens[i].line, fmt::format("'{}' is refused", word));
    if (reading_words.count(word)) check_merged(file, tokens, i, depth, checked);
    if (!printing_words.count(word)) continue;
    for (size_t j = i + 1; j < tokens.size() && tokens[j].text != ";"; ++j) {
      if (tokens[j].text == ">") refuse(file, tokens[i].line, fmt::format("'{}' into a file is refused", word));
    }
  }
}

void check_file(const std::filesystem::path& file, int depth, Checked& checked) {
  if (depth > deepest_merge)
    throw InputError(fmt::format("{}: files merge each other to too many levels", file.string()));
  std::error_code error;
  const std::filesystem::path known = std::filesystem::canonical(file, error);
  if (error || !std::filesystem::is_regular_file(known, error))
    throw InputError(fmt::format("{}: no such file, but a mesh file merges it", file.string()));
  if (checked.contains(known)) return;
  require_readable(known);
  const std::filesystem::path options = file.string() + ".opt";
  if (std::filesystem::exists(options, error)) {
    throw InputError(
        fmt::format("{} is beside the mesh file and gmsh would run it: rename or remove it", options.string()));
  }
  std::string extension = file.extension().string();
  if (extension == ".msh") {
    if (std::ifstream(file, std::ios::binary).get() != '$') {
      throw InputError(fmt::format("{} is not a .msh file: it does not begin with '$'", file.string()));
    }
    return;
  }
  if (cad_extensions.count(extension) == 0) check_geo(file, depth, checked);
  checked.insert(known);
}

}  // namespace

void check_script(const std::string& path) {
  Checked checked;
  check_file(path, 0, checked);
}

}  // namespace dygita
