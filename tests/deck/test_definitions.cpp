// The definitions for editors: Lua that loads, with every word and every argument of the deck reference.
#include <gtest/gtest.h>

#include <lua.hpp>
#include <map>
#include <memory>
#include <regex>
#include <set>
#include <sstream>

#include "deck/deck.hpp"

namespace dygita::definitions_tests {
namespace {

struct Closing {
  void operator()(lua_State* L) const { lua_close(L); }
};

struct Entry {
  std::string path;                    // "interface.contact", "substructure:face"
  std::vector<std::string> arguments;  // "friction"
};

// "### `interface.contact{ ... }`" and the rows "| `friction` | ..." below it.
std::vector<Entry> entries_of_reference() {
  static const std::regex head(R"(### `([a-z_]+)([.:]?)([a-z_]*).*)"), row(R"(\| `([A-Za-z_][A-Za-z_0-9]*)` \|.*)");
  std::vector<Entry> entries;
  std::istringstream text(deck_reference());
  std::smatch found;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("## ")) entries.push_back({"", {}});
    if (std::regex_match(line, found, head)) entries.push_back({found[1].str() + found[2].str() + found[3].str(), {}});
    if (!entries.empty() && std::regex_match(line, found, row)) entries.back().arguments.push_back(found[1]);
  }
  std::erase_if(entries, [](const Entry& entry) { return entry.path.empty(); });
  return entries;
}

// Fields of each class.
std::map<std::string, std::set<std::string>> classes_of(const std::string& definitions) {
  static const std::regex head(R"(---@class (\(exact\) )?([A-Za-z_.]+).*)"),
      field(R"(---@field ([A-Za-z_][A-Za-z_0-9]*)\??.*)");
  std::map<std::string, std::set<std::string>> classes;
  std::string open;
  std::istringstream text(definitions);
  std::smatch found;
  for (std::string line; std::getline(text, line);) {
    if (std::regex_match(line, found, head)) classes[open = found[2]];
    if (std::regex_match(line, found, field)) classes[open].insert(found[1]);
  }
  return classes;
}

TEST(Definitions, are_lua_that_loads_and_defines_every_word) {
  const std::unique_ptr<lua_State, Closing> state(luaL_newstate());
  ASSERT_EQ(luaL_loadstring(state.get(), deck_definitions().c_str()), LUA_OK) << lua_tostring(state.get(), -1);
  ASSERT_EQ(lua_pcall(state.get(), 0, 0, 0), LUA_OK) << lua_tostring(state.get(), -1);
  int n = 0;
  for (const Entry& entry : entries_of_reference()) {
    if (entry.path.find(':') != std::string::npos) continue;
    ASSERT_EQ(luaL_dostring(state.get(), ("return " + entry.path).c_str()), LUA_OK) << entry.path;
    // A word that is called itself and has members is a table.
    EXPECT_TRUE(lua_isfunction(state.get(), -1) || (entry.path == "substructure" && lua_istable(state.get(), -1)))
        << entry.path;
    ++n;
  }
  EXPECT_GT(n, 40);
  ASSERT_EQ(luaL_dostring(state.get(), "return 20*mm == 0.02 and kHz == 1000 and near ~= nil"), LUA_OK);
  EXPECT_TRUE(lua_toboolean(state.get(), -1));
}

TEST(Definitions, have_every_argument_of_the_reference_and_no_other) {
  const std::string text = deck_definitions();
  const auto classes = classes_of(text);
  for (const Entry& entry : entries_of_reference()) {
    std::string path = entry.path;
    const size_t colon = path.find(':');
    if (colon != std::string::npos) {
      EXPECT_NE(text.find(path.substr(colon) + "("), std::string::npos) << path;
      path[colon] = '.';
      if (!classes.count("dygita." + path + ".arguments")) continue;  // it takes a text or a function, not a table
    }
    const auto found = classes.find("dygita." + path + ".arguments");
    ASSERT_NE(found, classes.end()) << path;
    EXPECT_EQ(found->second, std::set<std::string>(entry.arguments.begin(), entry.arguments.end())) << path;
  }
}

TEST(Definitions, tell_unit_range_and_default) {
  const std::string text = deck_definitions();
  EXPECT_NE(text.find("---@field young number # Young's modulus. Pa, 1e+06 to 2e+12, required"), std::string::npos);
  EXPECT_NE(text.find("---@field friction? number # Coulomb's coefficient. 0 to 1000, default: 0"), std::string::npos);
  EXPECT_NE(text.find("---@field quantity \"displacement\"|\"velocity\"|"), std::string::npos);
}

TEST(Definitions, name_no_class_that_is_not_defined) {
  const std::string text = deck_definitions();
  const auto classes = classes_of(text);
  static const std::regex reference(R"(dygita\.[a-z_.]*[a-z_])");
  const std::set<std::string> aliases = {"dygita.vector", "dygita.counts", "dygita.value"};
  for (std::sregex_iterator it(text.begin(), text.end(), reference), end; it != end; ++it)
    EXPECT_TRUE(classes.count(it->str()) || aliases.count(it->str())) << it->str();
}

}  // namespace
}  // namespace dygita::definitions_tests
