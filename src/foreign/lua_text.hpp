// Texts and names in a deck that is written by a program.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "numerics/types.hpp"

namespace dygita {

// "plate" in quotes, with what Lua needs escaped.
std::string lua_quoted(const std::string& text);
// As few digits as read back to the same number.
std::string lua_number(double value);
// "{ x, y, z }", rounding to zero as zero.
std::string lua_vector(const Vec3& x);
// "a, b, c".
std::string comma_list(const std::vector<std::string>& items);
// A name that a deck takes for a part: without what cannot name a file.
std::string deck_name_of(const std::string& text);

// Names of local variables: letters, digits and _, each once, none of them a word of Lua or of decks.
class LuaNames {
 public:
  std::string of(const std::string& prefix, const std::string& text);

 private:
  std::set<std::string> taken_;
};

}  // namespace dygita
