// Fields, continuations, comments and included files of Nastran's bulk data.
#include <gtest/gtest.h>

#include "foreign/bulk_cards.hpp"
#include "foreign/nastran_names.hpp"
#include "foreign/written_file.hpp"
#include "mesh/expect_input_error.hpp"

namespace dygita::bulk_cards_tests {
namespace {

TEST(BulkCards, have_fields_in_free_small_and_large_format) {
  const WrittenFile written(
      "GRID,1,,1.5,-2.,3.+2\n"
      "grid           2       31.      2.      3.      \n"
      "GRID*                  3                              1.              2.*A\n"
      "*A                    3.               5\n"
      "CHEXA,4,1,1,2,3,4,5,6,+B\n+B,7,8\n"
      "GRID\t9\t\t1.\t2.\t3.\n");
  const BulkFile file(written.path());
  ASSERT_EQ(file.cards().size(), 5u);
  const BulkFields one(file, file.cards()[0]), two(file, file.cards()[1]), three(file, file.cards()[2]),
      four(file, file.cards()[3]), nine(file, file.cards()[4]);
  EXPECT_EQ(one.real(3, "x"), 1.5);
  EXPECT_EQ(one.real(5, "x"), 300.0);
  EXPECT_EQ(two.whole(1, "n"), 2);
  EXPECT_EQ(two.whole(2, "n"), 3);
  EXPECT_EQ(two.real(5, "x"), 3.0);
  EXPECT_EQ(three.whole(1, "n"), 3);
  EXPECT_FALSE(three.has(2));
  EXPECT_EQ(three.real(5, "x"), 3.0);
  EXPECT_EQ(three.whole(6, "n"), 5);
  EXPECT_EQ(four.whole(8, "n"), 6);
  EXPECT_EQ(four.whole(10, "n"), 8);
  EXPECT_EQ(four.size(), 10);
  EXPECT_EQ(nine.real(5, "x"), 3.0);
}

TEST(BulkCards, have_numbers_as_nastran_writes_them) {
  const auto value = [](const char* text) {
    double x = -1;
    EXPECT_TRUE(nastran_real(text, x)) << text;
    return x;
  };
  EXPECT_EQ(value("7.85-9"), 7.85e-9);
  EXPECT_EQ(value("-1.5+3"), -1500.0);
  EXPECT_EQ(value("1.D3"), 1000.0);
  EXPECT_EQ(value("+2.5e-1"), 0.25);
  EXPECT_EQ(value(".5"), 0.5);
  double x = 0;
  for (const char* text : {"", "nan", "1.5+", "1..5", "x", "1 2", "1.e999"})
    EXPECT_FALSE(nastran_real(text, x)) << text;
}

TEST(BulkCards, begin_below_the_case_control_and_end_at_enddata) {
  const WrittenFile written(
      "SOL 101\nCEND\n$ a comment\nSPC = 1\nBEGIN BULK\nGRID,1,,0.,0.,0. $ here\nENDDATA\nGRID,2\n");
  const BulkFile file(written.path());
  EXPECT_EQ(file.cards().size(), 1u);
  EXPECT_EQ(file.control().size(), 4u);
  EXPECT_EQ(file.where(file.cards()[0]), written.path() + ":6");
}

TEST(BulkCards, of_an_included_file_stand_in_its_place) {
  const WrittenFile nodes("GRID,1,,0.,0.,0.\n");
  const std::string half = nodes.name().substr(0, nodes.name().size() / 2), rest = nodes.name().substr(half.size());
  const WrittenFile written("INCLUDE '" + half + "\n" + rest + "'\nGRID,2,,1.,0.,0.\n");
  const BulkFile file(written.path());
  ASSERT_EQ(file.cards().size(), 2u);
  EXPECT_EQ(file.where(file.cards()[0]), nodes.path() + ":1");
  EXPECT_EQ(file.where(file.cards()[1]), written.path() + ":3");
}

TEST(BulkCards, that_are_none_are_refused_by_line) {
  const auto refuse = [](const std::string& text, std::initializer_list<const char*> words) {
    const WrittenFile written(text, "bulk.bdf");
    expect_input_error([&] { BulkFile file(written.path()); }, words);
  };
  refuse("+,1,2\n", {"bulk.bdf:1", "continues no card"});
  refuse("GRID,1\n=,*(1)\n", {"bulk.bdf:2", "repeats the card above"});
  refuse("GRID,1,2,3,4,5,6,7,8,9\n", {"bulk.bdf:1: GRID: a line has 8 fields, '9' is one more"});
  refuse("!GRID,1\n", {"bulk.bdf:1: the name of a card is expected", "'!GRID'"});
  refuse("INCLUDE 'nowhere.bdf'\n", {"bulk.bdf:1", "nowhere.bdf", "does not exist"});
  refuse("BEGIN SUPER=1\n", {"bulk.bdf:1", "superelements are not read"});
  const WrittenFile again("", "again.bdf");
  again.write("INCLUDE '" + again.name() + "'\n");
  expect_input_error([&] { BulkFile file(again.path()); }, {"again.bdf:1", "include each other"});
}

TEST(NastranNames, are_those_of_the_comments_of_preprocessors) {
  const WrittenFile written(
      "$HMNAME PROP                   3\"flange a\" 5\n$HMNAME COMP                   4\"rib\" 4\n$HMNAME MAT "
      "1\"steel\" \"MAT1\"\n"
      "$HMSET        7        1 \"feet\"\n$ Femap with NX Nastran Property 5 : cover plate\n"
      "$ Femap Material 2 : AISI 4340 Steel\n$ANSA_NAME_COMMENT;6;PSOLID;bracket;;NO;NO;NO;NO;\n"
      "$ Elements and Element Properties for region : lid\nPSOLID,8,1\n$ Material Record : aluminium\n"
      "$ Description of Material : Date: 1-Jan-20\nMAT1,4,7.+4,,.3\n$*  Material: titanium\nMAT1,5,1.+5,,.3\n");
  const BulkFile file(written.path());
  const NastranNames names = nastran_names(file);
  const std::map<long, std::string> properties = {
      {3, "flange a"}, {4, "rib"}, {5, "cover plate"}, {6, "bracket"}, {8, "lid"}};
  const std::map<long, std::string> materials = {
      {1, "steel"}, {2, "AISI 4340 Steel"}, {4, "aluminium"}, {5, "titanium"}};
  EXPECT_EQ(names.properties, properties);
  EXPECT_EQ(names.materials, materials);
  EXPECT_EQ(names.sets.at(7), "feet");
}

}  // namespace
}  // namespace dygita::bulk_cards_tests
