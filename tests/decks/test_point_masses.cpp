// Masses with their inertia on faces: against beam theory, the motion of a rigid body, and the two words they stand
// for.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "decks/engine.hpp"

namespace dygita::test::point_masses_tests {
namespace {

// A clamped beam of 400 mm with 0.5 kg, 30 mm beyond its end.
constexpr double length = 0.4, side = 0.01, young = 200e9, density = 7800, mass = 0.5, offset = 0.03;
constexpr double area = side * side, bending = area * area / 12;

std::string beam(const std::string& box) {
  return R"(
local p = param{ motion = 0 }
local motions = { [0] = "mean", "rigid" }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0, density = 7800 }
local beam = substructure{ name = "beam", mesh = mesh.box{ size = { 0.4, 0.01, 0.01 }, cells = { 20, 2, 2 }, order = 2 }, material = steel }
)" + box +
         R"(
local base = support.fixed{ name = "base", on = beam:face "xmin" }
local weigh = step.static{ name = "weigh", loads = { load.gravity{ z = -10 } } }
local let = step.dynamic{ name = "let", after = weigh, duration = 2*ms, dt = 0.1*ms, loads = { load.gravity{ z = 0 } } }
problem{ name = "tip", substructures = { beam, box }, interfaces = joints, supports = { base }, steps = { weigh, let }, solver = solver.latin{ tolerance = 1e-9 },
  outputs = { output.history{ name = "tip", on = beam:face "xmax", quantity = "displacement" }, output.resultant{ name = "base", on = base }, output.modes{ name = "modes", n = 5 } } }:run{}
)";
}

const std::string in_one = R"(
local box = mass.point{ name = "box", on = beam:face "xmax", mass = 0.5, inertia = { 2e-4, 3e-4, 4e-4 }, at = { 0.43, 0.005, 0.005 }, motion = motions[p.motion] }
local joints = {}
)";
const std::string in_two = R"(
local box = substructure.rigid{ name = "box", on = beam:face "xmax", mass = 0.5, inertia = { 2e-4, 3e-4, 4e-4 }, at = { 0.43, 0.005, 0.005 } }
local joints = { interface.bonded{ name = "feet", between = { beam:face "xmax", box:face "xmax" }, motion = p.motion == 0 and "mean" or "points" } }
)";

// Of Bernoulli's beam with a mass of inertia J (about its own centre) beyond its end: w = a (cosh - cos) + b (sinh -
// sin), E I w''' = -w^2 m (w + e w'), E I w'' = w^2 ((J + m e^2) w' + m e w) there.
double determinant(double omega, double inertia) {
  const double wave = std::pow(density * area * omega * omega / (young * bending), 0.25), x = wave * length;
  const double c = std::cos(x), s = std::sin(x), ch = std::cosh(x), sh = std::sinh(x), m = omega * omega * mass;
  const std::array<std::array<double, 4>, 2> shapes = {
      {{ch - c, wave * (sh + s), wave * wave * (ch + c), std::pow(wave, 3) * (sh - s)},
       {sh - s, wave * (ch - c), wave * wave * (sh + s), std::pow(wave, 3) * (ch + c)}}};
  std::array<std::array<double, 2>, 2> rows;
  for (size_t i = 0; i < 2; ++i) {
    const auto& w = shapes[i];
    rows[i] = {young * bending * w[3] + m * (w[0] + offset * w[1]),
               young * bending * w[2] - omega * omega * (inertia + mass * offset * offset) * w[1] - m * offset * w[0]};
  }
  return rows[0][0] * rows[1][1] - rows[0][1] * rows[1][0];
}

std::vector<double> frequencies(double inertia) {
  std::vector<double> found;
  for (double omega = 10.0; found.size() < 2; omega *= 1.001) {
    double low = omega, high = omega * 1.001;
    if (determinant(low, inertia) * determinant(high, inertia) > 0) continue;
    for (int k = 0; k < 60; ++k) {
      const double middle = (low + high) / 2;
      (determinant(low, inertia) * determinant(middle, inertia) > 0 ? low : high) = middle;
    }
    found.push_back(low / (2 * std::numbers::pi));
  }
  return found;
}

TEST(PointMasses, swing_on_a_clamped_beam_as_beam_theory_says) {
  for (const char* motion : {"0", "1"}) {
    SCOPED_TRACE(motion);
    const DeckRun run = run_text(beam(in_one), {{"motion", motion}}).at(0);
    const std::vector<double>& found = run.column("modes", "frequency");
    const std::vector<double> in_y = frequencies(4e-4), in_z = frequencies(3e-4);
    EXPECT_NEAR(found.at(0), in_y[0], 5e-4 * in_y[0]);
    EXPECT_NEAR(found.at(1), in_z[0], 5e-4 * in_z[0]);
    EXPECT_NEAR(found.at(2), in_y[1], 2.5e-3 * in_y[1]);
    EXPECT_NEAR(found.at(3), in_z[1], 2.5e-3 * in_z[1]);
    const double own = density * area * length, stiffness = young * bending;
    const double sag =
        10 * (own * std::pow(length, 3) / 8 + mass * std::pow(length, 3) / 3 + mass * offset * length * length / 2) /
        stiffness;
    EXPECT_NEAR(run.column("tip", "z").at(1), -sag, 5e-4 * sag);
    EXPECT_NEAR(run.column("base", "z").front(), 10 * (own + mass), 1e-6 * 10 * (own + mass));
  }
}

TEST(PointMasses, are_a_rigid_body_and_a_bond_in_one) {
  for (const char* motion : {"0", "1"}) {
    const DeckRun one = run_text(beam(in_one), {{"motion", motion}}).at(0),
                  two = run_text(beam(in_two), {{"motion", motion}}).at(0);
    EXPECT_EQ(one.column("modes", "frequency"), two.column("modes", "frequency"));
    EXPECT_EQ(one.column("tip", "z"), two.column("tip", "z"));
  }
}

// A bar in space with a mass at its end, pushed softly: it moves and turns as a rigid body.
TEST(PointMasses, are_pushed_as_a_rigid_body) {
  for (const char* motion : {"mean", "rigid"}) {
    const DeckRun run = run_text(std::string(R"(
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local bar = substructure{ name = "bar", mesh = mesh.box{ size = { 0.1, 0.02, 0.02 }, cells = { 6, 2, 2 }, order = 2 }, material = steel }
local box = mass.point{ name = "box", on = bar:face "xmax", mass = 0.4, inertia = { 1e-4, 2e-4, 2.5e-4 }, at = { 0.13, 0.01, 0.02 }, motion = ")") +
                                 motion + R"(" }
local push = load.force{ on = bar:face "xmin", y = history.half_sine{ peak = 100, duration = 2*ms }, z = history.half_sine{ peak = 50, duration = 2*ms } }
local function at(face) return output.history{ name = face, on = bar:face(face), quantity = "displacement" } end
problem{ name = "push", substructures = { bar, box }, steps = { step.dynamic{ name = "push", duration = 3*ms, dt = 10*us, loads = { push } } },
         outputs = { output.momentum{ name = "momentum" }, at "xmin", at "xmax", at "zmin", at "zmax" } }:run{}
)")
                            .at(0);
    const double duration = 2e-3, impulse = 2 / std::numbers::pi * 100 * duration;
    EXPECT_NEAR(run.column("momentum", "y").back(), impulse, 1e-3 * impulse);
    EXPECT_NEAR(run.column("momentum", "z").back(), impulse / 2, 1e-3 * impulse);
    const double m1 = 7800 * 0.1 * 4e-4, m2 = 0.4;
    const Vec3 x1(0.05, 0.01, 0.01), x2(0.13, 0.01, 0.02), centre = (m1 * x1 + m2 * x2) / (m1 + m2);
    Mat3 inertia = Vec3(m1 * 8e-4 / 12, m1 * 104e-4 / 12, m1 * 104e-4 / 12).asDiagonal();
    inertia += Vec3(1e-4, 2e-4, 2.5e-4).asDiagonal();
    for (const auto& [m, x] : {std::pair(m1, x1), {m2, x2}}) {
      const Vec3 d = x - centre;
      inertia += m * (d.squaredNorm() * Mat3::Identity() - d * d.transpose());
    }
    const double lasting =
        100 * duration / std::numbers::pi * duration + impulse * 1e-3;  // the force, integrated twice
    const Vec3 turn = inertia.inverse() * Vec3(Vec3(0, 0.01, 0.01) - centre).cross(Vec3(0, lasting, lasting / 2));
    const auto last = [&](const char* face, const char* d) { return run.column(face, d).back(); };
    EXPECT_NEAR((last("zmin", "y") - last("zmax", "y")) / 0.02, turn[0], 1e-3 * turn.norm()) << motion;
    EXPECT_NEAR((last("xmin", "z") - last("xmax", "z")) / 0.1, turn[1], 1e-3 * turn.norm()) << motion;
    EXPECT_NEAR((last("xmax", "y") - last("xmin", "y")) / 0.1, turn[2], 1e-3 * turn.norm()) << motion;
  }
}

// About an axis through its centre that is none of its principal ones a mass pulls by no force, and by the moment
// -w x J w: a bar bends as by a couple at its end. On a plane of symmetry it is not held, which is said.
TEST(PointMasses, bend_a_bar_that_spins_by_their_products_of_inertia) {
  constexpr double product = -5e-5, speed = 500.0, long_side = 0.1, modulus = 200e9, second = 1e-8 / 12;
  for (const char* motion : {"mean", "rigid"}) {
    testing::internal::CaptureStderr();
    const DeckRun run = run_text(std::string(R"(
local light = material.elastic{ name = "light", young = 200*GPa, poisson = 0, density = 10 }
local bar = substructure{ name = "bar", material = light,
  mesh = mesh.box{ origin = { -5*mm, -5*mm, 0 }, size = { 10*mm, 10*mm, 100*mm }, cells = { 2, 2, 20 }, order = 2 } }
local box = mass.point{ name = "box", on = bar:face "zmax", mass = 0.2, inertia = { 1e-4, 1.2e-4, 1e-4, 0, -5e-5, 0 }, at = { 0, 0, 100*mm }, motion = ")") +
                                 motion + R"(" }
local base, plane = support.fixed{ name = "base", on = bar:face "zmin" }, support.symmetry{ name = "plane", on = bar:face "ymin" }
local spin = step.static{ name = "spin", loads = { load.spin{ speed = 500, axis = { 0, 0, 1 } } }, supports = { base } }
problem{ name = "spin", substructures = { bar, box }, supports = { base, plane }, steps = { spin, step.static{ name = "after", after = spin, supports = { base, plane } } },
  outputs = { output.history{ name = "tip", on = bar:face "zmax", quantity = "displacement" } } }:run{}
)")
                            .at(0);
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_NE(said.find("rigid body 'box' is joined to face 'bar.zmax', which ends on the plane of support.symmetry "
                        "'plane': that plane does not hold the body"),
              std::string::npos)
        << said;
    const double moment = speed * speed * -product;
    EXPECT_NEAR(run.column("tip", "x").at(1), moment * long_side * long_side / (2 * modulus * second), 1e-9) << motion;
  }
}

// A mass on two feet, without moments of its own, weighs on both; its bonds are outputs' to ask for.
TEST(PointMasses, stand_on_several_faces) {
  const DeckRun run = run_text(R"(
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local function foot(name, x) return substructure{ name = name, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 2, 2, 2 }, origin = { x, 0, 0 } }, material = steel } end
local left, right = foot("left", 0), foot("right", 90*mm)
local box = mass.point{ name = "box", on = { left:face "zmax", right:face{ normal = { 0, 0, 1 }, at = 10*mm } }, mass = 2, at = { 35*mm, 5*mm, 30*mm } }
local ground = support.fixed{ name = "ground", on = { left:face "zmin", right:face "zmin" } }
problem{ name = "feet", substructures = { left, right, box }, supports = { ground }, steps = { step.static{ name = "weigh", loads = { load.gravity{ z = -10 } } } },
         outputs = { output.resultant{ name = "left", on = box.joints[1] }, output.resultant{ name = "right", on = box.joints[2] } } }:run{}
)")
                          .at(0);
  EXPECT_NEAR(run.column("left", "z").back() + run.column("right", "z").back(), -20.0, 1e-6 * 20);
}

}  // namespace
}  // namespace dygita::test::point_masses_tests
