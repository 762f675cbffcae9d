// The committed reference of the deck language is what the program prints.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "deck/deck.hpp"

namespace dygita {
namespace {

TEST(Reference, of_the_manual_is_the_printed_one) {
  std::ifstream file(DYGITA_SOURCE_DIR "/manual/deck-reference.md");
  ASSERT_TRUE(file) << "no manual/deck-reference.md";
  const std::string committed((std::istreambuf_iterator<char>(file)), {});
  EXPECT_EQ(committed, deck_reference()) << "the schema has changed: dygita schema > manual/deck-reference.md";
}

}  // namespace
}  // namespace dygita
