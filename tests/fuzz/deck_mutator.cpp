#include "fuzz/deck_mutator.hpp"

#include <algorithm>
#include <array>

#include "fuzz/text_changes.hpp"

namespace dygita::fuzz {

namespace {

// Of a value that begins at `at`: up to the comma or bracket that ends it.
size_t end_of_value(const std::string& deck, size_t at) {
  int depth = 0;
  for (; at < deck.size(); ++at) {
    const char c = deck[at];
    if (c == '{' || c == '(') ++depth;
    if ((c == '}' || c == ')') && --depth < 0) return at;
    if (depth == 0 && (c == ',' || c == '\n')) return at;
  }
  return at;
}

// "name = value" within calls.
std::vector<Span> arguments(const std::string& deck) {
  std::vector<Span> all;
  for (const Span& word : spans(deck, false)) {
    size_t at = word.begin + word.size;
    while (at < deck.size() && deck[at] == ' ') ++at;
    if (at >= deck.size() || deck[at] != '=' || deck.compare(at, 2, "==") == 0) continue;
    const size_t line = deck.rfind('\n', word.begin) + 1;
    if (deck.compare(line, 5, "local") == 0 && deck.find('{', line) > word.begin) continue;
    all.push_back({word.begin, end_of_value(deck, at + 1) - word.begin});
  }
  return all;
}

struct Call {
  const Entry* entry;
  size_t open;  // past its bracket
};

std::vector<Call> calls(const std::string& deck) {
  std::vector<Call> all;
  for (size_t at = deck.find('{'); at != std::string::npos; at = deck.find('{', at + 1)) {
    size_t begin = at;
    while (begin > 0 && (is_word(deck[begin - 1]) || deck[begin - 1] == '.')) --begin;
    if (const Entry* entry = grammar().entry(deck.substr(begin, at - begin))) all.push_back({entry, at + 1});
  }
  return all;
}

using Change = void (*)(std::string&, Random&);

void change_word(std::string& deck, Random& random) {
  const std::vector<Span> all = spans(deck, false);
  if (all.empty()) return;
  const Span at = one_of(all, random);
  deck.replace(at.begin, at.size,
               chance(0.6, random) ? one_of(grammar().words, random)
                                   : deck.substr(one_of(all, random).begin, one_of(all, random).size));
}

void drop_argument(std::string& deck, Random& random) {
  const std::vector<Span> all = arguments(deck);
  if (all.empty()) return;
  const Span at = one_of(all, random);
  const bool has_comma = at.begin + at.size < deck.size() && deck[at.begin + at.size] == ',';
  deck.erase(at.begin, at.size + (has_comma ? 1 : 0));
}

void change_argument(std::string& deck, Random& random) {
  const std::vector<Span> all = arguments(deck);
  if (all.empty()) return;
  const Span at = one_of(all, random);
  const std::string name = deck.substr(at.begin, std::min(deck.find_first_of(" =", at.begin), deck.size()) - at.begin);
  const Declared declared = declared_in(deck);
  std::vector<const Argument*> known;
  for (const Entry& entry : grammar().entries)
    for (const Argument& a : entry.arguments)
      if (a.name == name) known.push_back(&a);
  deck.replace(at.begin, at.size,
               known.empty() || chance(0.1, random) ? name + " = " + any_value(declared, random)
                                                    : text_of(*one_of(known, random), declared, random));
}

void add_argument(std::string& deck, Random& random) {
  const std::vector<Call> all = calls(deck);
  if (all.empty()) return;
  const Call call = one_of(all, random);
  if (call.entry->arguments.empty()) return;
  deck.insert(call.open, " " + text_of(one_of(call.entry->arguments, random), declared_in(deck), random) + ",");
}

void add_statement(std::string& deck, Random& random) {
  const std::vector<Span> all = lines(deck);
  deck.insert(all.empty() ? 0 : one_of(all, random).begin, statement(declared_in(deck), random));
}

// What is declared and stands in no list is not looked at much: puts it into one.
void list_declared(std::string& deck, Random& random) {
  const Declared declared = declared_in(deck);
  std::vector<size_t> lists;
  for (const char* name : {"substructures", "interfaces", "supports", "steps", "outputs", "loads", "on"})
    for (size_t at = deck.find(name); at != std::string::npos; at = deck.find(name, at + 1))
      if (const size_t open = deck.find('{', at); open != std::string::npos && open < at + 24)
        lists.push_back(open + 1);
  if (lists.empty() || declared.empty()) return;
  deck.insert(one_of(lists, random), " " + one_of(declared, random).second + ",");
}

constexpr std::array<Change, 16> changes = {change_number,   change_number,   change_number,   change_word,
                                            change_argument, change_argument, change_argument, add_argument,
                                            add_argument,    drop_argument,   add_statement,   add_statement,
                                            list_declared,   copy_line,       take_lines,      spoil_byte};

}  // namespace

std::string changed_deck(std::string deck, Random& random) {
  for (size_t n = 1 + random() % 4; n > 0; --n) changes[random() % changes.size()](deck, random);
  if (chance(0.1, random)) drop_line(deck, random);
  return deck;
}

}  // namespace dygita::fuzz
