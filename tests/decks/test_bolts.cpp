// bolt.hex: standard bolts, their stiffness, and patterns of them.
#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <cmath>

#include "decks/deck_prints.hpp"

namespace dygita::test {

namespace {

const double pi = std::acos(-1.0);

const std::string steel =
    "local steel = material.elastic{ name = 'steel', young = 200*GPa, poisson = 0, density = 7800 }\n";

// A bolt alone, its head held and its nut pulled by 10 kN: the shank stretches by F L/(E A), head and nut by the rest.
TEST(Bolts, the_shank_has_the_stiffness_of_its_section) {
  const auto stretch = [](const std::string& grip, const std::string& more) {
    const PrintedRun run = [&] {
      testing::internal::CaptureStdout();
      PrintedRun printed;
      printed.runs = run_text(steel + R"(
local screw = bolt.hex{ name = "screw", size = "M10", grip = )" +
                              grip + R"(, washer = false, material = steel)" + more + R"( }
local base = support.fixed{ name = "base", on = screw.upper }
local pull = step.static{ name = "pull", loads = { load.force{ on = screw.lower, z = -10*kN } } }
local a, b = output.history{ name = "a", on = screw.lower, quantity = "displacement", direction = { 0, 0, 1 } }, output.resultant{ name = "b", on = screw.shank }
problem{ name = "screw", substructures = screw.parts, interfaces = screw.interfaces, supports = { base }, steps = { pull }, outputs = { a, b } }:run{}
print(("area: %.12g"):format(screw.area))
)");
      printed.text = testing::internal::GetCapturedStdout();
      return printed;
    }();
    EXPECT_NEAR(run.runs.at(0).column("b", "normal").back(), 10e3, 1e-2);
    EXPECT_TRUE(run.runs.at(0).result->converged);
    return std::pair{-run.runs.at(0).column("a", "displacement").back(), run.number("area")};
  };
  for (const std::string more : {"", ", around = 24", ", order = 2", ", shank = 'nominal'"}) {
    const auto [shorter, area] = stretch("60*mm", more);
    const double diameter = more.find("nominal") == std::string::npos ? 10e-3 - 0.9382 * 1.5e-3 : 10e-3;
    EXPECT_NEAR(area, pi / 4.0 * diameter * diameter, 1e-9 * area);
    const double stiffness = 40e-3 / (stretch("100*mm", more).first - shorter);  // what 40 mm more of shank add
    EXPECT_NEAR(stiffness * 10e3, 200e9 * area, 1e-3 * 200e9 * area) << more;
  }
}

// Two plates from CAD with two clearance holes; bolts put through both by either pattern.
TEST(Bolts, of_a_pattern_are_named_placed_and_tightened_one_by_one) {
  const auto run = [](const std::string& pattern) {
    return run_text(steel + R"(
local file = mesh.step{ file = ")" +
                    (std::filesystem::path(DYGITA_SOURCE_DIR) / "meshes" / "joint.step").string() +
                    R"(", size = 9*mm, round = 8 }
local lower = substructure{ name = "lower", mesh = file:part "lower", material = steel }
local upper = substructure{ name = "upper", mesh = file:part "upper", material = steel }
local function screw() return bolt.hex{ name = "screw", size = "M8", grip = 18*mm, material = steel, place = { -20*mm, 0, 18*mm } } end
local screws = )" + pattern +
                    R"(
local contacts = interface.contact{ between = "all touching", friction = 0.2 }
assert(#screws == 2 and #screws.parts == 8 and #screws.interfaces == 6 and #contacts == 5)
local base = support.fixed{ name = "base", on = lower:face{ normal = { -1, 0, 0 }, at = 40*mm } }
local steps = {}
for _, i in ipairs{ 1, 2 } do
  steps[i] = step.static{ name = "tighten " .. i, after = steps[i - 1], loads = { load.preload{ on = screws[i].shank, force = 12*kN } } }
end
local outputs = {}
for i, contact in ipairs(contacts) do outputs[i] = output.resultant{ name = "contact" .. i, on = contact } end
problem{ name = "joint", substructures = { lower, upper, screws.parts }, interfaces = { contacts, screws.interfaces }, supports = { base },
         steps = steps, outputs = outputs }:run{}
)")
        .at(0);
  };
  const DeckRun line = run("pattern.line{ n = 2, step = { 40*mm, 0, 0 }, of = screw() }");
  const DeckRun circle = run("pattern.circle{ n = 2, axis = { 0, 0, 1 }, of = screw() }");
  const DeckRun through =
      run("bolt.through{ name = 'screw', size = 'M8', parts = { upper, lower }, material = steel }");
  for (const DeckRun* each : {&line, &circle, &through}) {
    EXPECT_TRUE(each->result->converged);
    ASSERT_EQ(each->result->bolts.size(), 2u);
    EXPECT_EQ(each->result->bolts[0].name, "screw[1]");
    EXPECT_EQ(each->result->bolts[1].name, "screw[2]");
    for (const BoltSummary& bolt : each->result->bolts) EXPECT_NEAR(bolt.tightened, 12e3, 1.0);
    EXPECT_EQ(each->problem.substructures[2]->name, "screw[1] head");
    // Plates on each other carry what both bolts have left; a washer what its bolt has.
    const double first = each->result->bolts[0].last, second = each->result->bolts[1].last;
    EXPECT_EQ(each->problem.interfaces[0]->name, "lower/upper");
    EXPECT_NEAR(each->column("contact1", "normal").back(), -(first + second), 5.0);
  }
  EXPECT_NEAR(line.result->bolts[0].last, circle.result->bolts[0].last, 20.0);
  for (const int i : {0, 1}) EXPECT_NEAR(line.result->bolts[i].last, through.result->bolts[i].last, 0.1) << i;
}

// Holes of few cells, curved or not, in parts that stand anywhere; the head is on the side of the first part.
TEST(Bolts, find_the_holes_that_they_go_through_whatever_the_mesh) {
  for (const std::string mesh : {"round = 5", "round = 6", "round = 8", "round = 16", "round = 6, order = 1"})
    for (const bool turned : {false, true})
      run_text(steel + R"(
local place = )" +
               std::string(turned ? "{ translate = { 1, 2, 3 }, rotate = { axis = { 1, 2, 3 }, angle = 50*deg } }"
                                  : "{ 0, 0, 0 }") +
               R"(
local file = mesh.step{ file = ")" +
               (std::filesystem::path(DYGITA_SOURCE_DIR) / "meshes" / "joint.step").string() + R"(", size = 9*mm, )" +
               mesh + R"( }
local lower = substructure{ name = "lower", mesh = file:part "lower", material = steel, place = place }
local upper = substructure{ name = "upper", mesh = file:part "upper", material = steel, place = place }
local down = bolt.through{ name = "down", size = "M8", parts = { upper, lower }, material = steel, n = 2 }
local up = bolt.through{ name = "up", size = "M8", parts = { lower, upper }, material = steel, n = 2 }
local half = bolt.through{ name = "half", size = "M8", parts = { upper }, material = steel, n = 2 }
for i = 1, 2 do
  local d, u, h = interface.contact{ name = "d" .. i, between = { upper, down[i].washers[1] } }, interface.contact{ name = "u" .. i, between = { lower, up[i].washers[1] } },
    interface.contact{ name = "h" .. i, between = { upper, half[i].washers[2] } }
end
local one = bolt.through{ name = "one", size = "M8", parts = { upper, lower }, material = steel,
  where = function(x, y, z) return )" +
               (turned ? "x > 1" : "x > 0") +
               R"( end }
assert(#one == 1, "the places of heads are those of the parts")
)");
}

// In the axes of their frame bolts are the same wherever the scene stands: hexagon, order and the head of a single
// part.
TEST(Bolts, turn_with_their_frame) {
  const auto run = [](const std::string& frame) {
    return run_text(steel + "local site = frame{" + frame + R"(}
local turn = { translate = site.origin, rotate = { axis = { 1, 2, 3 }, angle = )" +
                    (frame.empty() ? "0" : "50*deg") + R"( } }
local file = mesh.step{ file = ")" +
                    (std::filesystem::path(DYGITA_SOURCE_DIR) / "meshes" / "joint.step").string() +
                    R"(", size = 12*mm, round = 6, order = 1 }
local lower = substructure{ name = "lower", mesh = file:part "lower", material = steel, place = turn }
local upper = substructure{ name = "upper", mesh = file:part "upper", material = steel, place = turn }
local screws = bolt.through{ name = "screw", size = "M8", parts = { upper, lower }, material = steel, friction = 0.2, frame = site }
local contacts = interface.contact{ between = "all touching", friction = 0.2 }
local base = support.fixed{ name = "base", on = lower:face{ frame = site, normal = { -1, 0, 0 }, at = 40*mm } }
local tighten = step.static{ name = "tighten", loads = { load.preload{ on = screws[1].shank, force = 12*kN } } }
problem{ name = "joint", substructures = { lower, upper, screws.parts }, interfaces = { contacts, screws.interfaces }, supports = { base }, steps = { tighten },
  outputs = { output.history{ name = "tip", frame = site, on = screws[1].tip, quantity = "displacement", direction = { 1, 0, 0 } } },
  solver = solver.monolithic{ tolerance = 1e-10 } }:run{}
)")
        .at(0);
  };
  const DeckRun straight = run("");
  const double as_drawn = straight.column("tip", "displacement").back();
  // Axes of the frame: those of the deck, turned by 50 degrees about (1, 2, 3).
  const Eigen::Matrix3d q = Eigen::AngleAxisd(50.0 * pi / 180.0, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  const DeckRun turned = run(
      fmt::format("origin = {{ 1, 2, 3 }}, axis = {{ {:.17g}, {:.17g}, {:.17g} }}, x = {{ {:.17g}, {:.17g}, {:.17g} }}",
                  q(0, 2), q(1, 2), q(2, 2), q(0, 0), q(1, 0), q(2, 0)));
  EXPECT_TRUE(straight.result->converged && turned.result->converged);
  EXPECT_GT(std::abs(as_drawn), 1e-8);
  EXPECT_NEAR(turned.column("tip", "displacement").back(), as_drawn, 1e-6 * std::abs(as_drawn));
}

// A box from CAD on its bracket: every contact found, every bolt at its force, and the shock begun.
TEST(Bolts, hold_a_box_of_electronics_from_cad) {
  const PrintedRun box = run_printing("electronics_box.lua", {{"size", "18*mm"}, {"duration", "0.1*ms"}},
                                      "latin{ static_tolerance = 1e-6 }");
  const DeckRun& run = box.runs.at(0);
  EXPECT_EQ(run.problem.substructures.size(), 19u);
  EXPECT_EQ(run.problem.interfaces.size(), 22u);  // glue, feet, 8 washers on what they clamp, 3 in each bolt
  EXPECT_TRUE(run.result->converged);
  ASSERT_EQ(run.result->bolts.size(), 4u);
  for (const BoltSummary& bolt : run.result->bolts) EXPECT_NEAR(bolt.tightened, 8000.0, 5.0) << bolt.name;
  EXPECT_TRUE(is_finite(run));
  // In 0.1 ms the half-sine has given the base the integral of its acceleration.
  const double velocity = 1500 * 9.80665 * 0.5e-3 / M_PI * (1.0 - std::cos(M_PI * 0.1 / 0.5));
  EXPECT_NEAR(run.column("base", "velocity").back(), velocity, 0.03 * velocity);
}

// A unit of 28 solids from CAD in the coordinates of its launcher, coarse and without motion: eight bolts found by
// their holes have their forces, and what four of them clamp is pressed by these.
TEST(Bolts, hold_a_unit_of_28_solids_from_cad) {
  const PrintedRun unit = run_printing("instrument_unit.lua", {{"order", "1"}, {"duration", "0"}});
  const DeckRun& run = unit.runs.at(0);
  EXPECT_EQ(run.problem.substructures.size(), 28u + 8u * 4u);
  EXPECT_EQ(run.problem.interfaces.size(), 83u);
  EXPECT_TRUE(run.result->converged);
  ASSERT_EQ(run.result->bolts.size(), 8u);
  for (const BoltSummary& bolt : run.result->bolts)
    EXPECT_NEAR(bolt.tightened, bolt.name.starts_with("M6") ? 8000.0 : 5000.0, 5.0) << bolt.name;
  EXPECT_NEAR(run.column("unit on pedestal", "normal").back(), -4.0 * 5000.0, 20.0);
  EXPECT_TRUE(is_finite(run));
}

// Plates and a bolt with washers, turned as a whole: twelve points of each washer have equal areas, and which of them
// take in their neighbours may not depend on rounding.
TEST(Bolts, tightened_are_the_same_however_the_scene_stands_in_space) {
  const std::string plates = R"(
local p = param{ turn = 0 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local place = { translate = { 0, 0, 0 }, rotate = { axis = { 1, 2, 3 }, angle = p.turn } }
local function plate(name, z, height, layers)
  return substructure{ name = name, material = steel, place = place,
    mesh = mesh.box{ size = { 30*mm, 24*mm, height }, cells = { 9, 7, layers }, origin = { -13*mm, -11*mm, z } } }
end
local lower, upper = plate("lower", -22*mm, 12*mm, 2), plate("upper", -10*mm, 10*mm, 2)
local screw = bolt.hex{ name = "bolt", size = "M6", grip = 22*mm, washer = true, material = steel, friction = 0.15, place = place }
local top = interface.contact{ name = "top", between = { upper, screw.washers[1] }, friction = 0.15, points = "second" }
local below = interface.contact{ name = "below", between = { lower, screw.washers[2] }, friction = 0.15, points = "second" }
local mating = interface.contact{ name = "mating", between = { lower, upper }, friction = 0.15 }
local outputs = { output.energy{} }
for i, on in ipairs{ top, below, mating, screw.interfaces[2], screw.interfaces[3] } do outputs[i + 1] = output.joint{ name = "joint" .. i, on = on } end
problem{ name = "turned", substructures = { lower, upper, screw.parts }, interfaces = { top, below, mating, screw.interfaces }, outputs = outputs,
  supports = { support.fixed{ name = "ground", on = lower:face "xmin" } },
  steps = { step.static{ name = "tighten", loads = { load.preload{ on = screw.shank, force = 3*kN } } } },
  solver = solver.latin{ static_tolerance = 1e-10, static_steps = "assembled" } }:run{}
)";
  const DeckRun still = run_text(plates).at(0), turned = run_text(plates, {{"turn", "0.7"}}).at(0);
  for (const char* joint : {"joint1", "joint2", "joint3", "joint4", "joint5"})
    for (const char* column : {"normal", "slip", "friction_work"}) {
      const double value = still.column(joint, column).back();
      EXPECT_NEAR(turned.column(joint, column).back(), value, 1e-6 * std::abs(value)) << joint << "." << column;
    }
}

}  // namespace

}  // namespace dygita::test
