// The scalar search of a preload's shortening.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "step/preload.hpp"

namespace dygita::preload_tests {
namespace {

struct Counted {
  std::function<double(double)> f;
  int n = 0;
  std::function<double(double)> function() {
    return [this](double d) {
      ++n;
      return f(d);
    };
  }
};

TEST(FindShortening, of_a_straight_line_takes_two_evaluations) {
  Counted line{[](double d) { return 2e9 * (d - 1e-6); }};
  EXPECT_NEAR(find_shortening(line.function(), 5e4, 0.0, 2e9, 5e4), 26e-6, 1e-18);
  EXPECT_EQ(line.n, 2);
}

TEST(FindShortening, of_points_that_yield_one_after_the_other_ends_on_the_right_branch) {
  // Ten springs of 1e9 N/m that yield at 100, 200, ... 1000 N and harden by a hundredth.
  Counted springs{[](double d) {
    double sum = 0.0;
    for (int i = 1; i <= 10; ++i) sum += std::min(1e9 * d, 100.0 * i + 1e7 * (d - 1e-7 * i));
    return sum;
  }};
  for (const double target : {50.0, 999.0, 3000.0, 5400.0, 5600.0, 9000.0}) {
    springs.n = 0;
    const double d = find_shortening(springs.function(), target, 0.0, 1e10, target);
    EXPECT_NEAR(springs.f(d), target, 1e-12 * target);
    EXPECT_LE(springs.n, 40) << target;
  }
}

TEST(FindShortening, comes_back_from_a_plateau) {
  Counted plateau{[](double d) { return std::clamp(1e9 * d, -1e3, 400.0); }};
  const double d = find_shortening(plateau.function(), 399.0, 1e-3, 1e9, 399.0);
  EXPECT_NEAR(plateau.f(d), 399.0, 1e-10);
}

TEST(FindShortening, closes_a_gap) {
  Counted gap{[](double d) { return std::max(0.0, 1e8 * (d - 2e-4)); }};
  const double d = find_shortening(gap.function(), 1e3, 0.0, 1e9, 1e3);
  EXPECT_NEAR(d, 2.1e-4, 1e-15);
  EXPECT_LE(gap.n, 40);
}

TEST(FindShortening, goes_no_further_than_it_may) {
  double most = 0.0;
  const double d = find_shortening(
      [&](double x) {
        most = std::max(most, x);
        return 0.0;
      },
      1e3, 0.0, 1e9, 1e3, 1e-14, 0.5);
  EXPECT_LE(most, 0.5);
  EXPECT_EQ(d, 0.0);
}

}  // namespace
}  // namespace dygita::preload_tests
