// Round parts pressed on others whose meshes do not match, against Hertz, Cattaneo, Mindlin and Persson; flanges meshed
// apart.
#include <gtest/gtest.h>

#include <cmath>

#include "decks/deck_prints.hpp"

namespace dygita::test::round_contacts_tests {
namespace {

PrintedRun converged(const std::string& deck, const Settings& settings) {
  PrintedRun run = run_printing("verification/" + deck + ".lua", settings);
  for (const DeckRun& one : run.runs) EXPECT_TRUE(one.result->converged);
  return run;
}

TEST(Hertz, presses_a_ball_on_a_block_within_half_a_percent) {
  const PrintedRun ball = converged("hertz", {{"n", "6"}});
  EXPECT_LT(std::abs(ball.number("contact radius")), 0.5);
  EXPECT_LT(std::abs(ball.number("peak pressure")), 1.0);  // goal: 2
  const PrintedRun coarse = converged("hertz", {{"n", "3"}});
  EXPECT_LT(std::abs(ball.number("peak pressure")), 0.5 * std::abs(coarse.number("peak pressure")));
}

TEST(Hertz, is_the_same_with_the_points_on_the_ball) {
  const PrintedRun ball = converged("hertz", {{"n", "5"}, {"ratio", "0.7"}});
  EXPECT_LT(std::abs(ball.number("contact radius")), 0.5);
  EXPECT_LT(std::abs(ball.number("peak pressure")), 2.0);
}

// Points about as many as nodes of the other side, held to planes of symmetry: thousands of iterations while rows that
// nearly depend on each other, or on the planes, counted as stiff (manual, eq. K6).
TEST(Hertz, takes_few_iterations_with_friction_whatever_the_ratio_of_sizes) {
  for (const char* ratio : {"0.7", "1", "1.3"}) {
    const PrintedRun ball = converged("hertz", {{"n", "3"}, {"ratio", ratio}, {"friction", "0.3"}});
    EXPECT_LT(ball.number("iterations in all"), 100) << ratio;
  }
}

TEST(Hertz, presses_a_cylinder_on_a_block_within_half_a_percent) {
  for (const char* order : {"1", "2"}) {
    const PrintedRun cylinder = converged("hertz_cylinder", {{"n", "12"}, {"order", order}});
    EXPECT_LT(std::abs(cylinder.number("half width")), 0.5) << order;
    EXPECT_LT(std::abs(cylinder.number("peak pressure")), 0.2) << order;  // goal: 2
  }
}

TEST(Mindlin, a_sheared_ball_sticks_within_cattaneos_radius) {
  const PrintedRun ball = converged("mindlin", {{"n", "4"}, {"increments", "2"}});
  EXPECT_NEAR(ball.number("Q / (mu P)"), 0.56, 0.01);
  EXPECT_LT(std::abs(ball.number("contact radius")), 0.5);
  EXPECT_LT(std::abs(ball.number("stick radius")), 1.0);
}

TEST(PinInHole, touches_as_far_around_as_persson_says) {
  for (const char* ratio : {"1.3", "0.7"}) {
    const PrintedRun pin = converged("pin_in_hole", {{"ratio", ratio}});
    EXPECT_NEAR(pin.number("Persson's pressures pull with"), 1.0, 1e-5);
    EXPECT_LT(std::abs(pin.number("half angle")), 0.5);
    EXPECT_LT(std::abs(pin.number("peak pressure")), 0.5);
  }
}

// Hexahedra and tetrahedra, meshes that match and do not: goals 1 % and 0.5 dB.
TEST(FlangesApart, are_bolted_as_those_that_match) {
  const PrintedRun flanges = converged("flanges_apart", {{"edge", "1*mm"}, {"duration", "60*us"}});
  EXPECT_NEAR(flanges.number("matching, bolt force"), 29.28, 0.01 * 29.28);
  for (const std::string other : {"apart", "tetrahedra"}) {
    EXPECT_LT(std::abs(flanges.number(other + ", bolt force from the first")), 0.5) << other;
    EXPECT_LT(flanges.number(other + ", spectrum above from the first, largest"), 0.2) << other;
  }
}

TEST(FlangesApart, tied_and_graded_at_the_edges_come_within_a_percent_of_the_limit) {
  const PrintedRun flanges = converged("flanges_apart", {{"tied", "1"}, {"edge", "0.5*mm"}});
  for (const std::string name : {"matching", "apart", "tetrahedra"})
    EXPECT_LT(std::abs(flanges.number(name + ", bolt force, error of the limit")), 1.0) << name;
}

}  // namespace
}  // namespace dygita::test::round_contacts_tests
