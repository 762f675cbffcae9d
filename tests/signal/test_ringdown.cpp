// Frequency and damping of decaying vibrations: exact for an exponential, beside other ones and an offset, that of the
// differential equation for a damper that is not linear; what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "base/error.hpp"
#include "signal/ringdown.hpp"

namespace dygita {
namespace {

using std::numbers::pi;

EvenStretch sampled(double duration, double dt, const std::function<double(double)>& f) {
  EvenStretch signal{0.5, dt, {}};
  for (int i = 0; i * dt < duration; ++i) signal.values.push_back(f(i * dt));
  return signal;
}

TEST(RingdownOfASignal, of_one_decaying_vibration_is_exact_anywhere_in_the_band) {
  for (const double frequency : {8.1, 11.0, 13.9}) {
    const double zeta = 0.02, natural = 2 * pi * frequency, omega = natural * std::sqrt(1 - zeta * zeta);
    const Ringdown found = ring_down(
        sampled(3.0, 1e-3, [&](double t) { return 3.0 * std::exp(-zeta * natural * t) * std::cos(omega * t + 0.4); }),
        8.0, 14.0);
    ASSERT_GT(found.time.size(), 10u);
    EXPECT_NEAR(found.time.front(), 0.5 + ringdown_window(8.0, 14.0), 1e-3);
    for (size_t i = 0; i < found.time.size(); ++i) {
      EXPECT_NEAR(found.frequency[i], frequency, 1e-3 * frequency);
      EXPECT_NEAR(found.damping[i], zeta, 0.01 * zeta + 2e-4);
      const double amplitude = 3.0 * std::exp(-zeta * natural * (found.time[i] - 0.5));
      EXPECT_NEAR(found.amplitude[i], amplitude, 0.01 * amplitude);
    }
  }
}

TEST(RingdownOfASignal, leaves_other_vibrations_and_an_offset_out) {
  const auto one = [](double t) { return std::exp(-0.5 * t) * std::sin(2 * pi * 20 * t); };
  const Ringdown alone = ring_down(sampled(3.0, 1e-3, one), 16.0, 24.0);
  const Ringdown beside =
      ring_down(sampled(3.0, 1e-3, [&](double t) { return one(t) + std::sin(2 * pi * 47 * t) + 5.0; }), 16.0, 24.0);
  ASSERT_EQ(alone.time.size(), beside.time.size());
  for (size_t i = 0; i < alone.time.size(); ++i) {
    EXPECT_NEAR(beside.frequency[i], 20.0, 0.01);
    EXPECT_NEAR(beside.damping[i], alone.damping[i], 3e-4);
  }
}

// x'' + r sign(x') ... : a spring in parallel with dry friction loses 4 r an amplitude and cycle: damping 2 r/(pi k A).
TEST(RingdownOfASignal, of_dry_friction_has_its_damping_at_each_amplitude) {
  const double natural = 2 * pi * 10.0, friction = 0.004;  // of the spring's force at an amplitude of one
  const double dt = 1e-4;
  double x = 1.0, v = 0.0;
  const EvenStretch signal = sampled(6.0, dt, [&](double) {
    const double now = x;
    for (int i = 0; i < 10; ++i) {
      const double h = 0.1 * dt;
      v += h * natural * natural * (-x - (v > 0 ? friction : -friction));
      x += h * v;
    }
    return now;
  });
  const Ringdown found = ring_down(signal, 6.0, 14.0);
  ASSERT_GT(found.time.size(), 20u);
  for (size_t i = 0; i < found.time.size() && found.amplitude[i] > 0.1; ++i) {
    const double expected = 2.0 * friction / (pi * found.amplitude[i]);
    EXPECT_NEAR(found.damping[i], expected, 0.03 * expected) << "at an amplitude of " << found.amplitude[i];
    EXPECT_NEAR(found.frequency[i], 10.0, 0.02);
  }
  EXPECT_LT(found.amplitude.back(), 0.3 * found.amplitude.front());
}

TEST(RingdownOfASignal, is_empty_where_only_what_leaks_in_vibrates) {
  const EvenStretch signal =
      sampled(3.0, 1e-3, [](double t) { return std::exp(-0.5 * t) * std::sin(2 * pi * 20 * t); });
  EXPECT_TRUE(ring_down(signal, 30.0, 50.0).time.empty());
  EXPECT_TRUE(ring_down(signal, 7.0, 13.0).time.empty());
}

TEST(RingdownOfASignal, is_empty_of_a_short_one_and_refuses_bands_that_make_no_sense) {
  const EvenStretch signal = sampled(0.3, 1e-3, [](double t) { return std::sin(2 * pi * 20 * t); });
  EXPECT_TRUE(ring_down(signal, 19.0, 21.0).time.empty());
  EXPECT_THROW(ring_down(signal, 0.0, 21.0), InputError);
  EXPECT_THROW(ring_down(signal, 21.0, 19.0), InputError);
  EXPECT_THROW(ring_down(signal, 10.0, 31.0), InputError);
  EXPECT_THROW(ring_down(signal, 400.0, 500.0), InputError);
}

}  // namespace
}  // namespace dygita
