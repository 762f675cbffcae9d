#include <gtest/gtest.h>

#include "base/names.hpp"

namespace dygita {

TEST(ClosestName, is_the_one_with_the_fewest_edits) {
  const std::vector<std::string> known = {"density", "poisson", "young"};
  EXPECT_EQ(closest_name("yuong", known), "young");
  EXPECT_EQ(closest_name("poison", known), "poisson");
  EXPECT_EQ(closest_name("densitiy", known), "density");
}

TEST(ClosestName, is_the_name_itself_when_it_is_known) { EXPECT_EQ(closest_name("zmax", {"zmin", "zmax"}), "zmax"); }

TEST(ClosestName, is_none_when_half_the_word_differs) {
  EXPECT_EQ(closest_name("friction", {"density", "poisson", "young"}), "");
  EXPECT_EQ(closest_name("gap", {"yield"}), "");
  EXPECT_EQ(closest_name("gap", {}), "");
}

TEST(ClosestName, forgives_one_letter_of_a_short_name) {
  EXPECT_EQ(closest_name("m", {"mu", "poisson"}), "mu");
  EXPECT_EQ(closest_name("nu", {"mu", "poisson"}), "mu");
}

TEST(DidYouMean, proposes_the_closest_and_lists_the_known_in_order) {
  EXPECT_EQ(did_you_mean("yuong", {"young", "density", "poisson"}),
            "did you mean 'young'? known: density, poisson, young");
}

TEST(DidYouMean, proposes_the_neighbours_of_a_number) {
  const std::vector<std::string> sizes = {"M3", "M6", "M8", "M10", "washer"};
  EXPECT_TRUE(did_you_mean("M7", sizes).starts_with("did you mean 'M6' or 'M8'? known: "));
  EXPECT_TRUE(did_you_mean("m9", sizes).starts_with("did you mean 'M8' or 'M10'? "));
  EXPECT_TRUE(did_you_mean("M1", sizes).starts_with("did you mean 'M3'? "));
  EXPECT_TRUE(did_you_mean("M64", sizes).starts_with("did you mean 'M10'? "));
  EXPECT_TRUE(did_you_mean("m8", sizes).starts_with("did you mean 'M8'? "));
  EXPECT_TRUE(did_you_mean("wascher7", sizes).starts_with("did you mean 'washer'? "));
  EXPECT_TRUE(did_you_mean("7", sizes).starts_with("known: "));
}

TEST(DidYouMean, only_lists_when_none_is_near) {
  EXPECT_EQ(did_you_mean("friction", {"young", "density"}), "known: density, young");
}

TEST(DidYouMean, says_when_there_is_nothing_to_know) { EXPECT_EQ(did_you_mean("base", {}), "known: none"); }

}  // namespace dygita
