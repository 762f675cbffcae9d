// Unilateral contact with friction: its conditions, its slope, its limits, its springs.
#include <random>

#include "law/friction_disc.hpp"
#include "law/law_checks.hpp"
#include "law/law_slope.hpp"

namespace dygita {
namespace {

TEST(Contact, pulls_nothing_when_the_sides_part) {
  const LawPtr law = contact(0.3);
  EXPECT_EQ(law->force(trial({1.0, 5.0, 0.0}), dynamic_step, {}), Vec3(0, 0, 0));
}

TEST(Contact, pushes_back_what_closes) {
  const LawPtr law = contact(0.0);
  const Vec3 f = law->force(trial({-1.0, 0.0, 0.0}), dynamic_step, {});
  EXPECT_DOUBLE_EQ(f[0], -500.0);
  EXPECT_NEAR(law->advance(trial({-1.0, 0.0, 0.0}), dynamic_step, {}, f).rate[0], 0.0, 1e-15);
}

TEST(Contact, closes_an_open_gap_exactly_in_a_static_increment) {
  const LawPtr law = contact(0.0);
  LawState start;
  start.gap = 1e-3;
  const Trial t = trial({-3e-3, 0.0, 0.0});
  const Vec3 f = law->force(t, static_step, start);
  EXPECT_DOUBLE_EQ(f[0], -1.0);
  EXPECT_NEAR(law->advance(t, static_step, start, f).gap, 0.0, 1e-18);
}

// Forces before and after -100 N, half of 4 mm of the way is through the interference.
TEST(Contact, is_given_the_work_that_presses_an_interference_out_and_no_more) {
  const LawPtr law = contact(0.3);
  LawState start, end;
  start.force[0] = end.force[0] = -100.0;
  end.rate[0] = 4e-3;
  start.gap = -2e-3;
  EXPECT_DOUBLE_EQ(law->work(start, end, static_step, 1.0).given, 0.2);
  start.gap = -1e-18;  // rounding
  EXPECT_NEAR(law->work(start, end, static_step, 1.0).given, 0.0, 1e-15);
}

TEST(Contact, takes_no_work_back_where_friction_turns_around_in_a_static_increment) {
  const LawPtr law = contact(0.3);
  LawState start, end;
  start.force = {-100.0, -30.0, 0.0};
  end.force = {-100.0, 10.0, 0.0};
  end.rate[1] = 1e-3;
  EXPECT_EQ(law->work(start, end, static_step, 1.0).friction, 0.0);
  start.force[1] = 10.0;
  EXPECT_DOUBLE_EQ(law->work(start, end, static_step, 1.0).friction, 0.01);
}

TEST(Contact, does_not_throw_a_penetration_back_unless_asked) {
  const LawPtr law = contact(0.0);
  LawState start;
  start.gap = -1e-6;
  EXPECT_DOUBLE_EQ(law->force(trial({0.0, 0.0, 0.0}), dynamic_step, start)[0], 0.0);
  Increment pushing = dynamic_step;
  pushing.push_out = 0.1;
  EXPECT_NEAR(law->force(trial({0.0, 0.0, 0.0}), pushing, start)[0], -0.1 * 1e-6 / 1e-6 / 2e-3, 1e-9);
}

TEST(Contact, satisfies_signorini_and_coulomb_for_random_trials) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> in(-1.0, 1.0), positive(0.1, 5.0);
  for (int i = 0; i < 2000; ++i) {
    const double mu = positive(random) / 5.0;
    const LawPtr law = contact(mu);
    const Trial t = trial(Vec3(in(random), in(random), in(random)),
                          1e-3 * Vec3(positive(random), positive(random), positive(random)));
    const Vec3 f = law->force(t, dynamic_step, {});
    const LawState end = law->advance(t, dynamic_step, {}, f);
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
  EXPECT_FALSE(contact(0.0)->acts_on(1, false));
  EXPECT_TRUE(contact(0.1)->acts_on(2, false));
}

// Stick: 1/Y in all directions. Slip: the friction force follows the normal one. Open: nothing.
TEST(Contact, has_the_slope_of_its_state) {
  const LawPtr law = contact(0.3);
  const double y = 2e-3;
  const Mat3 stick = slope(*law, trial({-1.0, 0.1, 0.0}), dynamic_step, {}, 1e-6);
  EXPECT_LT((stick - Mat3::Identity() / y).norm(), 1e-6 / y);
  const Mat3 slip = slope(*law, trial({-1.0, 5.0, 0.0}), dynamic_step, {}, 1e-6);
  EXPECT_NEAR(slip(0, 0), 1 / y, 1e-6 / y);
  EXPECT_NEAR(slip(1, 0), -0.3 / y, 1e-6 / y);  // more pressure, more friction
  EXPECT_NEAR(slip(1, 1), 0.0, 1e-6 / y);
  EXPECT_NEAR(slip(2, 2), 0.3 * 1.0 / (5.0 * y), 1e-6 / y);  // the force turns with s
  EXPECT_EQ(slope(*law, trial({1.0, 5.0, 0.0}), dynamic_step, {}, 1e-6), Mat3(Mat3::Zero()));
}

// To first order  dF = C d rate + following dF_N,  d rate = d s - Y dF, with tangents that differ; nothing follows
// where it sticks or is open.
TEST(Contact, tells_how_its_friction_follows_the_normal_force) {
  const LawPtr law = contact(0.3);
  const Increment increment = static_step;
  const Vec3 y(2e-3, 3e-3, 3e-3);
  const auto limited_slope = [&](const Trial& t) { return slope_of(*law, t, increment, {}, &t.s[0], 1e-6); };
  std::mt19937 random(11);
  std::uniform_real_distribution<double> in(-1.0, 1.0);
  int n_slip = 0;
  for (int i = 0; i < 300; ++i) {
    const Trial t = trial(Vec3(in(random), in(random), in(random)), y);
    const Vec3 force = law->force(t, increment, {});
    const Mat3 stiffness = stiffness_of(limited_slope(t), y, false, {1e9, 1e-12});
    const Vec3 following = following_of(slope_of(*law, t, increment, {}, nullptr, 1e-6), stiffness, y);
    if (force[0] == 0.0 || force.tail<2>().norm() < 0.3 * std::abs(force[0]) * (1 - 1e-9)) {
      EXPECT_EQ(following.cwiseAbs().maxCoeff(), 0.0);
      continue;
    }
    ++n_slip;
    Trial moved = t;
    moved.s += 1e-7 * Vec3(in(random), in(random), in(random));
    const Vec3 change = law->force(moved, increment, {}) - force;
    const Vec3 rate = moved.s - t.s - y.cwiseProduct(change);
    const Vec3 told = stiffness * rate + following * change[0];
    // The normal rate of what is closed is zero, and its stiffness as large as one likes.
    EXPECT_LT((told - change).tail<2>().norm(), 1e-3 * change.norm()) << i;
  }
  EXPECT_GT(n_slip, 50);
}

// 1 / Y = 500 N s/m: pressed by 500 N, so that friction is 150 N at most.
Trial given(const Vec3& s, std::array<bool, 2> tangents) {
  Trial t = trial(s);
  for (int d = 1; d < 3; ++d)
    if ((t.is_given[d] = tangents[d - 1])) t.y[d] = 0.0;
  return t;
}

TEST(Contact, slides_as_it_is_driven_where_both_sides_are_held) {
  const LawPtr law = contact(0.3);
  for (const double size : {1e-12, 1.0, 1e6}) {
    const Trial t = given({-1.0, 3.0 * size, -4.0 * size}, {true, true});
    const Vec3 f = law->force(t, dynamic_step, {});
    EXPECT_LT((f - Vec3(-500.0, 90.0, -120.0)).norm(), 1e-9);
    const LawState end = law->advance(t, dynamic_step, {}, f);
    EXPECT_EQ(end.status, PointState::slip);
    EXPECT_EQ(end.rate.tail<2>(), t.s.tail<2>());
    EXPECT_NEAR(law->work({}, end, dynamic_step, t.area).friction, 150.0 * 0.5e-6 * 5.0 * size, 1e-15 * size);
  }
  EXPECT_EQ(law->force(given({1.0, 3.0, -4.0}, {true, true}), dynamic_step, {}), Vec3(0, 0, 0));
  EXPECT_EQ(contact(0.0)->force(given({-1.0, 3.0, -4.0}, {true, true}), dynamic_step, {}).tail<2>(),
            Eigen::Vector2d(0, 0));
}

// What is held and rests carries what it carried, but no more than the disc allows.
TEST(Contact, keeps_the_friction_that_there_was_where_both_sides_rest) {
  const LawPtr law = contact(0.3);
  LawState start;
  start.force = {-500.0, 60.0, 80.0};
  EXPECT_EQ(law->force(given({-1.0, 0.0, 0.0}, {true, true}), dynamic_step, start), start.force);
  const Vec3 less = law->force(given({-0.5, 0.0, 0.0}, {true, true}), dynamic_step, start);
  EXPECT_LT((less - Vec3(-250.0, 45.0, 60.0)).norm(), 1e-9);
}

// One tangent is driven, the other one free: along both the slip rate is along the force.
TEST(Contact, slides_across_the_way_it_is_driven_as_its_other_tangent_is_pulled) {
  const LawPtr law = contact(0.3);
  for (const double pull : {0.0, 0.1, 0.4, 50.0}) {
    const Trial t = given({-1.0, 2.0, pull}, {true, false});
    const Vec3 f = law->force(t, dynamic_step, {});
    const LawState end = law->advance(t, dynamic_step, {}, f);
    EXPECT_NEAR(f.tail<2>().norm(), 150.0, 1e-9);
    EXPECT_EQ(end.rate[1], 2.0);
    EXPECT_NEAR(f[1] * end.rate[2], f[2] * end.rate[1], 1e-9 * 150.0 * (2.0 + pull));
  }
  LawState start;
  start.force = {-500.0, 140.0, 0.0};
  const Vec3 sticks = law->force(given({-1.0, 0.0, 0.2}, {true, false}), dynamic_step, start);  // 100 N of 150 N
  EXPECT_LT((sticks - Vec3(-500.0, std::sqrt(150.0 * 150.0 - 100.0 * 100.0), 100.0)).norm(), 1e-9);
  const Vec3 slides = law->force(given({-1.0, 0.0, 0.5}, {true, false}), dynamic_step, start);
  EXPECT_LT((slides - Vec3(-500.0, 0.0, 150.0)).norm(), 1e-9);
}

TEST(Contact, is_for_small_motions_what_its_state_is) {
  LawState state;
  state.status = PointState::open;
  const auto n_held = [&](const LawPtr& law, bool ties_sliding) {
    const Tangent tangent = law->tangent(state, ties_sliding);
    EXPECT_EQ(tangent.holds[1], tangent.holds[2]);
    return tangent.holds[0] + tangent.holds[1] + tangent.holds[2];
  };
  EXPECT_EQ(n_held(contact(0.3), true), 0);
  state.status = PointState::stick;
  EXPECT_EQ(n_held(contact(0.3), false), 3);
  state.status = PointState::slip;
  EXPECT_EQ(n_held(contact(0.3), false), 1);
  EXPECT_EQ(n_held(contact(0.3), true), 3);
  EXPECT_EQ(n_held(contact(0.0), true), 1);
}

TEST(Contact, dissipates_by_friction_what_slides) {
  const LawPtr law = contact(0.3);
  const Trial t = trial({-1.0, 5.0, 0.0});
  const Vec3 f = law->force(t, dynamic_step, {});
  const LawState end = law->advance(t, dynamic_step, {}, f);
  const Work work = law->work({}, end, dynamic_step, t.area);
  EXPECT_NEAR(work.friction, 0.3 * 500.0 * 0.5e-6 * end.rate[1], 1e-12 * work.friction);
  EXPECT_EQ(work.plastic, 0.0);
  EXPECT_EQ(work.damping, 0.0);
}

// Ever stiffer springs press as the conditions do: a block pushed onto a wall and dragged along it.
TEST(Contact, its_springs_come_to_its_conditions) {
  const LawPtr law = contact(0.3);
  double before = 1.0;
  for (const double k : {1e6, 1e8, 1e10}) {
    const double pressed = 100.0, dragged = 1e-3;
    SpringPoint point = spring_point(*law, law->initial(), 1e-4, k);
    move_to(*law, {-pressed / k, 0, 0}, point);
    move_to(*law, {-pressed / k, dragged, 0}, point);
    EXPECT_NEAR(point.now.force[0], -pressed, 1e-9 * pressed);
    EXPECT_NEAR(point.now.force[1], 0.3 * pressed, 1e-9 * pressed);
    const double short_by = dragged - point.now.slip[1];  // what the spring gives way instead of sliding
    EXPECT_NEAR(short_by, 0.3 * pressed / k, 1e-12);
    EXPECT_NEAR(point.friction_work, 0.3 * pressed * point.now.slip[1], 1e-12);
    EXPECT_LT(short_by, before);
    before = short_by;
  }
}

TEST(Contact, goes_on_pressing_in_an_explicit_step_as_it_did) {
  LawState start;
  start.force = {-50.0, 0, 0};
  start.status = PointState::stick;
  const LawPtr law = contact(0.3);
  SpringPoint point = spring_point(*law, start, 1e-4, 1e8);
  move_to(*law, Vec3::Zero(), point);
  EXPECT_NEAR(point.now.force[0], -50.0, 1e-9);
}

}  // namespace
}  // namespace dygita
