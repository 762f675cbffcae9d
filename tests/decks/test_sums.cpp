// Sums of motions that a deck joins: support.equation, and mean motions of faces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.hpp"
#include "decks/engine.hpp"

namespace dygita::test::sums_tests {
namespace {

// Two bars of steel (nu = 0) side by side along x, 100 and 50 mm long, of 1 cm^2, with a rigid body on the end of each.
std::vector<DeckRun> two_bars(const std::string& equation, const std::string& steps, const std::string& outputs,
                              const std::string& solver = "") {
  return run_text(R"(
local light = material.elastic{ name = "light", young = 200*GPa, poisson = 0, density = 10 }
local a = substructure{ name = "a", material = light, mesh = mesh.box{ size = { 100*mm, 10*mm, 10*mm }, cells = { 2, 1, 1 } } }
local b = substructure{ name = "b", material = light, mesh = mesh.box{ size = { 50*mm, 10*mm, 10*mm }, cells = { 2, 1, 1 }, origin = { 0, 30*mm, 0 } } }
local inertia = { 1e-3, 1e-3, 1e-3 }
local box_a = substructure.rigid{ name = "box a", on = a:face "xmax", mass = 2, inertia = inertia, at = { 100*mm, 5*mm, 5*mm } }
local box_b = substructure.rigid{ name = "box b", on = b:face "xmax", mass = 1, inertia = inertia, at = { 50*mm, 35*mm, 5*mm } }
local feet_a = interface.bonded{ name = "feet a", between = { a:face "xmax", box_a:face "xmax" } }
local feet_b = interface.bonded{ name = "feet b", between = { b:face "xmax", box_b:face "xmax" } }
local roots = support.fixed{ name = "roots", on = { a:face "xmin", b:face "xmin" } }
local lever = support.equation{ name = "lever", )" +
                  equation + R"( }
local pull = step.static{ name = "pull", loads = { load.force{ on = a:face "xmax", x = 10*kN } } }
)" + steps + R"(
problem{ name = "bars", substructures = { a, b, box_a, box_b }, interfaces = { feet_a, feet_b }, supports = { roots, lever }, steps = steps, )" +
                  solver + "outputs = { " + outputs + R"( } }:run{}
)");
}

constexpr double k_a = 200e9 * 1e-4 / 0.1, k_b = 200e9 * 1e-4 / 0.05;
const std::string ends =
    "output.history{ name = 'a', on = a:face 'xmax', quantity = 'displacement' }, "
    "output.history{ name = 'b', on = b:face 'xmax', quantity = 'displacement' }";

// 2 u_a = u_b: the second bar's spring counts four times on the first one's end.
TEST(Equations, are_a_lever_between_two_parts) {
  for (const char* on : {"{ a:face 'xmax', b:face 'xmax' }", "{ box_a:face 'xmax', box_b:face 'xmax' }"})
    for (const char* solver :
         {"", "solver = solver.monolithic{}, ", "solver = solver.latin{ static_steps = 'iterated' }, "}) {
      const DeckRun run =
          two_bars(std::string("factors = { 2, -1 }, x = true, on = ") + on, "local steps = { pull }", ends, solver)
              .at(0);
      const double expected = 10e3 / (k_a + 4 * k_b);
      EXPECT_NEAR(run.column("a", "x").back(), expected, 1e-6 * expected) << on << solver;
      EXPECT_NEAR(run.column("b", "x").back(), 2 * expected, 1e-6 * expected) << on << solver;
    }
}

TEST(Equations, hold_in_modes) {
  const DeckRun run =
      two_bars("factors = { 2, -1 }, x = true, on = { a:face 'xmax', b:face 'xmax' }",
               "local steps = { step.static{ name = 'rest' } }", "output.modes{ name = 'modes', n = 12 }")
          .at(0);
  const double f = std::sqrt((k_a + 4 * k_b) / (2 + 4 * 1)) / (2 * std::numbers::pi);
  double nearest = 1e9;
  for (const double found : run.column("modes", "frequency"))
    if (std::abs(found - f) < std::abs(nearest - f)) nearest = found;
  EXPECT_NEAR(nearest, f, 2e-4 * f);
}

// Let go, both swing together at that frequency.
TEST(Equations, hold_in_motion) {
  const double f = std::sqrt((k_a + 4 * k_b) / (2 + 4 * 1)) / (2 * std::numbers::pi);
  for (const char* solver : {"solver = solver.latin{ tolerance = 1e-8 }, ", "solver = solver.monolithic{}, "}) {
    const DeckRun run = two_bars("factors = { 2, -1 }, x = true, on = { a:face 'xmax', b:face 'xmax' }",
                                 "local steps = { pull, step.dynamic{ name = 'swing', after = pull, duration = " +
                                     std::to_string(1 / f) + ", dt = " + std::to_string(1 / f) + " / 100 } }",
                                 ends, solver)
                            .at(0);
    const std::vector<double>&time = run.column("a", "time"), &a = run.column("a", "x"), &b = run.column("b", "x");
    std::vector<double> crossings;
    for (size_t i = 1; i < a.size(); ++i) {
      EXPECT_NEAR(b[i], 2 * a[i], 1e-5 * 10e3 / k_a) << solver << i;
      if (a[i - 1] * a[i] < 0)
        crossings.push_back(time[i - 1] + (time[i] - time[i - 1]) * a[i - 1] / (a[i - 1] - a[i]));
    }
    ASSERT_EQ(crossings.size(), 2u) << solver;
    EXPECT_NEAR(crossings[1] - crossings[0], 0.5 / f, 2e-3 / f) << solver;
  }
}

TEST(Equations, end_with_a_step_that_leaves_them_out) {
  const DeckRun run =
      two_bars("factors = { 2, -1 }, x = true, on = { a:face 'xmax', b:face 'xmax' }",
               "local free = step.static{ name = 'free', after = pull, loads = pull.loads, supports = { roots }, "
               "loads = { load.force{ on = a:face 'xmax', x = 10*kN } } }\nlocal steps = { pull, free }",
               ends)
          .at(0);
  EXPECT_NEAR(run.column("a", "x").back(), 10e3 / k_a, 1e-6 * 10e3 / k_a);
  EXPECT_NEAR(run.column("b", "x").back(), 0.0, 1e-6 * 10e3 / k_a);
}

// Two nodes of one part that move alike: by hand from what each force does alone.
TEST(Equations, join_two_nodes_of_one_part) {
  const auto run = [](const std::string& at, const std::string& supports, const std::string& solver = "") {
    const DeckRun found =
        run_text(R"(
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local block = substructure{ name = "block", material = steel, mesh = mesh.box{ size = { 40*mm, 20*mm, 30*mm }, cells = { 4, 2, 3 } } }
local one = block:where(function(x, y, z) return near(x, 0) and near(y, 0) and near(z, 30*mm) end)
local other = block:where(function(x, y, z) return near(x, 40*mm) and near(y, 20*mm) and near(z, 30*mm) end)
local root = support.fixed{ name = "root", on = block:face "zmin" }
local same = support.equation{ name = "same", on = { one, other }, factors = { 1, -1 }, z = true }
problem{ name = "block", substructures = { block }, supports = )" +
                 supports + ", " + solver + "steps = { step.static{ name = 'pull', loads = { load.force{ on = " + at +
                 R"(, z = 1*kN } } } },
         outputs = { output.history{ name = "one", on = one, quantity = "displacement" }, output.history{ name = "other", on = other, quantity = "displacement" } } }:run{}
)")
            .at(0);
    return std::pair(found.column("one", "z").back(), found.column("other", "z").back());
  };
  const auto [a11, a21] = run("one", "{ root }");
  const auto [a12, a22] = run("other", "{ root }");
  EXPECT_NEAR(a12, a21, 1e-6 * a11);
  const double share = (a11 - a21) / (a11 - a12 - a21 + a22), expected = a11 * (1 - share) + a12 * share;
  for (const char* solver : {"", "solver = solver.monolithic{}, "}) {
    const auto [one, other] = run("one", "{ root, same }", solver);
    EXPECT_NEAR(one, expected, 1e-5 * expected) << solver;
    EXPECT_NEAR(other, expected, 1e-5 * expected) << solver;
  }
  EXPECT_LT(expected, 0.7 * a11);
}

// The end of a bar on a spring to the ground, and on one to the end of another bar; energy stays in springs and bars.
TEST(Springs, act_on_mean_motions) {
  const double k = 3e8;
  const auto run = [&](const std::string& on, const std::string& solver) {
    return two_bars("factors = { 1 }, y = true, on = a:face 'xmax'", R"(
local soft = support.spring{ name = "soft", x = 3e8, on = )" + on + R"( }
local held = step.static{ name = "held", supports = { roots, soft }, loads = { load.force{ on = a:face "xmax", x = 10*kN } } }
local steps = { held })",
                    ends, solver)
        .at(0);
  };
  for (const char* solver : {"", "solver = solver.monolithic{}, "}) {
    const double grounded = 10e3 / (k_a + k), between = 10e3 / (k_a + 1 / (1 / k + 1 / k_b));
    EXPECT_NEAR(run("a:face 'xmax'", solver).column("a", "x").back(), grounded, 1e-6 * grounded) << solver;
    const DeckRun both = run("{ a:face 'xmax', box_b:face 'xmax' }", solver);
    EXPECT_NEAR(both.column("a", "x").back(), between, 1e-6 * between) << solver;
    EXPECT_NEAR(both.column("b", "x").back(), between * k / (k + k_b), 1e-6 * between) << solver;
  }
}

// Its centre and its inertia in a frame are those that are turned by hand.
TEST(RigidBodies, may_be_given_in_a_frame) {
  const auto modes = [](const char* way) {
    return run_text(R"(
local p = param{ way = 0 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local stub = substructure{ name = "stub", material = steel, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 2, 2, 2 } } }
local c, s = math.cos(30*deg), math.sin(30*deg)
local box = p.way == 0 and
  substructure.rigid{ name = "box", on = stub:face "zmax", mass = 3, inertia = { 1e-3, 2e-3, 2.5e-3, 1e-4, 0, 0 }, at = { 20*mm, 5*mm, -2*mm },
                      frame = frame{ origin = { 0, 0, 12*mm }, x = { c, s, 0 } } } or
  substructure.rigid{ name = "box", on = stub:face "zmax", mass = 3, at = { 20*mm * c - 5*mm * s, 20*mm * s + 5*mm * c, 10*mm },
                      inertia = { 1e-3 * c^2 + 2e-3 * s^2 - 2e-4 * c * s, 1e-3 * s^2 + 2e-3 * c^2 + 2e-4 * c * s, 2.5e-3, (1e-3 - 2e-3) * c * s + 1e-4 * (c^2 - s^2), 0, 0 } }
local feet = interface.bonded{ name = "feet", between = { stub:face "zmax", box:face "zmax" } }
local base = support.fixed{ name = "base", on = stub:face "zmin" }
problem{ name = "p", substructures = { stub, box }, interfaces = { feet }, supports = { base }, steps = { step.static{ name = "rest" } }, outputs = { output.modes{ name = "modes", n = 6 } } }:run{}
)",
                    {{"way", way}})
        .at(0)
        .column("modes", "frequency");
  };
  const std::vector<double> in_frame = modes("0"), by_hand = modes("1");
  ASSERT_EQ(in_frame.size(), 6u);
  for (size_t i = 0; i < in_frame.size(); ++i) EXPECT_NEAR(in_frame[i], by_hand[i], 1e-8 * by_hand[i]);
}

// A mass of 3 kg on the spring and a damper: decrement over a period, 2 pi zeta / sqrt(1 - zeta^2).
TEST(Springs, damp_by_their_dampers) {
  const DeckRun run = run_text(R"(
local light = material.elastic{ name = "light", young = 200*GPa, poisson = 0, density = 10 }
local stub = substructure{ name = "stub", material = light, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } } }
local box = substructure.rigid{ name = "box", on = stub:face "zmax", mass = 3, inertia = { 1e-3, 1e-3, 1e-3 }, at = { 5*mm, 5*mm, 10*mm } }
local feet = interface.bonded{ name = "feet", between = { stub:face "zmax", box:face "zmax" } }
local guide = support.held{ name = "guide", on = stub:face "zmin", x = true, y = true }
local spring = support.spring{ name = "spring", on = stub:face "zmin", z = 3e6, z_damping = 300 }
local bend = step.static{ name = "bend", loads = { load.force{ on = stub:face "zmax", z = 100 } } }
local swing = step.dynamic{ name = "swing", after = bend, duration = 14*ms, dt = 20*us }
problem{ name = "box", substructures = { stub, box }, interfaces = { feet }, supports = { guide, spring }, steps = { bend, swing },
         outputs = { output.history{ name = "z", on = stub:face "zmin", quantity = "displacement" } } }:run{}
)")
                          .at(0);
  const std::vector<double>&time = run.column("z", "time"), &z = run.column("z", "z");
  EXPECT_NEAR(*std::max_element(z.begin(), z.end()), 100 / 3e6, 1e-4 * 100 / 3e6);
  std::vector<double> peaks, at;
  for (size_t i = 2; i + 1 < z.size(); ++i)
    if (z[i] > z[i - 1] && z[i] >= z[i + 1]) {
      peaks.push_back(z[i]);
      at.push_back(time[i]);
    }
  ASSERT_GE(peaks.size(), 2u);
  const double zeta = 300 / (2 * std::sqrt(3e6 * 3)),
               expected = 2 * std::numbers::pi * zeta / std::sqrt(1 - zeta * zeta);
  EXPECT_NEAR(std::log(peaks[0] / peaks[1]), expected, 0.02 * expected);
  EXPECT_NEAR(at[1] - at[0], 2 * std::numbers::pi / std::sqrt(3e6 / 3 * (1 - zeta * zeta)), 5e-5);
}

// A rigid body on six springs, alone, in a frame that is turned: each motion has its spring and its mass.
TEST(Springs, hold_a_body_along_six_axes) {
  const auto run = [](const std::string& outputs, const std::string& loads, const std::string& solver = "") {
    return run_text(
               R"(
local light = material.elastic{ name = "light", young = 200*GPa, poisson = 0, density = 10 }
local own = frame{ origin = { 5*mm, 5*mm, 10*mm }, axis = { 1, 2, 3 }, x = { 2, -1, 0.3 } }
local stub = substructure{ name = "stub", material = light, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 2, 2, 1 } } }
local box = substructure.rigid{ name = "box", on = stub:face "zmax", mass = 2, inertia = { 1e-3, 1e-3, 1e-3 }, at = { 5*mm, 5*mm, 10*mm } }
local feet = interface.bonded{ name = "feet", between = { stub:face "zmax", box:face "zmax" } }
local six = support.spring{ name = "six", on = )" +
               std::string(solver.find("stub") == std::string::npos ? "box" : "stub") +
               R"(:face "zmax", frame = own, x = 1e6, y = 2e6, z = 3e6, about_x = 100, about_y = 200, about_z = 400 }
problem{ name = "box", substructures = { stub, box }, interfaces = { feet }, supports = { six }, )" +
               (solver.find("iterated") == std::string::npos ? ""
                                                             : "solver = solver.latin{ static_steps = 'iterated' }, ") +
               "steps = { step.static{ name = 'load', loads = { " + loads + " } } }, outputs = { " + outputs +
               R"( } }:run{}
)")
        .at(0);
  };
  for (const char* on : {"box", "stub"}) {
    const DeckRun run_modes = run("output.modes{ name = 'modes', n = 6 }", "", on);
    const std::vector<double>& f = run_modes.column("modes", "frequency");
    std::vector<double> expected;
    for (const double ratio : {100 / 1e-3, 200 / 1e-3, 400 / 1e-3, 1e6 / 2, 2e6 / 2, 3e6 / 2})
      expected.push_back(std::sqrt(ratio) / (2 * std::numbers::pi));
    std::sort(expected.begin(), expected.end());
    ASSERT_EQ(f.size(), 6u) << on;
    for (size_t i = 0; i < 6; ++i)
      EXPECT_NEAR(f[i], expected[i], 2e-3 * expected[i]) << on << i;  // the stub weighs 10 mg
  }
  const std::string corner =
      "output.history{ name = 'c', on = box:where(function(x, y, z) return near(x, 10*mm) and near(y, 10*mm) end), "
      "quantity = 'displacement' }, output.resultant{ name = 'r', on = six }";
  for (const char* solver : {"box", "stub", "box iterated", "stub iterated"}) {
    // About the z axis of the frame: u = theta x r, without a force.
    const DeckRun turned = run(corner, "load.torque{ on = box:face 'zmax', axis = { 1, 2, 3 }, history = 2 }", solver);
    const double theta = 2.0 / 400, length = std::sqrt(14.0);
    const Vec3 axis(1 / length, 2 / length, 3 / length), u = theta * axis.cross(Vec3(5e-3, 5e-3, 0));
    EXPECT_NEAR(turned.column("c", "x").back(), u[0], 2e-4 * u.norm()) << solver;
    EXPECT_NEAR(turned.column("c", "y").back(), u[1], 2e-4 * u.norm()) << solver;
    EXPECT_NEAR(turned.column("c", "z").back(), u[2], 2e-4 * u.norm()) << solver;
    for (const char* d : {"x", "y", "z"}) EXPECT_NEAR(turned.column("r", d).back(), 0.0, 1e-6) << solver;
    const DeckRun pulled = run(corner, "load.force{ on = box:face 'zmax', x = 1, y = 2, z = 3 }", solver);
    EXPECT_NEAR(pulled.column("c", "x").back(), 1 / 3e6, 2e-4 / 3e6) << solver;
    EXPECT_NEAR(pulled.column("c", "y").back(), 2 / 3e6, 2e-4 / 3e6) << solver;
    EXPECT_NEAR(pulled.column("r", "z").back(), pulled.column("r", "x").back() * 3, 2e-4) << solver;
  }
}

// Turned by a rotational spring of a part that deforms: the free swing has the period and the decrement of its motion.
TEST(Springs, damp_rotations) {
  const double k = 200, c = 0.05, inertia = 1e-3, zeta = c / (2 * std::sqrt(k * inertia));
  for (const char* solver : {"solver = solver.latin{ tolerance = 1e-8 }, ", "solver = solver.monolithic{}, "}) {
    const DeckRun run = run_text(R"(
local light = material.elastic{ name = "light", young = 200*GPa, poisson = 0, density = 10 }
local stub = substructure{ name = "stub", material = light, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 2, 2, 1 } } }
local box = substructure.rigid{ name = "box", on = stub:face "zmax", mass = 2, inertia = { 1e-3, 1e-3, 1e-3 }, at = { 5*mm, 5*mm, 10*mm } }
local feet = interface.bonded{ name = "feet", between = { stub:face "zmax", box:face "zmax" } }
local six = support.spring{ name = "six", on = stub:face "zmin", x = 1e9, y = 1e9, z = 1e9, about_x = 1e6, about_y = 1e6, about_z = 200, about_z_damping = 0.05 }
local twist = step.static{ name = "twist", loads = { load.torque{ on = box:face "zmax", axis = { 0, 0, 1 }, history = 0.1 } } }
local swing = step.dynamic{ name = "swing", after = twist, duration = 33*ms, dt = 50*us }
problem{ name = "box", substructures = { stub, box }, interfaces = { feet }, supports = { six }, )" +
                                 std::string(solver) + R"(steps = { twist, swing },
         outputs = { output.history{ name = "c", on = box:where(function(x, y, z) return near(x, 10*mm) and near(y, 10*mm) end), quantity = "displacement" } } }:run{}
)")
                            .at(0);
    const std::vector<double>&time = run.column("c", "time"), &y = run.column("c", "y");
    // The stub twists too, without warping: G I / h = 1.667e4 N m.
    const double most = 0.1 * (1 / k + 10e-3 / (1e11 * std::pow(10e-3, 4) / 6)) * 5e-3;
    EXPECT_NEAR(*std::max_element(y.begin(), y.end()), most, 1e-3 * most) << solver;
    std::vector<double> peaks, at;
    for (size_t i = 2; i + 1 < y.size(); ++i)
      if (y[i] > y[i - 1] && y[i] >= y[i + 1]) {
        peaks.push_back(y[i]);
        at.push_back(time[i]);
      }
    ASSERT_GE(peaks.size(), 2u) << solver;
    const double expected = 2 * std::numbers::pi * zeta / std::sqrt(1 - zeta * zeta);
    EXPECT_NEAR(std::log(peaks[0] / peaks[1]), expected, 0.03 * expected) << solver;
    EXPECT_NEAR(at[1] - at[0], 2 * std::numbers::pi / std::sqrt(k / inertia * (1 - zeta * zeta)), 1e-4) << solver;
  }
}

// Let go, what springs hold between a face that deforms and a rigid body, or two nodes in a lever, swings with the
// energy that it had: the rows of static and dynamic steps are the same.
TEST(Springs, and_levers_keep_their_energy) {
  for (const char* held : {"support.spring{ name = 'mount', on = { pad, box:face 'face 1' }, x = 2e6, y = 3e6, z = "
                           "4e6, about_x = 200, about_y = 150, about_z = 100 }",
                           "support.spring{ name = 'mount', on = box:face 'face 1', x = 2e6, y = 3e6, z = 4e6, about_x "
                           "= 200, about_y = 150, about_z = 100 }",
                           "lever"})
    for (const char* solver : {"", "solver = solver.monolithic{}, "}) {
      const bool is_lever = std::string(held) == "lever";
      const DeckRun run = run_text(R"(
local alloy = material.elastic{ name = "alloy", young = 70*GPa, poisson = 0.33, density = 2700 }
local plate = substructure{ name = "plate", material = alloy, mesh = mesh.box{ size = { 20*mm, 10*mm, 2*mm }, cells = { 8, 4, 1 } } }
local pad = plate:face{ normal = { 0, 0, -1 }, at = 0, low = { -1e-7, -1, -1 }, high = { 7.6*mm, 1, 1 } }
local box = substructure.rigid{ name = "box", on = pad, mass = 0.02, inertia = { 2e-6, 3e-6, 4e-6 }, at = { 4*mm, 6*mm, -7*mm } }
local arm = substructure{ name = "arm", material = alloy, mesh = mesh.box{ origin = { 0, 20*mm, 0 }, size = { 20*mm, 10*mm, 2*mm }, cells = { 4, 2, 1 } } }
local fixed = support.fixed{ name = "fixed", on = { plate:face "xmax")" +
                                   std::string(is_lever ? ", arm:face 'xmax'" : "") + R"( } }
local function corner(part, y) return part:where(function(X, Y, Z) return near(X, 0) and near(Y, y) and near(Z, 0) end) end
local held = )" +
                                   std::string(is_lever ? "support.equation{ name = 'lever', on = { corner(plate, 0), "
                                                          "corner(arm, 30*mm) }, factors = { 2, -0.7 }, z = true }"
                                                        : held) +
                                   R"(
local bend = step.static{ name = "bend", loads = { load.gravity{ x = 300, y = 500, z = -1000 } } }
problem{ name = "held", substructures = { plate, )" +
                                   (is_lever ? "arm" : "box") + R"( }, supports = { fixed, held }, )" + solver + R"(
  steps = { bend, step.dynamic{ name = "swing", after = bend, duration = 0.2*ms, dt = 2*us, loads = { load.gravity{ z = 0 } } } }, outputs = { output.energy{} } }:run{}
)")
                              .at(0);
      const double all = run.column("energy", "loads")[1];
      EXPECT_GT(all, 1e-9) << held << solver;
      EXPECT_LT(std::abs(run.column("energy", "scheme").back()), 2e-3 * all) << held << solver;
      for (const double kinetic : run.column("energy", "kinetic")) EXPECT_LT(kinetic, 1.1 * all) << held << solver;
    }
}

// A bell crank: 2 u along x of one body is the motion along y of the other, each on springs.
TEST(Equations, have_terms_along_several_axes) {
  const auto run = [](const std::string& equation, const std::string& solver) {
    return run_text(R"(
local light = material.elastic{ name = "light", young = 200*GPa, poisson = 0, density = 10 }
local function body(name, x)
  local stub = substructure{ name = name, material = light, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 2, 2, 1 }, origin = { x, 0, 0 } } }
  local holds = support.spring{ name = "springs of " .. name, on = stub:face "zmax", x = 1e6, y = 3e6, z = 1e6, about_x = 1e3, about_y = 1e3, about_z = 1e3 }
  return stub, holds, output.history{ name = name, on = stub:face "zmax", quantity = "displacement" }
end
local a, holds_a, of_a = body("a", 0)
local b, holds_b, of_b = body("b", 30*mm)
local own = frame{ axis = { 0, 0, 1 }, x = { 1, 1, 0 } }
local crank = support.equation{ name = "crank", )" +
                    equation + R"( }
problem{ name = "crank", substructures = { a, b }, supports = { holds_a, holds_b, crank }, )" +
                    solver +
                    R"(steps = { step.static{ name = "pull", loads = { load.force{ on = a:face "zmax", x = 100 } } } },
         outputs = { of_a, of_b } }:run{}
)")
        .at(0);
  };
  for (const char* solver :
       {"", "solver = solver.monolithic{}, ", "solver = solver.latin{ static_steps = 'iterated' }, "}) {
    const DeckRun crank = run("on = { a:face 'zmax', b:face 'zmax' }, terms = { { x = 2 }, { y = -1 } }", solver);
    const double u = 100 / (1e6 + 4 * 3e6);
    EXPECT_NEAR(crank.column("a", "x").back(), u, 1e-4 * u) << solver;
    EXPECT_NEAR(crank.column("b", "y").back(), 2 * u, 1e-4 * u) << solver;
    EXPECT_NEAR(crank.column("b", "x").back(), 0.0, 1e-4 * u) << solver;
    // One place alone moves along y = -x: as an equation of terms, and along an axis of a frame.
    const double aslant = 100 / (1e6 + 3e6);
    for (const char* same :
         {"on = a:face 'zmax', terms = { { x = 1, y = 1 } }", "on = a:face 'zmax', factors = 2, x = true, frame = own",
          "on = a:face 'zmax', terms = { { x = 3 } }, frame = own"}) {
      const DeckRun held = run(same, solver);
      EXPECT_NEAR(held.column("a", "x").back(), aslant, 1e-4 * aslant) << solver << same;
      EXPECT_NEAR(held.column("a", "y").back(), -aslant, 1e-4 * aslant) << solver << same;
    }
  }
}

// A quarter of a bar pulled through the mean motion of its end contracts there as anywhere; a rigid end would not let
// it.
TEST(MeanMotions, pull_a_bar_without_holding_its_end) {
  for (const char* order : {"1", "2"})
    for (const char* solver : {"", "solver = solver.monolithic{}, "})
      for (const char* motion : {"mean", "points"}) {
        const DeckRun run = run_text(R"(
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local bar = substructure{ name = "bar", material = steel, mesh = mesh.box{ size = { 20*mm, 10*mm, 60*mm }, cells = { 2, 2, 3 }, order = )" +
                                     std::string(order) + R"( } }
local box = substructure.rigid{ name = "box", on = bar:face "zmax", mass = 1, inertia = { 1e-3, 1e-3, 1e-3 }, at = { 0, 0, 90*mm } }
local feet = interface.bonded{ name = "feet", between = { bar:face "zmax", box:face "zmax" }, motion = ")" +
                                     motion + R"(" }
local planes = support.symmetry{ name = "planes", on = { bar:face "xmin", bar:face "ymin", bar:face "zmin" } }
local corner = bar:where(function(x, y, z) return near(x, 20*mm) and near(y, 10*mm) and near(z, 60*mm) end)
problem{ name = "bar", substructures = { bar, box }, interfaces = { feet }, supports = { planes }, )" +
                                     solver + R"(
         steps = { step.static{ name = "pull", loads = { load.force{ on = box:face "zmax", z = 20*kN } } } },
         outputs = { output.history{ name = "box", on = box:face "zmax", quantity = "displacement" }, output.history{ name = "corner", on = corner, quantity = "displacement" } } }:run{}
)")
                                .at(0);
        const double strain = 20e3 / 2e-4 / 200e9;
        if (std::string(motion) == "points") {
          EXPECT_LT(std::abs(run.column("corner", "x").back()), 0.5 * 0.3 * strain * 20e-3) << order << solver;
          continue;
        }
        EXPECT_NEAR(run.column("box", "z").back(), strain * 60e-3, 1e-6 * strain * 60e-3) << order << solver;
        EXPECT_NEAR(run.column("corner", "z").back(), strain * 60e-3, 1e-5 * strain * 60e-3) << order << solver;
        EXPECT_NEAR(run.column("corner", "x").back(), -0.3 * strain * 20e-3, 1e-5 * strain * 60e-3) << order << solver;
        EXPECT_NEAR(run.column("corner", "y").back(), -0.3 * strain * 10e-3, 1e-5 * strain * 60e-3) << order << solver;
      }
}

// What a deck with these words on two (three) bars side by side says.
std::string message_of(const std::string& words, const std::string& substructures = "{ one, two }") {
  try {
    run_text(
        R"(
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local function bar(name, y) return substructure{ name = name, material = steel, mesh = mesh.box{ size = { 0.1, 0.01, 0.01 }, cells = { 5, 1, 1 }, origin = { 0, y, 0 } } } end
local one, two, three = bar("one", 0), bar("two", 0.02), bar("three", 0.04)
local roots = support.fixed{ name = "roots", on = { one:face "xmin", two:face "xmin", three:face "xmin" } }
local loads, interfaces, supports = {}, {}, { roots }
)" + words +
        R"(
problem{ name = "bars", substructures = )" +
        substructures +
        R"(, interfaces = interfaces, supports = supports, steps = { step.static{ name = "pull", loads = loads } } }:run{}
)");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(Equations, refuse_what_they_cannot_hold) {
  EXPECT_NE(
      message_of(
          R"(supports = { roots, support.equation{ name = "same", on = { one:face "xmax", two:face "xmax", three:face "xmax" }, factors = { 1, 1, -2 }, x = true } })",
          "{ one, two, three }")
          .find("support.equation 'same': its places are on 3 parts, and two are the most"),
      std::string::npos);
  const std::string two =
      "three = two\nroots = support.fixed{ name = 'both', on = { one:face 'xmin', two:face 'xmin', two:face 'xmax' } "
      "}\n";
  EXPECT_NE(
      message_of(
          two +
          R"(supports = { roots, support.equation{ name = "same", on = { one:face "xmax", two:face "xmax" }, factors = { 1, -1 }, x = true } }
loads = { load.displacement{ on = one:face "xmax", x = 0.01*mm } })")
          .find("'same': loads and supports prescribe all of the motions that it joins"),
      std::string::npos);
  EXPECT_NE(
      message_of(
          two +
          R"(supports = { roots, support.equation{ name = "same", on = { one:face "xmax", one:face "xmax" }, factors = { 1, -1 }, x = true } })")
          .find("same place"),
      std::string::npos);
}

TEST(MeanMotions, are_not_tightened) {
  const std::string two =
      "roots = support.fixed{ name = 'both', on = { one:face 'xmin', two:face 'xmin' } }\nsupports = { roots }\n";
  EXPECT_NE(
      message_of(
          two +
          R"(local shank = interface.bonded{ name = "shank", between = { one:face "xmax", two:face "xmax" }, motion = "mean" }
interfaces = { shank }
loads = { load.preload{ on = shank, force = 1*kN } })")
          .find("which joins mean motions: tighten the shank of a bolt"),
      std::string::npos);
}

}  // namespace
}  // namespace dygita::test::sums_tests
