// Orders, limits and uncertainties of sequences whose limit is known.
#include <gtest/gtest.h>

#include <cmath>

#include "estimates/grid_convergence.hpp"

namespace dygita::grid_convergence_tests {
namespace {

GridConvergence of(const std::vector<double>& sizes, double (*value)(double)) {
  std::vector<std::vector<double>> values;
  for (const double size : sizes) values.push_back({value(size)});
  return grid_convergence(sizes, values, 1e-12);
}

TEST(GridConvergence, finds_order_and_limit_of_a_power_law) {
  const GridConvergence second = of({4.0, 2.0, 1.0}, [](double h) { return 5.0 - 0.1 * h * h; });
  EXPECT_EQ(second.tendency, Tendency::asymptotic);
  EXPECT_NEAR(second.order, 2.0, 1e-10);
  EXPECT_NEAR(second.limit[0], 5.0, 1e-10);
  EXPECT_NEAR(second.uncertainty, 1.25 * 0.1, 1e-10);
  EXPECT_NEAR(second.at(0.5), 1.25 * 0.025, 1e-10);
}

TEST(GridConvergence, takes_any_ratio_of_sizes) {
  const GridConvergence uneven = of({4.0, 3.0, 1.0}, [](double h) { return 2.0 + 0.3 * std::pow(h, 1.5); });
  EXPECT_NEAR(uneven.order, 1.5, 1e-9);
  EXPECT_NEAR(uneven.limit[0], 2.0, 1e-9);
}

// Celik et al., J. Fluids Eng. 130, 078001 (2008), table 1: phi = 6.063, 5.972, 5.863 at r = 1.5, 1.333 is of
// order 1.53, extrapolated 6.1685, fine-grid convergence index 2.2 %.
TEST(GridConvergence, agrees_with_a_published_example) {
  const GridConvergence found = grid_convergence({2.0, 1.5, 1.0}, {{5.863}, {5.972}, {6.063}}, 0.0);
  EXPECT_NEAR(found.order, 1.53, 0.01);
  EXPECT_NEAR(found.limit[0], 6.1685, 1e-3);
  EXPECT_NEAR(found.uncertainty / 6.063, 0.022, 5e-4);
}

TEST(GridConvergence, tells_a_singularity_by_its_order) {
  const GridConvergence slow = of({4.0, 2.0, 1.0}, [](double h) { return 1.0 + std::sqrt(h); });
  EXPECT_EQ(slow.tendency, Tendency::slow);
  EXPECT_NEAR(slow.order, 0.5, 1e-9);
  EXPECT_NEAR(slow.uncertainty, 3.0, 1e-9);
  EXPECT_EQ(of({4.0, 2.0, 1.0}, [](double h) { return -std::log(h); }).tendency, Tendency::divergent);
  EXPECT_EQ(of({4.0, 2.0, 1.0}, [](double h) { return 1.0 / h; }).tendency, Tendency::divergent);
}

TEST(GridConvergence, does_not_extrapolate_what_goes_up_and_down) {
  const GridConvergence found = grid_convergence({4.0, 2.0, 1.0}, {{1.0}, {1.2}, {1.1}}, 0.0);
  EXPECT_EQ(found.tendency, Tendency::oscillating);
  EXPECT_DOUBLE_EQ(found.limit[0], 1.1);
  EXPECT_NEAR(found.uncertainty, 3.0 * 0.2, 1e-12);
  EXPECT_TRUE(std::isnan(found.order));
}

TEST(GridConvergence, trusts_no_order_that_is_too_high) {
  const GridConvergence fast = of({4.0, 2.0, 1.0}, [](double h) { return std::pow(h, 6.0); });
  EXPECT_EQ(fast.tendency, Tendency::fast);
  EXPECT_NEAR(fast.uncertainty, 3.0 * (64.0 - 1.0) / 3.0, 1e-9);
}

// The peak of a cantilever's reaction (kN) over dt; finer runs give 4.385, 4.357, 4.365.
TEST(GridConvergence, trusts_no_last_change_that_is_small_after_a_plateau_and_a_jump) {
  const GridConvergence found =
      grid_convergence({64.0, 32.0, 16.0, 8.0, 4.0, 2.0, 1.0},
                       {{3.4907}, {3.6788}, {4.3061}, {4.1546}, {4.1877}, {4.49}, {4.5193}}, 0.0);
  EXPECT_EQ(found.tendency, Tendency::oscillating);
  EXPECT_GT(found.uncertainty, 4.5193 - 4.365);
}

TEST(GridConvergence, of_runs_that_fall_ever_faster_is_fast) {
  const GridConvergence fast = of({8.0, 4.0, 2.0, 1.0}, [](double h) { return std::pow(h, 6.0); });
  EXPECT_EQ(fast.tendency, Tendency::fast);
}

TEST(GridConvergence, leaves_rounding_alone) {
  const GridConvergence still = grid_convergence({4.0, 2.0, 1.0}, {{1.0}, {1.0 + 1e-13}, {1.0 - 1e-13}}, 1e-12);
  EXPECT_EQ(still.tendency, Tendency::settled);
  EXPECT_DOUBLE_EQ(still.uncertainty, 1e-12);
}

TEST(GridConvergence, takes_a_spectrum_by_its_largest_change) {
  const auto level = [](double h) { return std::vector<double>{1.0 + h * h, 2.0 - 3.0 * h * h, 4.0}; };
  const GridConvergence found = grid_convergence({4.0, 2.0, 1.0}, {level(4.0), level(2.0), level(1.0)}, 0.0);
  EXPECT_NEAR(found.order, 2.0, 1e-9);
  EXPECT_NEAR(found.limit[1], 2.0, 1e-9);
  EXPECT_NEAR(found.uncertainty, 1.25 * 3.0, 1e-9);
}

TEST(GridConvergence, knows_nothing_of_runs_that_gave_nothing) {
  const GridConvergence found = grid_convergence({4.0, 2.0, 1.0}, {{1.0}, {NAN}, {1.0}}, 0.0);
  EXPECT_EQ(found.tendency, Tendency::divergent);
  EXPECT_TRUE(std::isinf(found.uncertainty));
}

}  // namespace
}  // namespace dygita::grid_convergence_tests
