#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "signal/spectrum.hpp"

namespace dygita {
namespace {

std::vector<double> sampled(int n, double dt, double (*f)(double)) {
  std::vector<double> samples(n);
  for (int i = 0; i < n; ++i) samples[i] = f(i * dt);
  return samples;
}

TEST(BandLimit, of_a_tone_is_its_frequency) {
  const auto tone = sampled(1000, 1e-3, [](double t) { return std::sin(2 * std::numbers::pi * 50 * t); });
  EXPECT_NEAR(band_limit(tone, 1e-3, 0.9), 50.0, 1.0);
}

// 97 % of the energy of a half-sine of duration D lies below 1 / D: its spectrum falls with the square of the
// frequency.
TEST(BandLimit, of_a_half_sine_is_of_the_order_of_one_over_its_duration) {
  const auto pulse =
      sampled(2000, 1e-6, [](double t) { return t < 1e-4 ? std::sin(std::numbers::pi * t / 1e-4) : 0.0; });
  const double limit = band_limit(pulse, 1e-6, 0.95);
  EXPECT_GT(limit, 0.6e4);
  EXPECT_LT(limit, 1.0e4);
}

TEST(BandLimit, of_what_does_not_change_is_zero) {
  EXPECT_EQ(band_limit(std::vector<double>(64, 3.0), 1e-3, 0.95), 0.0);
  EXPECT_EQ(band_limit({}, 1e-3, 0.95), 0.0);
}

}  // namespace
}  // namespace dygita
