// A bond that yields along its normal: by hand, its slope, its limits, its springs.
#include "law/law_checks.hpp"

namespace dygita {
namespace {

const LawState fresh = make_law("plastic", {{"yield", 1.0}, {"hardening", 0.0}, {"compression", 0.0}})->initial();

// One point pulled by a displacement through a spring 1/Y: yield, unload, reload further, by hand.
TEST(Plastic, yields_unloads_and_reloads_as_by_hand) {
  const double area = 1e-4, yield = 1e6, hardening = 1e9, y = 1e-8;  // force = s/y, yield force 100 N
  const LawPtr law = plastic(yield, hardening, false);
  LawState state = law->initial();
  double jump = 0.0, work = 0.0;
  const auto pull = [&](double s) {
    Trial t = trial({s, 0, 0}, {y, y, y});
    t.area = area;
    t.jump = {jump, 0, 0};
    const Vec3 f = law->force(t, static_step, state);
    const LawState end = law->advance(t, static_step, state, f);
    work += law->work(state, end, static_step, area).plastic;
    state = end;
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
  EXPECT_NEAR(work, area * (yield * (opened + more) + 0.5 * hardening * std::pow(opened + more, 2)), 1e-15);
}

TEST(Plastic, yields_in_compression_only_when_asked) {
  const Trial t = trial({-1.0, 0, 0}, {1e-3, 1e-3, 1e-3});
  EXPECT_NEAR(plastic(1e6, 0, false)->force(t, static_step, fresh)[0], -1000.0, 1e-9);
  const LawPtr both = plastic(1e6, 0, true);
  const Vec3 f = both->force(t, static_step, fresh);
  EXPECT_NEAR(f[0], -100.0, 1e-9);
  const LawState end = both->advance(t, static_step, fresh, f);
  EXPECT_LT(end.plastic_opening, 0.0);
  EXPECT_GT(end.memory.scalar(0), 0.0);
}

// The force is continuous and monotone in s: compared with a finite difference away from the kinks.
TEST(Plastic, force_slope_is_the_hardening_slope_beyond_yield) {
  const double y = 1e-3, h = 1e9, area = 1e-4;
  const LawPtr law = plastic(1e6, h, false);
  const auto force = [&](double s) { return law->force(trial({s, 0, 0}, {y, y, y}), static_step, fresh)[0]; };
  const double slope = (force(1.0 + 1e-6) - force(1.0 - 1e-6)) / 2e-6;
  EXPECT_NEAR(slope, area * h / (1 + y * area * h), 1e-4 * slope);
  EXPECT_NEAR((force(0.05 + 1e-6) - force(0.05 - 1e-6)) / 2e-6, 1 / y, 1e-4 / y);
}

TEST(Plastic, is_bonded_below_yield) {
  const LawPtr law = plastic(1e12, 0, false), bond = make_law("bonded");
  const Trial t = trial({0.2, 0.1, -0.1});
  EXPECT_EQ(law->force(t, dynamic_step, fresh), bond->force(t, dynamic_step, {}));
}

TEST(Plastic, carries_no_more_than_it_yields_at_unless_it_hardens) {
  EXPECT_EQ(plastic(1e6, 0, false)->tension_limit().traction, 1e6);
  EXPECT_TRUE(std::isinf(plastic(1e6, 1e9, false)->tension_limit().traction));
  EXPECT_NEAR(plastic(1e6, 0, false)->force(trial({1e3, 0, 0}), static_step, fresh)[0], 1e6 * 1e-4, 1e-9);
}

// Springs stretch before they yield: less and less, the stiffer they are.
TEST(Plastic, its_springs_come_to_the_rigid_law) {
  const double area = 1e-4, yield = 1e6, hardening = 1e9, opening = 1e-6;
  const LawPtr law = plastic(yield, hardening, false);
  double before = 1.0;
  for (const double k : {1e9, 1e11, 1e13}) {
    SpringPoint point = spring_point(*law, law->initial(), area, k);
    move_to(*law, {opening, 0, 0}, point);
    const double error = std::abs(point.now.force[0] / (area * (yield + hardening * opening)) - 1);
    EXPECT_LT(error, 0.2 * before);
    EXPECT_EQ(point.now.status, PointState::slip);
    before = error;
  }
  EXPECT_LT(before, 1e-5);
}

}  // namespace
}  // namespace dygita
