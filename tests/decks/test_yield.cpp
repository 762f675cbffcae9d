// Stress against yield, and what took a bolt's preload: figures known by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "decks/engine.hpp"

namespace dygita::test::yield_tests {
namespace {

// A rod of 100 mm along x that does not contract sideways, held at xmin.
std::string rod(const std::string& steps, const std::string& more = "") {
  return R"(
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0, density = 7800, yield = 250*MPa }
local rod = substructure{ name = "rod", material = steel, mesh = mesh.box{ size = { 100*mm, 10*mm, 10*mm }, cells = { 40, 1, 1 } } }
local base = support.fixed{ name = "base", on = rod:face "xmin" }
)" + steps +
         R"(
local p = problem{ name = "rod", substructures = { rod }, supports = { base }, steps = steps, outputs = {} }
)" + (more.empty() ? "p:run{}" : more);
}

const std::string pulled = R"(
local steps = { step.static{ name = "pull", increments = 4, loads = { load.traction{ on = rod:face "xmax", x = 200*MPa } } },
}
)";

TEST(Yield, margin_of_a_rod_under_tension) {
  const DeckRun run = run_text(rod(pulled, R"(
local r = p:run{}
assert(math.abs(r[rod].von_mises / (200*MPa) - 1) < 1e-6, "stress")
assert(math.abs(r[rod].margin - 0.25) < 1e-6 and r[rod].volume_above_yield == 0, "margin")
assert(math.abs(r[rod].mass - 0.078) < 1e-12, "mass")
)"))
                          .at(0);
  ASSERT_EQ(run.result->stresses.size(), 1u);
  EXPECT_NEAR(run.result->stresses[0].largest, 200e6, 200.0);
  EXPECT_NEAR(run.figure("smallest margin against yield [1]"), 0.25, 1e-6);
}

TEST(Yield, tells_how_much_of_a_part_would_yield) {
  std::string text = rod(pulled);
  text.replace(text.find("250*MPa"), 7, "160*MPa");
  const DeckRun run = run_text(text).at(0);
  EXPECT_NEAR(run.result->stresses.at(0).margin(), -0.2, 1e-6);
  EXPECT_NEAR(run.result->stresses.at(0).above, 1.0, 1e-12);
}

TEST(Yield, costs_nothing_without_a_yield) {
  std::string text = rod(pulled);
  text.replace(text.find(", yield = 250*MPa"), 17, "");
  const DeckRun run = run_text(text).at(0);
  EXPECT_TRUE(run.result->stresses.empty());
  EXPECT_EQ(run.figures().count("smallest margin against yield [1]"), 0u);
}

// A pulse doubles where the rod is held. In 2,000 increments most are between the instants at which all nodes are seen.
TEST(Yield, sees_the_peak_of_a_wave_between_its_instants) {
  const auto wave = [](const std::string& duration, const std::string& dt) {
    return run_text(rod("local steps = { step.dynamic{ name = 'hit', duration = " + duration + ", dt = " + dt +
                        ", loads = { load.traction{ on = rod:face 'xmax', x = history.half_sine{ peak = -100*MPa, "
                        "duration = "
                        "20*us } } } } }"))
        .at(0)
        .result->stresses.at(0);
  };
  const PartStress fine = wave("60*us", "0.3*us"), watched = wave("600*us", "0.3*us");
  const double arrival = 0.1 / std::sqrt(210e9 / 7800);
  EXPECT_NEAR(fine.largest, 200e6, 6e6);
  EXPECT_NEAR(fine.place[0], 0.0, 5e-3);
  EXPECT_NEAR(fine.time, arrival + 10e-6, 1.5e-6);
  EXPECT_GT(watched.largest, 0.99 * fine.largest);
}

// A stud of 10 x 10 mm, tightened against a sleeve, pulled beyond its yield and let go: what it loses is all its own.
std::string clamped(const std::string& shank, const std::string& pull) {
  return R"(
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0, density = 7800 }
local function block(name, x, z, h) return substructure{ name = name, material = steel,
  mesh = mesh.box{ size = { 10*mm, 10*mm, h }, origin = { x, 0, z }, cells = { 2, 2, 4 } } } end
local sleeve, low, high = block("sleeve", 10*mm, 0, 40*mm), block("low", 0, 0, 20*mm), block("high", 0, 20*mm, 20*mm)
local head = substructure{ name = "head", material = steel, mesh = mesh.box{ size = { 20*mm, 10*mm, 10*mm }, origin = { 0, 0, 40*mm }, cells = { 4, 2, 2 } } }
local shank = )" +
         shank + R"(
local top = interface.bonded{ name = "top", between = { high:face "zmax", head:face "zmin" } }
local seat = interface.contact{ name = "seat", between = { sleeve:face "zmax", head:face "zmin" } }
local base = support.fixed{ name = "base", on = { low:face "zmin", sleeve:face "zmin" } }
local guide = support.symmetry{ name = "guide", on = { head:face "xmin", head:face "xmax", head:face "ymin" } }
local tighten = step.static{ name = "tighten", increments = 4, loads = { load.preload{ on = shank, force = 20*kN } } }
local pull = step.static{ name = "pull", after = tighten, increments = 8, loads = { load.force{ on = head:face "zmax", z = )" +
         pull + R"( } } }
local rest = step.static{ name = "rest", after = pull, increments = 4, loads = {} }
problem{ name = "clamp", substructures = { sleeve, low, high, head }, interfaces = { shank, top, seat }, supports = { base, guide },
  steps = { tighten, pull, rest }, outputs = {}, solver = solver.latin{ max_iterations = 3000 } }:run{}
)";
}

TEST(BoltLoss, by_yielding_is_all_of_it_where_nothing_else_gives) {
  const DeckRun run =
      run_text(clamped(R"(interface.plastic{ name = "shank", between = { low:face "zmax", high:face "zmin" },
  yield = 300*MPa, hardening = 200*MPa/mm })",
                       "36*kN"))
          .at(0);
  const BoltSummary& bolt = run.result->bolts.at(0);
  EXPECT_NEAR(bolt.tightened, 20e3, 20.0);
  EXPECT_GT(bolt.yielded, 1e-6);
  ASSERT_TRUE(bolt.loss_by_yield().has_value());
  EXPECT_GT(bolt.loss().value(), 0.05);
  EXPECT_NEAR(*bolt.loss_by_yield(), bolt.loss().value(), 0.02 * bolt.loss().value());
}

TEST(BoltLoss, is_none_by_yielding_where_the_bolt_stays_elastic) {
  const DeckRun run =
      run_text(
          clamped(R"(interface.bonded{ name = "shank", between = { low:face "zmax", high:face "zmin" } })", "10*kN"))
          .at(0);
  const BoltSummary& bolt = run.result->bolts.at(0);
  EXPECT_EQ(bolt.yielded, 0.0);
  EXPECT_EQ(bolt.loss_by_yield().value(), 0.0);
  EXPECT_LT(std::abs(bolt.loss().value()), 1e-3);
  EXPECT_GT(bolt.stiffness.value(), 0.0);
}

}  // namespace
}  // namespace dygita::test::yield_tests
