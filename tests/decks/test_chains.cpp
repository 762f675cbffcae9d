// What one step leaves to the next, and sums that once counted twice: every case was wrong at some time.
#include <gtest/gtest.h>

#include <cmath>

#include "decks/engine.hpp"

namespace dygita::test::chains_tests {
namespace {

const std::string bars = R"(
local metal = material.elastic{ name = "metal", young = 200*GPa, poisson = 0, density = 8000 }
local function bar(name, z0, n)
  return substructure{ name = name, material = metal, mesh = mesh.box{ origin = { 0, 0, z0 }, size = { 10*mm, 10*mm, 10*mm }, cells = { n, n, n } } }
end
)";

TEST(Supports, a_node_that_two_faces_of_a_support_share_counts_once) {
  const DeckRun run = run_text(bars + R"(
local b = bar("b", 0, 2)
local held = support.fixed{ name = "held", on = { b:face "zmin", b:face "xmin" } }
local pull = step.static{ name = "pull", loads = { load.traction{ on = b:face "zmax", z = 10*MPa } } }
problem{ name = "p", substructures = { b }, supports = { held }, steps = { pull }, outputs = { output.resultant{ name = "r", on = held } } }:run{}
)")
                          .at(0);
  EXPECT_NEAR(run.column("r", "z").back(), -1000.0, 1e-6);
  EXPECT_NEAR(run.column("r", "x").back(), 0.0, 1e-6);
}

// Anderson may throw a body that has not touched yet far away: the step then says so. Called converged, it must carry
// the load.
TEST(StaticStep, never_calls_a_body_that_has_flown_off_converged) {
  const DeckRun run = run_text(bars + R"(
local a, b = bar("a", 0, 1), bar("b", 10*mm, 1)
local touch = interface.contact{ name = "touch", between = { a:face "zmax", b:face "zmin" }, gap = 10*um, friction = 0.3 }
local base = support.fixed{ name = "base", on = a:face "zmin" }
local guide = support.symmetry{ name = "guide", on = { b:face "xmin", b:face "ymin" } }
local press = step.static{ name = "press", loads = { load.pressure{ on = b:face "zmax", history = 10*MPa } } }
problem{ name = "p", substructures = { a, b }, interfaces = { touch }, supports = { base, guide }, steps = { press },
  outputs = { output.resultant{ name = "r", on = touch } } }:run{}
)")
                          .at(0);
  EXPECT_TRUE(!run.result->converged || std::abs(run.column("r", "normal").back() + 1000.0) < 1e-3);
}

TEST(Shortening, ramps_evenly_over_the_increments_and_on_from_what_it_reached) {
  const DeckRun run = run_text(bars + R"(
local a, b = bar("a", 0, 1), bar("b", 10*mm, 1)
local cut = interface.bonded{ name = "cut", between = { a:face "zmax", b:face "zmin" } }
local ends = support.fixed{ name = "ends", on = { a:face "zmin", b:face "zmax" } }
local one = step.static{ name = "one", increments = 4, loads = { load.shortening{ on = cut, by = 10*um } } }
local two = step.static{ name = "two", after = one, increments = 2, loads = { load.shortening{ on = cut, by = 20*um } } }
problem{ name = "p", substructures = { a, b }, interfaces = { cut }, supports = { ends }, steps = { one, two },
  outputs = { output.resultant{ name = "r", on = cut } } }:run{}
)")
                          .at(0);
  const double whole = 200e9 * 1e-4 * 10e-6 / 20e-3;
  const double expected[] = {0.25, 0.5, 0.75, 1.0, 1.5, 2.0};
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(run.column("r", "normal").at(i), expected[i] * whole, 1e-5 * whole) << i;
}

TEST(PrescribedMotion, goes_on_from_where_a_dynamic_step_left_it_and_its_strain_energy_stays) {
  const DeckRun run = run_text(bars + R"(
local b = bar("b", 0, 1)
local base = support.fixed{ name = "base", on = b:face "zmin" }
local function to(z) return { load.displacement{ on = b:face "zmax", z = z } } end
local one = step.static{ name = "one", loads = to(10*um) }
local hold = step.dynamic{ name = "hold", after = one, duration = 5*us, dt = 0.5*us, loads = to(10*um) }
local two = step.static{ name = "two", after = hold, loads = to(20*um) }
problem{ name = "p", substructures = { b }, supports = { base }, steps = { one, hold, two },
  outputs = { output.resultant{ name = "r", on = base }, output.energy{} } }:run{}
)")
                          .at(0);
  EXPECT_NEAR(run.column("r", "z").front(), -20000.0, 1e-3);
  EXPECT_NEAR(run.column("r", "z").back(), -40000.0, 1e-3);
  EXPECT_NEAR(run.column("energy", "strain").back(), 0.5 * 40000.0 * 20e-6, 1e-9);
  EXPECT_LT(run.figure("energy imbalance [%]"), 1e-6);
}

TEST(Wall, that_comes_later_stands_where_it_was_declared) {
  const DeckRun run = run_text(bars + R"(
local b = bar("b", 0, 1)
local wall = support.wall{ name = "wall", on = b:face "zmin", gap = 10*um }
local hand = support.symmetry{ name = "hand", on = { b:face "xmin", b:face "ymin" } }
local function to(z) return { load.displacement{ on = b:face "zmax", z = z } } end
local near_it = step.static{ name = "near_it", loads = to(-8*um), supports = { hand } }
local on_it = step.static{ name = "on_it", after = near_it, loads = to(-14*um) }
problem{ name = "p", substructures = { b }, supports = { wall, hand }, steps = { near_it, on_it }, outputs = { output.resultant{ name = "r", on = wall } } }:run{}
)")
                          .at(0);
  EXPECT_NEAR(run.column("r", "normal").back(), -200e9 * 1e-4 * 4e-6 / 10e-3, 1e-2);
}

}  // namespace
}  // namespace dygita::test::chains_tests
