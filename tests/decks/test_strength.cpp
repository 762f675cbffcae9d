// Stress along the axes of a material with directions and its failure index, against what is known by hand.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "decks/engine.hpp"

namespace dygita::test::strength_tests {
namespace {

constexpr double xt = 1500e6, xc = 1200e6, yt = 50e6, yc = 200e6, s12 = 70e6, s23 = 60e6;  // Pa

std::string ply(const std::string& criterion) {
  return R"(
local ply = material.orthotropic{ name = "ply", e1 = 140*GPa, e2 = 10*GPa, e3 = 10*GPa, nu12 = 0.3, nu13 = 0.3, nu23 = 0.45,
                                  g12 = 5*GPa, g13 = 5*GPa, g23 = 3.4*GPa, density = 1600, criterion = ")" +
         criterion + R"(",
  strength = { xt = 1500*MPa, xc = 1200*MPa, yt = 50*MPa, yc = 200*MPa, zt = 50*MPa, zc = 200*MPa, s12 = 70*MPa, s13 = 70*MPa, s23 = 60*MPa } }
local function corner(part, x, y, z) return part:where(function(a, b, c) return near(a, x) and near(b, y) and near(c, z) end) end
local function held(part, l, w)
  return { load.displacement{ on = corner(part, 0, 0, 0), x = 0, y = 0, z = 0 }, load.displacement{ on = corner(part, l, 0, 0), y = 0, z = 0 },
           load.displacement{ on = corner(part, 0, w, 0), z = 0 } }
end
)";
}

// A strip under a stress along x alone, its fibres at an angle.
DeckRun pulled(const std::string& criterion, double degrees, double stress, const char* solver, int order = 1) {
  return run_text(
             ply(criterion) + R"(
local p = param{ angle = 0, stress = 0, order = 1 }
local c, s = math.cos(p.angle*deg), math.sin(p.angle*deg)
local strip = substructure{ name = "strip", material = ply, orientation = { { c, s, 0 }, { -s, c, 0 } },
                            mesh = mesh.box{ size = { 40*mm, 20*mm, 2*mm }, cells = { 4, 3, 1 }, order = p.order } }
local pull = step.static{ name = "pull", loads = { held(strip, 40*mm, 20*mm),
  load.traction{ on = strip:face "xmax", x = p.stress }, load.traction{ on = strip:face "xmin", x = -p.stress } } }
local r = problem{ name = "p", substructures = { strip }, steps = { pull }, outputs = {
  output.history{ name = "stress", on = corner(strip, 40*mm, 20*mm, 2*mm), quantity = "material_stress" },
  output.history{ name = "index", on = strip:face "ymax", quantity = "failure_index" } } }:run{}
assert(math.abs((1 + r[strip].margin) * r[strip].failure_index - 1) < 1e-12, "margin")
)",
             {{"angle", std::to_string(degrees)}, {"stress", std::to_string(stress)}, {"order", std::to_string(order)}},
             1, solver)
      .at(0);
}

// Of Tsai and Wu: the stress at which linear s + quadratic s^2 = 1, and how much of it there is.
double off_axis_index(double degrees, double stress) {
  const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
  const double f11 = 1 / (xt * xc), f22 = 1 / (yt * yc), f66 = 1 / (s12 * s12), f12 = -0.5 * std::sqrt(f11 * f22);
  const double linear = (1 / xt - 1 / xc) * c * c + (1 / yt - 1 / yc) * s * s;
  const double quadratic = f11 * std::pow(c, 4) + f22 * std::pow(s, 4) + (f66 + 2 * f12) * s * s * c * c;
  const double sign = stress < 0 ? -1 : 1;
  const double strength = (-sign * linear + std::sqrt(linear * linear + 4 * quadratic)) / (2 * quadratic);
  return std::abs(stress) / strength;
}

TEST(Strength, of_a_ply_pulled_off_its_axes_is_that_of_tsai_and_wu) {
  for (const double degrees : {0.0, 15.0, 30.0, 60.0, 90.0})
    for (const double stress : {40e6, -90e6}) {
      SCOPED_TRACE(std::to_string(degrees) + " " + std::to_string(stress));
      const DeckRun run =
          pulled("tsai_wu", degrees, stress, degrees == 30.0 ? "monolithic" : "latin", degrees == 15.0 ? 2 : 1);
      const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
      const double close = 1e-6 * std::abs(stress), index = off_axis_index(degrees, stress);
      EXPECT_NEAR(run.column("stress", "s11").back(), stress * c * c, close);
      EXPECT_NEAR(run.column("stress", "s22").back(), stress * s * s, close);
      EXPECT_NEAR(run.column("stress", "s12").back(), -stress * s * c, close);
      EXPECT_NEAR(run.column("stress", "s33").back(), 0.0, close);
      EXPECT_NEAR(run.column("index", "failure_index").back(), index, 1e-6 * index);
      const PartStress& peak = run.result->stresses.at(0);
      EXPECT_TRUE(peak.is_index);
      EXPECT_NEAR(peak.largest, index, 1e-6 * index);
      EXPECT_EQ(peak.above, index > 1 ? 1.0 : 0.0);
      EXPECT_NEAR(run.figure("largest failure index [1]"), index, 1e-6 * index);
      EXPECT_EQ(run.figures().count("smallest margin against yield [1]"), 0u);
    }
  // Twice the load is twice the index, although the criterion is quadratic and tells the signs apart.
  EXPECT_NEAR(off_axis_index(20, 80e6), 2 * off_axis_index(20, 40e6), 1e-12);
}

TEST(Strength, of_hashin_tells_fibres_from_matrix) {
  struct Case {
    double degrees, stress;
    const char* mode;
  };
  for (const auto& [degrees, stress, mode] : {Case{0.0, 100e6, "fibres in tension"},
                                              {0.0, -100e6, "fibres in compression"},
                                              {60.0, 40e6, "matrix in tension"},
                                              {60.0, -90e6, "matrix in compression"}}) {
    SCOPED_TRACE(mode);
    const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
    const double across = stress * s * s, shear = stress * s * c / s12;
    double index = degrees == 0.0 ? std::abs(stress) / (stress > 0 ? xt : xc) : std::hypot(across / yt, shear);
    if (degrees > 0.0 && stress < 0.0) {  // index^2 - b index - a = 0
      const double b = (std::pow(yc / (2 * s23), 2) - 1) * across / yc,
                   a = std::pow(across / (2 * s23), 2) + shear * shear;
      index = (b + std::sqrt(b * b + 4 * a)) / 2;
    }
    const DeckRun run = pulled("hashin", degrees, stress, "latin");
    EXPECT_EQ(run.result->stresses.at(0).mode, mode);
    EXPECT_NEAR(run.result->stresses.at(0).largest, index, 1e-6 * index);
  }
}

// Shear along the axes, and along axes at 45 degrees to it, where it is a pull and a push.
TEST(Strength, in_pure_shear) {
  for (const bool is_turned : {false, true}) {
    const DeckRun run = run_text(ply("tsai_wu") + R"(
local p = param{ turned = 0 }
local axes = p.turned == 1 and { { 1, 1, 0 }, { -1, 1, 0 } } or { { 1, 0, 0 }, { 0, 1, 0 } }
local block = substructure{ name = "block", material = ply, orientation = axes, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 2, 2, 2 } } }
local t = 20*MPa
local shear = step.static{ name = "shear", loads = { held(block, 10*mm, 10*mm),
  load.traction{ on = block:face "xmax", y = t }, load.traction{ on = block:face "xmin", y = -t },
  load.traction{ on = block:face "ymax", x = t }, load.traction{ on = block:face "ymin", x = -t } } }
problem{ name = "p", substructures = { block }, steps = { shear }, outputs = { output.history{ name = "stress", on = block:face "zmax", quantity = "material_stress" } } }:run{}
)",
                                 {{"turned", is_turned ? "1" : "0"}}, 1)
                            .at(0);
    const double t = 20e6, f11 = 1 / (xt * xc), f22 = 1 / (yt * yc);
    const double linear = t * ((1 / xt - 1 / xc) - (1 / yt - 1 / yc)),
                 quadratic = t * t * (f11 + f22 + std::sqrt(f11 * f22));
    const double index = is_turned ? (linear + std::sqrt(linear * linear + 4 * quadratic)) / 2 : t / s12;
    EXPECT_NEAR(run.result->stresses.at(0).largest, index, 1e-6 * index);
    EXPECT_NEAR(run.column("stress", is_turned ? "s22" : "s12").back(), is_turned ? -t : t, 1e-6 * t);
  }
}

// A wave in a bar of fibres, watched between the instants at which all nodes are seen: rho c v, doubled where it is
// held.
TEST(Strength, is_watched_in_motion_explicitly_too) {
  for (const char* is_explicit : {"0", "1"}) {
    const DeckRun run = run_text(R"(
local p = param{ explicit = 0 }
local fabric = material.orthotropic{ name = "fabric", e1 = 90*GPa, e2 = 40*GPa, e3 = 10*GPa, nu12 = 0, nu13 = 0, nu23 = 0, g12 = 5*GPa, g13 = 4*GPa, g23 = 3*GPa, density = 1600,
  strength = { xt = 100*MPa, xc = 50*MPa, yt = 50*MPa, yc = 50*MPa, zt = 50*MPa, zc = 50*MPa, s12 = 30*MPa, s13 = 30*MPa, s23 = 30*MPa } }
local bar = substructure{ name = "bar", material = fabric, velocity = { -1, 0, 0 }, mesh = mesh.box{ size = { 60*mm, 1*mm, 1*mm }, cells = { 60, 1, 1 } }, integration = p.explicit == 1 and "explicit" or "implicit" }
local stop = support.fixed{ name = "stop", on = bar:face "xmin" }
local c = math.sqrt(90*GPa / 1600)
local hit = step.dynamic{ name = "hit", duration = 60*mm / c, dt = 0.5*mm / c }
problem{ name = "p", substructures = { bar }, supports = { stop }, steps = { hit }, outputs = {
  output.history{ name = "behind", on = bar:where(function(x) return near(x, 10*mm) end), quantity = "failure_index" } } }:run{}
)",
                                 {{"explicit", is_explicit}}, 1)
                            .at(0);
    const double push = 1600 * std::sqrt(90e9 / 1600) * 1.0, b = -push * (1 / 100e6 - 1 / 50e6),
                 index = (b + std::sqrt(b * b + 4 * push * push / (100e6 * 50e6))) / 2;
    EXPECT_NEAR(push / 50e6, index, 1e-12);  // by hand: a push along one axis
    EXPECT_NEAR(run.column("behind", "failure_index").back(), index, 0.03 * index) << is_explicit;
    EXPECT_GT(run.result->stresses.at(0).largest, index);
  }
}

// In two pieces, the part turned as a whole: the same.
TEST(Strength, turns_with_the_part_and_is_the_same_in_pieces) {
  const std::string scene = ply("tsai_wu") + R"(
local p = param{ turned = 0, pieces = 1 }
local part = substructure{ name = "part", material = ply, orientation = { { 1, 0.5, 0.3 }, { 0, 1, 1 } }, mesh = mesh.box{ size = { 30*mm, 10*mm, 10*mm }, cells = { 6, 2, 2 } },
                           place = p.turned == 1 and { rotate = { axis = { 0, 0, 1 }, angle = 90*deg } } or { 0, 0, 0 } }
local base = support.fixed{ name = "base", on = part:face "xmin" }
local push = p.turned == 1 and { x = -5*MPa, y = 20*MPa, z = 3*MPa } or { x = 20*MPa, y = 5*MPa, z = 3*MPa }
local press = step.static{ name = "press", loads = { load.traction{ on = part:face "xmax", x = push.x, y = push.y, z = push.z } } }
problem{ name = "p", substructures = { part }, supports = { base }, steps = { press }, solver = solver.latin{ pieces = p.pieces, tolerance = 1e-9 },
  outputs = { output.history{ name = "stress", on = part:face "zmax", quantity = "material_stress" } } }:run{}
)";
  const DeckRun one = run_text(scene, {}, 1).at(0);
  for (const Settings& other : {Settings{{"turned", "1"}}, Settings{{"pieces", "2"}}}) {
    const DeckRun run = run_text(scene, other, 1).at(0);
    EXPECT_NEAR(run.result->stresses.at(0).largest, one.result->stresses.at(0).largest,
                1e-5 * one.result->stresses.at(0).largest);
    for (const char* component : {"s11", "s22", "s13"})
      EXPECT_NEAR(run.column("stress", component).back(), one.column("stress", component).back(), 1e3);
  }
}

}  // namespace
}  // namespace dygita::test::strength_tests
