// Rough faces by hand: springs in series, asperities under pressure, a bounce, Mindlin's slope and friction's limit,
// the books of any path, explicit steps.
#include <random>

#include "law/law_checks.hpp"
#include "law/rough_contact.hpp"

namespace dygita {
namespace {

constexpr double of_area = 1e-4;

LawPtr rough(LawArguments of, double friction = 0.0, double gap = 0.0) {
  of["friction"] = friction;
  of["gap"] = gap;
  return make_law("contact", of);
}
const LawArguments tips = {{"coefficient", 1e20}, {"height", 28e-6}, {"ratio", 0.82}};
const LawArguments spring = {{"normal", 5e12}, {"tangential", 3e12}};
const LawArguments curve = {
    {"approach[1]", 2e-6}, {"pressure[1]", 1e6}, {"approach[2]", 5e-6}, {"pressure[2]", 9e6}, {"ratio", 0.82}};

double pressure_of_tips(double d) { return 1e20 * (std::pow(d, 2.5) - (d > 28e-6 ? std::pow(d - 28e-6, 2.5) : 0.0)); }

// The state of a point that a static increment has brought to an approach.
LawState pressed(const Law& law, double approach, const Vec3& moved = Vec3::Zero(), const LawState* before = nullptr) {
  const LawState start = before ? *before : law.initial();
  Trial t = trial(Vec3::Zero(), Vec3::Zero());
  t.is_given = {true, true, true};
  t.s = moved;
  t.s[0] = -approach - start.gap;
  return law.advance(t, static_step, start, law.force(t, static_step, start));
}

TEST(RoughContact, is_a_spring_in_series) {
  const LawPtr law = rough(spring, 0.0, 1e-6);
  const Trial t = trial({-5e-6, 0, 0}, {2e-9, 0, 0});  // 2e-9 m/N are two bodies
  const double force = law->force(t, static_step, law->initial())[0];
  EXPECT_NEAR(force, -4e-6 / (2e-9 + 1 / (of_area * 5e12)), 1e-12 * std::abs(force));
  EXPECT_EQ(law->force(trial({-1e-6, 0, 0}, {2e-9, 0, 0}), static_step, law->initial())[0], 0.0);
}

TEST(RoughContact, carries_what_its_tips_do_at_any_approach) {
  const LawPtr law = rough(tips);
  for (const double d : {1e-8, 1e-6, 6.9e-6, 27e-6, 40e-6}) {
    const double force = of_area * pressure_of_tips(d), y = 1e-9;
    const Trial t = trial({-d - y * force, 0, 0}, {y, 0, 0});
    EXPECT_NEAR(law->force(t, static_step, law->initial())[0], -force, 1e-11 * force) << d;
  }
  // The published ones carry 12.8 MPa at 6.9 um, with a slope of 4.6e12 Pa/m.
  const double modulus = 192.31e9 / (2 * (1 - 0.09));
  const double c = coefficient_of_asperities(1.365e-3, 1.371e6, modulus, 28e-6);
  EXPECT_NEAR(c, 1.02e20, 0.01e20);
  const double approach = std::pow(12.8e6 / c, 0.4);
  EXPECT_NEAR(approach, 6.9e-6, 0.05e-6);
  const LawPtr published = rough({{"coefficient", c}, {"height", 28e-6}, {"ratio", 0.82}}, 0.2);
  const Tangent tangent = published->tangent(pressed(*published, approach), true);
  EXPECT_NEAR(tangent.stiffness[0], 2.5 * 12.8e6 / approach, 1e-6 * 5e12);
  EXPECT_NEAR(tangent.stiffness[0], 4.6e12, 0.05e12);
  EXPECT_NEAR(tangent.stiffness[1], 0.82 * tangent.stiffness[0], 1.0);
}

TEST(RoughContact, follows_its_curve_and_goes_on_straight) {
  const LawPtr law = rough(curve);
  for (const auto& [d, p] : std::vector<std::pair<double, double>>{{1e-6, 0.5e6}, {3.5e-6, 5e6}, {8e-6, 17e6}})
    EXPECT_NEAR(pressed(*law, d).force[0], -of_area * p, 1e-9 * of_area * p) << d;
}

// dt/m as Y: it comes back as fast as it came, having gone as deep as its energy asks for, whatever the step.
TEST(RoughContact, throws_a_mass_back_as_fast_as_it_came) {
  constexpr double m = 7.8e-3, v = 0.5;
  for (const LawArguments& of : {tips, spring, curve}) {
    const LawPtr law = rough(of, 0.0, 3e-6);
    for (const double dt : {1e-7, 1e-6, 5e-6}) {
      const Increment increment{TimeScheme::implicit(dt)};
      LawState state = law->initial();
      state.rate[0] = -v;
      double deepest = 0.0, stored = 0.0;
      for (int i = 0; i < 2000 && (i < 5 || state.gap < 3e-6); ++i) {
        const Trial t = trial(state.rate, {dt / m, 0.0, 0.0});
        const LawState end = law->advance(t, increment, state, law->force(t, increment, state));
        stored += law->work(state, end, increment, of_area).stored;
        EXPECT_NEAR(stored + 0.5 * m * end.rate[0] * end.rate[0], 0.5 * m * v * v, 1e-10 * m * v * v);
        deepest = std::max(deepest, -end.gap);
        state = end;
      }
      EXPECT_NEAR(state.rate[0], v, 1e-9 * v);
      if (!of.contains("coefficient") || dt > 1e-7) continue;
      // 1/2 m v^2 = A c d^3.5/3.5, less what is beyond the height.
      double low = 0.0, high = 1e-3;
      for (int k = 0; k < 100; ++k) {
        const double d = 0.5 * (low + high), beyond = std::max(0.0, d - 28e-6);
        (of_area * 1e20 / 3.5 * (std::pow(d, 3.5) - std::pow(beyond, 3.5)) < 0.5 * m * v * v ? low : high) = d;
      }
      EXPECT_NEAR(deepest, low, 2e-3 * low);
    }
  }
}

TEST(RoughContact, gives_way_along_the_tangents_by_Mindlins_slope_until_it_slides) {
  const LawPtr law = rough(tips, 0.2);
  const double d = 6.9e-6, p = pressure_of_tips(d), slope = 0.82 * 2.5 * p / d, most = 0.2 * p / slope;
  const LawState start = pressed(*law, d);
  for (const double share : {0.3, 0.99, 1.5, 4.0}) {
    const LawState end = pressed(*law, d, {0, 0.6 * share * most, -0.8 * share * most}, &start);
    const double traction = std::min(1.0, share) * 0.2 * p;
    EXPECT_LT((end.force.tail<2>() - of_area * traction * Eigen::Vector2d(0.6, -0.8)).norm(), 1e-9 * of_area * p)
        << share;
    EXPECT_EQ(end.status, share > 1.0 ? PointState::slip : PointState::stick);
    const Work work = law->work(start, end, static_step, of_area);
    EXPECT_NEAR(work.friction, of_area * 0.2 * p * std::max(0.0, share - 1.0) * most, 1e-9 * of_area * p * most);
  }
  // With unlike search directions along the tangents the end is on the limit, the slip along the force.
  Trial t = trial({0, 3 * most, most}, {0, 1e-9, 5e-9});
  t.is_given[0] = true;
  const Vec3 force = law->force(t, static_step, start);
  const LawState end = law->advance(t, static_step, start, force);
  EXPECT_NEAR(force.tail<2>().norm(), of_area * 0.2 * p, 1e-9 * of_area * p);
  const Eigen::Vector2d slid = end.rate.tail<2>() - end.memory.vector(0).tail<2>();
  EXPECT_NEAR(slid.dot(force.tail<2>()), slid.norm() * force.tail<2>().norm(), 1e-9 * slid.norm() * of_area * p);
}

// Asperities that first touch are not stretched; below the largest approach traction and slope go together.
TEST(RoughContact, adds_traction_by_the_slope_at_hand) {
  const LawPtr law = rough(tips, 10.0);
  const auto slope = [](double d) { return 0.82 * 2.5 * pressure_of_tips(d) / d; };
  const double s = 1e-8;
  LawState state = pressed(*law, 2e-6);
  state = pressed(*law, 2e-6, {0, s, 0}, &state);
  state = pressed(*law, 4e-6, {0, 0, 0}, &state);
  EXPECT_NEAR(state.force[1], of_area * slope(2e-6) * s, 1e-9 * of_area * slope(2e-6) * s);
  state = pressed(*law, 4e-6, {0, s, 0}, &state);
  const double loaded = of_area * (slope(2e-6) + slope(4e-6)) * s;
  EXPECT_NEAR(state.force[1], loaded, 1e-9 * loaded);
  state = pressed(*law, 3e-6, {0, 0, 0}, &state);
  EXPECT_NEAR(state.force[1], loaded * slope(3e-6) / slope(4e-6), 1e-9 * loaded);
  state = pressed(*law, 4e-6, {0, 0, 0}, &state);
  EXPECT_NEAR(state.force[1], loaded, 1e-9 * loaded);
  state = pressed(*law, -1e-6, {0, 0, 0}, &state);
  EXPECT_EQ(law->tangent(state, true).stiffness, Vec3(0, 0, 0));
  EXPECT_EQ(pressed(*law, 4e-6, {0, 0, 0}, &state).force[1], 0.0);
}

// Any path in time: what the force works is stored or rubs, to rounding, and friction never gives.
TEST(RoughContact, stores_or_loses_exactly_what_works_on_it) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (const LawArguments& of : {tips, spring, curve})
    for (const double g : {0.5, 0.4}) {
      const LawPtr law = rough(of, 0.4);
      const Increment increment{TimeScheme::weighted(1e-6, g)};
      LawState state = pressed(*law, 4e-6);
      double worked = 0.0, booked = 0.0, rubbed = 0.0;
      for (int i = 0; i < 4000; ++i) {
        Trial t = trial({3.0 * any(random), 3.0 * any(random), 3.0 * any(random)}, {1e-3, 2e-3, 5e-3});
        t.s[0] -= 0.4;
        const LawState end = law->advance(t, increment, state, law->force(t, increment, state));
        const Work work = law->work(state, end, increment, of_area);
        const double own = end.force.dot(motion_of(state, end, increment)), size = end.force.norm() * 1e-6;
        if (g == 0.5) {
          EXPECT_NEAR(own, work.stored + work.friction, 1e-9 * size);
        } else {
          EXPECT_GE(own, work.stored + work.friction - 1e-9 * size);
        }
        EXPECT_GE(work.friction, -1e-12 * size);
        EXPECT_LE(end.force.tail<2>().norm(), 0.4 * std::abs(end.force[0]) * (1 + 1e-9));
        EXPECT_EQ(work.given, 0.0);
        worked += own;
        booked += work.stored + work.friction;
        rubbed += work.friction;
        state = end;
      }
      EXPECT_GT(rubbed, 0.1 * worked);
    }
}

TEST(RoughContact, is_the_same_spring_in_explicit_steps) {
  for (const LawArguments& of : {tips, spring, curve}) {
    const LawPtr law = rough(of, 0.2);
    const ExplicitForm form = law->explicit_form();
    ASSERT_TRUE(form.springs);
    const double d = 4e-6;
    const LawState start = pressed(*law, d);
    SpringPoint point;
    point.area = of_area;
    point.start = point.now = start;
    point.stiffness = form.springs->stiffness(of_area, 1e10, 0.1);
    form.springs->begin(point);
    move_to(*law, {0, 0, 0}, point);
    EXPECT_LT((point.now.force - start.force).norm(), 1e-12 * start.force.norm());
    const double before = form.springs->stored_energy(point.now, of_area);
    double worked = 0.0;
    constexpr int n = 20000;
    const auto path = [&](int i) { return Vec3(-1e-6 * i / n, 2e-6 * i / n, -1e-6 * i / n); };
    for (int i = 0; i < n; ++i) {
      const Vec3 f = point.now.force;
      move_to(*law, path(i + 1), point);
      worked += 0.5 * (f + point.now.force).dot(path(i + 1) - path(i));
    }
    EXPECT_NEAR(point.now.force[0], pressed(*law, d + 1e-6).force[0], 1e-9 * start.force.norm());
    EXPECT_NEAR(point.now.force.tail<2>().norm(), 0.2 * -point.now.force[0], 1e-9 * start.force.norm());
    const double stored = form.springs->stored_energy(point.now, of_area) - before;
    EXPECT_NEAR(worked, stored + point.friction_work, 2e-3 * worked);
    EXPECT_GT(point.friction_work, 0.0);
    EXPECT_EQ(form.springs->penalty_energy(point), 0.0);
  }
}

// Asperities grow stiffer without limit, an explicit step does not: beyond the cells' stiffness they are straight.
TEST(RoughContact, is_bounded_by_the_cells_in_explicit_steps) {
  const LawPtr law = rough(tips);
  SpringPoint point = spring_point(*law, law->initial(), of_area, of_area * 2.5 * pressure_of_tips(5e-6) / 5e-6);
  const double slope = point.stiffness[0] / of_area;
  EXPECT_NEAR(point.offset, 5e-6, 1e-12);
  move_to(*law, {-9e-6, 0, 0}, point);
  const double p = pressure_of_tips(5e-6);
  EXPECT_NEAR(point.now.force[0], -of_area * (p + slope * 4e-6), 1e-9 * of_area * p);
  const double exact = of_area * (p * 5e-6 / 3.5 + p * 4e-6 + 0.5 * slope * 16e-12);
  const PenaltyForm& form = *law->explicit_form().springs;
  EXPECT_NEAR(form.stored_energy(point.now, of_area) + form.penalty_energy(point), exact, 1e-9 * exact);
}

}  // namespace
}  // namespace dygita
