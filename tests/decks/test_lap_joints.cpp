// Lap joints that slip little by little in decks, with every solver: Segalman's backbone, the loss of cycles,
// macroslip, a free swing, turned, and a superelement.
#include <gtest/gtest.h>

#include <any>
#include <cmath>

#include "decks/deck_prints.hpp"
#include "reduction/superelement.hpp"

namespace dygita::test::lap_joints_tests {
namespace {

// A cube between two lap joints on fixed blocks: moved to and fro by u (mm; what = 0), thrown (1), or pushed until all
// slides (2).
const std::string lap = R"(
local p = param{ turned = 0, what = 0, u = 0.5, sliders = 30, beta = 0.1 }
local steel = material.elastic{ name = "steel", young = 2000*GPa, poisson = 0, density = 7800 }
local function turned(v)
  if p.turned == 0 then return v end
  local n, c, s = math.sqrt(14), math.cos(0.7), math.sin(0.7)
  local a = { 1/n, 2/n, 3/n }
  local d = a[1]*v[1] + a[2]*v[2] + a[3]*v[3]
  return { c*v[1] + s*(a[2]*v[3] - a[3]*v[2]) + (1 - c)*d*a[1], c*v[2] + s*(a[3]*v[1] - a[1]*v[3]) + (1 - c)*d*a[2], c*v[3] + s*(a[1]*v[2] - a[2]*v[1]) + (1 - c)*d*a[3] }
end
local function box(name, z, height, cells, velocity)
  return substructure{ name = name, material = steel, velocity = velocity, mesh = mesh.box{ origin = { 0, 0, z }, size = { 10*mm, 10*mm, height }, cells = cells },
    place = p.turned == 1 and { rotate = { axis = { 1, 2, 3 }, angle = 0.7 } } or nil }
end
local low, high = box("low", -4*mm, 4*mm, { 2, 2, 1 }), box("high", 10*mm, 4*mm, { 2, 2, 1 })
local mid = box("mid", 0, 10*mm, { 2, 2, 2 }, p.what == 1 and turned{ 2.0, 0.5, 0 } or nil)
local function iwan(name, a, b)
  return interface.iwan{ name = name, between = { a, b }, slip = 1*MPa, stiffness = 2e9, chi = -0.5, beta = p.beta, sliders = p.sliders }
end
local lower, upper = iwan("lower", low:face "zmax", mid:face "zmin"), iwan("upper", mid:face "zmax", high:face "zmin")
local base = support.fixed{ name = "base", on = { low:face "zmin", high:face "zmax" } }
local steps
if p.what == 0 then   -- a first motion, back and forth: twice to amplitude u (mm)
  steps = { step.static{ name = "cycle", increments = 180, loads = {
    load.displacement{ on = mid:face "xmax", x = function(t) return p.u*mm * math.sin(4.5 * math.pi * t) end } } } }
elseif p.what == 1 then
  steps = { step.dynamic{ name = "swing", duration = 3*ms, dt = 4*us } }
else
  steps = { step.static{ name = "slip", increments = 10, loads = { load.displacement{ on = mid:face "xmax", x = function(t) return 3*mm * t end } } } }
end
problem{ name = "lap", substructures = { low, mid, high }, interfaces = { lower, upper }, supports = { base }, steps = steps,
  outputs = { output.joint{ name = "lower", on = lower }, output.joint{ name = "upper", on = upper },
    output.history{ name = "place", on = mid:face "zmax", quantity = "displacement" }, output.energy{} } }:run{}
)";

constexpr double area = 1e-4, slip = 1e6, stiffness = 2e9, chi = -0.5, beta = 0.1;
const double shape = beta + (chi + 1) / (chi + 2), longest = slip * (1 + beta) / (stiffness * shape);
const double density = slip * (chi + 1) / (std::pow(longest, chi + 2) * shape);

double backbone(double u) {
  return area * (u < longest ? stiffness * u - density * std::pow(u, chi + 2) / ((chi + 1) * (chi + 2)) : slip);
}
double loss(double u) { return area * 4 * density * std::pow(u, chi + 3) / ((chi + 2) * (chi + 3)); }

class EveryLapJoint : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Lap, EveryLapJoint,
                         ::testing::Values("latin{ integration = 'implicit', tolerance = 1e-10 }",
                                           "latin{ integration = 'explicit' }", "monolithic",
                                           "explicit{ bulk_viscosity = false }"),
                         [](const auto& tested) {
                           std::string name = tested.param;
                           std::erase_if(name, [](char c) { return !std::isalpha(c); });
                           return name;
                         });

TEST_P(EveryLapJoint, follows_the_backbone_and_loses_by_the_power_law) {
  for (const char* amplitude : {"0.5", "0.05"}) {
    const DeckRun run = run_text(lap, {{"u", amplitude}}, 1, GetParam()).at(0);
    const double u = 1e-3 * std::atof(amplitude);
    const std::vector<double>&shear = run.column("lower", "shear"), &slid = run.column("lower", "slip");
    for (size_t i = 0; i < 20; ++i) EXPECT_NEAR(shear[i], backbone(slid[i]), 0.01 * backbone(u)) << i;
    // Two cycles of 80 increments, from the first top on: row 0 is the start.
    const std::vector<double>& friction = run.column("energy", "friction");
    const double lost = friction.at(180) - friction.at(20);
    EXPECT_NEAR(lost, 2 * 2 * loss(u), 0.015 * 4 * loss(u)) << amplitude;  // by the bands of 30 sliders
    EXPECT_LT(largest(run.column("energy", "balance")), 1e-6 * friction.back());
    EXPECT_NEAR(run.column("lower", "friction_work").back(), 0.5 * friction.back(), 1e-6 * friction.back());
  }
}

TEST_P(EveryLapJoint, slides_altogether_at_its_limit) {
  const DeckRun run = run_text(lap, {{"what", "2"}}, 1, GetParam()).at(0);
  EXPECT_NEAR(run.column("lower", "shear").back(), area * slip, 1e-9 * area * slip);
  EXPECT_NEAR(run.column("lower", "slip_area").back(), area, 1e-9 * area);
  EXPECT_EQ(run.column("lower", "slip_area").front(), 0.0);
}

// A free swing of a cube that both joints hold: energy is kept, friction never gives, and the motion dies down.
TEST_P(EveryLapJoint, swings_freely_and_loses_what_its_sliders_take) {
  const DeckRun run = run_text(lap, {{"what", "1"}}, 1, GetParam()).at(0);
  const double moving = 0.5 * 7.8e-3 * (4 + 0.25);
  EXPECT_LT(largest(run.column("energy", "balance")), 1e-4 * moving);
  EXPECT_LT(largest(run.column("energy", "scheme")), 5e-3 * moving);
  const std::vector<double>& friction = run.column("energy", "friction");
  for (size_t i = 1; i < friction.size(); ++i) EXPECT_GE(friction[i] - friction[i - 1], -1e-6 * moving);
  EXPECT_GT(friction.back(), 0.5 * moving);
  EXPECT_GT(largest(run.column("energy", "stored")), 0.3 * moving);
}

TEST(LapJoints, swing_alike_with_every_solver_and_turned) {
  const DeckRun one = run_text(lap, {{"what", "1"}}, 1, "latin{ integration = 'implicit', tolerance = 1e-10 }").at(0);
  const auto expect_alike = [&](const DeckRun& other, double enough) {
    for (const char* column : {"friction", "stored", "kinetic"}) {
      const double off = difference(one.column("energy", column), other.column("energy", column));
      std::cout << "  " << column << " differs by " << off << "\n";
      EXPECT_LT(off, enough) << column;
    }
  };
  expect_alike(run_text(lap, {{"what", "1"}}, 1, "monolithic").at(0), 1e-6);
  expect_alike(
      run_text(lap, {{"what", "1"}, {"turned", "1"}}, 1, "latin{ integration = 'implicit', tolerance = 1e-10 }").at(0),
      1e-6);
  expect_alike(run_text(lap, {{"what", "1"}}, 1, "latin{ integration = 'explicit' }").at(0), 5e-3);
  expect_alike(run_text(lap, {{"what", "1"}}, 1, "explicit{ bulk_viscosity = false }").at(0), 1e-2);
}

TEST(LapJoints, have_their_stiffness_in_a_superelement) {
  std::string deck = lap;
  const auto replace = [&](const std::string& what, const std::string& by) {
    deck.replace(deck.find(what), what.size(), by);
  };
  replace("output.energy{} }",
          "output.energy{}, output.superelement{ name = 'element', on = mid:face 'xmax', modes = 2 } }");
  const DeckRun run = run_text(deck, {{"what", "2"}}, 1).at(0);
  const Superelement& element = *std::any_cast<const SuperelementPtr&>(run.findings("element").model);
  const double k = 2 * area * stiffness;
  EXPECT_NEAR(element.stiffness(0, 0), k, 1e-3 * k);  // what turns round sticks
}

}  // namespace
}  // namespace dygita::test::lap_joints_tests
