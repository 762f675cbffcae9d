// A damper by hand: its force, its decay, the work it takes, its slope, its limits.
#include "law/law_checks.hpp"

namespace dygita {
namespace {

LawPtr viscous(double normal, double tangential) {
  return make_law("viscous", {{"normal", normal}, {"tangential", tangential}});
}

TEST(Viscous, has_the_force_of_the_mean_rate) {
  const LawPtr law = viscous(4e6, 1e6);
  const Trial t = trial({-1.0, 2.0, 0.5});
  LawState start;
  start.rate = {0.3, -0.2, 0.1};
  for (const double g : {0.5, 0.4, 0.0}) {
    const Increment increment{TimeScheme::weighted(1e-6, g)};
    const Vec3 f = law->force(t, increment, start);
    const LawState end = law->advance(t, increment, start, f);
    const Vec3 mean = g * start.rate + (1 - g) * end.rate;
    EXPECT_LT((f - t.area * Vec3(4e6, 1e6, 1e6).cwiseProduct(mean)).norm(), 1e-12 * f.norm());
    EXPECT_NEAR(law->work(start, end, increment, t.area).damping, f.dot(1e-6 * mean), 1e-18);
    EXPECT_GT(law->work(start, end, increment, t.area).damping, 0.0);
  }
}

// Two free masses, as search directions: Y = dt/m + dt/m', s the rate without force. The rate decays as exp(-c A t/m*).
TEST(Viscous, two_masses_lose_their_relative_velocity_exponentially) {
  const double m_1 = 2e-3, m_2 = 6e-3, reduced = m_1 * m_2 / (m_1 + m_2), c = 2e6, area = 1e-4;
  const double time = 2 * reduced / (c * area);
  const LawPtr law = viscous(c, 0.0);
  double error = 0.0;
  for (const int n : {10, 20, 40}) {
    const Increment increment{TimeScheme::implicit(time / n)};
    LawState state;
    state.rate = {5.0, 1.0, 0.0};
    double work = 0.0;
    for (int i = 0; i < n; ++i) {
      const double y = increment.dt / reduced;
      Trial t = trial(state.rate, {y, 0.0, 0.0});
      t.area = area;
      const LawState end = law->advance(t, increment, state, law->force(t, increment, state));
      work += law->work(state, end, increment, area).damping;
      state = end;
    }
    EXPECT_NEAR(work, 0.5 * reduced * (25.0 - state.rate[0] * state.rate[0]), 1e-12 * work);
    EXPECT_EQ(state.rate[1], 1.0);  // no force, no change
    const double now = std::abs(state.rate[0] / (5.0 * std::exp(-2.0)) - 1);
    if (error > 0.0) {
      EXPECT_NEAR(error / now, 4.0, 0.2);  // of second order
    }
    error = now;
  }
  EXPECT_LT(error, 1e-3);
}

TEST(Viscous, pulls_as_it_pushes) {
  const LawPtr law = viscous(4e6, 1e6);
  const Trial t = trial({-1.0, 2.0, 0.5});
  Trial other = t;
  other.s = -t.s;
  EXPECT_EQ(law->force(t, dynamic_step, {}), Vec3(-law->force(other, dynamic_step, {})));
}

TEST(Viscous, has_the_slope_of_its_coefficients) {
  const double c = 4e6, c_t = 1e6, area = 1e-4, y = 2e-3;
  const auto expected = [&](double k) { return 0.5 * area * k / (1 + 0.5 * area * k * y); };
  const Mat3 found = slope(*viscous(c, c_t), trial({-1.0, 2.0, 0.5}), dynamic_step, {}, 1e-3);
  EXPECT_LT((found - Vec3(expected(c), expected(c_t), expected(c_t)).asDiagonal().toDenseMatrix()).norm(), 1e-6);
  EXPECT_EQ(viscous(c, c_t)->tangent({}, true).damping, Vec3(c, c_t, c_t));
}

// Without a coefficient there is no force; with a huge one the mean rate is zero, as of a bond.
TEST(Viscous, lies_between_free_and_bonded) {
  const Trial t = trial({-1.0, 2.0, 0.5});
  EXPECT_FALSE(viscous(0.0, 0.0)->takes_part(false));
  EXPECT_EQ(viscous(0.0, 0.0)->force(t, dynamic_step, {}), Vec3(0, 0, 0));
  EXPECT_EQ(viscous(4e6, 0.0)->force(t, dynamic_step, {}).tail<2>(), Eigen::Vector2d(0, 0));
  const LawPtr stiff = viscous(1e18, 1e18);
  const Vec3 f = stiff->force(t, dynamic_step, {});
  EXPECT_LT(stiff->advance(t, dynamic_step, {}, f).rate.norm(), 1e-9);
}

TEST(Viscous, damps_the_rate_that_both_held_sides_are_given) {
  Trial t = trial({-1.0, 2.0, 0.5});
  t.y.setZero();
  t.is_given = {true, true, false};
  LawState start;
  start.rate = {1.0, 1.0, 1.0};
  EXPECT_EQ(viscous(4e6, 1e6)->force(t, dynamic_step, start), Vec3(0.0, 1e2 * 1.5, 0.0));
}

TEST(Viscous, holds_nothing_in_a_static_step) {
  const LawPtr law = viscous(4e6, 1e6);
  EXPECT_FALSE(law->takes_part(true));
  EXPECT_EQ(law->force(trial({-1.0, 2.0, 0.5}), static_step, {}), Vec3(0, 0, 0));
  EXPECT_FALSE(law->can_be_tightened());
}

}  // namespace
}  // namespace dygita
