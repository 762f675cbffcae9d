#include "app/command_rows.hpp"

#include <sstream>

namespace dygita {

std::vector<std::string> choices_of(const std::string& value) {
  if (value.size() < 2 || value.front() != '{' || value.back() != '}') return {};
  std::istringstream words(value.substr(1, value.size() - 2));
  std::vector<std::string> choices;
  for (std::string word; std::getline(words, word, ',');) choices.push_back(word);
  return choices;
}

std::string ending_of(const std::string& value) { return value.starts_with("FILE.") ? value.substr(4) : ""; }

}  // namespace dygita
