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

TEST(DidYouMean, only_lists_when_none_is_near) {
  EXPECT_EQ(did_you_mean("friction", {"young", "density"}), "known: density, young");
}

TEST(DidYouMean, says_when_there_is_nothing_to_know) { EXPECT_EQ(did_you_mean("base", {}), "known: none"); }

}  // namespace dygita
