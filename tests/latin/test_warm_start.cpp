// Which guess a warm start takes: hindsight decides.
#include <gtest/gtest.h>

#include "latin/warm_start.hpp"

namespace dygita {
namespace {

Vec vec(double a, double b) {
  Vec v(2);
  v << a, b;
  return v;
}

void keep(InterfaceFields& fields, const std::vector<Vec>& all) {
  fields.begin_step();
  for (const Vec& q : all) fields.append(q);
}

TEST(WarmStart, without_another_case_leaves_everything_as_it_is) {
  WarmStart start(nullptr, 0, vec(1, 1));
  Vec q = vec(3, 4);
  EXPECT_TRUE(start.predict(0, q));
  EXPECT_EQ(q, vec(3, 4));
}

TEST(WarmStart, begins_with_the_other_cases_first_field) {
  InterfaceFields fields(1e6);
  keep(fields, {vec(1, 2), vec(5, 6)});
  WarmStart start(&fields, 0, vec(1, 1));
  Vec q = vec(0, 0);
  EXPECT_TRUE(start.predict(0, q));
  EXPECT_EQ(q, vec(1, 2));
}

TEST(WarmStart, follows_the_other_cases_changes_while_they_tell_most) {
  InterfaceFields fields(1e6);
  keep(fields, {vec(0, 0), vec(1, 0), vec(3, 0), vec(6, 0)});
  WarmStart start(&fields, 0, vec(1, 1));
  Vec q = vec(0, 0);
  start.predict(0, q);
  q = vec(10, 0);  // this case is ten higher, always
  start.predict(1, q);
  EXPECT_EQ(q, vec(11, 0));
  start.predict(2, q);
  EXPECT_EQ(q, vec(13, 0));
}

TEST(WarmStart, takes_the_other_cases_field_where_that_was_right) {
  InterfaceFields fields(1e6);
  keep(fields, {vec(0, 0), vec(1, 0), vec(3, 0), vec(6, 0)});
  WarmStart start(&fields, 0, vec(1, 1));
  Vec q = vec(0, 0);
  start.predict(0, q);
  q = vec(-5, 0);  // far off at first,
  start.predict(1, q);
  q = vec(1, 0);  // then the same
  start.predict(2, q);
  EXPECT_EQ(q, vec(3, 0));
}

TEST(WarmStart, stays_where_it_is_when_the_other_case_is_of_no_use) {
  InterfaceFields fields(1e6);
  keep(fields, {vec(0, 0), vec(100, 0), vec(-300, 0), vec(600, 0)});
  WarmStart start(&fields, 0, vec(1, 1));
  Vec q = vec(0, 0);
  start.predict(0, q);
  q = vec(0, 1);
  start.predict(1, q);
  q = vec(0, 1.1);
  start.predict(2, q);
  EXPECT_EQ(q, vec(0, 1.1));
}

TEST(WarmStart, weighs_the_components) {
  InterfaceFields fields(1e6);
  keep(fields, {vec(0, 0), vec(1, 50), vec(2, 70)});
  WarmStart start(&fields, 0, vec(1, 0));  // the second component does not count
  Vec q = vec(0, 0);
  start.predict(0, q);
  q = vec(0.5, 0);
  start.predict(1, q);
  q = vec(1.5, 0);
  start.predict(2, q);
  EXPECT_EQ(q, vec(2.5, 20));
}

TEST(WarmStart, says_that_nothing_fits) {
  InterfaceFields fields(1e6);
  keep(fields, {vec(1, 2)});
  WarmStart start(&fields, 0, Vec::Ones(3));
  Vec q = Vec::Ones(3);
  EXPECT_FALSE(start.predict(0, q));
  EXPECT_EQ(q, Vec::Ones(3));
  WarmStart beyond(&fields, 0, vec(1, 1));
  Vec p = vec(0, 0);
  EXPECT_TRUE(beyond.predict(0, p));
  EXPECT_FALSE(beyond.predict(1, p));
  EXPECT_EQ(p, vec(1, 2));
}

}  // namespace
}  // namespace dygita
