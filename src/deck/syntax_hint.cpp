#include "deck/syntax_hint.hpp"

#include <regex>
#include <sstream>

namespace dygita {

namespace {

// "deck.lua:12: ..." -> line 12 of the text, without its comment.
std::string line_of(const std::string& message, const std::string& text) {
  std::smatch place;
  if (!std::regex_search(message, place, std::regex(R"(:(\d+): )"))) return "";
  std::istringstream lines(text);
  std::string line;
  for (int i = 0; i < std::stoi(place[1]) && std::getline(lines, line); ++i) {
  }
  return line.substr(0, line.find("--"));
}

const char* const units = "mm|um|ms|us|kN|kPa|MPa|GPa|Hz|kHz|g0|deg";

// 20mm, 20 mm.
std::string unit_hint(const std::string& line) {
  std::smatch found;
  static const std::regex number_unit(std::string(R"((^|[^\w.])(\d+\.?\d*(?:[eE][-+]?\d+)?|\.\d+)\s*()") + units +
                                      R"()(?!\w))");
  if (std::regex_search(line, found, number_unit))
    return "a unit is a factor: write " + found[2].str() + "*" + found[3].str();
  static const std::regex base_unit(R"((^|[^\w.])(\d+\.?\d*(?:[eE][-+]?\d+)?)\s*(m|s|N|Pa|kg|g|cm)(?!\w))");
  if (std::regex_search(line, found, base_unit))
    return "numbers are in SI units: write " + found[2].str() + " without '" + found[3].str() +
           "', or multiply by a unit, as in 20*mm";
  return "";
}

std::string sign_hint(const std::string& near) {
  if (near == "!") return "'not equal' is ~=, 'not' is the word not";
  if (near.starts_with("<\\255") || near.starts_with("<\\254")) return "the deck is text in UTF-16: save it as UTF-8";
  if (near.starts_with("<\\")) return "text requires straight quotes, \"\", and minus is the plain -";
  if (near == "&" || near == "|") return "write 'and', 'or'";
  if (near == "#" || near == "//" || near == "%") return "a comment starts with --";
  if (near == "+" || near == "-" || near == "*" || near == "/") return "there is no += in Lua: write x = x + 1";
  return "";
}

}  // namespace

std::string syntax_hint(const std::string& message, const std::string& text) {
  const std::string line = line_of(message, text);
  std::smatch found;
  std::string near, hint;
  if (std::regex_search(message, found, std::regex(R"( near '?([^']*)'?$)"))) near = found[1];
  const bool is_number = message.find("malformed number") != std::string::npos;
  static const std::regex word(R"([A-Za-z_]\w*)");
  if (is_number || std::regex_match(near, word)) hint = unit_hint(line);
  if (hint.empty()) hint = sign_hint(near);
  static const std::regex keyword("local|return|end|for|while|if|then|else|elseif|do|repeat|until|break|function");
  if (hint.empty() && message.find("'}' expected") != std::string::npos && !std::regex_match(near, keyword) &&
      (std::regex_match(near, word) || near == "{"))
    hint = "is a comma missing before '" + near + "', or at the end of the line above?";
  if (hint.empty() && near == "=") hint = "is a comma or a brace missing before this name, or '==' meant?";
  return hint.empty() ? "" : "\n    " + hint;
}

}  // namespace dygita
