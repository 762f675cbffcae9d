// A part in one solid that a plane cuts: bonded it is the part it was, and it is tightened across the cut.
#include <gtest/gtest.h>

#include <cmath>

#include "decks/engine.hpp"

namespace dygita::test::cut_meshes_tests {
namespace {

// A rod that stands obliquely, in tetrahedra, whole (whole = 1) or cut.
const std::string rod = R"(
local p = param{ whole = 0, order = 2, at = 17.3*mm, poisson = 0.3 }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = p.poisson, density = 7800 }
local along = frame{ axis = { 3, 2, 6 } }
local solid = mesh.gmsh{ file = ")" +
                        std::string(DYGITA_SOURCE_DIR) +
                        R"(/tests/decks/round_rod.geo", unit = mm, size = 3*mm, order = p.order }:volume "rod"
local low, high, interfaces, parts
if p.whole == 1 then
  low = substructure{ name = "rod", mesh = solid, material = steel }
  high, interfaces, parts = low, {}, { low }
else
  local halves = solid:cut{ normal = along.z, at = p.at }
  low = substructure{ name = "low", mesh = halves[1], material = steel }
  high = substructure{ name = "high", mesh = halves[2], material = steel }
  interfaces = { interface.bonded{ name = "cut", between = { low:face "cut", high:face "cut" } } }
  parts = { low, high }
end
local foot = support.fixed{ name = "foot", on = low:face "foot" }
)";

TEST(CutMeshes, bonded_are_the_part_in_one_solid) {
  const std::string deck = rod + R"(
local pull = step.static{ name = "pull", loads = { load.traction{ on = high:face "top", x = 20*MPa, y = -30*MPa, z = 50*MPa } } }
problem{ name = "rod", substructures = parts, interfaces = interfaces, supports = { foot }, steps = { pull }, solver = solver.latin{ tolerance = 1e-9 },
         outputs = { output.history{ name = "top", on = high:face "top", quantity = "displacement" }, output.modes{ name = "modes", n = 6 } } }:run{}
)";
  for (const char* order : {"1", "2"}) {
    const DeckRun whole = run_text(deck, {{"whole", "1"}, {"order", order}}).at(0);
    for (const char* at : {"17.3*mm", "20*mm", "31*mm"}) {
      SCOPED_TRACE(std::string(order) + ", " + at);
      // Cells of order one that are divided are finer ones.
      const double same = std::string(order) == "1" ? 0.01 : 1e-4;
      const DeckRun cut = run_text(deck, {{"at", at}, {"order", order}}).at(0);
      EXPECT_TRUE(cut.result->converged);
      const double size = std::abs(whole.column("top", "y").back());
      for (const char* d : {"x", "y", "z"})
        EXPECT_NEAR(cut.column("top", d).back(), whole.column("top", d).back(), same * size);
      for (size_t i = 0; i < 6; ++i) {
        const double expected = whole.column("modes", "frequency").at(i);
        EXPECT_NEAR(cut.column("modes", "frequency").at(i), expected, same * expected);
      }
    }
  }
}

// Held at both ends, and without lateral contraction: N = E A d / L wherever it is cut; A as the section's facets have
// it.
TEST(CutMeshes, are_shortened_and_preloaded_across_the_cut) {
  const std::string deck = rod + R"(
local top = support.fixed{ name = "top", on = high:face "top" }
local shorten = step.static{ name = "shorten", loads = { load.shortening{ on = interfaces[1], by = 0.02*mm } } }
local preload = step.static{ name = "preload", after = shorten, loads = { load.preload{ on = interfaces[1], force = 12*kN } } }
problem{ name = "rod", substructures = parts, interfaces = interfaces, supports = { foot, top }, steps = { shorten, preload }, solver = solver.latin{ tolerance = 1e-9 },
         outputs = { output.resultant{ name = "bolt", on = interfaces[1] }, output.resultant{ name = "held", on = top } } }:run{}
)";
  for (const char* at : {"17.3*mm", "31*mm"}) {
    const DeckRun run = run_text(deck, {{"at", at}, {"poisson", "0"}}).at(0);
    const std::vector<double>& force = run.column("bolt", "normal");
    const double expected = 200e9 * 25e-6 * 3.14159265 * 0.02 / 40;
    EXPECT_NEAR(force.front(), expected, 0.005 * expected) << at;  // facets are chords of the circle
    EXPECT_NEAR(force.back(), 12e3, 1e-5 * 12e3) << at;
    const double held =
        std::hypot(run.column("held", "x").back(), run.column("held", "y").back(), run.column("held", "z").back());
    EXPECT_NEAR(held, 12e3, 1e-4 * 12e3) << at;
  }
}

TEST(CutMeshes, move_as_the_part_in_one_solid) {
  const std::string deck = rod + R"(
local hit = step.dynamic{ name = "hit", duration = 40*us, dt = 0.5*us, loads = { load.pressure{ on = high:face "top", history = history.half_sine{ peak = 100*MPa, duration = 20*us } } } }
problem{ name = "rod", substructures = parts, interfaces = interfaces, supports = { foot }, steps = { hit }, solver = solver.latin{ integration = "implicit" },
         outputs = { output.history{ name = "top", on = high:face "top", quantity = "displacement", direction = along.z } } }:run{}
)";
  const std::vector<double> whole = run_text(deck, {{"whole", "1"}}).at(0).column("top", "displacement"),
                            cut = run_text(deck, {}).at(0).column("top", "displacement");
  double largest = 0.0, off = 0.0;
  for (size_t i = 0; i < whole.size(); ++i) {
    largest = std::max(largest, std::abs(whole[i]));
    off = std::max(off, std::abs(whole[i] - cut[i]));
  }
  EXPECT_GT(largest, 1e-6);
  EXPECT_LT(off, 1e-4 * largest);
}

// Hexahedra stay whole: the cut is where they have facets. Cut twice, the new faces have names of their own.
TEST(CutMeshes, of_hexahedra_may_be_cut_again) {
  const DeckRun run = run_text(R"(
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0, density = 7800 }
local first = mesh.box{ size = { 10*mm, 10*mm, 60*mm }, cells = { 2, 2, 6 } }:cut{ normal = { 0, 0, 1 }, at = 19*mm }
local second = first[2]:cut{ normal = { 0, 0, 2 }, at = 40*mm, face = "again" }
local a = substructure{ name = "a", mesh = first[1], material = steel }
local b = substructure{ name = "b", mesh = second[1], material = steel }
local c = substructure{ name = "c", mesh = second[2], material = steel }
local ab = interface.bonded{ name = "ab", between = { a:face "cut", b:face "cut" } }
local bc = interface.plastic{ name = "bc", between = { b:face "again", c:face "again" }, yield = 50*MPa }
local ends = support.fixed{ name = "ends", on = { a:face "zmin", c:face "zmax" } }
local tighten = step.static{ name = "tighten", loads = { load.shortening{ on = ab, by = 0.006*mm } } }
problem{ name = "rod", substructures = { a, b, c }, interfaces = { ab, bc }, supports = { ends }, steps = { tighten },
         outputs = { output.resultant{ name = "ab", on = ab }, output.joint{ name = "bc", on = bc } } }:run{}
)")
                          .at(0);
  EXPECT_NEAR(run.column("ab", "normal").back(), 200e9 * 1e-4 * 1e-4, 1e-5 * 2e3);
}

}  // namespace
}  // namespace dygita::test::cut_meshes_tests
