// Where a block presses on a wall: uniform pressure by hand, and nothing where nothing presses.
#include <gtest/gtest.h>

#include <cmath>

#include "decks/engine.hpp"

namespace dygita::test::footprint_tests {
namespace {

const std::string block_on_a_wall = R"(
local p = param{ gap = 0, about = 0 }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0, density = 8000 }
local block = substructure{ name = "block", material = steel,
  mesh = mesh.box{ size = { 8*mm, 4*mm, 4*mm }, cells = { 4, 4, 2 } } }
local table_ = substructure{ name = "table", material = steel,
  mesh = mesh.box{ size = { 8*mm, 4*mm, 4*mm }, cells = { 4, 4, 2 }, origin = { 0, 0, -4*mm } } }
local seat = interface.contact{ name = "seat", between = { block:face "zmin", table_:face "zmax" }, friction = 0.5, gap = p.gap }
local floor = support.fixed{ name = "floor", on = table_:face "zmin" }
local guide = support.symmetry{ name = "guide", on = { block:face "ymin", table_:face "ymin" } }
local press = step.static{ name = "press", loads = {
  load.displacement{ on = block:face "zmax", x = 0.1*um, z = -1*um } } }
local arguments = { name = "print", on = seat, direction = { 1, 0, 0 } }
if p.about == 1 then arguments.about = { 0, 0, 0 } end
problem{ name = "block", substructures = { block, table_ }, interfaces = { seat }, supports = { floor, guide }, steps = { press },
  solver = solver.latin{ static_tolerance = 1e-10 }, outputs = { output.footprint(arguments) } }:run{}
)";

double last(const DeckRun& run, const char* column) { return run.column("print", column).back(); }

TEST(Footprint, of_a_uniform_pressure_is_that_of_the_face) {
  const DeckRun run = run_text(block_on_a_wall).at(0);
  EXPECT_NEAR(last(run, "area"), 32e-6, 1e-15);
  EXPECT_NEAR(last(run, "x"), 4e-3, 1e-9);
  EXPECT_NEAR(last(run, "y"), 2e-3, 1e-9);
  EXPECT_NEAR(last(run, "z"), 0.0, 1e-12);
  EXPECT_NEAR(last(run, "spread_y"), std::sqrt(16.0 / 12 + 1.0 / 6) * 1e-3, 1e-6);  // of forces at the nodes, h = 1 mm
  EXPECT_GT(last(run, "pressure"), 200e9 * 1e-6 / 8e-3);                            // more where it is sheared down
  EXPECT_GT(last(run, "shear_x"), 2e-3);
  EXPECT_LT(last(run, "spread_z"), 1e-12);
}

TEST(Footprint, is_measured_from_a_point_of_the_deck) {
  const DeckRun run = run_text(block_on_a_wall, {{"about", "1"}}).at(0);
  const double centre = last(run, "y"), about_centre = std::sqrt(16.0 / 12 + 1.0 / 6) * 1e-3;
  EXPECT_NEAR(last(run, "spread_y"), std::hypot(centre, about_centre), 1e-6);
}

TEST(Footprint, of_what_does_not_touch_is_nowhere) {
  const DeckRun run = run_text(block_on_a_wall, {{"gap", "1e-3"}}).at(0);
  EXPECT_EQ(last(run, "pressure"), 0.0);
  EXPECT_EQ(last(run, "area"), 0.0);
  EXPECT_TRUE(std::isnan(last(run, "x")));
  EXPECT_TRUE(std::isnan(last(run, "spread_x")));
}

}  // namespace
}  // namespace dygita::test::footprint_tests
