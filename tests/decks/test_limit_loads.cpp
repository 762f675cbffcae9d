// What a run says of increments that have not converged: why, and what helps.
#include <gtest/gtest.h>

#include <regex>

#include "decks/deck_prints.hpp"

namespace dygita::test::limit_loads_tests {
namespace {

// A run with what it warned of on the screen.
struct Said {
  DeckRun run;
  std::string warnings;
};

Said said_by(const std::string& text, const Settings& settings = {}) {
  testing::internal::CaptureStderr();
  DeckRun run = run_text(text, settings).at(0);
  return {run, testing::internal::GetCapturedStderr()};
}

void expect_in(const std::string& said, const std::vector<std::string>& what) {
  for (const std::string& each : what) EXPECT_NE(said.find(each), std::string::npos) << each << "\nnot in\n" << said;
}

// A strap clamped on a base by a pressure, and pulled along it.
const std::string strap = R"(
local p = param{ pull = 100, iterations = 0, increments = 2, lift = 0 }
local m = material.elastic{ name = "m", young = 70*GPa, poisson = 0.3, density = 2700 }
local base = substructure{ name = "base", material = m, mesh = mesh.box{ size = { 40*mm, 10*mm, 5*mm }, cells = { 8, 2, 1 } } }
local strap = substructure{ name = "strap", material = m, mesh = mesh.box{ origin = { 0, 0, 5*mm }, size = { 40*mm, 10*mm, 5*mm }, cells = { 8, 2, 1 } } }
local mating = interface.contact{ name = "mating", between = { base:face "zmax", strap:face "zmin" }, friction = 0.25 }
local floor = support.fixed{ name = "floor", on = base:face "zmin" }
local press = load.pressure{ on = strap:face "zmax", history = 10*MPa }
local clamp = step.static{ name = "clamp", loads = { press } }
local pull = step.static{ name = "pull", after = clamp, increments = p.increments, loads = { press,
  load.force{ on = strap:face "xmax", x = p.pull }, load.traction{ on = strap:face "zmax", z = p.lift } } }
problem{ name = "strap", substructures = { base, strap }, interfaces = { mating }, supports = { floor }, steps = { clamp, pull },
  solver = p.iterations > 0 and solver.latin{ max_iterations = p.iterations } or solver.latin{} }:run{}
)";

TEST(LimitLoad, a_joint_that_slides_as_a_whole_is_named_with_force_and_capacity) {
  // 10 MPa on 400 mm^2: friction holds 0.25 x 4000 N.
  const Said slides = said_by(strap, {{"pull", "1500"}});
  EXPECT_FALSE(slides.run.result->converged);
  expect_in(slides.warnings,
            {"static step 'pull', increment 2: 'strap' slides as a whole: 1500 N act along (1.00, ",  // no equilibrium
             "joints resist about 1000 N of it ('mating' slides at 1000 N)", "more preload or friction"});
}

TEST(LimitLoad, a_part_that_is_pulled_off_is_named) {
  const Said lifted = said_by(strap, {{"pull", "0"}, {"lift", "20*MPa"}});
  EXPECT_FALSE(lifted.run.result->converged);
  expect_in(lifted.warnings,
            {"static step 'pull', increment 2: 'strap' comes off as a whole: 4000 N act along (", "'mating' is open"});
}

TEST(LimitLoad, a_part_whose_only_joint_is_released_is_named) {
  std::string text = strap;
  const std::string joint = "load.force{ on = strap:face \"xmax\", x = p.pull }";
  text.replace(text.find(joint), joint.size(), "load.release{ on = mating, at = 0.4 }");
  const Said released = said_by(text, {{"lift", "20*MPa"}});
  EXPECT_FALSE(released.run.result->converged);
  expect_in(released.warnings,
            {"'strap' comes off as a whole: 4000 N act along (0.00, 0.00, 1.00)", "('mating' is released)"});
}

TEST(LimitLoad, a_joint_that_holds_is_not_complained_of) {
  const Said holds = said_by(strap, {{"pull", "900"}});
  EXPECT_TRUE(holds.run.result->converged);
  EXPECT_EQ(holds.warnings, "");
}

TEST(LimitLoad, of_a_block_between_jaws_is_what_the_deck_of_hard_cases_asks_for) {
  testing::internal::CaptureStderr();
  const PrintedRun clamp = run_printing("hard/held_by_contact.lua", {{"pull", "1.5"}});
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_FALSE(clamp.runs.at(0).result->converged);
  expect_in(said, {"'block' slides as a whole: ", "'a' slides at", "'b' slides at"});
}

// A block on a plate that only friction holds, pressed by 1 kN across a gap and pushed aside; friction holds 300 N.
const std::string pressed_aside = R"(
local p = param{ side = 285, iterations = 0 }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local a = substructure{ name = "a", material = steel, mesh = mesh.box{ size = { 30*mm, 30*mm, 10*mm }, cells = { 6, 6, 2 } } }
local b = substructure{ name = "b", material = steel, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 3, 3, 3 }, origin = { 10*mm, 10*mm, 10.1*mm } } }
local j = interface.contact{ name = "j", between = { a:face "zmax", b:face "zmin" }, friction = 0.3, gap = "geometry", within = 0.2*mm }
local base = support.fixed{ name = "base", on = a:face "zmin" }
local s = step.static{ name = "s", loads = { load.force{ on = b:face "zmax", z = -1*kN, x = p.side } } }
problem{ name = "press", substructures = { a, b }, interfaces = { j }, supports = { base }, steps = { s }, outputs = { output.joint{ name = "o", on = j } },
  solver = p.iterations > 0 and solver.latin{ max_iterations = p.iterations } or solver.latin{} }:run{}
)";

TEST(OtherWay, is_taken_where_parts_one_by_one_stand_still) {
  testing::internal::CaptureStdout();
  const Said pressed = said_by(pressed_aside);
  expect_in(testing::internal::GetCapturedStdout(),
            {"static step 's', increment 1: ", " part by part did not converge"});
  EXPECT_TRUE(pressed.run.result->converged);
  EXPECT_EQ(pressed.warnings.find("equilibrium"), std::string::npos) << pressed.warnings;
  EXPECT_NEAR(pressed.run.column("o", "normal").back(), -1000.0, 1e-3);
  EXPECT_NEAR(pressed.run.column("o", "shear").back(), 285.0, 1e-3);
}

// 4 MPa on a small block of which one upper node is dragged by half its length at once.
TEST(OtherWay, finds_where_a_block_is_dragged_over_friction_in_one_increment) {
  const std::string dragged = R"(
local p = param{ increments = 1 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local cube = substructure{ name = "cube", material = steel, mesh = mesh.box{ size = { 1*mm, 1*mm, 1*mm }, cells = { 1, 1, 1 } } }
local block = substructure{ name = "block", material = steel, mesh = mesh.box{ size = { 0.2*mm, 0.2*mm, 0.2*mm }, cells = { 1, 1, 1 }, origin = { 0.4*mm, 0.4*mm, 1*mm } } }
local seat = interface.contact{ name = "seat", between = { block:face "zmin", cube:face "zmax" }, friction = 0.0001 }
local ground = support.fixed{ name = "ground", on = cube:face "zmin" }
local function node(X, Y) return block:where(function(x, y, z) return near(x, X*mm) and near(y, Y*mm) and near(z, 1.2*mm) end) end
local push = load.pressure{ on = block:face "zmax", history = 100*MPa }
local press = step.static{ name = "press", loads = { push, load.displacement{ on = node(0.4, 0.4), x = 0, y = 0 }, load.displacement{ on = node(0.4, 0.6), x = 0 } } }
local drag = step.static{ name = "drag", after = press, increments = p.increments, loads = { push, load.displacement{ on = node(0.4, 0.4), x = 0, y = 0.1*mm }, load.displacement{ on = node(0.4, 0.6), x = 0 } } }
problem{ name = "slide", substructures = { cube, block }, interfaces = { seat }, supports = { ground }, steps = { press, drag },
  outputs = { output.resultant{ name = "seat", on = seat }, output.history{ name = "u", on = block:face "zmin", quantity = "displacement" } } }:run{}
)";
  for (const char* increments : {"1", "10"}) {
    const DeckRun run = run_text(dragged, {{"increments", increments}}).at(0);
    EXPECT_TRUE(run.result->converged) << increments;
    EXPECT_NEAR(run.column("seat", "normal").back(), -4.0, 1e-5) << increments;
    EXPECT_NEAR(std::abs(run.column("seat", "y").back()), 4e-4, 1e-7) << increments;
    EXPECT_NEAR(run.column("u", "y").back(), 100.014e-6, 1e-8) << increments;
  }
}

TEST(NoEquilibrium, is_said_only_where_no_forces_balance_the_loads) {
  // Friction holds 300 N; the cone that no forces must be found in is up to a tenth wider.
  const Said pushed = said_by(pressed_aside, {{"side", "340"}});
  EXPECT_FALSE(pushed.run.result->converged);
  expect_in(pushed.warnings, {"there is no equilibrium"});
  const Said few = said_by(pressed_aside, {{"side", "285"}, {"iterations", "60"}});
  EXPECT_FALSE(few.run.result->converged);
  EXPECT_EQ(few.warnings.find("there is no equilibrium"), std::string::npos) << few.warnings;
}

// Half a block over the edge of another, pressed from above beyond it.
TEST(NoEquilibrium, of_a_block_that_tips_names_it) {
  const std::string tipping = R"(
local p = param{ dx = 12 }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local a = substructure{ name = "a", material = steel, mesh = mesh.box{ size = { 20*mm, 20*mm, 10*mm }, cells = { 4, 4, 2 } } }
local b = substructure{ name = "b", material = steel, mesh = mesh.box{ size = { 20*mm, 20*mm, 10*mm }, cells = { 4, 4, 2 }, origin = { p.dx*mm, 0, 10*mm } } }
local j = interface.contact{ name = "j", between = { a:face "zmax", b:face "zmin" }, friction = 0.3 }
problem{ name = "tipping", substructures = { a, b }, interfaces = { j }, supports = { support.fixed{ name = "base", on = a:face "zmin" } },
  steps = { step.static{ name = "t", loads = { load.pressure{ on = b:face "zmax", history = 10*MPa } } } }, outputs = { output.joint{ name = "o", on = j } } }:run{}
)";
  const Said tips = said_by(tipping);
  EXPECT_FALSE(tips.run.result->converged);
  expect_in(tips.warnings, {"static step 't', increment 1: the loads tip 'b' about (0.00, 1.00, 0.00)",
                            " points of 'j' can balance them: there is no equilibrium"});
}

// Too few iterations are told apart from an indicator that stands still, and what the message asks for is enough.
TEST(NotConverged, asks_for_as_many_iterations_as_are_enough) {
  const Said few = said_by(strap, {{"pull", "900"}, {"iterations", "20"}});
  EXPECT_FALSE(few.run.result->converged);
  expect_in(few.warnings,
            {"step 'pull': increment", "the indicator is still decreasing, halving in ", "more are needed"});
  std::smatch found;
  ASSERT_TRUE(std::regex_search(few.warnings, found, std::regex(R"(max_iterations = (\d+))"))) << few.warnings;
  const Said enough = said_by(strap, {{"pull", "900"}, {"iterations", found[1]}});
  EXPECT_TRUE(enough.run.result->converged) << found[1];
  EXPECT_LT(std::stoi(found[1]), 1000);
}

// The defaults go on as long as iterations help.
TEST(NotConverged, is_not_what_ordinary_bolts_are_at_the_defaults) {
  const PrintedRun box = run_printing("hard/four_bolts.lua");
  const DeckRun& run = box.runs.at(0);
  EXPECT_EQ(run.problem.substructures.size(), 18u);
  EXPECT_EQ(run.problem.interfaces.size(), 21u);
  EXPECT_TRUE(run.result->converged);
  ASSERT_EQ(run.result->bolts.size(), 4u);
  for (const BoltSummary& bolt : run.result->bolts) EXPECT_NEAR(bolt.tightened, 8000.0, 1.0) << bolt.name;
  for (const StepSummary& step : run.result->steps) EXPECT_LE(step.worst_indicator, 1e-8) << step.name;
}

}  // namespace
}  // namespace dygita::test::limit_loads_tests
