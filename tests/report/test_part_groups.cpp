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

TEST(PartGroups, leave_apart_what_is_called_otherwise_or_meshed_otherwise) {
  const Json parts = {part("bolt1"), part("bolt2"),  part("pin[1]"), part("pin[2]", 20),
                      part("[1]"),   part("lug[x]"), part("lug[]")};
  EXPECT_EQ(part_groups(parts).size(), 7u);
  EXPECT_EQ(part_groups({part("pin[1]"), part("pin[2]", 20), part("pin[3]")}).size(), 2u);
  EXPECT_TRUE(part_groups(Json::array()).empty());
}

}  // namespace

}  // namespace dygita::part_groups_tests
