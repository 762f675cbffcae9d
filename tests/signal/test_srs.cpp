// Shock response spectra: published half-sine values, Smallwood's coefficients, limits; the upsampler behind them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "base/error.hpp"
#include "base/log.hpp"
#include "signal/oscillator.hpp"
#include "signal/srs.hpp"
#include "signal/upsampler.hpp"

namespace dygita {
namespace {

using std::numbers::pi;
constexpr double infinite = std::numeric_limits<double>::infinity();

std::vector<double> half_sine(int n_intervals) {
  std::vector<double> signal;
  for (int i = 0; i <= n_intervals; ++i) signal.push_back(std::sin(pi * i / n_intervals));
  signal.back() = 0.0;
  return signal;
}

std::vector<double> sampled(size_t n, const std::function<double(double)>& f) {
  std::vector<double> signal(n);
  for (size_t i = 0; i < n; ++i) signal[i] = f(static_cast<double>(i));
  return signal;
}

// The spectrum at one frequency.
Srs at(const std::vector<double>& signal, double dt, double frequency, double q_factor) {
  return shock_response_spectrum(signal, dt, {q_factor, frequency, 1.001 * frequency, 1});
}

double largest(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

const double table[][2] = {{10, 0.4052}, {20, 0.7831},  {40, 1.3615},  {60, 1.6136},
                           {80, 1.6483}, {100, 1.5914}, {200, 1.1396}, {1000, 1.0076}};

TEST(Srs, of_a_half_sine_has_the_published_values) {
  const std::vector<double> signal = half_sine(1100);
  for (const auto& [frequency, expected] : table) {
    EXPECT_NEAR(at(signal, 1e-5, frequency, 10.0).maximax[0], expected, 0.5e-4 + 1e-6) << frequency << " Hz";
  }
}

TEST(Srs, of_a_coarsely_sampled_half_sine_is_the_same_below_a_tenth_of_the_sampling_rate) {
  const std::vector<double> signal = half_sine(22);  // 2 kHz
  for (const auto& [frequency, expected] : table) {
    if (frequency > 200.0) continue;
    const double decibel = 20.0 * std::log10(at(signal, 0.5e-3, frequency, 10.0).maximax[0] / expected);
    EXPECT_NEAR(decibel, 0.0, 0.05) << frequency << " Hz";
  }
}

// Gaussian packets of a tone each, nothing above 0.45 of the sampling rate; exact is the same function sampled 64 times
// as often, where the filter's bias is 4e-6 dB.
TEST(Srs, of_a_band_limited_signal_is_exact_up_to_a_tenth_of_the_sampling_rate) {
  const auto packets = [](double t) {
    double sum = 0.0;
    for (const auto& [frequency, centre, size] : {std::array{0.01, 300.0, 1.0},
                                                  {0.06, 150.0, 2.0},
                                                  {0.09, 420.0, -1.5},
                                                  {0.17, 220.0, 3.0},
                                                  {0.3, 380.0, 5.0}}) {
      const double x = (t - centre) / 12.0;
      sum += size * std::exp(-x * x) * std::cos(2.0 * pi * frequency * t);
    }
    return sum;
  };
  constexpr int finer = 64;
  const std::vector<double> coarse = sampled(600, packets);
  const std::vector<double> fine = sampled(599 * finer + 1, [&](double i) { return packets(i / finer); });
  for (const SrsQuantity quantity :
       {SrsQuantity::absolute_acceleration, SrsQuantity::relative_displacement, SrsQuantity::pseudo_velocity}) {
    const SrsSettings settings{10.0, 0.002, 0.1, 24, quantity};
    const Srs found = shock_response_spectrum(coarse, 1.0, settings),
              exact = shock_response_spectrum(fine, 1.0 / finer, settings);
    double worst = 0.0;
    for (size_t i = 0; i < exact.frequency.size(); ++i)
      for (const auto series : {&Srs::maximax, &Srs::positive, &Srs::negative, &Srs::primary, &Srs::residual})
        worst = std::max(worst, std::abs(20.0 * std::log10((found.*series)[i] / (exact.*series)[i])));
    EXPECT_LT(worst, 0.05);
    RecordProperty("largest error in dB", std::to_string(worst));
    std::printf("largest error: %.2g dB\n", worst);
  }
}

TEST(Srs, of_a_half_sine_peaks_where_and_as_high_as_published) {
  const std::vector<double> signal = half_sine(1100);
  const Srs damped = shock_response_spectrum(signal, 1e-5, {10.0, 50.0, 120.0, 200});
  const auto peak = std::max_element(damped.maximax.begin(), damped.maximax.end());
  EXPECT_NEAR(*peak, 1.6516, 1e-4);
  EXPECT_NEAR(damped.frequency[static_cast<size_t>(peak - damped.maximax.begin())], 75.0, 1.0);
  for (const double q_factor : {1e12, infinite}) {
    const Srs undamped = shock_response_spectrum(signal, 1e-5, {q_factor, 50.0, 120.0, 200});
    EXPECT_NEAR(largest(undamped.maximax), 1.7685, 1e-4);
  }
}

TEST(Srs, of_an_undamped_half_sine_has_the_residual_of_its_fourier_transform) {
  // Residual = wn |X(wn)|, and for a half-sine |X| = (pi / D) 2 |cos(wn D / 2)| / |(pi / D)^2 - wn^2|.
  const double duration = 11e-3;
  const std::vector<double> signal = half_sine(1100);
  for (const double frequency : {20.0, 70.0, 100.0, 333.0}) {
    const double wn = 2.0 * pi * frequency, w = pi / duration;
    const double exact = wn * w * 2.0 * std::abs(std::cos(wn * duration / 2.0)) / std::abs(w * w - wn * wn);
    EXPECT_NEAR(at(signal, duration / 1100, frequency, infinite).residual[0], exact, 1e-5) << frequency << " Hz";
  }
}

// Of a constant base acceleration A, undamped: z = -A/wn^2 (1 - cos wn t), a step's textbook answer.
TEST(Srs, of_a_constant_has_the_textbooks_relative_displacement) {
  for (const double damping : {0.0, 0.05}) {
    SrsSettings settings{q_factor_of(damping), 5.0, 400.0, 3, SrsQuantity::relative_displacement};
    const std::vector<double> constant(4000, 3.0);
    const Srs z = shock_response_spectrum(constant, 1e-3, settings);
    settings.quantity = SrsQuantity::pseudo_velocity;
    const Srs pseudo = shock_response_spectrum(constant, 1e-3, settings);
    const double overshoot = 1.0 + std::exp(-pi * damping / std::sqrt(1.0 - damping * damping));
    for (size_t i = 0; i < z.frequency.size(); ++i) {
      const double wn = 2.0 * pi * z.frequency[i];
      EXPECT_NEAR(z.negative[i] * wn * wn / (3.0 * overshoot), 1.0, 2e-5) << z.frequency[i];
      EXPECT_NEAR(pseudo.maximax[i] / (wn * z.maximax[i]), 1.0, 1e-10);
    }
  }
}

// A short pulse leaves the base with a change of velocity, which a soft oscillator shows undamped as its
// pseudo-velocity; a stiff one's relative displacement is that of the peak acceleration, at rest.
TEST(Srs, of_a_half_sine_tends_to_its_change_of_velocity_and_to_its_peak) {
  const std::vector<double> signal = half_sine(1100);  // 11 ms
  const SrsSettings soft{infinite, 0.5, 0.6, 3, SrsQuantity::pseudo_velocity};
  EXPECT_NEAR(shock_response_spectrum(signal, 1e-5, soft).maximax[0], 2.0 / pi * 11e-3, 1e-3 * 7e-3);
  const SrsSettings stiff{10.0, 3000.0, 3001.0, 3, SrsQuantity::relative_displacement};
  const double wn = 2.0 * pi * 3000.0;
  EXPECT_NEAR(shock_response_spectrum(signal, 1e-5, stiff).maximax[0] * wn * wn, 1.0, 0.01);
}

TEST(Srs, has_the_unit_of_its_quantity) {
  EXPECT_EQ(srs_unit(SrsQuantity::absolute_acceleration, "g"), "g");
  EXPECT_EQ(srs_unit(SrsQuantity::relative_displacement, "m/s^2"), "m");
  EXPECT_EQ(srs_unit(SrsQuantity::pseudo_velocity, "m/s^2"), "m/s");
  EXPECT_EQ(srs_unit(SrsQuantity::pseudo_velocity, "g"), "g s");
}

// A haversine: at a kink, as a half-sine ends, the record that stops and the one that goes on are interpolated
// differently (7e-6).
TEST(Srs, residual_is_what_a_long_silence_after_the_record_shows) {
  std::vector<double> signal = half_sine(1100);
  for (double& value : signal) value *= value;
  std::vector<double> followed = signal;
  followed.resize(60000, 0.0);
  for (const double frequency : {30.0, 75.0, 150.0}) {
    const Srs brief = at(signal, 1e-5, frequency, 5.0), full = at(followed, 1e-5, frequency, 5.0);
    EXPECT_NEAR(std::max(brief.primary[0], brief.residual[0]), full.primary[0], 1e-6);
    EXPECT_NEAR(brief.positive[0], full.positive[0], 1e-6);
    EXPECT_NEAR(brief.negative[0], full.negative[0], 1e-6);
  }
}

TEST(Srs, is_linear_and_turns_over_with_the_signal) {
  const std::vector<double> signal = sampled(500, [](double i) { return std::exp(-0.01 * i) * std::sin(0.2 * i); });
  std::vector<double> turned;
  for (const double value : signal) turned.push_back(-3.0 * value);
  const Srs a = shock_response_spectrum(signal, 1e-4, {}), b = shock_response_spectrum(turned, 1e-4, {});
  for (size_t i = 0; i < a.frequency.size(); ++i) {
    EXPECT_NEAR(b.positive[i], 3.0 * a.negative[i], 1e-12);
    EXPECT_NEAR(b.negative[i], 3.0 * a.positive[i], 1e-12);
    EXPECT_EQ(a.maximax[i], std::max(a.positive[i], a.negative[i]));
    EXPECT_EQ(a.maximax[i], std::max(a.primary[i], a.residual[i]));
  }
}

TEST(Srs, of_a_suddenly_applied_constant_is_twice_that_constant_without_damping) {
  const Srs srs = shock_response_spectrum(std::vector<double>(2000, 1.0), 1e-3, {infinite, 5.0, 400.0, 3});
  // The vertex of a parabola through samples of a cosine an angle a apart is off by 3/128 a^4 at most; a = 2 pi / 40.
  for (const double value : srs.primary) EXPECT_NEAR(value, 2.0, 3.0 / 128.0 * std::pow(2.0 * pi / 40.0, 4));
}

TEST(Srs, stands_still_for_a_signal_of_zeros_and_for_one_sample) {
  const Srs zeros = shock_response_spectrum(std::vector<double>(50, 0.0), 1e-3, {10.0, 50.0, 400.0, 3});
  EXPECT_EQ(largest(zeros.maximax), 0.0);
  EXPECT_EQ(largest(shock_response_spectrum({1.0}, 1e-3, {10.0, 50.0, 400.0, 3}).maximax), 0.0);
  EXPECT_GT(largest(shock_response_spectrum({1.0, 1.0}, 1e-3, {10.0, 50.0, 400.0, 3}).maximax), 0.0);
}

TEST(Srs, keeps_its_digits_at_a_millionth_of_the_sampling_rate) {
  // Far below 1/T only the impulse I counts: the undamped response is wn I.
  const std::vector<double> signal = half_sine(1000);
  for (const double frequency : {1e-3, 1e-5, 1e-7}) {  // sampled at 1000 Hz
    const double impulse = at(signal, 1e-3, frequency, infinite).residual[0] / (2.0 * pi * frequency);
    EXPECT_NEAR(impulse, 2.0 / pi, 1e-5);
  }
}

TEST(Srs, has_the_asked_frequencies) {
  const Srs srs = shock_response_spectrum(half_sine(100), 1e-4, {10.0, 100.0, 800.0, 2});
  ASSERT_EQ(srs.frequency.size(), 7u);
  EXPECT_DOUBLE_EQ(srs.frequency.front(), 100.0);
  EXPECT_NEAR(srs.frequency.back(), 800.0, 1e-9);
  EXPECT_NEAR(srs.frequency[1] / srs.frequency[0], std::sqrt(2.0), 1e-12);
}

TEST(Srs, ends_at_the_highest_frequency_that_is_asked_for) {
  const Srs srs = shock_response_spectrum(half_sine(100), 1e-6, {10.0, 100.0, 10e3, 12});
  ASSERT_EQ(srs.frequency.size(), 81u);
  EXPECT_EQ(srs.frequency.back(), 10e3);
  EXPECT_NEAR(srs.frequency[79], 9589.0, 1.0);
  EXPECT_EQ(shock_response_spectrum(half_sine(100), 1e-6, {10.0, 100.0, 6400.0, 12}).frequency.back(), 6400.0);
}

TEST(Srs, is_as_large_as_its_signal_however_large_that_is) {
  const std::vector<double> signal = sampled(300, [](double i) { return std::exp(-0.01 * i) * std::sin(0.2 * i); });
  const Srs plain = shock_response_spectrum(signal, 1e-4, {});
  for (const double factor : {1e200, 1e-200}) {
    std::vector<double> scaled;
    for (const double value : signal) scaled.push_back(factor * value);
    const Srs srs = shock_response_spectrum(scaled, 1e-4, {});
    for (size_t i = 0; i < srs.frequency.size(); ++i)
      EXPECT_NEAR(srs.maximax[i] / factor, plain.maximax[i], 1e-9 * plain.maximax[i]) << factor;
  }
  EXPECT_THROW(shock_response_spectrum({0.0, 1.7e308, -1.7e308, 1.7e308, -1.7e308}, 1e-4, {}), InputError);
}

double decibels(double a, double b) { return 20.0 * std::log10(a / b); }

// Ten samples a second apart, then two hundred 10 ns apart: what was still before says nothing, and costs nothing.
TEST(Srs, of_a_long_quiet_stretch_before_a_short_one_is_that_of_the_short_one) {
  const std::vector<double> pulse = half_sine(200);
  const SrsSettings settings{10.0, 1e3, 1e6, 12};
  const auto start = std::chrono::steady_clock::now();
  const Srs srs =
      shock_response_spectrum({{0.5, 1.0, std::vector<double>(10, 0.0)}, {10.0 + 0.5e-8, 1e-8, pulse}}, settings);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 1.0);
  const Srs alone = shock_response_spectrum(pulse, 1e-8, settings);
  for (size_t i = 0; i < alone.frequency.size(); ++i)
    EXPECT_NEAR(decibels(srs.maximax[i], alone.maximax[i]), 0.0, 1e-6) << alone.frequency[i];
  EXPECT_THROW(shock_response_spectrum({{0.0, 1.0, pulse}, {10.0, 1.0, pulse}}, settings), InputError);
}

// A wave sampled 200 times a period, then 20 times: as the same wave at the finer rate throughout.
TEST(Srs, of_stretches_of_unlike_steps_is_that_of_the_signal_behind_them) {
  const auto wave = [](double t) { return std::exp(-0.5 * t) * std::sin(2.0 * pi * t); };
  EvenStretch fine{0.0, 1.0 / 200.0, {}}, coarse{4.0, 1.0 / 20.0, {}};
  for (int i = 0; i < 796; ++i) fine.values.push_back(wave(fine.time(static_cast<size_t>(i))));
  for (int i = 0; i < 120; ++i) coarse.values.push_back(wave(coarse.time(static_cast<size_t>(i))));
  std::vector<double> all;
  for (int i = 0; i <= 1990; ++i) all.push_back(wave(i / 200.0));
  const SrsSettings settings{10.0, 0.25, 4.0, 6};
  const Srs srs = shock_response_spectrum({fine, coarse}, settings),
            exact = shock_response_spectrum(all, 1.0 / 200.0, settings);
  for (size_t i = 0; i < exact.frequency.size(); ++i) {
    EXPECT_NEAR(decibels(srs.maximax[i], exact.maximax[i]), 0.0, 0.01) << exact.frequency[i];
    EXPECT_NEAR(decibels(srs.residual[i], exact.residual[i]), 0.0, 0.1) << exact.frequency[i];
  }
}

SrsSettings watched(double q_factor, double from, double to) {
  SrsSettings settings{q_factor, from, to, 6};
  settings.watches_end = true;
  return settings;
}

// A ring of 1 Hz that has set in slowly, cut at its largest velocity: to a slow oscillator the cut is a step of
// velocity.
const std::vector<double>& cut_ring() {
  static const std::vector<double> signal = sampled(2051, [](double i) {
    const double t = i / 100.0;
    return std::sin(2.0 * pi * t) * std::min(t / 10.0, 1.0);
  });
  return signal;
}

TEST(Srs, of_a_record_that_is_cut_off_in_motion_tells_what_depends_on_the_cut) {
  const Srs srs = shock_response_spectrum(cut_ring(), 0.01, watched(10.0, 0.1, 8.0));
  for (size_t i = 0; i < srs.frequency.size(); ++i) {
    if (srs.frequency[i] < 0.3) {
      EXPECT_GT(srs.ending.maximax[i], 6.0) << srs.frequency[i];
    }
    if (srs.frequency[i] > 0.9) {
      EXPECT_LT(srs.ending.maximax[i], 1.0) << srs.frequency[i];
    }
    EXPECT_LT(srs.ending.primary[i], 1.0) << srs.frequency[i];
    EXPECT_FALSE(srs.ending.grows[i]) << srs.frequency[i];
  }
  EXPECT_TRUE(shock_response_spectrum(cut_ring(), 0.01, {10.0, 0.1, 8.0}).ending.maximax.empty());
}

// What keeps its velocity after a push ends as it will go on.
TEST(Srs, of_a_push_depends_on_no_cut) {
  std::vector<double> signal = half_sine(100);
  signal.resize(1000, 0.0);
  const Srs srs = shock_response_spectrum(signal, 1e-3, watched(10.0, 1.0, 400.0));
  for (const double moved : srs.ending.maximax) EXPECT_LT(moved, 0.01);
  signal.insert(signal.begin(), 20000, 0.0);  // a long rest before it is no part of the record
  for (const double moved : shock_response_spectrum(signal, 1e-3, watched(10.0, 1.0, 400.0)).ending.maximax)
    EXPECT_LT(moved, 0.01);
  for (const double moved :
       shock_response_spectrum(std::vector<double>(100, 0.0), 1e-3, watched(10.0, 10.0, 400.0)).ending.maximax)
    EXPECT_EQ(moved, 0.0);
}

// Twenty periods at the frequency of an oscillator of Q 50: it has come to 1 - exp(-20 pi/50) = 72 % of its peak.
TEST(Srs, tells_a_response_that_still_grows) {
  const std::vector<double> tone = sampled(2000, [](double i) { return std::sin(2.0 * pi * i / 100.0); });
  const Srs srs = shock_response_spectrum(tone, 0.01, watched(50.0, 1.0, 1.001));
  ASSERT_TRUE(srs.ending.grows.front());
  const double quarter_before = 20.0 * std::log10((1.0 - std::exp(-0.4 * pi)) / (1.0 - std::exp(-0.3 * pi)));
  EXPECT_NEAR(srs.ending.maximax.front(), quarter_before, 0.2);
  EXPECT_FALSE(shock_response_spectrum(tone, 0.01, watched(5.0, 1.0, 1.001)).ending.grows.front());
}

// The truth is the ring that dies away by itself.
TEST(Srs, of_a_tapered_record_is_that_of_a_ring_that_dies_away) {
  std::vector<double> whole = cut_ring();
  for (int i = 0; i < 3000; ++i) whole.push_back(std::sin(2.0 * pi * (2051 + i) / 100.0) * std::exp(-i / 300.0));
  SrsSettings settings = watched(10.0, 0.25, 8.0);
  const Srs truth = shock_response_spectrum(whole, 0.01, settings),
            cut = shock_response_spectrum(cut_ring(), 0.01, settings);
  settings.taper = 5.0;
  const Srs tapered = shock_response_spectrum(cut_ring(), 0.01, settings);
  EXPECT_GT(decibels(cut.maximax.front(), truth.maximax.front()), 6.0);
  EXPECT_GT(cut.ending.maximax.front(), 6.0);
  for (size_t i = 0; i < truth.frequency.size(); ++i) {
    EXPECT_NEAR(decibels(tapered.maximax[i], truth.maximax[i]), 0.0, 1.0) << truth.frequency[i];
    EXPECT_LT(tapered.ending.maximax[i], 2.0) << truth.frequency[i];
  }
  settings.taper = -1.0;
  EXPECT_THROW(shock_response_spectrum(cut_ring(), 0.01, settings), InputError);
}

TEST(Srs, warns_below_the_record_and_above_its_nyquist_frequency) {
  take_warnings();
  shock_response_spectrum(half_sine(100), 1e-3, {10.0, 20.0, 400.0, 3});
  EXPECT_TRUE(take_warnings().empty());
  shock_response_spectrum(half_sine(100), 1e-3, {10.0, 5.0, 600.0, 3});
  EXPECT_EQ(take_warnings().size(), 2u);
}

TEST(Srs, refuses_what_has_no_meaning) {
  const std::vector<double> signal = half_sine(10);
  EXPECT_THROW(shock_response_spectrum({}, 1e-3, {}), InputError);
  EXPECT_THROW(shock_response_spectrum({0.0, std::nan("")}, 1e-3, {}), InputError);
  EXPECT_THROW(shock_response_spectrum(signal, 0.0, {}), InputError);
  EXPECT_THROW(shock_response_spectrum(signal, 1e-3, {0.5, 10.0, 20.0, 3}), InputError);
  EXPECT_THROW(shock_response_spectrum(signal, 1e-3, {10.0, 20.0, 20.0, 3}), InputError);
  EXPECT_THROW(shock_response_spectrum(signal, 1e-3, {10.0, 0.0, 20.0, 3}), InputError);
  EXPECT_THROW(shock_response_spectrum(signal, 1e-3, {10.0, 10.0, 20.0, 0}), InputError);
}

TEST(Srs, of_ten_thousand_samples_at_a_hundred_frequencies_is_had_in_a_second) {
  const std::vector<double> signal = sampled(10000, [](double i) { return std::sin(1e-5 * i * i); });
  const auto start = std::chrono::steady_clock::now();
  const Srs srs = shock_response_spectrum(signal, 1e-5, {10.0, 100.0, 31000.0, 12});
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_GE(srs.frequency.size(), 99u);
  EXPECT_LT(seconds, 1.0);
  RecordProperty("seconds", std::to_string(seconds));
}

TEST(Oscillator, answers_as_smallwoods_recursion_does) {
  const std::vector<double> base = sampled(400, [](double i) { return i == 0.0 ? 0.0 : std::cos(0.3 * i) + 0.01 * i; });
  const double dt = 1e-4, frequency = 180.0, q_factor = 7.0;
  const double wn = 2.0 * pi * frequency, z = 0.5 / q_factor, wd = wn * std::sqrt(1.0 - z * z);
  const double e = std::exp(-z * wn * dt), b = wd * dt, c = e * std::cos(b), s = e * std::sin(b) / b;
  double x1 = 0.0, x2 = 0.0, y1 = 0.0, y2 = 0.0;
  Oscillator oscillator(frequency, q_factor, dt, base[0]);
  for (size_t i = 1; i < base.size(); ++i) {
    const double y = (1.0 - s) * base[i] + 2.0 * (s - c) * x1 + (e * e - s) * x2 + 2.0 * c * y1 - e * e * y2;
    oscillator.advance({base[i]});
    ASSERT_NEAR(oscillator.response(), y, 1e-11) << i;
    x2 = x1, x1 = base[i], y2 = y1, y1 = y;
  }
}

// Against the line in ten thousand steps, for oscillators of a twentieth to five hundred periods along it.
TEST(Oscillator, follows_a_line_of_any_length) {
  for (const double q_factor : {0.6, 10.0, infinite})
    for (const double frequency : {0.05, 0.7, 5.0, 40.0, 500.0}) {
      Oscillator far(frequency, q_factor, 1.0, 0.0), near(frequency, q_factor, 1e-4, 0.0);
      far.sample_every(0.002);
      near.sample_every(0.002);
      for (Oscillator* oscillator : {&far, &near})
        oscillator->advance(std::vector<double>(3, 0.4));  // so that it vibrates
      std::vector<double> line;
      for (int i = 1; i <= 100000; ++i) line.push_back(0.4 - 1.4 * i / 100000.0);
      far.follow_line(-1.0, 1.0);
      near.sample_every(1e-5);
      near.advance(line);
      EXPECT_NEAR(far.response(), near.response(), 1e-6) << frequency;
      EXPECT_NEAR(far.during().highest, near.during().highest, 1e-3) << frequency << " Hz, Q " << q_factor;
      EXPECT_NEAR(far.during().lowest, near.during().lowest, 1e-3) << frequency << " Hz, Q " << q_factor;
    }
}

TEST(Oscillator, reads_a_peak_between_samples) {
  // Undamped free vibration after a constant: y = 1 - cos, sampled 20 times a period, away from the crest.
  const double frequency = 1.0, dt = 1.0 / 20.37;
  Oscillator oscillator(frequency, infinite, dt, 1.0);
  oscillator.advance(std::vector<double>(20, 1.0));
  EXPECT_NEAR(oscillator.during().highest, 2.0, 1e-4);
  EXPECT_NEAR(oscillator.after().maximax(), 2.0 * std::abs(std::sin(pi * 20 / 20.37)), 1e-12);
}

TEST(Upsampler, gives_back_band_limited_signals_within_a_twentieth_of_a_decibel) {
  for (const double share : {0.01, 0.1, 0.25, 0.4, 0.44}) {  // of the sampling rate
    const auto wave = [&](double t) { return std::sin(2.0 * pi * share * t + 0.4); };
    const std::vector<double> signal = sampled(400, wave);
    const Upsampler upsampler(signal, 8);
    std::vector<double> fine;
    upsampler.intervals(100, 300, fine);
    double error = 0.0;
    for (size_t i = 0; i < fine.size(); ++i) {
      error = std::max(error, std::abs(fine[i] - wave(100.0 + static_cast<double>(i) / 8.0)));
    }
    EXPECT_LT(error, 1.2e-4) << "at " << share << " of the sampling rate";  // 0.001 dB
  }
}

TEST(Upsampler, keeps_the_samples_and_works_in_pieces) {
  const std::vector<double> signal = sampled(90, [](double i) { return std::sin(i * i); });
  const Upsampler upsampler(signal, 4);
  std::vector<double> all, first, second;
  upsampler.intervals(0, 89, all);
  upsampler.intervals(0, 33, first);
  upsampler.intervals(33, 89, second);
  first.insert(first.end(), second.begin(), second.end());
  EXPECT_EQ(all, first);
  for (size_t i = 0; i < 89; ++i) EXPECT_EQ(all[4 * i], signal[i]);
}

TEST(Upsampler, does_not_ring_at_the_ends_of_records_that_start_and_end_anywhere) {
  for (const auto& f :
       std::vector<std::function<double(double)>>{[](double) { return 3.0; }, [](double t) { return 2.0 + 0.1 * t; }}) {
    for (const size_t n : {2u, 5u, 200u}) {
      const std::vector<double> signal = sampled(n, f);
      std::vector<double> fine;
      Upsampler(signal, 4).intervals(0, n - 1, fine);
      for (size_t i = 0; i < fine.size(); ++i) EXPECT_NEAR(fine[i], f(static_cast<double>(i) / 4.0), 1e-4);
    }
  }
  // A record cut out of a wave at a tenth of the sampling rate, at any phase.
  const auto wave = [](double t) { return std::sin(0.2 * pi * t + 1.0); };
  std::vector<double> fine;
  Upsampler(sampled(100, wave), 4).intervals(0, 99, fine);
  for (size_t i = 0; i < fine.size(); ++i) EXPECT_NEAR(fine[i], wave(static_cast<double>(i) / 4.0), 0.03);
}

}  // namespace
}  // namespace dygita
