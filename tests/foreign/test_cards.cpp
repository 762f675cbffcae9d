// Keywords, options, data and included files of an .inp.
#include <gtest/gtest.h>

#include "foreign/cards.hpp"
#include "foreign/file_units.hpp"
#include "foreign/written_file.hpp"
#include "mesh/expect_input_error.hpp"

namespace dygita {
namespace {

TEST(Cards, have_keywords_without_blanks_options_and_lines_of_data) {
  const WrittenFile written(
      "** a comment\n*Solid  Section, Elset = \"my bolt\",\n Material=Steel\n*NODE\n 1, 0.,0.\n\n2\n");
  const CardFile file(written.path());
  ASSERT_EQ(file.cards().size(), 2u);
  const FileCard& section = file.cards()[0];
  EXPECT_EQ(section.keyword, "SOLIDSECTION");
  EXPECT_EQ(section.written, "*Solid  Section");
  EXPECT_EQ(section.option("ELSET"), "my bolt");
  EXPECT_EQ(section.option("MATERIAL"), "Steel");
  EXPECT_EQ(section.line, 2);
  ASSERT_EQ(file.cards()[1].data.size(), 2u);
  EXPECT_EQ(file.cards()[1].data[1].text, "2");
  EXPECT_EQ(file.cards()[1].data[1].line, 7);
}

TEST(Cards, of_an_included_file_stand_in_its_place) {
  const WrittenFile nodes("1, 0., 0., 0.\n2, 1., 0., 0.\n*NSET, NSET=N\n1\n");
  const WrittenFile written("*NODE\n*INCLUDE, INPUT=" + nodes.name() + "\n2\n");
  const CardFile file(written.path());
  ASSERT_EQ(file.cards().size(), 2u);
  EXPECT_EQ(file.cards()[0].data.size(), 2u);
  EXPECT_EQ(file.cards()[1].keyword, "NSET");
  ASSERT_EQ(file.cards()[1].data.size(), 2u);
  EXPECT_EQ(file.where(file.cards()[1]), nodes.path() + ":3");
  EXPECT_EQ(file.cards()[1].data[1].line, 3);
}

TEST(Cards, that_include_themselves_or_no_file_are_refused) {
  const WrittenFile written("", "again.inp");
  written.write("*INCLUDE, INPUT=" + written.name() + "\n");
  expect_input_error([&] { CardFile file(written.path()); }, {"again.inp:1", "include each other"});
  written.write("*NODE\n*INCLUDE, INPUT=nowhere.inp\n");
  expect_input_error([&] { CardFile file(written.path()); }, {"again.inp:2", "nowhere.inp", "does not exist"});
  written.write("1, 2, 3\n");
  expect_input_error([&] { CardFile file(written.path()); }, {"again.inp:1: a keyword is expected", "'1, 2, 3'"});
}

TEST(Cards, have_numbers_with_the_exponents_of_fortran) {
  const WrittenFile written("*A\n 1.5d+3, +2, -1.E-2, .5D2, nan, 1x\n");
  const CardFile file(written.path());
  LineFields fields(file, file.cards()[0].data[0]);
  EXPECT_EQ(fields.real("a number"), 1500.0);
  EXPECT_EQ(fields.real("a number"), 2.0);
  EXPECT_EQ(fields.real("a number"), -0.01);
  EXPECT_EQ(fields.real("a number"), 50.0);
  expect_input_error([&] { fields.real("a number"); }, {":2: a number is expected, not 'nan'"});
  expect_input_error([&] { fields.real("a number"); }, {"not '1x'"});
  expect_input_error([&] { fields.whole("a node"); }, {"a node is expected, not the end of the line"});
}

TEST(FileUnits, give_density_and_modulus_in_si) {
  const FileUnits tonnes = file_units("mm t s");
  EXPECT_NEAR(tonnes.stress(), 1e6, 1e-6);
  EXPECT_NEAR(7.85e-9 * tonnes.density(), 7850, 1e-8);
  const FileUnits ms = file_units("mm kg ms");
  EXPECT_NEAR(ms.stress(), 1e9, 1e-3);
  EXPECT_NEAR(7.85e-6 * ms.density(), 7850, 1e-8);
  const FileUnits inches = file_units("in lbf s");  // psi; lbf s^2/in^4
  EXPECT_NEAR(inches.stress(), 6894.757, 1e-3);
  EXPECT_NEAR(7.345e-4 * inches.density(), 7849.4, 0.5);
  EXPECT_NEAR(inches.force(), 4.4482216, 1e-7);
}

TEST(FileUnits, that_are_no_system_are_refused) {
  for (const char* text : {"mm", "mm t", "mm t s s", "mm s t", "furlong kg s", ""})
    expect_input_error([&] { file_units(text); }, {"'units'", "is no system of units", "\"mm t s\""});
}

}  // namespace
}  // namespace dygita
