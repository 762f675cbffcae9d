// The classic solvers by themselves, on two cubes.
#include <gtest/gtest.h>

#include <cmath>

#include "marching/solve.hpp"
#include "reference/explicit.hpp"
#include "reference/monolithic.hpp"
#include "step/blocks.hpp"

namespace dygita::reference_tests {
namespace {

constexpr double reference_dt = 0.4e-6;

Watcher run_latin(Problem problem) {
  problem.monolithic.reset();
  problem.explicit_dynamics.reset();
  Watcher recorder;
  solve(problem, recorder);
  return recorder;
}
Watcher run_monolithic(Problem problem) {
  problem.monolithic = MonolithicSettings{};
  problem.monolithic->tolerance = 1e-12;
  Watcher recorder;
  solve_monolithic(problem, recorder);
  return recorder;
}
Watcher run_explicit(Problem problem) {
  problem.explicit_dynamics = ExplicitSettings{};
  problem.explicit_dynamics->one_point = problem.explicit_dynamics->bulk_viscosity = false;
  Watcher recorder;
  solve_explicit(problem, recorder);
  return recorder;
}

// A blow on top that also pushes sideways, on what a static step has pressed down.
std::vector<StepPtr> press_and_strike(const Problem& of, int n) {
  const Face top = top_of(of);
  const StepPtr press = static_step("press", 2, {number("pressure", {top}, 50e6)});
  return {press, dynamic_step("strike", n, reference_dt,
                              {load("pressure", {top}, History::constant(50e6)),
                               load("traction", {top}, History::half_sine(60e6, 8e-6), 0)},
                              press)};
}

void expect_that_both_agree(LawPtr law, bool slides) {
  Problem problem = two_cubes(std::move(law), {});
  problem.steps = press_and_strike(problem, 30);
  const Watcher latin = run_latin(problem), whole = run_monolithic(problem);
  ASSERT_EQ(whole.rows.size(), 32U);
  for (const Watcher::Row& row : latin.rows) EXPECT_TRUE(row.converged);
  EXPECT_LT(displacement_difference(latin, whole), 1e-7);
  EXPECT_LT(velocity_difference(latin, whole), 1e-6);
  const Energies &one = latin.rows.back().energies, &other = whole.rows.back().energies;
  EXPECT_NEAR(one.kinetic + one.strain, other.kinetic + other.strain, 1e-6 * (other.kinetic + other.strain));
  EXPECT_NEAR(one.friction, other.friction, 1e-5 * other.loads);
  EXPECT_NEAR(one.plastic, other.plastic, 1e-5 * other.loads);
  EXPECT_NEAR(other.balance(), 0.0, 1e-9 * other.loads);
  EXPECT_EQ(other.friction + other.plastic > 1e-3 * other.loads, slides);
}

TEST(Monolithic, is_what_latin_converges_to_where_two_blocks_are_bonded) { expect_that_both_agree(bonded(), false); }
TEST(Monolithic, is_what_latin_converges_to_where_two_blocks_slide) { expect_that_both_agree(contact(0.2), true); }
TEST(Monolithic, is_what_latin_converges_to_where_an_interface_yields) {
  expect_that_both_agree(plastic(30e6, 1e12, true), true);
}

TEST(Monolithic, keeps_the_energy_of_a_free_flight) {
  Problem problem = two_cubes(contact(0.0, 1e-3), {});
  std::const_pointer_cast<Substructure>(problem.substructures[1])->velocity = {1.0, -2.0, 3.0};
  problem.steps = {dynamic_step("fly", 20, reference_dt, {})};
  const Watcher flight = run_monolithic(problem);
  const double mass = 7800.0 * 1e-6, kinetic = 0.5 * mass * 14.0;
  for (const Watcher::Row& row : flight.rows) {
    EXPECT_NEAR(row.energies.kinetic, kinetic, 1e-12 * kinetic);
    EXPECT_LT(row.energies.strain, 1e-12 * kinetic);
  }
  EXPECT_LT((flight.rows.back().displacement[1].colwise() - 20 * reference_dt * Vec3(1.0, -2.0, 3.0)).norm(), 1e-13);
}

// Both are of second order in time: half the step, a quarter of the difference.
TEST(Explicit, goes_to_the_monolithic_solution_as_the_time_step_goes_to_zero) {
  double before = 0.0;
  for (const int halvings : {0, 1, 2}) {
    const int n = 24 << halvings;
    Problem problem = two_cubes(bonded(), {});
    problem.steps = {dynamic_step("strike", n, 0.24e-6 / (1 << halvings),
                                  {load("pressure", {top_of(problem)}, History::half_sine(100e6, 4e-6))})};
    const Watcher explicit_run = run_explicit(problem), whole = run_monolithic(problem);
    const Points &one = explicit_run.rows.back().displacement[1], &other = whole.rows.back().displacement[1];
    const double apart = (one - other).norm() / other.norm();
    EXPECT_LT(apart, 0.05);
    if (halvings > 0) {
      EXPECT_NEAR(std::log2(before / apart), 2.0, 0.2) << halvings;
    }
    before = apart;
  }
}

TEST(Explicit, in_balance_of_a_static_step_stays_there) {
  Problem problem = two_cubes(bonded(), {});
  const Face top = top_of(problem);
  const StepPtr press = static_step("press", 1, {number("pressure", {top}, 50e6)});
  problem.steps = {press,
                   dynamic_step("hold", 20, reference_dt, {load("pressure", {top}, History::constant(50e6))}, press)};
  const Watcher held = run_explicit(problem);
  const Points start = held.rows.front().displacement[1];
  for (const Watcher::Row& row : held.rows) EXPECT_LT((row.displacement[1] - start).norm(), 1e-9 * start.norm());
}

TEST(Explicit, gives_the_force_of_a_weight_to_its_support) {
  Problem problem = two_cubes(bonded(), {});
  const StepPtr rest = static_step("rest", 1, {number("gravity", {}, -9.81, 2)});
  problem.steps = {rest,
                   dynamic_step("hold", 5, reference_dt, {load("gravity", {}, History::constant(-9.81), 2)}, rest)};
  const double weight = 2 * 7800.0 * 1e-6 * 9.81;
  const Watcher held = run_explicit(problem);
  for (const Watcher::Row& row : held.rows) {
    EXPECT_NEAR(row.reactions[0].row(2).sum(), weight, 1e-6 * weight);
    // A tie carries the upper half.
    double between = 0.0;
    for (const LawState& point : row.surfaces[0].points) between += point.force[2];
    EXPECT_NEAR(between, -0.5 * weight, 1e-6 * weight);
  }
}

}  // namespace
}  // namespace dygita::reference_tests
