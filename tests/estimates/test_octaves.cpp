#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "estimates/octaves.hpp"

namespace dygita::test::octaves_tests {
namespace {

constexpr double quarter = std::numbers::pi / 2;

// Contents of one octave that swings by a quarter of a turn a sample and decays by a share of a turn's angle.
OctaveBank decaying(double damping, int n) {
  OctaveBank bank(false);
  for (int i = 0; i < n; ++i) {
    const double content = std::cos(quarter * i + 0.3) * std::exp(-damping * quarter * i);
    const std::vector<double> squares = {content * content};
    bank.add(squares);
  }
  return bank;
}

double mean_lag() { return std::pow(quarter, 3) / 12.0 * 0.5 * (std::cos(0.3) + std::sin(0.3)); }

TEST(OctaveBank, adds_up_the_lags_of_a_motion_that_stays) {
  EXPECT_NEAR(decaying(0.0, 1000).phase_error(1e-4), 1e-4 * 1000 * mean_lag(), 0.01 * 1000 * 1e-4 * mean_lag());
}

// n lag exp(-d n) is largest at n = 1/d; its envelope lasts sixteen samples longer.
TEST(OctaveBank, lets_lags_decay_with_the_motion) {
  constexpr double damping = 0.002, decay = damping * quarter;
  const double largest = mean_lag() / (decay * std::numbers::e),
               found = decaying(damping, 3000).phase_error(1e-4) / 1e-4;
  EXPECT_GT(found, largest);
  EXPECT_LT(found, std::exp(16.0 * decay) * largest * 1.05);
  // An oscillator with 5 % responds most at ln(25)/(0.048 w), when less has gathered.
  const double heard = decaying(damping, 3000).lags(1e-4).front().error / 1e-4;
  EXPECT_LT(heard, 0.8 * largest);
  EXPECT_GT(heard, 0.2 * largest);
}

}  // namespace
}  // namespace dygita::test::octaves_tests
