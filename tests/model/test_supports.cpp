// What each kind of support says of itself, and what holds for every one.
#include <gtest/gtest.h>

#include <set>

#include "law/law.hpp"
#include "model/support.hpp"

namespace dygita {

namespace {

TEST(Supports, hold_what_their_names_say) {
  const SupportKindPtr fixed = make_support("fixed"), symmetry = make_support("symmetry"),
                       absorbing = make_support("absorbing"),
                       wall = make_support("wall", {{"friction", 0.3}, {"gap", 2e-6}});
  for (const bool is_static : {false, true}) {
    EXPECT_EQ(fixed->holds(is_static), Directions::all);
    EXPECT_EQ(symmetry->holds(is_static), Directions::normal);
    EXPECT_EQ(wall->holds(is_static), Directions::none);
  }
  const SupportKindPtr held = make_support("held", {{"x", 1.0}, {"y", 0.0}, {"z", 1.0}});
  EXPECT_EQ(held->holds(true), (Directions{.axes = {true, false, true}}));
  EXPECT_EQ(held->claims(), held->holds(false));
  EXPECT_EQ(absorbing->holds(true), Directions::all);
  EXPECT_EQ(absorbing->holds(false), Directions::none);
  EXPECT_TRUE(absorbing->absorbs());
  ASSERT_TRUE(wall->law());
  EXPECT_EQ(wall->law()->initial().gap, 2e-6);
}

TEST(Supports, of_the_table_have_words_of_their_own_and_need_a_face_where_they_need_a_normal) {
  std::set<std::string> words;
  for (const SupportEntry& entry : support_table()) {
    EXPECT_TRUE(words.insert(entry.word).second) << entry.word;
    const SupportKindPtr kind = example_of(entry);
    EXPECT_EQ(kind->word(), entry.word);
    const bool needs_face = kind->absorbs() || kind->law() || kind->claims().along_normals ||
                            kind->holds(true).along_normals || kind->holds(false).along_normals;
    EXPECT_FALSE(needs_face && kind->takes_regions()) << entry.word;
  }
}

}  // namespace

}  // namespace dygita
