// The indicator where fields run away along what nothing determines.

#include <gtest/gtest.h>

#include <cmath>

#include "latin/indicator.hpp"

namespace dygita {
namespace {

TEST(Indicator, does_not_fall_where_fields_grow_and_their_distance_stays) {
  const Indicator indicator(0.0);
  const double tolerance = 1e-6;
  IndicatorSums sums;
  sums.force_distance = sums.velocity_distance = 1e-11;
  sums.force_size = sums.velocity_size = 1e-10;
  const double beginning = 2.2e-10;
  EXPECT_FALSE(indicator.of_runaway(sums, beginning, tolerance)) << "what has not grown";
  sums.force_size = 50.0;
  const Outcome grown = indicator.measure(sums);
  ASSERT_LE(grown.eta, tolerance);
  EXPECT_GT(indicator.of_runaway(sums, beginning, tolerance).value_or(0.0), 1e-3);
}

TEST(Indicator, takes_what_an_impact_adds_for_what_it_is) {
  Indicator indicator(0.0);
  IndicatorSums sums;
  sums.force_distance = sums.velocity_distance = 1e-11;
  sums.force_size = 50.0;
  EXPECT_FALSE(indicator.of_runaway(sums, 40.0, 1e-6)) << "it began with as much";
  indicator.accept({0.0, 1.0, 1.0});
  EXPECT_FALSE(indicator.of_runaway(sums, 1e-10, 1e-6)) << "increments before had as much";
  sums.force_distance = sums.velocity_distance = 1e-18;
  EXPECT_FALSE(Indicator(0.0).of_runaway(sums, 1e-6, 1e-5)) << "it has converged beside what it began with";
}

}  // namespace
}  // namespace dygita
