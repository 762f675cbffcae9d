#include "foreign/nastran_names.hpp"

#include <algorithm>
#include <cctype>

#include "foreign/cards.hpp"

namespace dygita {

namespace {

// Reads a comment piece by piece.
struct Words {
  std::string_view rest;

  void skip_blanks() {
    while (!rest.empty() && std::isspace(static_cast<unsigned char>(rest.front()))) rest.remove_prefix(1);
  }
  long number() {
    skip_blanks();
    constexpr size_t most_digits = 9;
    size_t n = 0;
    while (n < rest.size() && rest[n] >= '0' && rest[n] <= '9') ++n;
    if (n == 0 || n > most_digits) return -1;
    const long value = std::stol(std::string(rest.substr(0, n)));
    rest.remove_prefix(n);
    return value;
  }
  std::string quoted() {
    const size_t begin = rest.find('"');
    const size_t end = begin == std::string_view::npos ? begin : rest.find('"', begin + 1);
    if (end == std::string_view::npos) return "";
    const std::string text(without_blanks_around(rest.substr(begin + 1, end - begin - 1)));
    rest.remove_prefix(end + 1);
    return text;
  }
};

// What follows `words` in the comment, whatever the letters; false where it does not begin so.
bool after(std::string_view comment, std::string_view words, std::string_view& rest) {
  const std::string capitals = in_capitals(comment.substr(0, words.size()));
  if (capitals != words) return false;
  rest = comment.substr(words.size());
  return true;
}

void note(std::map<long, std::string>& names, long number, std::string_view name) {
  name = without_blanks_around(name);
  if (number > 0 && !name.empty()) names.try_emplace(number, name);
}

// $HMNAME PROP 3"flange" 5; $HMSET 4 1 "feet".
void read_hypermesh(std::string_view text, NastranNames& names, std::map<long, std::string>& components) {
  std::string_view rest;
  const auto read = [&](std::string_view words, std::map<long, std::string>& into) {
    if (!after(text, words, rest)) return;
    Words line{rest};
    const long number = line.number();
    note(into, number, line.quoted());
  };
  read("$HMNAME PROP", names.properties);
  read("$HMNAME MAT", names.materials);
  read("$HMNAME COMP", components);
  if (!after(text, "$HMSET ", rest)) return;
  Words line{rest};
  const long number = line.number(), kind = line.number();
  names.kinds_of_sets[number] = static_cast<int>(kind);
  note(names.sets, number, line.quoted());
}

// $ Femap with NX Nastran Property 3 : flange.
void read_femap(std::string_view text, NastranNames& names) {
  std::string_view rest;
  if (!after(text, "$ FEMAP", rest)) return;
  for (const auto& [word, into] :
       {std::pair(" Property ", &names.properties), std::pair(" Material ", &names.materials)}) {
    const size_t at = rest.find(word);
    if (at == std::string_view::npos) continue;
    Words line{rest.substr(at + std::string_view(word).size())};
    const long number = line.number();
    const size_t colon = line.rest.find(':');
    if (colon != std::string_view::npos) note(*into, number, line.rest.substr(colon + 1));
  }
}

// $ANSA_NAME_COMMENT;3;PSOLID;flange;...
void read_ansa(std::string_view text, NastranNames& names) {
  std::string_view rest;
  if (!after(text, "$ANSA_NAME_COMMENT;", rest)) return;
  Words line{rest};
  const long number = line.number();
  if (!line.rest.starts_with(';')) return;
  const std::string_view kind = line.rest.substr(1, line.rest.find(';', 1) - 1);
  const size_t begin = kind.size() + 2;
  if (begin > line.rest.size()) return;
  const std::string_view name = line.rest.substr(begin, line.rest.find(';', begin) - begin);
  if (kind == "PSOLID") note(names.properties, number, name);
  if (kind.starts_with("MAT")) note(names.materials, number, name);
  if (kind.starts_with("SET")) note(names.sets, number, name);
}

// Patran and Simcenter name the card below.
void read_next(const BulkFile& file, const BulkComment& comment, NastranNames& names) {
  static constexpr std::pair<const char*, bool> beginnings[] = {{"$ ELEMENTS AND ELEMENT PROPERTIES FOR REGION", false},
                                                                {"$ MATERIAL RECORD", true},
                                                                {"$*  PHYSICAL PROPERTY", false},
                                                                {"$*  PROPERTY", false},
                                                                {"$*  MATERIAL", true}};
  for (const auto& [beginning, is_material] : beginnings) {
    std::string_view rest;
    if (!after(comment.text, beginning, rest) || comment.card >= file.cards().size()) continue;
    rest = without_blanks_around(rest);
    if (!rest.starts_with(':')) continue;
    const BulkCard& card = file.cards()[comment.card];
    long number = -1;
    if (is_whole(file.field(card, 1))) number = Words{file.field(card, 1)}.number();
    if (is_material ? card.name.starts_with("MAT") : card.name == "PSOLID")
      note(is_material ? names.materials : names.properties, number, rest.substr(1));
  }
}

}  // namespace

NastranNames nastran_names(const BulkFile& file) {
  NastranNames names;
  std::map<long, std::string> components;
  for (const BulkComment& comment : file.comments()) {
    read_hypermesh(comment.text, names, components);
    read_femap(comment.text, names);
    read_ansa(comment.text, names);
    read_next(file, comment, names);
  }
  for (const auto& [number, name] : components) note(names.properties, number, name);
  return names;
}

}  // namespace dygita
