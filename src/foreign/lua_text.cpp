#include "foreign/lua_text.hpp"

#include <spdlog/fmt/fmt.h>

#include <cctype>
#include <cmath>
#include <cstdlib>

namespace dygita {

std::string lua_quoted(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      quoted += std::string("\\") + c;
    else if (byte < 0x20 || byte == 0x7f)
      quoted += fmt::format("\\{:03}", byte);
    else
      quoted += c;
  }
  return quoted + "\"";
}

std::string lua_number(double value) {
  for (int digits = 6; digits < 17; ++digits)
    if (const std::string text = fmt::format("{:.{}g}", value, digits); std::strtod(text.c_str(), nullptr) == value)
      return text;
  return fmt::format("{:.17g}", value);
}

std::string lua_vector(const Vec3& x) {
  constexpr double zero = 1e-15;
  std::vector<std::string> numbers;
  for (int d = 0; d < 3; ++d) numbers.push_back(lua_number(std::abs(x[d]) < zero ? 0.0 : x[d]));
  return "{ " + comma_list(numbers) + " }";
}

std::string comma_list(const std::vector<std::string>& items) {
  std::string text;
  for (const std::string& item : items) text += (text.empty() ? "" : ", ") + item;
  return text;
}

std::string deck_name_of(const std::string& text) {
  constexpr size_t longest = 80;
  std::string name = text.substr(0, longest);
  for (char& c : name)
    if (std::string("/\\:*?\"<>|").find(c) != std::string::npos || static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      c = '_';
  while (!name.empty() && (name.front() == '.' || name.front() == ' ')) name.erase(0, 1);
  while (!name.empty() && (name.back() == '.' || name.back() == ' ')) name.pop_back();
  return name.empty() ? "unnamed" : name;
}

std::string LuaNames::of(const std::string& prefix, const std::string& text) {
  constexpr size_t longest = 40;
  std::string name = prefix + "_";
  for (const char c : text.substr(0, longest))
    name += std::isalnum(static_cast<unsigned char>(c)) ? static_cast<char>(std::tolower(static_cast<unsigned char>(c)))
                                                        : '_';
  std::string unique = name;
  for (int n = 2; !taken_.insert(unique).second; ++n) unique = fmt::format("{}_{}", name, n);
  return unique;
}

}  // namespace dygita
