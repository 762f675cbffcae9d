// Commands and options as plain rows, for the pages made from them.
#pragma once

#include <string>
#include <vector>

namespace dygita {

struct OptionRow {
  std::vector<std::string> names;  // "-h", "--help"; of an argument without dashes its one name
  // What it takes: FILE, FILE.lua (of that kind), DIR, {one,of,these}, else a word like FLOAT. Empty: a flag.
  std::string value;
  std::string doc, by_default;
  bool is_positional = false, is_repeated = false;
};

struct CommandRow {
  std::string name, doc;
  std::vector<OptionRow> options;
};

// The alternatives of a value {one,of,these}; none of any other.
std::vector<std::string> choices_of(const std::string& value);

// The ending ".lua" of a value FILE.lua; empty for any other.
std::string ending_of(const std::string& value);

}  // namespace dygita
