#include "fuzz/text_changes.hpp"

#include <algorithm>
#include <cctype>
#include <deque>

namespace dygita::fuzz {

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

// Numbers, or words, of a text.
std::vector<Span> spans(const std::string& text, bool of_numbers) {
  std::vector<Span> all;
  for (size_t i = 0; i < text.size();) {
    if (text.compare(i, 2, "--") == 0) i = std::min(text.find('\n', i), text.size());
    if (i == text.size()) break;
    if (!is_word(text[i])) {
      ++i;
      continue;
    }
    const bool is_number = std::isdigit(static_cast<unsigned char>(text[i]));
    size_t end = i;
    while (end < text.size() && (is_word(text[end]) || (is_number && text[end] == '.'))) ++end;
    if (is_number == of_numbers) all.push_back({i, end - i});
    i = end;
  }
  return all;
}

std::vector<Span> lines(const std::string& text) {
  std::vector<Span> all;
  for (size_t i = 0; i < text.size();) {
    const size_t end = std::min(text.find('\n', i), text.size() - 1);
    all.push_back({i, end + 1 - i});
    i = end + 1;
  }
  return all;
}

void change_number(std::string& text, Random& random) {
  const std::vector<Span> all = spans(text, true);
  if (all.empty()) return;
  const Span at = one_of(all, random);
  const std::string near =
      std::to_string(std::strtod(text.c_str() + at.begin, nullptr) * (0.5 + 1e-3 * (random() % 2000)));
  text.replace(at.begin, at.size, chance(0.5, random) ? near : any_number(random));
}

void drop_line(std::string& text, Random& random) {
  const std::vector<Span> all = lines(text);
  if (all.empty()) return;
  const Span at = one_of(all, random);
  text.erase(at.begin, at.size);
}

void copy_line(std::string& text, Random& random) {
  const std::vector<Span> all = lines(text);
  if (all.empty()) return;
  const Span from = one_of(all, random), to = one_of(all, random);
  text.insert(to.begin, text.substr(from.begin, from.size));
}

void take_lines(std::string& text, Random& random) {
  static std::deque<std::string> seen;
  if (!seen.empty()) {
    const std::string& other = seen[random() % seen.size()];
    const std::vector<Span> theirs = lines(other), own = lines(text);
    if (!theirs.empty()) {
      const size_t first = random() % theirs.size(), last = std::min(first + random() % 8, theirs.size() - 1);
      text.insert(own.empty() ? 0 : one_of(own, random).begin,
                  other.substr(theirs[first].begin, theirs[last].begin + theirs[last].size - theirs[first].begin));
    }
  }
  seen.push_back(text);
  if (seen.size() > 200) seen.pop_front();
}

void spoil_byte(std::string& text, Random& random) {
  if (text.empty()) return;
  const size_t at = random() % text.size();
  switch (random() % 3) {
    case 0:
      text[at] = static_cast<char>(random());
      break;
    case 1:
      text.erase(at, 1 + random() % 5);
      break;
    default:
      text.insert(at, 1, "{}()=,.\"'-*/#%[]\n"[random() % 17]);
      break;
  }
}

}  // namespace dygita::fuzz
