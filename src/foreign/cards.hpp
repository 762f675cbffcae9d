// An .inp as cards: keywords with their options, and the lines of data below each; included files in their places.
#pragma once

#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace dygita {

struct DataLine {
  std::string_view text;
  int file, line;
};

struct FileCard {
  std::string keyword;                         // capitals without blanks: "SOLIDSECTION"
  std::string written;                         // "*Solid Section"
  std::map<std::string, std::string> options;  // names in capitals without blanks; empty: a word without a value
  int file = 0, line = 0;
  std::vector<DataLine> data;

  bool has(const std::string& option) const { return options.contains(option); }
  // "" where it is not given.
  std::string option(const std::string& name) const;
};

class CardFile {
 public:
  // Throws InputError: a file missing or unreadable, data before the first keyword, files that include each other.
  explicit CardFile(const std::string& file);
  CardFile(const CardFile&) = delete;
  CardFile& operator=(const CardFile&) = delete;

  const std::string& file() const { return files_[0]; }
  const std::vector<FileCard>& cards() const { return cards_; }
  const std::vector<std::string>& files() const { return files_; }

  // "plate.inp:45", for messages.
  std::string where(int file, int line) const;
  std::string where(const FileCard& card) const { return where(card.file, card.line); }
  [[noreturn]] void fail(const FileCard& card, const std::string& what) const;
  [[noreturn]] void fail(const DataLine& line, const std::string& what) const;

 private:
  struct Lines;
  void add(const std::string& file, const std::string& asked_at, int depth);
  void add_keyword(const std::string& text, int file, int line);
  int load(const std::string& file, const std::string& asked_at);

  std::vector<std::string> files_;
  std::deque<std::string> texts_;
  std::vector<FileCard> cards_;
};

// LineFields of a line between commas, without the blanks around them.
class LineFields {
 public:
  LineFields(const CardFile& file, const DataLine& line) : file_(file), line_(line), rest_(line_.text) {}

  // False at the end of the line; a comma there opens no field.
  bool next(std::string_view& field);
  // What follows; an empty field, or none, is an error of `what`.
  long whole(const char* what);
  double real(const char* what);
  double real_or(double otherwise);  // of an empty field, or none
  std::string name(const char* what);
  bool is_at_end() const;

  long whole_of(std::string_view field, const char* what) const;
  double real_of(std::string_view field, const char* what) const;
  [[noreturn]] void fail(const std::string& what) const { file_.fail(line_, what); }

 private:
  std::string_view needed(const char* what);

  const CardFile& file_;
  DataLine line_;
  std::string_view rest_;
};

// Of files that include files.
inline constexpr int deepest_include = 20;
inline constexpr size_t most_files = 1000;

// A field of a stranger's file, for a message.
std::string shown(std::string_view field);
// "plate.inp:5, plate.inp:9 and 30 more".
std::string few_of(const std::vector<std::string>& places);
std::string in_capitals(std::string_view text);
std::string_view without_blanks_around(std::string_view text);
// Is the field a whole number, as of a node?
bool is_whole(std::string_view field);

}  // namespace dygita
