// tests/wrong_decks/NAME.lua must be refused with the message in NAME.txt, to the letter.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "deck/fake_engine.hpp"

namespace dygita::test::wrong_decks_tests {

namespace {

namespace fs = std::filesystem;

const fs::path folder = fs::path(DYGITA_SOURCE_DIR) / "tests" / "wrong_decks";

std::vector<std::string> wrong_decks() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.path().extension() == ".lua") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

// The text of a file, "{version}" replaced.
std::string text_in(const fs::path& path) {
  std::ostringstream stream;
  stream << std::ifstream(path).rdbuf();
  std::string text = stream.str();
  const std::string placeholder = "{version}";
  const size_t at = text.find(placeholder);
  return at == std::string::npos ? text : text.replace(at, placeholder.size(), version());
}

class WrongDeck : public testing::TestWithParam<std::string> {};

TEST_P(WrongDeck, is_refused_with_its_message) {
  const fs::path before = fs::current_path();
  fs::current_path(folder);  // some messages tell a path as the deck wrote it
  FakeEngine fake;
  DeckOptions options;
  options.path = GetParam() + ".lua";
  std::string message;
  try {
    check_deck(options, fake.engine());
  } catch (const InputError& error) {
    message = error.what();
  }
  fs::current_path(before);
  const std::string expected = text_in(folder / (GetParam() + ".txt"));
  ASSERT_FALSE(expected.empty()) << "no " << GetParam() << ".txt";
  EXPECT_EQ(message + "\n", expected);
}

INSTANTIATE_TEST_SUITE_P(Decks, WrongDeck, testing::ValuesIn(wrong_decks()),
                         [](const testing::TestParamInfo<std::string>& deck) { return deck.param; });

// Every constructor of the language has a wrong deck.
TEST(WrongDecks, cover_every_constructor) {
  const std::vector<std::string> names = wrong_decks();
  const std::string reference = deck_reference();
  int n_constructors = 0;
  for (size_t at = reference.find("### `"); at != std::string::npos; at = reference.find("### `", at + 1)) {
    std::string path = reference.substr(at + 5, reference.find('{', at) - at - 5);
    if (path.find(':') != std::string::npos || path.find('`') != std::string::npos) continue;
    ++n_constructors;
    std::replace(path.begin(), path.end(), '.', '_');
    const bool is_covered = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
      return name.rfind(path == "material_elastic" ? "material" : path, 0) == 0;
    });
    EXPECT_TRUE(is_covered) << path;
  }
  EXPECT_GT(n_constructors, 35);
}

}  // namespace

}  // namespace dygita::test::wrong_decks_tests
