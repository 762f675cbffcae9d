// Motions that a theory of small displacements does not know are named, with figures, place and time.
#include <gtest/gtest.h>

#include "decks/engine.hpp"

namespace dygita::test::small_displacements_tests {
namespace {

std::string all(const DeckRun& run) {
  std::string text;
  for (const std::string& warning : run.result->warnings) text += warning + "\n";
  return text;
}

void expect_said(const std::string& said, const std::vector<std::string>& what) {
  for (const std::string& each : what) EXPECT_NE(said.find(each), std::string::npos) << each << "\nnot in\n" << said;
}

// A block of 20 mm with cells of 10 mm, thrown along a plate of 40 mm with cells as wide.
DeckRun thrown(const std::string& speed, const std::string& friction) {
  return run_text(R"(
local p = param{ speed = 1, mu = 0 }
local m = material.elastic{ name = "m", young = 1*GPa, poisson = 0, density = 1000 }
local plate = substructure{ name = "plate", material = m, mesh = mesh.box{ size = { 40*mm, 20*mm, 10*mm }, cells = { 4, 2, 1 } } }
local block = substructure{ name = "block", material = m, velocity = { p.speed, 0, 0 },
  mesh = mesh.box{ origin = { 0, 0, 10*mm }, size = { 20*mm, 20*mm, 10*mm }, cells = { 2, 2, 1 } } }
local touch = interface.contact{ name = "touch", between = { plate:face "zmax", block:face "zmin" }, friction = p.mu }
local floor = support.fixed{ name = "floor", on = plate:face "zmin" }
problem{ name = "thrown", substructures = { plate, block }, interfaces = { touch }, supports = { floor },
  steps = { step.dynamic{ name = "slide", duration = 1*ms, dt = 5*us, loads = { load.gravity{ z = -1000 } } } } }:run{}
)",
                  {{"speed", speed}, {"mu", friction}})
      .at(0);
}

TEST(SmallDisplacements, a_block_that_slides_beyond_half_a_cell_is_named) {
  for (const char* friction : {"0", "0.1"}) {
    const DeckRun run = thrown("8", friction);
    expect_said(all(run), {"interface 'touch' slides by ", " mm at (", "t = 1 ms in step 'slide'",
                           "; too large since t = 0.6", "half a cell is 5 mm there"});
    EXPECT_NEAR(run.figure("largest slip [contact cells]"), 0.8, 0.01) << friction;
  }
}

TEST(SmallDisplacements, a_block_that_has_slid_off_its_plate_is_said_to_be_carried_still) {
  const std::string said = all(thrown("78", "0"));
  expect_said(said,
              {"slides by 78", "it is 20 mm long there, so one side has slid off the other but is still supported"});
}

TEST(SmallDisplacements, a_block_that_slides_little_is_no_matter) {
  const DeckRun run = thrown("4", "0");
  EXPECT_EQ(all(run), "");
  EXPECT_FALSE(run.figures().contains("largest slip [contact cells]"));
}

// A cantilever of 100 mm; F L^3 / (3 E I) at its end, and a slope of F L^2 / (2 E I).
TEST(SmallDisplacements, a_cantilever_that_turns_is_named_with_its_angle) {
  const auto bent = [](const std::string& force) {
    return run_text(R"(
local p = param{ force = 1 }
local m = material.elastic{ name = "m", young = 200*GPa, poisson = 0, density = 8000 }
local beam = substructure{ name = "beam", material = m, mesh = mesh.box{ size = { 100*mm, 5*mm, 2*mm }, cells = { 20, 1, 1 } } }
local clamp = support.fixed{ name = "clamp", on = beam:face "xmin" }
problem{ name = "cantilever", substructures = { beam }, supports = { clamp },
  steps = { step.static{ name = "bend", loads = { load.force{ on = beam:face "xmax", z = p.force } } } } }:run{}
)",
                    {{"force", force}})
        .at(0);
  };
  const double inertia = 5e-3 * 8e-9 / 12;  // m^4
  const double slope = 390.0 * 0.01 / (2 * 200e9 * inertia);
  const DeckRun far = bent("390");  // deflects 195 mm
  expect_said(all(far),
              {"substructure 'beam' turns by ", "degrees at (97.5, 2.5, 1) mm, increment 1 of static step 'bend'",
               "valid to about 5 degrees"});
  EXPECT_NEAR(far.figure("largest rotation [degrees]"), std::atan(slope) * 57.29578, 0.5);
  EXPECT_EQ(all(bent("10")), "");  // 4.3 degrees
}

// A bar pulled to a strain of q / E all over: the strain farthest from zero counts, that of compression, too.
TEST(SmallDisplacements, a_bar_that_is_strained_too_far_is_named_with_its_strain) {
  const auto pulled = [](const std::string& traction, const std::string& solver) {
    return all(run_text(R"(
local p = param{ q = 1, monolithic = 0 }
local m = material.elastic{ name = "m", young = 200*GPa, poisson = 0, density = 8000 }
local bar = substructure{ name = "bar", material = m, mesh = mesh.box{ size = { 100*mm, 10*mm, 10*mm }, cells = { 10, 1, 1 } } }
problem{ name = "pulled", substructures = { bar }, supports = { support.fixed{ name = "wall", on = bar:face "xmin" } },
  steps = { step.static{ name = "pull", increments = 2, loads = { load.traction{ on = bar:face "xmax", x = p.q*GPa } } } },
  solver = p.monolithic == 1 and solver.monolithic{} or nil }:run{}
)",
                        {{"q", traction}, {"monolithic", solver}})
                   .at(0));
  };
  for (const char* monolithic : {"0", "1"}) {
    expect_said(pulled("100", monolithic), {"substructure 'bar' is strained by 50 % at ",
                                            "increment 2 of static step 'pull'; too large since increment 1",
                                            "strains are assumed small, which is valid to some 10 %"});
    expect_said(pulled("-24", monolithic),
                {"substructure 'bar' is strained by 12 % at ", "increment 2 of static step 'pull':"});
    EXPECT_EQ(pulled("19", monolithic), "");  // 9.5 %
  }
}

TEST(SmallDisplacements, parts_that_leave_each_other_are_named) {
  const DeckRun run = run_text(R"(
local m = material.elastic{ name = "m", young = 1*GPa, poisson = 0, density = 1000 }
local function cube(name, z, v)
  return substructure{ name = name, material = m, velocity = { 0, 0, v }, mesh = mesh.box{ origin = { 0, 0, z }, size = { 10*mm, 10*mm, 10*mm }, cells = { 2, 2, 2 } } }
end
local low, high = cube("low", 0, 0), cube("high", 10*mm, 20)
local touch = interface.contact{ name = "touch", between = { low:face "zmax", high:face "zmin" } }
problem{ name = "leaves", substructures = { low, high }, interfaces = { touch },
  steps = { step.dynamic{ name = "fly", duration = 0.4*ms, dt = 4*us } } }:run{}
)")
                          .at(0);
  expect_said(all(run), {"interface 'touch' is open everywhere, by 8 mm at least, t = 0.4 ms in step 'fly'",
                         "more than a cell (5 mm)"});
}

TEST(SmallDisplacements, sides_that_a_release_lets_pass_into_each_other_are_named) {
  const DeckRun run = run_text(R"(
local m = material.elastic{ name = "m", young = 1*GPa, poisson = 0, density = 1000 }
local function cube(name, z, v)
  return substructure{ name = name, material = m, velocity = { 0, 0, v }, mesh = mesh.box{ origin = { 0, 0, z }, size = { 10*mm, 10*mm, 10*mm }, cells = { 2, 2, 2 } } }
end
local low, high = cube("low", 0, 0), cube("high", 10*mm, -5)
local weld = interface.bonded{ name = "weld", between = { low:face "zmax", high:face "zmin" } }
problem{ name = "released", substructures = { low, high }, interfaces = { weld },
  steps = { step.dynamic{ name = "fly", duration = 0.4*ms, dt = 4*us, loads = { load.release{ on = weld, at = 0 } } } } }:run{}
)")
                          .at(0);
  expect_said(all(run), {"interface 'weld' is released, and its sides overlap by 2 mm"});
}

}  // namespace
}  // namespace dygita::test::small_displacements_tests
