// Constant damping over a band in whole steps: every solver against the others, from step to step, static ones after
// dynamic ones (manual, eq. D22-D25, S16).
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "marching/solve.hpp"
#include "reference/explicit.hpp"
#include "reference/monolithic.hpp"
#include "step/blocks.hpp"

namespace dygita::damping_band_tests {
namespace {

// First mode of the two cubes: about 62 kHz.
const Damping& band() {
  static const Damping damping = damping_over(0.1, {5e3, 500e3});
  return damping;
}

Problem damped_cubes(const Damping& damping, IntegrationChoice integration = IntegrationChoice::implicitly) {
  Problem problem = two_cubes(bonded(), {});
  problem.solver.mass.is_chosen = false;  // lumped
  for (const SubstructurePtr& part : problem.substructures) {
    Substructure& own = *std::const_pointer_cast<Substructure>(part);
    own.material.damping = damping;
    own.integration = integration;
  }
  return problem;
}

Watcher run_latin(Problem problem) {
  problem.solver.tolerance = 1e-9;
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

// A blow that also pushes sideways on what a static step has pressed down.
std::vector<StepPtr> press_and_strike(const Problem& of, int n, double dt) {
  const Face top = top_of(of);
  const StepPtr press = static_step("press", 1, {number("pressure", {top}, 50e6)});
  return {press, dynamic_step("strike", n, dt,
                              {load("pressure", {top}, History::constant(50e6)),
                               load("traction", {top}, History::half_sine(60e6, 8e-6), 0)},
                              press)};
}

TEST(DampingBand, is_the_same_in_one_system_and_by_iteration) {
  Problem problem = damped_cubes(band());
  problem.steps = press_and_strike(problem, 60, 0.4e-6);
  const Watcher latin = run_latin(problem), whole = run_monolithic(problem);
  EXPECT_LT(displacement_difference(latin, whole), 1e-7);
  EXPECT_LT(velocity_difference(latin, whole), 1e-6);
  const Energies &one = latin.rows.back().energies, &other = whole.rows.back().energies;
  EXPECT_NEAR(one.damping, other.damping, 1e-6 * other.damping);
  EXPECT_NEAR(one.strain, other.strain, 1e-6 * other.strain);
  for (const Watcher* run : {&latin, &whole})
    for (const Watcher::Row& row : run->rows) EXPECT_LT(std::abs(row.energies.balance()), 1e-8 * row.energies.loads);
  // Nothing but the branches damps.
  Problem bare = damped_cubes({});
  bare.steps = press_and_strike(bare, 60, 0.4e-6);
  const Watcher undamped = run_monolithic(bare);
  EXPECT_EQ(undamped.rows.back().energies.damping, 0.0);
  EXPECT_GT(other.damping, 0.02 * (other.kinetic + other.strain));
  EXPECT_EQ(undamped.rows.front().displacement[1], whole.rows.front().displacement[1]);
}

// Both are of second order in time: half the step, a quarter of the difference.
TEST(DampingBand, of_explicit_increments_goes_to_that_of_implicit_ones) {
  for (const bool is_reference : {false, true}) {
    double before = 0.0, before_in_energy = 0.0;
    for (const int halvings : {0, 1, 2}) {
      const int n = 100 << halvings;
      const double dt = 0.16e-6 / (1 << halvings);
      const auto steps = [&](const Problem& of) {
        return std::vector<StepPtr>{
            dynamic_step("strike", n, dt, {load("pressure", {top_of(of)}, History::half_sine(100e6, 8e-6))})};
      };
      Problem problem = damped_cubes(band()), other = damped_cubes(band(), IntegrationChoice::explicitly);
      problem.steps = steps(problem);
      other.steps = steps(other);
      const Watcher whole = run_monolithic(problem), run = is_reference ? run_explicit(problem) : run_latin(other);
      const Points &a = run.rows.back().displacement[1], &b = whole.rows.back().displacement[1];
      const double apart = (a - b).norm() / b.norm();
      const Energies &of = run.rows.back().energies, &expected = whole.rows.back().energies;
      const double in_energy = std::abs(of.damping / expected.damping - 1.0);
      printf("%s, dt %.3g us: %.3g, damping %.3g, balance %.2g\n", is_reference ? "reference" : "pieces", 1e6 * dt,
             apart, in_energy, of.balance() / of.loads);
      EXPECT_LT(apart, 0.05);
      EXPECT_LT(in_energy, 0.05);
      EXPECT_LT(std::abs(of.balance()), (is_reference ? 1e-2 : 1e-9) * of.loads);
      if (halvings > 0) {
        EXPECT_NEAR(std::log2(before / apart), 2.0, 0.3) << halvings;
        EXPECT_LT(in_energy, 0.5 * before_in_energy) << halvings;
      }
      before = apart;
      before_in_energy = in_energy;
    }
  }
}

// What the branches are stretched by goes on from step to step.
TEST(DampingBand, does_not_feel_where_a_step_ends) {
  const std::vector<std::pair<IntegrationChoice, std::function<Watcher(Problem)>>> ways{
      {IntegrationChoice::implicitly, run_monolithic},
      {IntegrationChoice::implicitly, run_explicit},
      {IntegrationChoice::implicitly, run_latin},
      {IntegrationChoice::explicitly, run_latin}};
  for (const auto& [integration, run] : ways) {
    Problem one = damped_cubes(band(), integration), two = damped_cubes(band(), integration);
    const auto push = [](const Problem& of) { return load("pressure", {top_of(of)}, History::constant(80e6)); };
    one.steps = {dynamic_step("strike", 80, 0.1e-6, {push(one)})};
    const StepPtr first = dynamic_step("strike", 50, 0.1e-6, {push(two)});
    two.steps = {first, dynamic_step("on", 30, 0.1e-6, {push(two)}, first)};
    const Watcher whole = run(one), parted = run(two);
    EXPECT_LT(displacement_difference(parted, whole), 1e-6);
    EXPECT_LT(velocity_difference(parted, whole), 1e-6);
    const Energies &a = parted.rows.back().energies, &b = whole.rows.back().energies;
    EXPECT_NEAR(a.damping, b.damping, 1e-3 * b.damping);
    EXPECT_NEAR(a.strain, b.strain, 1e-3 * b.strain);
    EXPECT_LT(std::abs(a.balance()), 1e-2 * a.loads);
  }
}

// A static step is that of the stiffness as given, whatever was before it.
TEST(DampingBand, is_relaxed_by_a_static_step) {
  for (const auto& run : {run_monolithic, run_latin}) {
    std::vector<Points> found;
    for (const Damping& damping : {band(), Damping()}) {
      Problem problem = damped_cubes(damping);
      problem.steps = press_and_strike(problem, 20, 0.4e-6);
      problem.steps.push_back(
          static_step("rest", 1, {number("pressure", {top_of(problem)}, 70e6)}, problem.steps.back()));
      const Watcher watched = run(problem);
      found.push_back(watched.rows.back().displacement[1]);
      EXPECT_LT(std::abs(watched.rows.back().energies.balance()), 1e-8 * watched.rows.back().energies.loads);
    }
    EXPECT_LT((found[0] - found[1]).norm(), 1e-8 * found[1].norm());
  }
}

}  // namespace
}  // namespace dygita::damping_band_tests
