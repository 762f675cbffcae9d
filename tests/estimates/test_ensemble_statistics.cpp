// Designs, tolerance limits and rank correlations against closed forms, published tables and repetition.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "estimates/random_design.hpp"
#include "estimates/scatter.hpp"

namespace dygita::ensemble_statistics_tests {
namespace {

TEST(NormalQuantile, inverts_the_distribution) {
  EXPECT_NEAR(normal_quantile(0.95), 1.6448536269514722, 1e-13);
  EXPECT_NEAR(normal_quantile(0.5), 0.0, 1e-15);
  EXPECT_NEAR(normal_quantile(0.001), -3.0902323061678132, 1e-12);
  EXPECT_EQ(normal_quantile(0.9), -normal_quantile(1.0 - 0.9));
}

// Of the median of the units the noncentral t is Student's, whose quantiles are tan(pi (p - 1/2)) with one degree of
// freedom and (2p - 1) / sqrt(2 p (1 - p)) with two.
TEST(ToleranceFactor, of_the_median_is_students_t_in_closed_form) {
  for (const double p : {0.6, 0.75, 0.9, 0.95}) {
    EXPECT_NEAR(tolerance_factor(2, 0.5, p), std::tan(std::numbers::pi * (p - 0.5)) / std::sqrt(2.0), 1e-7);
    EXPECT_NEAR(tolerance_factor(3, 0.5, p), (2.0 * p - 1.0) / std::sqrt(2.0 * p * (1.0 - p)) / std::sqrt(3.0), 1e-7);
  }
}

// One-sided factors of normal populations, as handbooks tabulate them to three digits.
TEST(ToleranceFactor, is_that_of_published_tables) {
  EXPECT_NEAR(tolerance_factor(10, 0.95, 0.95), 2.911, 6e-4);
  EXPECT_NEAR(tolerance_factor(20, 0.95, 0.95), 2.396, 6e-4);
  EXPECT_NEAR(tolerance_factor(30, 0.95, 0.95), 2.220, 6e-4);
  EXPECT_NEAR(tolerance_factor(10, 0.90, 0.95), 2.355, 6e-4);
  EXPECT_NEAR(tolerance_factor(3, 0.95, 0.5), 1.94, 6e-3);
  EXPECT_NEAR(tolerance_factor(5, 0.95, 0.5), 1.78, 6e-3);
  EXPECT_NEAR(tolerance_factor(10, 0.95, 0.5), 1.70, 6e-3);
  EXPECT_NEAR(tolerance_factor(100000, 0.95, 0.5), normal_quantile(0.95), 1e-4);
}

// A limit with 50 % confidence lies above 95 % of the units in half of all repetitions.
TEST(ToleranceFactor, covers_as_often_as_it_says) {
  std::mt19937_64 generator(7);
  const auto uniform = [&] { return (static_cast<double>(generator() >> 11) + 0.5) * 0x1p-53; };
  constexpr int repetitions = 20000;
  for (const int n : {3, 8, 16})
    for (const double confidence : {0.5, 0.9}) {
      const double k = tolerance_factor(n, 0.95, confidence);
      int covered = 0;
      for (int r = 0; r < repetitions; ++r) {
        std::vector<double> sample;
        for (int i = 0; i < n; ++i) sample.push_back(3.0 + 2.0 * normal_quantile(uniform()));
        covered += sample_mean(sample) + k * sample_deviation(sample) >= 3.0 + 2.0 * normal_quantile(0.95);
      }
      const double within = 3.5 * std::sqrt(confidence * (1.0 - confidence) / repetitions);
      EXPECT_NEAR(static_cast<double>(covered) / repetitions, confidence, within) << n;
    }
}

TEST(Sample, quantiles_are_linear_between_the_values_in_order) {
  EXPECT_EQ(sample_quantile({4.0, 1.0, 3.0, 2.0}, 0.5), 2.5);
  EXPECT_EQ(sample_quantile({4.0, 1.0, 3.0, 2.0}, 0.0), 1.0);
  EXPECT_EQ(sample_quantile({4.0, 1.0, 3.0, 2.0}, 1.0), 4.0);
  EXPECT_TRUE(std::isnan(sample_quantile({1.0, std::nan("")}, 0.5)));
  EXPECT_NEAR(sample_deviation({1.0, 2.0, 3.0, 4.0}), std::sqrt(5.0 / 3.0), 1e-15);
}

TEST(RankCorrelation, is_one_for_whatever_rises_and_nan_for_what_does_not_vary) {
  const std::vector<double> x = {0.1, 0.4, 0.2, 0.9, 0.7, 0.3};
  std::vector<double> cubes, falling;
  for (const double v : x) cubes.push_back(v * v * v), falling.push_back(-std::exp(v));
  EXPECT_NEAR(rank_correlation(x, cubes).value, 1.0, 1e-12);
  EXPECT_NEAR(rank_correlation(x, falling).value, -1.0, 1e-12);
  EXPECT_TRUE(std::isnan(rank_correlation(x, std::vector<double>(6, 2.0)).value));
  // All orders of four are as likely: two of 24 agree in full, which proves nothing.
  EXPECT_LT(rank_correlation({1, 2, 3, 4}, {1, 2, 3, 4}).low, 0.0);
  EXPECT_GT(rank_correlation({1, 2, 3, 4, 5, 6, 7, 8}, {1, 2, 3, 4, 5, 6, 7, 8}).low, 0.8);
  // By hand: ranks 1 2 3 4 5 and 2 1 4 3 5, 1 - 6 sum d^2 / (n (n^2 - 1)) = 1 - 24/120.
  EXPECT_NEAR(rank_correlation({1, 2, 3, 4, 5}, {20, 10, 40, 30, 50}).value, 0.8, 1e-12);
  // Ties have their mean rank: 1, 2.5, 2.5, 4.
  EXPECT_NEAR(rank_correlation({1, 2, 3, 4}, {1, 5, 5, 7}).value, 4.5 / std::sqrt(5.0 * 4.5), 1e-12);
}

// What nine digits leave of one number in several members has no driver.
TEST(RankCorrelation, is_nan_for_what_differs_by_rounding) {
  std::vector<double> x, rounding, rising;
  for (int i = 0; i < 8; ++i) {
    x.push_back(i);
    rounding.push_back(2e4 * (1.0 + 1e-9 * i));
    rising.push_back(2e4 * (1.0 + 1e-7 * i));
  }
  EXPECT_TRUE(std::isnan(rank_correlation(x, rounding).value));
  EXPECT_EQ(rank_correlation(x, rising).value, 1.0);
}

TEST(TwoGroups, are_told_with_their_sizes_and_the_gap) {
  const std::optional<TwoGroups> found = two_groups({10.2, 0.0, 0.1, 10.0, 0.2, 0.3, 10.1, 0.4});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->n_upper, 3);
  EXPECT_NEAR(found->gap, 9.6, 1e-12);
  EXPECT_NEAR(found->middle, 5.2, 1e-12);
  EXPECT_FALSE(two_groups({0, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_FALSE(two_groups({0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 10}));  // one is an outlier
  EXPECT_FALSE(two_groups({0, 0.1, 0.2, 10, 10.1, 10.2, 10.3}));    // too few to tell
  EXPECT_FALSE(two_groups(std::vector<double>(9, 1.0)));
  EXPECT_FALSE(two_groups({0, 0, 0, 0, 1, 1, 1, NAN}));
}

TEST(TwoGroups, are_hardly_ever_found_in_normal_values) {
  std::mt19937_64 generator(5);
  constexpr int repetitions = 30000;
  for (const int n : {8, 10, 16, 64}) {
    int found = 0;
    for (int r = 0; r < repetitions; ++r) {
      std::vector<double> values;
      for (int i = 0; i < n; ++i)
        values.push_back(normal_quantile((static_cast<double>(generator() >> 11) + 0.5) * 0x1p-53));
      found += two_groups(std::move(values)).has_value();
    }
    EXPECT_LE(found, 9) << n;  // three expected
  }
}

// Of normal pairs with correlation rho Spearman's is 6/pi asin(rho/2); its bounds hold it 95 times in a hundred.
TEST(RankCorrelation, bounds_hold_the_true_value_as_often_as_they_say) {
  std::mt19937_64 generator(11);
  const auto normal = [&] { return normal_quantile((static_cast<double>(generator() >> 11) + 0.5) * 0x1p-53); };
  constexpr int repetitions = 3000;
  for (const double rho : {0.0, 0.7}) {
    const double truth = 6.0 / std::numbers::pi * std::asin(0.5 * rho);
    int held = 0;
    for (int r = 0; r < repetitions; ++r) {
      std::vector<double> x, y;
      for (int i = 0; i < 20; ++i) {
        x.push_back(normal());
        y.push_back(rho * x.back() + std::sqrt(1.0 - rho * rho) * normal());
      }
      const RankCorrelation found = rank_correlation(x, y);
      held += found.low <= truth && truth <= found.high;
    }
    EXPECT_GT(held, 0.92 * repetitions) << rho;
    EXPECT_LT(held, 0.98 * repetitions) << rho;
  }
}

TEST(Design, a_latin_hypercube_has_one_point_in_each_stratum) {
  for (const int n : {2, 7, 16}) {
    const auto points = design_points(Design::latin_hypercube, n, 5, 3);
    for (size_t j = 0; j < 5; ++j) {
      std::set<int> strata;
      for (const auto& point : points) strata.insert(static_cast<int>(point[j] * n));
      EXPECT_EQ(strata.size(), static_cast<size_t>(n));
    }
  }
  EXPECT_EQ(design_points(Design::latin_hypercube, 8, 3, 5), design_points(Design::latin_hypercube, 8, 3, 5));
  EXPECT_NE(design_points(Design::latin_hypercube, 8, 3, 5), design_points(Design::latin_hypercube, 8, 3, 6));
}

// Any 2^m points from the start have one in each interval of length 2^-m, and in the first two dimensions one in each
// of all dyadic rectangles of that area; more points leave the first ones what they are.
TEST(Design, sobol_points_fill_dyadic_intervals_and_rectangles) {
  constexpr int m = 6, n = 1 << m;
  const auto points = design_points(Design::sobol, n, most_sobol_parameters, 9);
  for (size_t j = 0; j < most_sobol_parameters; ++j) {
    std::set<int> intervals;
    for (const auto& point : points) intervals.insert(static_cast<int>(point[j] * n));
    EXPECT_EQ(intervals.size(), static_cast<size_t>(n)) << j;
  }
  for (int a = 0; a <= m; ++a) {
    std::set<std::pair<int, int>> boxes;
    for (const auto& point : points)
      boxes.emplace(static_cast<int>(point[0] * (1 << a)), static_cast<int>(point[1] * (1 << (m - a))));
    EXPECT_EQ(boxes.size(), static_cast<size_t>(n)) << a;
  }
  const auto fewer = design_points(Design::sobol, 10, most_sobol_parameters, 9);
  EXPECT_TRUE(std::equal(fewer.begin(), fewer.end(), points.begin()));
}

// Integrates a smooth product far better than chance does: a wrong direction number in any dimension shows.
TEST(Design, sobol_points_integrate_in_every_pair_of_dimensions) {
  constexpr int n = 4096;
  const auto points = design_points(Design::sobol, n, most_sobol_parameters, 1);
  for (size_t i = 0; i < most_sobol_parameters; ++i)
    for (size_t j = 0; j < i; ++j) {
      double sum = 0.0;
      for (const auto& point : points) sum += (2.0 * point[i] - 1.0) * (2.0 * point[j] - 1.0);
      EXPECT_LT(std::abs(sum / n), 0.2 / (3.0 * std::sqrt(n))) << i << " " << j;  // a fifth of one standard deviation
    }
}

TEST(Design, random_points_are_uniform_and_independent) {
  constexpr int n = 20000;
  const auto points = design_points(Design::random, n, 2, 5);
  double product = 0.0, square = 0.0;
  for (const auto& point : points) {
    product += (2.0 * point[0] - 1.0) * (2.0 * point[1] - 1.0) / n;
    square += std::pow(2.0 * point[0] - 1.0, 2) / n;
  }
  EXPECT_NEAR(product, 0.0, 4.0 / (3.0 * std::sqrt(n)));
  EXPECT_NEAR(square, 1.0 / 3.0, 4.0 * 0.3 / std::sqrt(n));
}

TEST(Design, corners_are_all_of_them) {
  const auto points = design_points(Design::corners, 1, 3, 0);
  EXPECT_EQ(std::set<std::vector<double>>(points.begin(), points.end()).size(), 8u);
}

TEST(Distribution, quantiles_are_those_of_their_names) {
  using Kind = Distribution::Kind;
  EXPECT_DOUBLE_EQ((Distribution{Kind::uniform, {2.0, 6.0}, 10.0}).quantile(0.25), 30.0);
  EXPECT_NEAR((Distribution{Kind::normal, {1.0, 0.1}}).quantile(0.95), 1.16448536269514722, 1e-12);
  EXPECT_NEAR((Distribution{Kind::lognormal, {2.0, 0.5}, 3.0}).quantile(0.5), 6.0, 1e-12);
  EXPECT_NEAR((Distribution{Kind::lognormal, {2.0, 0.5}}).quantile(0.95), 2.0 * std::exp(0.5 * 1.6448536269514722),
              1e-11);
  // The peak has the share (b - a) / (c - a) below it; halfway up to it a quarter of that.
  const Distribution triangle{Kind::triangular, {1.0, 2.0, 5.0}};
  EXPECT_NEAR(triangle.quantile(0.25), 2.0, 1e-12);
  EXPECT_NEAR(triangle.quantile(0.0625), 1.5, 1e-12);
  EXPECT_NEAR(triangle.quantile(1.0 - 0.1875), 3.5, 1e-12);
  const Distribution list{Kind::list, {3.0, 1.0, 2.0}};
  EXPECT_EQ(list.quantile(0.3), 3.0);
  EXPECT_EQ(list.quantile(0.5), 1.0);
  EXPECT_EQ(list.quantile(0.9), 2.0);
  EXPECT_EQ((Distribution{Kind::uniform, {2.0, 6.0}}).corner(true), 6.0);
  EXPECT_NEAR((Distribution{Kind::normal, {0.0, 1.0}}).corner(true), 1.959963984540054, 1e-12);
}

}  // namespace
}  // namespace dygita::ensemble_statistics_tests
