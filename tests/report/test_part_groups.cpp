#include <gtest/gtest.h>

#include "report/part_groups.hpp"

namespace dygita::part_groups_tests {

namespace {

Json part(const std::string& name, int nodes = 8) {
  return {{"name", name}, {"material", "steel"}, {"nodes", nodes}, {"cells", 1}};
}

TEST(PartGroups, hold_the_equal_parts_of_a_pattern) {
  const Json parts = {part("base"), part("bolt[1]"), part("nut[1]"), part("bolt[2]"), part("nut[2]"), part("bolt[3]")};
  const std::vector<PartGroup> groups = part_groups(parts);
  ASSERT_EQ(groups.size(), 3u);
  EXPECT_EQ(groups[0].name, "base");
  EXPECT_EQ(groups[1].name, "bolt[1] to bolt[3]");
  EXPECT_EQ(groups[1].n, 3u);
  EXPECT_EQ(groups[2].name, "nut[1] to nut[2]");
  EXPECT_EQ(groups[2].first, 2u);
  EXPECT_EQ(group_of_parts(parts), (std::vector<int>{0, 1, 2, 1, 2, 1}));
}

TEST(PartGroups, hold_several_parts_whose_names_differ_by_numbers_alone) {
  const Json parts = {part("M6 ring 1 head"), part("screw1"),          part("M6 ring 2 head"),
                      part("screw2"),         part("M6 ring 11 head"), part("screw2a")};
  const std::vector<PartGroup> groups = part_groups(parts);
  ASSERT_EQ(groups.size(), 4u);
  EXPECT_EQ(groups[0].name, "M6 ring 1 head to M6 ring 11 head");
  EXPECT_EQ(groups[0].n, 3u);
  EXPECT_EQ(groups[1].name, "screw1");  // two are told by themselves
  // Another mesh or size is another kind.
  Json large = part("M8[2] nut");
  large["mass"] = 2.0;
  EXPECT_EQ(part_groups({part("M6[1] nut"), part("M6[2] nut"), part("M6[3] nut"), large}).size(), 2u);
  EXPECT_EQ(part_groups({part("pin 1"), part("pin 2", 20), part("pin 3")}).size(), 3u);
}

TEST(PartGroups, leave_apart_what_is_called_otherwise_or_meshed_otherwise) {
  const Json parts = {part("bolt1"), part("bolt2"),  part("pin[1]"), part("pin[2]", 20),
                      part("[1]"),   part("lug[x]"), part("lug[]")};
  EXPECT_EQ(part_groups(parts).size(), 7u);
  EXPECT_EQ(part_groups({part("pin[1]"), part("pin[2]", 20), part("pin[3]")}).size(), 2u);
  EXPECT_TRUE(part_groups(Json::array()).empty());
}

}  // namespace

}  // namespace dygita::part_groups_tests
