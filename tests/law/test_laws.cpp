// Interface laws against hand solutions, their conditions and their limits.
#include <gtest/gtest.h>

#include <random>

#include "law/law.hpp"

namespace dygita {
namespace {

const Increment dynamic_step{1e-6, 0.5, false, 0.0};
const Increment static_step{};

Trial trial(const Vec3& s, const Vec3& y = Vec3(2e-3, 2e-3, 2e-3)) {
  Trial t;
  t.s = s;
  t.y = y;
  t.area = 1e-4;
  return t;
}

TEST(Contact, pulls_nothing_when_the_sides_part) {
  const ContactLaw law(0.3);
  EXPECT_EQ(law.force(trial({1.0, 5.0, 0.0}), dynamic_step, {}), Vec3(0, 0, 0));
}

TEST(Contact, pushes_back_what_closes) {
  const ContactLaw law(0.0);
  const Vec3 f = law.force(trial({-1.0, 0.0, 0.0}), dynamic_step, {});
  EXPECT_DOUBLE_EQ(f[0], -500.0);
  EXPECT_NEAR(law.advance(trial({-1.0, 0.0, 0.0}), dynamic_step, {}, f).rate[0], 0.0, 1e-15);
}

TEST(Contact, closes_an_open_gap_exactly_in_a_static_increment) {
  const ContactLaw law(0.0);
  LawState start;
  start.gap = 1e-3;
  const Trial t = trial({-3e-3, 0.0, 0.0});
  const Vec3 f = law.force(t, static_step, start);
  EXPECT_DOUBLE_EQ(f[0], -1.0);
  EXPECT_NEAR(law.advance(t, static_step, start, f).gap, 0.0, 1e-18);
}

TEST(Contact, does_not_throw_a_penetration_back_unless_asked) {
  const ContactLaw law(0.0);
  LawState start;
  start.gap = -1e-6;
  EXPECT_DOUBLE_EQ(law.force(trial({0.0, 0.0, 0.0}), dynamic_step, start)[0], 0.0);
  Increment pushing = dynamic_step;
  pushing.push_out = 0.1;
  EXPECT_NEAR(law.force(trial({0.0, 0.0, 0.0}), pushing, start)[0], -0.1 * 1e-6 / 1e-6 / 2e-3, 1e-9);
}

TEST(Contact, satisfies_signorini_and_coulomb_for_random_trials) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> in(-1.0, 1.0), positive(0.1, 5.0);
  for (int i = 0; i < 2000; ++i) {
    const double mu = positive(random) / 5.0;
    const ContactLaw law(mu);
    const Trial t = trial(Vec3(in(random), in(random), in(random)),
                          1e-3 * Vec3(positive(random), positive(random), positive(random)));
    const Vec3 f = law.force(t, dynamic_step, {});
    const LawState end = law.advance(t, dynamic_step, {}, f);
    ASSERT_LE(f[0], 0.0);
    ASSERT_GE(end.rate[0], -1e-14);
    ASSERT_NEAR(f[0] * end.rate[0], 0.0, 1e-12);
    const Eigen::Vector2d slip = end.rate.tail<2>(), rub = f.tail<2>();
    ASSERT_LE(rub.norm(), mu * std::abs(f[0]) * (1 + 1e-12));
    if (f[0] == 0.0) continue;
    if (slip.norm() > 1e-9) {  // slipping: on the disc, and along the force
      ASSERT_NEAR(rub.norm(), mu * std::abs(f[0]), 1e-9 * std::abs(f[0]));
      ASSERT_NEAR(slip.dot(rub), slip.norm() * rub.norm(), 1e-9 * slip.norm() * rub.norm());
    }
  }
}

TEST(Friction, radial_scaling_is_wrong_when_the_tangents_differ) {
  const DiscForce f = project_on_disc({1.0, 1.0}, {1e-3, 4e-3}, 100.0);
  EXPECT_NEAR(f.force.norm(), 100.0, 1e-9);
  EXPECT_NEAR(f.force[0] * (1e-3 + f.lambda), 1.0, 1e-9);
  EXPECT_NEAR(f.force[1] * (4e-3 + f.lambda), 1.0, 1e-9);
  const Eigen::Vector2d radial = Eigen::Vector2d(1000.0, 250.0).normalized() * 100.0;
  EXPECT_GT((f.force - radial).norm(), 10.0);
}

TEST(Friction, sticks_without_limit_and_slides_without_friction) {
  EXPECT_EQ(project_on_disc({1.0, 0.0}, {1e-3, 1e-3}, 1e9).lambda, 0.0);
  EXPECT_EQ(project_on_disc({1.0, 0.0}, {1e-3, 1e-3}, 0.0).force.norm(), 0.0);
  EXPECT_FALSE(ContactLaw(0.0).acts_on(1));
  EXPECT_TRUE(ContactLaw(0.1).acts_on(2));
}

TEST(Bonded, brings_the_jump_to_the_shortening) {
  const BondedLaw law;
  Trial t = trial({0.2, 0.1, -0.1});
  t.jump = {1e-6, 2e-6, 3e-6};
  t.shortening = 5e-6;
  const Vec3 f = law.force(t, static_step, {});
  const Vec3 rate = law.advance(t, static_step, {}, f).rate;
  EXPECT_NEAR((t.jump + rate - Vec3(-5e-6, 0, 0)).norm(), 0.0, 1e-15);
}

// One point pulled by a displacement through a spring 1/Y: yield, unload, reload further, by hand.
TEST(Plastic, yields_unloads_and_reloads_as_by_hand) {
  const double area = 1e-4, yield = 1e6, hardening = 1e9, y = 1e-8;  // force = s/y, yield force 100 N
  const PlasticLaw law(yield, hardening, false);
  LawState state;
  double jump = 0.0;
  const auto pull = [&](double s) {
    Trial t = trial({s, 0, 0}, {y, y, y});
    t.area = area;
    t.jump = {jump, 0, 0};
    const Vec3 f = law.force(t, static_step, state);
    state = law.advance(t, static_step, state, f);
    jump += state.rate[0];
    return f[0];
  };
  // Springs carry memory through s here: s is the free opening of the increment from the present jump.
  EXPECT_NEAR(pull(0.5e-6), 50.0, 1e-9);
  EXPECT_EQ(state.plastic_opening, 0.0);
  const double excess = 2e-6 - y * 100.0;
  const double opened = excess / (1 + y * area * hardening);
  EXPECT_NEAR(pull(2e-6), 100.0 + area * hardening * opened, 1e-9);
  EXPECT_NEAR(state.plastic_opening, opened, 1e-18);
  EXPECT_NEAR(pull(0.2e-6), 20.0, 1e-9);  // rigid unloading
  EXPECT_NEAR(state.plastic_opening, opened, 1e-18);
  EXPECT_NEAR(pull(-0.5e-6), -50.0, 1e-9);  // tension only
  const double limit = 100.0 + area * hardening * opened;
  const double more = (3e-6 - y * limit) / (1 + y * area * hardening);
  EXPECT_NEAR(pull(3e-6), limit + area * hardening * more, 1e-9);
  EXPECT_NEAR(law.plastic_work(state, area),
              area * (yield * (opened + more) + 0.5 * hardening * std::pow(opened + more, 2)), 1e-15);
}

TEST(Plastic, yields_in_compression_only_when_asked) {
  const Trial t = trial({-1.0, 0, 0}, {1e-3, 1e-3, 1e-3});
  EXPECT_NEAR(PlasticLaw(1e6, 0, false).force(t, static_step, {})[0], -1000.0, 1e-9);
  const PlasticLaw both(1e6, 0, true);
  const Vec3 f = both.force(t, static_step, {});
  EXPECT_NEAR(f[0], -100.0, 1e-9);
  const LawState end = both.advance(t, static_step, {}, f);
  EXPECT_LT(end.plastic_opening, 0.0);
  EXPECT_GT(end.hardening_opening, 0.0);
}

// The force is continuous and monotone in s: compared with a finite difference away from the kinks.
TEST(Plastic, force_slope_is_the_hardening_slope_beyond_yield) {
  const double y = 1e-3, h = 1e9, area = 1e-4;
  const PlasticLaw law(1e6, h, false);
  const auto force = [&](double s) { return law.force(trial({s, 0, 0}, {y, y, y}), static_step, {})[0]; };
  const double slope = (force(1.0 + 1e-6) - force(1.0 - 1e-6)) / 2e-6;
  EXPECT_NEAR(slope, area * h / (1 + y * area * h), 1e-4 * slope);
  EXPECT_NEAR((force(0.05 + 1e-6) - force(0.05 - 1e-6)) / 2e-6, 1 / y, 1e-4 / y);
}

}  // namespace
}  // namespace dygita
