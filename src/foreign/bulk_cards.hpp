// Bulk data of Nastran as cards: fields in free, small and large format with their continuations; included files in
// their places. Source: MSC Nastran Quick Reference Guide, "Format of Bulk Data Entries".
#pragma once

#include <array>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace dygita {

struct BulkCard {
  std::string_view name;  // capitals, without the asterisk of large fields
  size_t first;           // of its fields
  int n_fields, file, line;
};

struct BulkLine {
  std::string_view text;
  int file, line;
};

// A comment above a card, with its $.
struct BulkComment {
  std::string_view text;
  size_t card;  // the next one
};

class BulkFile {
 public:
  // Throws InputError: a file missing or unreadable, a line that continues no card, files that include each other.
  explicit BulkFile(const std::string& file);
  BulkFile(const BulkFile&) = delete;
  BulkFile& operator=(const BulkFile&) = delete;

  const std::string& file() const { return files_[0]; }
  const std::vector<std::string>& files() const { return files_; }
  const std::vector<BulkCard>& cards() const { return cards_; }
  // Lines before BEGIN BULK; none where the file has bulk data alone.
  const std::vector<BulkLine>& control() const { return control_; }
  const std::vector<BulkComment>& comments() const { return comments_; }

  std::string where(int file, int line) const;
  std::string where(const BulkCard& card) const { return where(card.file, card.line); }
  [[noreturn]] void fail(const BulkCard& card, const std::string& what) const;

  // The field by its number among the card's data, from 1; empty where there is none.
  std::string_view field(const BulkCard& card, int i) const {
    return i >= 1 && i <= card.n_fields ? fields_[card.first + static_cast<size_t>(i) - 1] : std::string_view();
  }

 private:
  void add_lines(const std::string& file, const std::string& asked_at, int depth);
  bool add_included(std::string_view text, int file, int line, std::string_view& rest, int& at, int depth);
  void read_cards(size_t first);
  void take(const BulkLine& line);
  void append(const BulkLine& line, std::string_view first, bool is_free);
  void pad(size_t to_multiple);
  std::string_view kept(std::string text);

  std::vector<std::string> files_;
  std::deque<std::string> texts_;
  std::vector<BulkLine> lines_, control_;
  std::vector<BulkCard> cards_;
  std::vector<std::string_view> fields_;
  std::vector<BulkComment> comments_;
};

// Fields of a card one by one, from 1.
class BulkFields {
 public:
  BulkFields(const BulkFile& file, const BulkCard& card) : file_(file), card_(card) {}

  int size() const;  // up to the last that is not empty
  bool has(int i) const { return !text(i).empty(); }
  std::string_view text(int i) const { return file_.field(card_, i); }
  std::string word(int i) const;  // capitals
  // An empty field, or another text, is an error of `what`.
  long whole(int i, const char* what) const;
  double real(int i, const char* what) const;
  long whole_or(int i, long otherwise, const char* what) const { return has(i) ? whole(i, what) : otherwise; }
  double real_or(int i, double otherwise, const char* what) const { return has(i) ? real(i, what) : otherwise; }
  // Numbers from field i on, with "a THRU b" and "a THRU b BY c"; empty fields say nothing.
  std::vector<std::array<long, 3>> ranges_from(int i, const char* what) const;
  [[noreturn]] void fail(const std::string& what) const { file_.fail(card_, what); }

 private:
  const BulkFile& file_;
  const BulkCard& card_;
};

// Of "1.5", "1.5E3", "1.5D3", "1.5+3"; false where it is no number.
bool nastran_real(std::string_view field, double& value);

}  // namespace dygita
