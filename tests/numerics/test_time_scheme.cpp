#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "numerics/time_scheme.hpp"

namespace dygita {
namespace {

// A mass on a spring by the balance of an increment.
struct Oscillator {
  double mass = 2.0, stiffness = 8e6;
  Damping damping = {};
  double u = 0.0, v = 1.0;

  double frequency() const { return std::sqrt(stiffness / mass); }
  double energy() const { return 0.5 * (mass * v * v + stiffness * u * u); }
  void advance(const TimeScheme& scheme) {
    const double old = v;
    v = (scheme.inertia_of_start(damping) * mass * old - stiffness * (u + scheme.c0(damping) * old)) /
        (scheme.inertia_of_end(damping) * mass + scheme.c1(damping) * stiffness);
    u += scheme.motion(old, v);
  }
};

TEST(TimeScheme, takes_an_increment_by_its_weights) {
  const TimeScheme scheme = TimeScheme::implicit(2e-6, 0.2);  // g = 0.4
  EXPECT_DOUBLE_EQ(scheme.mean(3.0, 5.0), 0.4 * 3.0 + 0.6 * 5.0);
  EXPECT_DOUBLE_EQ(scheme.motion(3.0, 5.0), 2e-6 * 4.2);
  EXPECT_DOUBLE_EQ(scheme.from_start(3.0) + scheme.from_end(5.0), scheme.mean(3.0, 5.0));
  EXPECT_NEAR(scheme.motion(3.0, -scheme.undoing(3.0)), 0.0, 1e-21);
  EXPECT_DOUBLE_EQ(scheme.numerical_damping(), 0.2);
  EXPECT_TRUE(scheme.dissipates());
  EXPECT_FALSE(TimeScheme::implicit(2e-6).dissipates());
  EXPECT_DOUBLE_EQ(scheme.working(2.0, 4.0), 4.0);
  const TimeScheme end = scheme.of_end();
  EXPECT_FALSE(end.is_static);
  EXPECT_DOUBLE_EQ(end.motion(3.0, 5.0), 2e-6 * 5.0);
}

TEST(TimeScheme, of_a_static_step_has_no_inertia_and_moves_by_its_end) {
  const TimeScheme scheme;
  const Damping damping{100.0, 1e-6};
  EXPECT_TRUE(scheme.is_static);
  EXPECT_EQ(scheme.motion(3.0, 5.0), 5.0);
  EXPECT_EQ(scheme.working(2.0, 4.0), 3.0);
  EXPECT_EQ(scheme.inertia_of_start(damping), 0.0);
  EXPECT_EQ(scheme.inertia_of_end(damping), 0.0);
  EXPECT_EQ(scheme.c0(damping), 0.0);
  EXPECT_EQ(scheme.c1(damping), 1.0);
}

TEST(TimeScheme, loses_what_it_says_and_else_nothing) {
  for (const double numerical_damping : {0.0, 0.05, 0.6}) {
    Oscillator body;
    const TimeScheme scheme = TimeScheme::implicit(0.3 / body.frequency(), numerical_damping);
    double lost = 0.0;
    const double first = body.energy();
    for (int i = 0; i < 200; ++i) {
      const Oscillator before = body;
      body.advance(scheme);
      const double du = body.u - before.u, dv = body.v - before.v;
      lost += scheme.loss(body.stiffness * du * du + body.mass * dv * dv);
    }
    EXPECT_NEAR(body.energy() + lost, first, 1e-12 * first) << numerical_damping;
    EXPECT_EQ(lost > 0.5 * first, numerical_damping > 0.0) << numerical_damping;
  }
}

// Against u = sin(w t), v = cos(w t): how far the phase is behind.
TEST(TimeScheme, turns_a_motion_too_little_by_its_lag_and_is_of_second_order) {
  double before = 0.0;
  for (const double turn : {0.2, 0.1, 0.05}) {
    Oscillator body;
    const int n = static_cast<int>(std::lround(1.0 / turn));
    for (int i = 0; i < n; ++i) body.advance(TimeScheme::implicit(turn / body.frequency()));
    const double behind = n * turn - std::atan2(body.u * body.frequency(), body.v);
    EXPECT_NEAR(behind, n * TimeScheme::phase_lag(turn, false), 0.6 * turn * turn * behind) << turn;
    EXPECT_NEAR(behind, TimeScheme::frequency_lag(turn * turn, false), 0.6 * turn * turn * behind) << turn;
    if (before > 0.0) {
      EXPECT_NEAR(std::log2(before / behind), TimeScheme::order, 0.02) << turn;
    }
    before = behind;
  }
}

TEST(TimeScheme, damps_as_its_ratio_says) {
  Oscillator body;
  const double f = body.frequency() / (2.0 * std::numbers::pi);
  body.damping = {0.02 * body.frequency(), 0.01 / body.frequency()};
  EXPECT_NEAR(body.damping.ratio(f), 0.015, 1e-15);
  // Over whole half periods, at one phase of the motion.
  const int n = 3000;
  const double turn = 10.0 * std::numbers::pi / n, first = body.energy();
  for (int i = 0; i < n; ++i) body.advance(TimeScheme::implicit(turn / body.frequency()));
  const double lost = 2.0 * 0.015 * 10.0 * std::numbers::pi;
  EXPECT_NEAR(std::log(first / body.energy()), lost, 2e-3 * lost);
}

// Central differences, v at half steps and damping at the old one: bounded below the limit, without bound above it.
TEST(TimeScheme, knows_how_long_central_differences_stay_stable) {
  for (const double beta : {0.0, 2e-4}) {
    const Oscillator of;
    const double omega2 = of.stiffness / of.mass;
    const double longest = TimeScheme::longest_damped(TimeScheme::longest_of_central_differences(omega2), {0.0, beta});
    for (const double share : {0.99, 1.01}) {
      const double dt = share * longest;
      double u = 0.0, v = 1.0, largest = 0.0;
      for (int i = 0; i < 4000 && largest < 1e6; ++i) {
        v -= dt * omega2 * (u + beta * v);
        u += dt * v;
        largest = std::max(largest, std::abs(v));
      }
      EXPECT_EQ(largest < 100.0, share < 1.0) << beta << " " << share;
    }
  }
  EXPECT_TRUE(std::isinf(TimeScheme::longest_of_central_differences(0.0)));
  EXPECT_TRUE(std::isinf(TimeScheme::longest_damped(TimeScheme::longest_of_central_differences(0.0), {0.0, 1e-6})));
}

}  // namespace
}  // namespace dygita
