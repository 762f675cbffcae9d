#include <gtest/gtest.h>

#include "base/name_list.hpp"

namespace dygita::test {
namespace {

TEST(NameList, names_all_of_a_few_and_counts_the_rest_of_many) {
  EXPECT_EQ(list_of_names({}), "");
  EXPECT_EQ(list_of_names({"a"}), "'a'");
  EXPECT_EQ(list_of_names({"a", "b", "c", "d", "e", "f", "g"}), "'a', 'b', 'c', 'd', 'e', 'f', 'g'");
  EXPECT_EQ(list_of_names({"a", "b", "c", "d", "e", "f", "g", "h"}), "'a', 'b', 'c', 'd', 'e', 'f' and 2 more");
}

}  // namespace
}  // namespace dygita::test
