// Nastran's DMIG entries, in small, large and free fields. Source: MSC Nastran Quick Reference Guide, DMIG.
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <map>

#include "base/error.hpp"
#include "base/names.hpp"
#include "intake/labelled_matrix.hpp"

namespace dygita {

namespace {

// A card and its continuations: fields after the first, of 8 to a line, of 4 where they are large.
struct Card {
  std::string name;  // capitals, without the asterisk
  std::vector<std::string> fields;
};

std::string in_capitals(std::string_view text) {
  std::string capitals(trimmed(text));
  for (char& c : capitals)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return capitals;
}

// The first field of a line and its data.
struct CardLine {
  std::string first;
  std::vector<std::string> data;

  bool is_large() const { return first.starts_with('*') || first.ends_with('*'); }
  bool is_continuation() const { return first.empty() || first.starts_with('+') || first.starts_with('*'); }
};

CardLine card_line(std::string_view line) {
  CardLine found;
  if (line.find(',') != std::string_view::npos) {
    const std::vector<std::string_view> fields = split_at(line, ',');
    found.first = in_capitals(fields.front());
    const size_t n = found.is_large() ? 4 : 8;
    for (size_t i = 1; i <= n; ++i) found.data.emplace_back(i < fields.size() ? fields[i] : std::string_view());
    return found;
  }
  const auto field = [&](size_t first, size_t width) {
    return first < line.size() ? trimmed(line.substr(first, width)) : std::string_view();
  };
  found.first = in_capitals(field(0, 8));
  const size_t width = found.is_large() ? 16 : 8;
  for (size_t at = 8; at < 72; at += width) found.data.emplace_back(field(at, width));
  return found;
}

// Calls for each DMIG card once it has all its fields; the lines are then at its last.
template <class Take>
void for_dmig_cards(const std::string& text, const std::string& file, Take&& take) {
  TextLines lines(text, file);
  Card card;
  std::string_view line;
  TextLines at = lines;
  while (lines.next(line)) {
    line = line.substr(0, line.find('$'));
    if (trimmed(line).empty()) continue;
    const bool is_of_dmig = !card.name.empty();
    const size_t start = line.find_first_not_of(" \t");
    const bool may_be_dmig = in_capitals(line.substr(start, 4)) == "DMIG";
    if (!is_of_dmig && !may_be_dmig) continue;
    CardLine own = card_line(line);
    if (own.is_continuation()) {
      card.fields.insert(card.fields.end(), own.data.begin(), own.data.end());
      at = lines;
      continue;
    }
    if (is_of_dmig) take(card, at);
    card = {};
    if (own.first != "DMIG" && own.first != "DMIG*") continue;
    card = {"DMIG", std::move(own.data)};
    at = lines;
  }
  if (!card.name.empty()) take(card, at);
}

struct DmigHeader {
  int form = 0, type = 0;
};

class DmigReader {
 public:
  DmigReader(std::string name, const std::string& file) : name_(std::move(name)), file_(file) {}

  void take(const Card& card, const TextLines& at) {
    if (in_capitals(card.fields[0]) != in_capitals(name_)) return;
    if (card.fields[1] == "0")
      read_header(card, at);
    else
      read_column(card, at);
  }
  LabelledMatrix finish() const {
    if (header_.form == 0)
      throw InputError(fmt::format("'{}': matrix '{}' has no header, DMIG with 0 after its name", file_, name_));
    if (entries_.empty()) throw InputError(fmt::format("'{}': matrix '{}' has no entry", file_, name_));
    return entries_.finish(header_.form == 6 ? MatrixEntries::Given::one_triangle : MatrixEntries::Given::both, file_);
  }

 private:
  void read_header(const Card& card, const TextLines& at) {
    if (header_.form != 0) at.fail(fmt::format("matrix '{}' has a second header", name_));
    header_.form = static_cast<int>(at.integer(card.fields[2], "the form of a matrix, 1 (square) or 6 (symmetric),"));
    header_.type = static_cast<int>(at.integer(card.fields[3], "the type of entries, 1 or 2 (real),"));
    if (header_.form != 1 && header_.form != 6)
      at.fail(fmt::format("matrix '{}' has form {}: 1 (square) or 6 (symmetric) is expected", name_, header_.form));
    if (header_.type != 1 && header_.type != 2)
      at.fail(fmt::format("matrix '{}' is of type {}: real entries, 1 or 2, are expected", name_, header_.type));
  }

  void read_column(const Card& card, const TextLines& at) {
    if (header_.form == 0) at.fail(fmt::format("matrix '{}' has no header before this", name_));
    const MatrixRow column = row_of(card.fields[1], card.fields[2], at);
    if (!trimmed(card.fields[3]).empty()) at.fail("field 5 of a DMIG column must be empty");
    entries_.name(column, at);
    for (size_t i = 4; i < card.fields.size(); i += 4) {
      const auto field = [&](size_t k) { return i + k < card.fields.size() ? card.fields[i + k] : std::string(); };
      if (field(0).empty() && field(1).empty() && field(2).empty() && field(3).empty()) continue;
      if (!field(3).empty() && at.real(field(3), "an imaginary part") != 0.0)
        at.fail(fmt::format("an entry of matrix '{}' has an imaginary part, though it is real", name_));
      entries_.add(row_of(field(0), field(1), at), column, at.real(field(2), "an entry"), at);
    }
  }

  static MatrixRow row_of(const std::string& node, const std::string& component, const TextLines& at) {
    constexpr long most = 100000000;
    const long number = at.integer(node, "the number of a grid point");
    const long direction = component.empty() ? 0 : at.integer(component, "a component");
    if (number < 1 || number > most) at.fail(fmt::format("there is no grid point {}", number));
    if (direction < 0 || direction > 6) at.fail(fmt::format("component {} is not one of 0 to 6", direction));
    return {number, static_cast<int>(direction)};
  }

  std::string name_;
  const std::string& file_;
  DmigHeader header_;
  MatrixEntries entries_;
};

}  // namespace

LabelledMatrix read_dmig(const std::string& text, const std::string& file, MatrixRole role, const std::string& name) {
  std::vector<std::string> names;
  for_dmig_cards(text, file, [&](const Card& card, const TextLines& at) {
    if (card.fields.size() < 4 || card.fields[0].empty()) at.fail("a DMIG card without a name");
    const std::string own = in_capitals(card.fields[0]);
    if (std::find(names.begin(), names.end(), own) == names.end()) names.push_back(own);
  });
  DmigReader reader(chosen_matrix(names, role, name, file), file);
  for_dmig_cards(text, file, [&](const Card& card, const TextLines& at) { reader.take(card, at); });
  return reader.finish();
}

}  // namespace dygita
