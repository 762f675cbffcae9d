// Dampers in decks, with every solver: waves and decays by hand, static steps, energies, outputs, superelements.
#include <gtest/gtest.h>

#include <any>
#include <cmath>

#include "base/error.hpp"
#include "base/log.hpp"
#include "decks/deck_prints.hpp"
#include "reduction/superelement.hpp"

namespace dygita::test::dampers_tests {
namespace {

class EverySolver : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Damper, EverySolver, ::testing::Values("latin", "monolithic", "explicit"),
                         [](const auto& tested) { return std::string(tested.param); });

TEST_P(EverySolver, lets_through_a_damper_what_is_exact_and_slows_a_block_down_exponentially) {
  for (const char* ratio : {"0.25", "1", "4"}) {
    // Bulk viscosity takes 1 % of the energy of a front: the explicit code is compared without it.
    const std::string solver =
        GetParam() == std::string("explicit") ? "explicit{ bulk_viscosity = false }" : GetParam();
    const PrintedRun run = run_printing("verification/damper.lua", {{"ratio", ratio}, {"n", "120"}}, solver);
    const double c = std::atof(ratio);
    EXPECT_NEAR(run.number("wave: stress that gets through, exact"), 20.0 * 2 * c / (2 * c + 1), 0.01);
    EXPECT_LT(std::abs(run.number("wave: stress that gets through, error")), 0.2);
    EXPECT_LT(std::abs(run.number("wave: stroke at the end, error")), 1.0);
    EXPECT_LT(std::abs(run.number("wave: energy dissipated, error")), 1.0);
    EXPECT_LT(std::abs(run.number("normal: velocity after two times")), 0.2);
    EXPECT_LT(std::abs(run.number("tangent: velocity after two times")), 0.2);
    for (const DeckRun& each : run.runs) {
      EXPECT_TRUE(each.result->converged);
      EXPECT_LT(each.figure("energy imbalance [%]"), 0.2);
      EXPECT_LT(each.figure("energy dissipated by the scheme [%]"), 0.01);
    }
  }
}

// A damper in an edge with another, on nodes that a tie shares and on others that let waves out; let go in the end.
const std::string corner = R"(
local m = material.elastic{ name = "m", young = 70*GPa, poisson = 0.3, density = 2700 }
local function box(name, x, z, cells) return substructure{ name = name, material = m,
  mesh = mesh.box{ origin = { x, 0, z }, size = { 4*mm, 4*mm, 4*mm }, cells = { 2, 2, 2 } } } end
local corner, under, beside, on = box("corner", 4*mm, 4*mm), box("under", 4*mm, 0), box("beside", 0, 4*mm), box("on", 4*mm, 8*mm)
local c = math.sqrt(70e9 * 2700)
local foot = interface.viscous{ name = "foot", between = { under:face "zmax", corner:face "zmin" }, normal = c, tangential = 0.5 * c }
local side = interface.viscous{ name = "side", between = { beside:face "xmax", corner:face "xmin" }, normal = 2 * c }
local cap = interface.bonded{ name = "cap", between = { corner:face "zmax", on:face "zmin" } }
local base = support.fixed{ name = "base", on = { under:face "zmin", beside:face "xmin" } }
local out = support.absorbing{ name = "out", on = corner:face "ymax" }
local hit = step.dynamic{ name = "hit", duration = 8*us, dt = 0.02*us, loads = {
  load.traction{ on = on:face "zmax", x = history.half_sine{ peak = 30*MPa, duration = 3*us }, z = history.half_sine{ peak = -50*MPa, duration = 4*us } },
  load.release{ on = side, at = 6*us } } }
problem{ name = "corner", substructures = { corner, under, beside, on }, interfaces = { foot, side, cap }, supports = { base, out },
  steps = { hit }, outputs = { output.joint{ name = "foot", on = foot }, output.joint{ name = "side", on = side },
    output.history{ name = "top", on = on:face "zmax", quantity = "velocity" }, output.energy{} } }:run{}
)";

double far_apart(const DeckRun& a, const DeckRun& b, const std::string& output, const std::string& column) {
  const double d = difference(a.column(output, column), b.column(output, column));
  std::cout << "  " << output << "." << column << " differs by " << d << "\n";
  return d;
}

TEST(Dampers, in_an_edge_are_the_same_to_every_solver) {
  const DeckRun latin = run_text(corner, {}, 1, "latin{ tolerance = 1e-8, integration = 'implicit' }").at(0),
                monolithic = run_text(corner, {}, 1, "monolithic").at(0),
                full = run_text(corner, {}, 1, "explicit{ integration = \"full\", bulk_viscosity = false }").at(0);
  const std::vector<std::pair<std::string, std::string>> columns = {
      {"foot", "normal"},  {"foot", "shear"}, {"foot", "opening"},      {"foot", "slip"},     {"side", "normal"},
      {"side", "opening"}, {"top", "z"},      {"foot", "damping_work"}, {"energy", "damping"}};
  for (const auto& [output, column] : columns) {
    EXPECT_LT(far_apart(latin, monolithic, output, column), 1e-6);
    EXPECT_LT(far_apart(latin, full, output, column), 0.02);
  }
  for (const DeckRun* run : {&latin, &monolithic, &full}) {
    EXPECT_LT(run->figure("energy imbalance [%]"), 0.2);
    EXPECT_EQ(run->column("side", "normal").back(), 0.0);     // let go
    EXPECT_LT(largest(run->column("side", "shear")), 1e-20);  // free along its tangents
    // Both dampers and the absorbing support.
    const double joints = run->column("foot", "damping_work").back() + run->column("side", "damping_work").back();
    EXPECT_GT(joints, 0.1 * run->column("energy", "damping").back());
    EXPECT_LT(joints, run->column("energy", "damping").back());
    EXPECT_EQ(largest(run->column("foot", "stick_area")) + largest(run->column("foot", "slip_area")), 0.0);
  }
}

std::string hung(const std::string& steps) {
  return R"(
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local function box(name, z) return substructure{ name = name, material = steel,
  mesh = mesh.box{ origin = { 0, 0, z }, size = { 10*mm, 10*mm, 10*mm }, cells = { 2, 2, 2 } } } end
local low, high = box("low", 0), box("high", 10*mm)
local damper = interface.viscous{ name = "damper", between = { low:face "zmax", high:face "zmin" }, normal = 4e6, tangential = 1e6 }
local base = support.fixed{ name = "base", on = low:face "zmin" }
)" + steps;
}

TEST_P(EverySolver, leaves_a_part_that_only_a_damper_holds_unconstrained_in_a_static_step) {
  const std::string problem = R"(
local press = step.static{ name = "press", increments = 2, loads = { load.pressure{ on = PRESSED:face "xmax", history = 1*MPa } } }
problem{ name = "hung", substructures = { low, high }, interfaces = { damper }, supports = { base }, steps = { press },
  outputs = { output.joint{ name = "joint", on = damper },
              output.history{ name = "place", on = high:face "zmax", quantity = "displacement" } } }:run{}
)";
  const auto on = [&](const std::string& part) {
    std::string text = problem;
    return hung(text.replace(text.find("PRESSED"), 7, part));
  };
  testing::internal::CaptureStderr();
  const DeckRun run = run_text(on("low"), {}, 1, GetParam()).at(0);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_NE(said.find("substructure 'high' is unconstrained"), std::string::npos) << said;
  EXPECT_EQ(largest(run.column("joint", "normal")), 0.0);
  EXPECT_LT(largest(run.column("place", "z")), 1e-12);
  try {
    run_text(on("high"), {}, 1, GetParam());
    FAIL() << "a loaded part that nothing holds is accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("'high' is loaded, but no support or interface holds it: interface.viscous 'damper' "),
              std::string::npos)
        << error.what();
  }
}

// From a static step to a dynamic one and back: the damper works in the motion only.
TEST_P(EverySolver, starts_from_a_static_step_and_ends_in_one) {
  const DeckRun run = run_text(hung(R"(
local all = high:where(function() return true end)
local ties = support.fixed{ name = "ties", on = high:where(function(x, y, z) return near(z, 20*mm) end) }
local load = load.pressure{ on = high:face "xmax", history = history.half_sine{ peak = 50*MPa, duration = 5*us } }
local first = step.static{ name = "first", increments = 1 }
local shock = step.dynamic{ name = "shock", after = first, duration = 10*us, dt = 0.1*us, loads = { load } }
local last = step.static{ name = "last", after = shock, increments = 1 }
problem{ name = "hung", substructures = { low, high }, interfaces = { damper }, supports = { base, ties }, steps = { first, shock, last },
  outputs = { output.joint{ name = "joint", on = damper }, output.energy{} } }:run{}
)"),
                               {}, 1, GetParam())
                          .at(0);
  const std::vector<double>& normal = run.column("joint", "normal");
  EXPECT_GT(largest(normal), 0.0);
  EXPECT_EQ(normal.front(), 0.0);
  EXPECT_EQ(normal.back(), 0.0);
  EXPECT_LT(run.figure("energy imbalance [%]"), 0.2);
  EXPECT_NEAR(run.column("joint", "opening").back(), 0.0, 1e-15);  // all is straight again
}

TEST(Dampers, go_to_the_damping_of_a_superelement_and_add_no_stiffness) {
  const DeckRun run = run_text(hung(R"(
local rest = step.static{ name = "rest" }
problem{ name = "hung", substructures = { low, high }, interfaces = { damper }, supports = { base }, steps = { rest },
  outputs = { output.superelement{ name = "element", on = high:face "zmax", modes = 4 } } }:run{}
)"))
                          .at(0);
  const Superelement& element = *std::any_cast<const SuperelementPtr&>(run.result->findings.begin()->second.model);
  ASSERT_EQ(element.damping.rows(), element.stiffness.rows());
  const double area = 1e-4;
  // Rows: x, y, z and three rotations of the upper block's face; the first six motions are rigid.
  EXPECT_NEAR(element.damping(0, 0), 1e6 * area, 1e-6 * 1e6 * area);
  EXPECT_NEAR(element.damping(1, 1), 1e6 * area, 1e-6 * 1e6 * area);
  EXPECT_NEAR(element.damping(2, 2), 4e6 * area, 1e-6 * 4e6 * area);
  EXPECT_LT(element.stiffness.topLeftCorner(6, 6).norm(), 1e-6 * element.stiffness.norm());
  EXPECT_EQ(element.n_tied + element.n_normal + element.n_open, 0);
}

}  // namespace
}  // namespace dygita::test::dampers_tests
