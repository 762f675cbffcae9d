// The committed reference of the deck language is what the program prints.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "deck/deck.hpp"
#include "model/load.hpp"

namespace dygita::reference_tests {
namespace {

TEST(Reference, of_the_manual_is_the_printed_one) {
  std::ifstream file(DYGITA_SOURCE_DIR "/manual/deck-reference.md");
  ASSERT_TRUE(file) << "no manual/deck-reference.md";
  const std::string committed((std::istreambuf_iterator<char>(file)), {});
  EXPECT_EQ(committed, deck_reference()) << "the schema has changed: dygita schema > manual/deck-reference.md";
}

TEST(Reference, has_every_load_that_has_a_file_and_no_other) {
  const std::string reference = deck_reference();
  size_t n = 0;
  for (size_t at = reference.find("### `load."); at != std::string::npos; at = reference.find("### `load.", at + 1))
    ++n;
  EXPECT_EQ(n, load_table().size());
  for (const LoadEntry& entry : load_table())
    EXPECT_NE(reference.find("### `load." + entry.word + "{"), std::string::npos) << entry.word;
}

}  // namespace
}  // namespace dygita::reference_tests
