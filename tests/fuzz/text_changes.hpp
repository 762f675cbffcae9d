// Changes that make sense in any text of numbers and words.
#pragma once

#include <string>
#include <vector>

#include "fuzz/grammar.hpp"

namespace dygita::fuzz {

struct Span {
  size_t begin = 0, size = 0;
};

bool is_word(char c);
// Numbers, or words, outside of Lua's comments.
std::vector<Span> spans(const std::string& text, bool of_numbers);
std::vector<Span> lines(const std::string& text);

void change_number(std::string& text, Random& random);
void drop_line(std::string& text, Random& random);
void copy_line(std::string& text, Random& random);
void take_lines(std::string& text, Random& random);  // of another text that came by
void spoil_byte(std::string& text, Random& random);

}  // namespace dygita::fuzz
