// A spring and a damper by hand: force, an oscillation, works, slope, what a release leaves, the springs of explicit
// steps.
#include <numbers>

#include "law/law_checks.hpp"

namespace dygita {
namespace {

LawPtr bushing(double normal, double tangential, double normal_damping = 0.0, double tangential_damping = 0.0,
               double loss = 0.0, double frequency = 0.0) {
  return make_law("bushing", {{"normal", normal},
                              {"tangential", tangential},
                              {"normal_damping", normal_damping},
                              {"tangential_damping", tangential_damping},
                              {"loss", loss},
                              {"frequency", frequency}});
}

TEST(Bushing, pulls_by_its_elongation_and_damps_the_mean_rate) {
  const double k = 3e9, k_t = 1e9, c = 4e6, c_t = 1e6;
  const LawPtr law = bushing(k, k_t, c, c_t);
  Trial t = trial({-1.0, 2.0, 0.5});
  t.jump = {2e-6, -1e-6, 3e-6};
  t.shortening = 5e-6;
  LawState start = law->initial();
  start.memory.vector(0) = Vec3(7e-6, -1e-6, 3e-6);
  start.rate = {0.3, -0.2, 0.1};
  for (const Increment& increment : {dynamic_step, Increment{TimeScheme::weighted(1e-6, 0.4)}, static_step}) {
    LawState before = start;
    if (increment.is_static) before.rate.setZero();
    const Vec3 f = law->force(t, increment, before);
    const LawState end = law->advance(t, increment, before, f);
    const Vec3 first = before.memory.vector(0), last = end.memory.vector(0), motion = motion_of(before, end, increment);
    EXPECT_LT((last - first - motion).norm(), 1e-12 * last.norm());
    Vec3 traction = Vec3(k, k_t, k_t).cwiseProduct(increment.mean(first, last));
    if (!increment.is_static) traction += Vec3(c, c_t, c_t).cwiseProduct(motion / increment.dt);
    EXPECT_LT((f - t.area * traction).norm(), 1e-12 * f.norm());
    const Work work = law->work(before, end, increment, t.area);
    const auto energy = [&](const Vec3& e) { return 0.5 * t.area * Vec3(k, k_t, k_t).dot(e.cwiseAbs2()); };
    EXPECT_NEAR(work.stored, energy(last) - energy(first), 1e-12 * energy(last));
    EXPECT_GE(work.damping, 0.0);
    if (!increment.dissipates()) {
      EXPECT_NEAR(work.stored + work.damping, f.dot(motion), 1e-12 * work.damping);
    }
  }
}

// A mass on it, dt/m as Y: frequency, decrement, and what is stored, moving and damped adds up to what there was.
TEST(Bushing, a_mass_on_it_swings_with_its_frequency_and_decrement) {
  const double m = 7.8e-3, k = 1e10, area = 1e-4, frequency = 1500.0, eta = 0.1;
  const double damping = eta * k / (2 * std::numbers::pi * frequency);
  const LawPtr law = bushing(k, 0.0, 0.0, 0.0, eta, frequency);
  EXPECT_NEAR(law->tangent(law->initial(), true).damping[0], damping, 1e-12 * damping);
  const double omega = std::sqrt(k * area / m), zeta = damping * area / (2 * m * omega);
  const double swing = omega * std::sqrt(1 - zeta * zeta), time = 1.3 * 2 * std::numbers::pi / omega, v = 2.0;
  double error = 0.0;
  for (const int n : {100, 200, 400}) {
    const Increment increment{TimeScheme::implicit(time / n)};
    LawState state = law->initial();
    state.rate[0] = v;
    double place = 0.0, damped = 0.0, stored = 0.0;
    for (int i = 0; i < n; ++i) {
      Trial t = trial(state.rate, {increment.dt / m, 0.0, 0.0});
      t.area = area;
      t.jump[0] = place;
      const LawState end = law->advance(t, increment, state, law->force(t, increment, state));
      const Work work = law->work(state, end, increment, area);
      damped += work.damping;
      stored += work.stored;
      place = end.memory.vector(0)[0];
      state = end;
    }
    EXPECT_NEAR(stored, 0.5 * k * area * place * place, 1e-12 * damped);
    EXPECT_NEAR(damped + stored + 0.5 * m * state.rate[0] * state.rate[0], 0.5 * m * v * v, 1e-12 * m * v * v);
    const double exact = v / swing * std::exp(-zeta * omega * time) * std::sin(swing * time);
    const double now = std::abs(place / exact - 1);
    if (error > 0.0) {
      EXPECT_NEAR(error / now, 4.0, 0.3);  // of second order
    }
    error = now;
  }
  EXPECT_LT(error, 1e-3);
}

TEST(Bushing, holds_in_a_static_step_what_has_a_stiffness) {
  const LawPtr law = bushing(1e9, 0.0, 0.0, 1e6);
  EXPECT_TRUE(law->acts_on(0, true));
  EXPECT_FALSE(law->acts_on(1, true));  // a damper alone
  EXPECT_TRUE(law->acts_on(1, false));
  EXPECT_FALSE(bushing(1e9, 0.0)->acts_on(1, false));
  EXPECT_EQ(law->force(trial({1e-6, 1e-6, 1e-6}), static_step, law->initial())[1], 0.0);
  EXPECT_NEAR(law->force(trial({1e-6, 0, 0}, {1e-8, 1e-8, 1e-8}), static_step, law->initial())[0],
              1e5 * 1e-6 / (1 + 1e5 * 1e-8), 1e-12);
}

// Where both sides have given rates there is no unknown.
TEST(Bushing, takes_given_rates_as_they_are) {
  const LawPtr law = bushing(1e9, 2e9);
  Trial t = trial({1e-6, 2e-6, 0.0}, {0.0, 0.0, 0.0});
  EXPECT_EQ(law->force(t, static_step, law->initial()), Vec3(0, 0, 0));
  t.is_given = {true, true, true};
  EXPECT_LT((law->force(t, static_step, law->initial()) - Vec3(0.1, 0.4, 0.0)).norm(), 1e-12);
}

TEST(Bushing, comes_to_a_bond_where_it_is_stiff) {
  Trial t = trial({1e-5, -2e-5, 1e-5}, {1e-8, 1e-8, 1e-8});
  t.jump = {1e-7, 2e-7, 0.0};
  t.shortening = 1e-6;
  const LawPtr bond = make_law("bonded"), law = bushing(1e18, 1e18);
  const Vec3 held = bond->force(t, static_step, bond->initial());
  EXPECT_LT((law->force(t, static_step, law->initial()) - held).norm(), 1e-5 * held.norm());
}

TEST(Bushing, is_a_spring_of_its_own_in_explicit_steps) {
  const LawPtr law = bushing(3e9, 1e9, 1e5);
  const ExplicitForm form = law->explicit_form();
  ASSERT_TRUE(form.springs && form.rates);
  EXPECT_EQ(form.rates->tangent({}, true).damping, Vec3(1e5, 0, 0));
  EXPECT_FALSE(bushing(3e9, 1e9)->explicit_form().rates);
  const double area = 1e-4;
  EXPECT_EQ(form.springs->stiffness(area, 1e12, 0.1), area * Vec3(3e9, 1e9, 1e9));  // whatever the penalty is
  LawState start = law->initial();
  start.memory.vector(0) = Vec3(-1e-6, 0, 0);
  SpringPoint point = spring_point(*law, start, area, 1.0);
  point.stiffness = form.springs->stiffness(area, 1e12, 0.1);
  for (const double x : {1e-6, 3e-6}) move_to(*law, {x, 2 * x, 0}, point);
  EXPECT_LT((point.now.force - Vec3(3e5 * 2e-6, 1e5 * 6e-6, 0)).norm(), 1e-12);
  EXPECT_EQ(form.springs->penalty_energy(point), 0.0);
  EXPECT_NEAR(form.springs->stored_energy(point.now, area), 0.5 * (3e5 * 4e-12 + 1e5 * 36e-12), 1e-18);
}

}  // namespace
}  // namespace dygita
