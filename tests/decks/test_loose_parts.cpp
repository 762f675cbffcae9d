// Parts that nothing holds and nothing touches rest in static steps, however these are solved.
#include <gtest/gtest.h>

#include "decks/engine.hpp"

namespace dygita::test::loose_parts_tests {
namespace {

// A lid above a column that a ring of forces makes shorter, or longer, and moves sideways.
const std::string lidded = R"(
local p = param{ gap = 2, pull = -4000, symmetric = 0 }
local alloy = material.elastic{ name = "alloy", young = 70*GPa, poisson = 0.3, density = 2700 }
local column = substructure{ name = "column", material = alloy, mesh = mesh.box{ size = { 20*mm, 20*mm, 60*mm }, cells = { 3, 3, 8 } } }
local lid = substructure{ name = "lid", material = alloy, mesh = mesh.box{ origin = { 0, 0, 60*mm }, size = { 20*mm, 20*mm, 10*mm }, cells = { 4, 4, 2 } } }
local contact = interface.contact{ name = "contact", between = { column:face "zmax", lid:face "zmin" }, friction = 0.3, gap = p.gap*um }
local ring = load.force{ on = column:where(function(x, y, z) return z > 29.9*mm and z < 52.4*mm end), z = p.pull, x = 200 }
local supports = { support.fixed{ name = "floor", on = column:face "zmin" } }
if p.symmetric == 1 then supports[2] = support.symmetry{ name = "half", on = { column:face "ymin", lid:face "ymin" } } end
problem{ name = "lidded", substructures = { column, lid }, interfaces = { contact }, supports = supports,
  steps = { step.static{ name = "press", increments = 2, loads = { ring } } },
  outputs = { output.joint{ name = "contact", on = contact },
              output.history{ name = "column", on = column:face "zmax", quantity = "displacement" },
              output.history{ name = "lid", on = lid:face "zmin", quantity = "displacement" } } }:run{}
)";

constexpr const char* solvers[] = {"latin{ static_steps = 'iterated' }", "latin{ static_steps = 'assembled' }",
                                   "monolithic"};

TEST(LoosePart, rests_where_what_is_under_it_goes_away) {
  for (const char* solver : solvers)
    for (const char* gap : {"2", "0"})
      for (const char* symmetric : {"0", "1"}) {
        const DeckRun run = run_text(lidded, {{"gap", gap}, {"symmetric", symmetric}}, 0, solver)[0];
        EXPECT_LT(run.column("column", "z").back(), -4e-6);
        for (const char* of : {"x", "y", "z"})
          EXPECT_NEAR(run.column("lid", of).back(), 0.0, 1e-11)
              << solver << " " << gap << " " << symmetric << " " << of;
        EXPECT_EQ(run.column("contact", "normal").back(), 0.0);
      }
}

TEST(LoosePart, is_pushed_by_what_comes) {
  for (const char* solver : solvers) {
    const DeckRun run = run_text(lidded, {{"pull", "4000"}}, 0, solver)[0];
    const double column = run.column("column", "z").back(), lid = run.column("lid", "z").back();
    EXPECT_GT(column, 4e-6);
    EXPECT_GT(lid, column - 2.5e-6) << solver;  // of corners that tilt, besides the gap
    EXPECT_LT(lid, column + 1e-6) << solver;
  }
}

}  // namespace
}  // namespace dygita::test::loose_parts_tests
