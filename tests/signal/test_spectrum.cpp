#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "signal/signal_doubts.hpp"
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

// A half-sine of `n` samples in a record of 200, on `offset`.
std::vector<double> pulse_of(int n, double offset = 0.0) {
  std::vector<double> signal(200, offset);
  for (int i = 0; i < n; ++i) signal[static_cast<size_t>(60 + i)] += 100.0 * std::sin(std::numbers::pi * (i + 0.5) / n);
  return signal;
}

std::string doubt_of(const std::vector<double>& signal, double to) {
  const std::vector<std::string> doubts = doubts_of_signal(signal, 1e-3, to);
  return doubts.empty() ? "" : doubts.front();
}

TEST(SignalDoubts, are_none_of_a_pulse_that_is_whole_and_well_sampled) {
  EXPECT_EQ(doubt_of(pulse_of(20), 400.0), "");
  EXPECT_EQ(doubt_of(pulse_of(40), 100.0), "");
  EXPECT_EQ(doubt_of(pulse_of(20, 0.5), 100.0), "");
}

TEST(SignalDoubts, are_of_an_offset_and_of_ends_that_are_no_rest) {
  EXPECT_EQ(doubt_of(pulse_of(20, -5.0), 100.0).find("is -5 before the shock and -5 after it"), 0u);
  std::vector<double> cut = pulse_of(20);
  cut.resize(75);
  EXPECT_EQ(doubt_of(cut, 100.0).find("ends with 76"), 0u) << doubt_of(cut, 100.0);
  std::reverse(cut.begin(), cut.end());
  EXPECT_EQ(doubt_of(cut, 100.0).find("begins with 76"), 0u);
  EXPECT_EQ(doubt_of(std::vector<double>(50, 0.0), 100.0), "is zero throughout");
}

TEST(SignalDoubts, are_of_samples_too_few_for_what_they_hold) {
  EXPECT_EQ(doubt_of(pulse_of(3), 300.0).find("has 3.33 samples per period at 300 Hz"), 0u)
      << doubt_of(pulse_of(3), 300.0);
  EXPECT_EQ(doubt_of(pulse_of(3), 100.0), "");  // ten times a period
}

}  // namespace
}  // namespace dygita
