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

TEST(Supports, that_sum_places_hold_none_of_them_by_itself) {
  const SupportKindPtr equation = make_support("equation", {{"x", 0.0}, {"y", 1.0}, {"z", 0.0}});
  const SupportKindPtr spring = make_support("spring", {{"x", 5.0},
                                                        {"y", 0.0},
                                                        {"z", 0.0},
                                                        {"x_damping", 0.0},
                                                        {"y_damping", 0.0},
                                                        {"z_damping", 0.0},
                                                        {"about_x", 0.0},
                                                        {"about_y", 0.0},
                                                        {"about_z", 7.0},
                                                        {"about_x_damping", 0.0},
                                                        {"about_y_damping", 0.0},
                                                        {"about_z_damping", 3.0}});
  EXPECT_EQ(equation->sums(), (Directions{.axes = {false, true, false}}));
  EXPECT_EQ(spring->sums(), (Directions{.axes = {true, false, true}}));
  EXPECT_FALSE(equation->spring(1));
  EXPECT_EQ(spring->spring(0)->stiffness, 5.0);
  EXPECT_EQ(spring->spring(2)->stiffness, 0.0);
  EXPECT_EQ(spring->spring(5)->stiffness, 7.0);
  EXPECT_EQ(spring->spring(5)->damping, 3.0);
  for (const SupportKindPtr& kind : {equation, spring}) {
    EXPECT_EQ(kind->holds(true), Directions::none);
    EXPECT_EQ(kind->claims(), Directions::none);
    EXPECT_FALSE(kind->can_be_shaken());
  }
}

TEST(Supports, of_the_table_have_words_of_their_own_and_need_a_face_where_they_need_a_normal) {
  std::set<std::string> words;
  for (const SupportEntry& entry : support_table()) {
    EXPECT_TRUE(words.insert(entry.word).second) << entry.word;
    const SupportKindPtr kind = example_of(entry);
    EXPECT_EQ(kind->word(), entry.word);
    const bool needs_face = kind->absorbs() || (kind->law() && kind->sums() == Directions::none) ||
                            kind->claims().along_normals || kind->holds(true).along_normals ||
                            kind->holds(false).along_normals;
    EXPECT_FALSE(needs_face && kind->takes_regions()) << entry.word;
  }
}

}  // namespace

}  // namespace dygita
