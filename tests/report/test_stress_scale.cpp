// Colours of stresses: in proportion, or by quantile where a peak would leave most of a picture one colour.
#include <gtest/gtest.h>

#include <cmath>

#include "report/stress_scale.hpp"

namespace dygita {
namespace {

// Values 1 ... n, each covering as much.
std::vector<std::pair<double, double>> even(int n) {
  std::vector<std::pair<double, double>> values;
  for (int i = 1; i <= n; ++i) values.emplace_back(i, 1.0);
  return values;
}

TEST(StressScale, is_in_proportion_where_stresses_are_spread) {
  const StressScale scale(even(1000), 10);
  EXPECT_FALSE(scale.is_by_quantile());
  EXPECT_EQ(scale.ends().front(), 0.0);
  EXPECT_EQ(scale.ends().back(), 996.0);  // one in two hundred is above
  EXPECT_NEAR(scale.ends()[5], 498.0, 1e-9);
  EXPECT_EQ(scale.color(0.0), 0);
  EXPECT_EQ(scale.color(500.0), 5);
  EXPECT_EQ(scale.color(1e9), 9);
}

TEST(StressScale, gives_each_colour_as_much_of_the_picture_beside_a_peak) {
  std::vector<std::pair<double, double>> values = even(1000);
  for (int i = 0; i < 20; ++i) values.emplace_back(1e6, 1e-3);  // a bolt, hardly seen
  const StressScale scale(values, 10);
  EXPECT_TRUE(scale.is_by_quantile());
  EXPECT_EQ(scale.ends().back(), 1e6);
  std::vector<int> covered(10, 0);
  for (int i = 1; i <= 1000; ++i) ++covered[static_cast<size_t>(scale.color(i))];
  for (const int n : covered) EXPECT_NEAR(n, 100, 2);
}

TEST(StressScale, weighs_by_what_is_covered) {
  std::vector<std::pair<double, double>> values = even(100);
  for (auto& [value, area] : values) area = value > 50 ? 9.0 : 1.0;
  for (int i = 0; i < 20; ++i) values.emplace_back(1e6, 1e-3);
  const StressScale scale(values, 2);
  EXPECT_NEAR(scale.ends()[1], 73.0, 1.0);  // 50 + 9 n = 250
}

TEST(StressScale, of_nothing_and_of_equal_stresses_has_no_colours_of_rounding) {
  EXPECT_EQ(StressScale({}, 4).color(0.5), 2);
  const StressScale equal({{1e6, 1.0}, {1e6 + 1e-3, 1.0}, {1e6 - 1e-3, 1.0}}, 16);
  EXPECT_FALSE(equal.is_by_quantile());
  EXPECT_EQ(equal.color(1e6 - 1e-3), equal.color(1e6 - 2e-3));
}

}  // namespace
}  // namespace dygita
