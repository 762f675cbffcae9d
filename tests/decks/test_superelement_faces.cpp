// Which rows the faces of a superelement have: supports, single nodes, rigid faces, the number of modes.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "decks/engine.hpp"
#include "reduction/superelement.hpp"

namespace dygita::test::superelement_faces_tests {
namespace {

// A block on two planes of symmetry.
DeckRun block(const std::string& element, const std::string& supports = "{ planes }") {
  return run_text(R"(
local m = material.elastic{ name = "m", young = 70*GPa, poisson = 0.3, density = 2700 }
local a = substructure{ name = "a", material = m, mesh = mesh.box{ size = { 20*mm, 20*mm, 40*mm }, cells = { 3, 3, 6 } } }
local planes = support.symmetry{ name = "planes", on = { a:face "xmin", a:face "zmin" } }
local corner = a:where(function(x, y, z) return near(x, 20*mm) and near(y, 20*mm) and near(z, 40*mm) end)
local element = output.superelement{ name = "element", )" +
                  element + R"( }
local result = problem{ name = "block", substructures = { a }, supports = )" +
                  supports + R"(, steps = { step.static{ name = "rest" } }, outputs = { element } }:run{}
)")
      .at(0);
}
const Superelement& element_of(const DeckRun& run) {
  return *std::any_cast<const SuperelementPtr&>(run.findings("element").model);
}
int n_interface(const Superelement& e) {
  return static_cast<int>(e.rows.size() - static_cast<size_t>(e.fixed_frequencies.size()));
}

TEST(SuperelementFaces, have_no_row_for_a_motion_that_a_support_holds) {
  const DeckRun run = block("on = { a:face 'xmin', a:face 'zmax' }, modes = 10");
  const Superelement& e = element_of(run);
  ASSERT_EQ(n_interface(e), 3 + 6);
  std::vector<int> left;
  for (int i = 0; i < 3; ++i) left.push_back(e.rows[i].direction);
  EXPECT_EQ(left, (std::vector<int>{1, 2, 3}));  // along y and z, about x
  EXPECT_EQ(e.rows[3].direction, 0);
  EXPECT_NEAR(e.rows[3].place[2], 40e-3, 1e-12);
}

TEST(SuperelementFaces, of_one_node_have_its_three_displacements) {
  for (const char* motion : {"mean", "nodes", "rigid"}) {
    const DeckRun run = block("on = corner, modes = 10, motion = '" + std::string(motion) + "'");
    EXPECT_EQ(n_interface(element_of(run)), 3) << motion;
  }
}

// A node has no rotation: what would be its rows moves nothing, has no mass, and would make every frequency zero.
TEST(SuperelementFaces, of_one_node_give_one_model_whatever_the_motion) {
  const Superelement nodes = element_of(block("on = corner, modes = 10, motion = 'nodes'"));
  const Superelement rigid = element_of(block("on = corner, modes = 10, motion = 'rigid'"));
  ASSERT_EQ(rigid.frequencies.size(), nodes.frequencies.size());
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(rigid.frequencies[i], nodes.frequencies[i], 1e-6 * nodes.frequencies[5]) << i;
  EXPECT_GT(rigid.frequencies[5], 100.0);
}

// A rigid body on faces that were picked by geometry: each has a name that can be typed.
TEST(SuperelementFaces, of_a_rigid_body_that_were_picked_have_a_short_name_too) {
  const auto sinks = [](const std::string& face) {
    return run_text(R"(
local m = material.elastic{ name = "m", young = 70*GPa, poisson = 0.3, density = 2700 }
local a = substructure{ name = "a", material = m, mesh = mesh.box{ size = { 20*mm, 20*mm, 40*mm }, cells = { 2, 2, 4 } } }
local b = substructure{ name = "b", material = m, mesh = mesh.box{ size = { 20*mm, 20*mm, 40*mm }, cells = { 2, 2, 4 }, origin = { 40*mm, 0, 0 } } }
local top = b:face{ normal = { 0, 0, 1 } }
local box = substructure.rigid{ name = "box", on = { a:face "zmax", top }, mass = 1, inertia = { 1e-3, 1e-3, 1e-3 }, at = { 30*mm, 10*mm, 50*mm } }
local feet = { interface.bonded{ name = "1", between = { a:face "zmax", box:face "zmax" } }, interface.bonded{ name = "2", between = { top, box:face ")" +
                    face + R"(" } } }
problem{ name = "box", substructures = { a, b, box }, interfaces = feet, supports = { support.fixed{ name = "held", on = { a:face "zmin", b:face "zmin" } } },
  steps = { step.static{ name = "weigh", loads = { load.gravity{ z = -9.81 } } } }, outputs = { output.history{ name = "top", on = top, quantity = "displacement" } } }:run{}
)")
        .at(0)
        .column("top", "z")
        .back();
  };
  EXPECT_LT(sinks("face 2"), 0.0);
  EXPECT_EQ(sinks("face 2"), sinks("(normal 0 0 1)"));
}

// Two bars on each other, free in space: as springs hold points between faces that do not match, a rounding of them
// must not be stiffness.
TEST(SuperelementFaces, of_free_bodies_have_six_motions_at_zero) {
  for (const char* order : {"1", "2"})
    for (const char* gap : {"0", "1"}) {
      const DeckRun run = run_text(R"(
local p = param{ order = 2, gap = 0 }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local function bar(name, z) return substructure{ name = name, material = steel, place = { 0, 0, z },
  mesh = mesh.box{ size = { 720*mm, 25.4*mm, 12.7*mm }, cells = { 24, 2, 1 }, order = p.order } } end
local a, b = bar("a", 0), bar("b", 12.7*mm + (p.gap == 1 and 0.1*mm or 0))
local lap = interface.contact{ name = "lap", between = { a:face "zmax", b:face "zmin" }, friction = 0.2, within = 0.2*mm, gap = p.gap == 1 and "geometry" or 0 }
local squeeze = step.static{ name = "squeeze", increments = 2, loads = { load.pressure{ on = { a:face "zmin", b:face "zmax" }, history = 10*MPa } } }
problem{ name = "f2", substructures = { a, b }, interfaces = { lap }, steps = { squeeze },
  outputs = { output.superelement{ name = "element", on = { a:face "xmin", b:face "xmax" }, up_to = 1*kHz } } }:run{}
)",
                                   {{"order", order}, {"gap", gap}})[0];
      const Vec& frequencies = element_of(run).frequencies;
      std::printf("order %s, gap %s: %.5f ... %.5f, %.3f Hz\n", order, gap, frequencies[0], frequencies[5],
                  frequencies[6]);
      EXPECT_EQ(frequencies[5], 0.0);
      EXPECT_GT(frequencies[6], 100.0);
    }
}

TEST(SuperelementFaces, by_nodes_leave_out_what_is_held) {
  const DeckRun run = block("on = a:face 'zmax', modes = 10, motion = 'nodes'");
  EXPECT_EQ(n_interface(element_of(run)), 3 * 16 - 4);  // four nodes on the plane of symmetry
}

TEST(SuperelementFaces, that_are_partly_held_cannot_be_rigid) {
  testing::internal::CaptureStderr();
  const DeckRun run = block("on = a:face 'zmax', modes = 10, motion = 'rigid'");
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_FALSE(run.findings("element").model.has_value());
  EXPECT_NE(said.find("a node of a.zmax is held by a support"), std::string::npos) << said;
}

TEST(SuperelementFaces, keep_as_many_modes_as_asked_for_and_say_how_far_they_reach) {
  const DeckRun run = block("on = a:face 'zmax', modes = 7");
  const Superelement& e = element_of(run);
  EXPECT_EQ(e.fixed_frequencies.size() - e.n_residual, 7);
  EXPECT_NEAR(e.valid_to, 0.5 * e.fixed_frequencies[6], 1e-9 * e.valid_to);
  EXPECT_EQ(e.damping.size(), 0);
  // All modes there are: nothing is left out that others would have to stand for, and the frequencies are the whole's.
  const DeckRun all = block("on = a:face 'zmax', modes = 2000");
  EXPECT_EQ(element_of(all).n_residual, 0);
  EXPECT_EQ(static_cast<int>(element_of(all).rows.size()), element_of(all).n_unknowns);
  for (int i = 0; i < 4; ++i)
    EXPECT_NEAR(e.frequencies[i], element_of(all).frequencies[i], 1e-3 * e.frequencies[i] + 0.1)
        << i;  // rigid: zero but for rounding
}

// A bar that only stretches: the static stiffness E A / L and the mass of a rod are known.
TEST(SuperelementFaces, of_a_rod_have_its_static_stiffness) {
  const DeckRun run = run_text(R"(
local m = material.elastic{ name = "m", young = 200*GPa, poisson = 0, density = 8000 }
local rod = substructure{ name = "rod", material = m, mesh = mesh.box{ size = { 5*mm, 5*mm, 100*mm }, cells = { 1, 1, 40 } } }
local element = output.superelement{ name = "element", on = { rod:face "zmin", rod:face "zmax" }, up_to = 30*kHz }
problem{ name = "rod", substructures = { rod }, supports = {}, steps = { step.static{ name = "rest" } }, outputs = { element } }:run{}
)")
                          .at(0);
  const Superelement& e = element_of(run);
  const double k = 200e9 * 25e-6 / 0.1;
  EXPECT_NEAR(e.stiffness(2, 2), k, 1e-9 * k);
  EXPECT_NEAR(e.stiffness(2, 8), -k, 1e-9 * k);
  EXPECT_NEAR(e.mass(2, 2), 8000 * 25e-6 * 0.1 / 3,
              1e-3 * 8000 * 25e-6 * 0.1);  // of a linear motion, but for the lumped cells
  EXPECT_NEAR(e.mass_of_parts, 8000 * 25e-6 * 0.1, 1e-12);
  // Stretching, free at both ends: c / (2 L).
  const double f = std::sqrt(200e9 / 8000) / 0.2;
  double nearest = 1e9;
  for (const double other : e.frequencies) nearest = std::min(nearest, std::abs(other - f));
  EXPECT_LT(nearest, 2e-3 * f);
}

// A clamped beam of steel (nu = 0) with a rigid body on its end, whose centre is `ahead` of the end.
std::vector<DeckRun> beam_with_body(const std::string& ahead, const std::string& steps, const std::string& outputs,
                                    const std::string& solver = "") {
  return run_text(R"(
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0, density = 7800 }
local beam = substructure{ name = "beam", material = steel, mesh = mesh.box{ size = { 300*mm, 10*mm, 10*mm }, cells = { 15, 1, 1 }, order = 2 } }
local box = substructure.rigid{ name = "box", on = beam:face "xmax", mass = 2, inertia = { 4e-3, 2e-3, 3e-3 }, at = { 300*mm + )" +
                  ahead + R"(, 5*mm, 5*mm } }
local feet = interface.bonded{ name = "feet", between = { beam:face "xmax", box:face "xmax" } }
local root = support.fixed{ name = "root", on = beam:face "xmin" }
)" + steps + R"(
problem{ name = "beam", substructures = { beam, box }, interfaces = { feet }, supports = { root }, steps = steps, )" +
                  solver + "outputs = { " + outputs + R"( } }:run{}
)");
}

constexpr double e_i = 200e9 * 1e-8 / 12, beam_length = 0.3, beam_mass = 7800 * 0.3e-4, box_mass = 2,
                 box_inertia = 2e-3;

// Of a clamped beam with a mass and its inertia on the end: zero at its natural frequencies (rad/s), without shear.
double characteristic(double omega) {
  const double x = beam_length * std::pow(omega * omega * beam_mass / beam_length / e_i, 0.25);
  const double m = box_mass / beam_mass, j = box_inertia / (beam_mass * beam_length * beam_length);
  const double c = std::cos(x), s = std::sin(x), ch = std::cosh(x), sh = std::sinh(x);
  return 1 + c * ch + x * m * (c * sh - s * ch) - x * x * x * j * (ch * s + sh * c) +
         x * x * x * x * m * j * (1 - c * ch);
}

double natural_frequency(double low, double high) {
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (characteristic(low) * characteristic(middle) <= 0 ? high : low) = middle;
  }
  return low / (2 * std::numbers::pi);
}

// Its weight bends the beam at its centre of mass, which may be ahead of the end.
TEST(RigidBodies, hang_on_a_beam_by_their_weight_and_its_arm) {
  for (const char* ahead : {"0", "60*mm"})
    for (const char* solver : {"", "solver = solver.monolithic{}, "}) {
      const DeckRun run =
          beam_with_body(ahead, "local steps = { step.static{ name = 'hang', loads = { load.gravity{ z = -g0 } } } }",
                         "output.history{ name = 'end', on = beam:face 'xmax', quantity = 'displacement' }", solver)
              .at(0);
      const double w = box_mass * 9.80665, l = beam_length, arm = std::string(ahead) == "0" ? 0.0 : 0.06;
      const double area = 1e-4, shear = 200e9 / 2;
      const double expected = w * l * l * l / (3 * e_i) + w * arm * l * l / (2 * e_i) + w * l / (area * shear * 5 / 6) +
                              beam_mass * 9.80665 * l * l * l / (8 * e_i);
      EXPECT_NEAR(run.column("end", "z").back(), -expected, 5e-4 * expected) << ahead << " " << solver;
    }
}

TEST(RigidBodies, give_a_beam_the_frequencies_of_a_mass_and_its_inertia) {
  const DeckRun run =
      beam_with_body("0", "local steps = { step.static{ name = 'rest' } }", "output.modes{ name = 'modes', n = 4 }")
          .at(0);
  const std::vector<double>& found = run.column("modes", "frequency");
  const double first = natural_frequency(10, 400);
  std::printf("%.4f Hz of %.4f\n", found[1], first);
  // About y the inertia is 2e-3, about z 3e-3: the bending along z (about y) is the faster one.
  EXPECT_NEAR(found[1], first, 1e-3 * first);
  EXPECT_LT(found[0], found[1]);
}

// Let go, it swings with that frequency.
TEST(RigidBodies, swing_in_time_as_their_mode_does) {
  const double f = natural_frequency(10, 400), period = 1 / f;
  const DeckRun run =
      beam_with_body(
          "0",
          "local bend = step.static{ name = 'bend', loads = { load.force{ on = beam:face 'xmax', z = 10 } } }\n"
          "local steps = { bend, step.dynamic{ name = 'swing', after = bend, duration = " +
              std::to_string(period) + ", dt = " + std::to_string(period) + " / 80 } }",
          "output.history{ name = 'end', on = beam:face 'xmax', quantity = 'displacement' }")
          .at(0);
  const std::vector<double>&time = run.column("end", "time"), &z = run.column("end", "z");
  std::vector<double> crossings;
  for (size_t i = 1; i < z.size(); ++i)
    if (z[i - 1] * z[i] < 0) crossings.push_back(time[i - 1] + (time[i] - time[i - 1]) * z[i - 1] / (z[i - 1] - z[i]));
  ASSERT_EQ(crossings.size(), 2u);
  std::printf("half a period %.6f s of %.6f\n", crossings[1] - crossings[0], period / 2);
  EXPECT_NEAR(crossings[1] - crossings[0], period / 2, 5e-3 * period / 2);
}

// Free in space, pushed for a while through the common centre of mass: all move with the impulse over the whole mass.
TEST(RigidBodies, share_the_momentum_of_a_push) {
  const DeckRun run = run_text(R"(
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local block = substructure{ name = "block", material = steel, mesh = mesh.box{ size = { 40*mm, 40*mm, 40*mm }, cells = { 3, 3, 3 } } }
local box = substructure.rigid{ name = "box", on = block:face "zmax", mass = 1.5, inertia = { 1e-3, 1e-3, 1e-3 }, at = { 20*mm, 20*mm, 70*mm } }
local feet = interface.bonded{ name = "feet", between = { block:face "zmax", box:face "zmax" } }
local push = step.dynamic{ name = "push", duration = 0.4*ms, dt = 2*us,
                           loads = { load.force{ on = block:face "zmin", z = history.half_sine{ peak = 1*kN, duration = 0.2*ms } } } }
problem{ name = "pushed", substructures = { block, box }, interfaces = { feet }, steps = { push },
         outputs = { output.momentum{ name = "all" }, output.momentum{ name = "box", of = box } } }:run{}
)")
                          .at(0);
  const double impulse = 1000 * 0.2e-3 * 2 / std::numbers::pi, block_mass = 7800 * 64e-6;
  EXPECT_NEAR(run.column("all", "z").back(), impulse, 1e-4 * impulse);
  EXPECT_NEAR(run.column("all", "x").back(), 0.0, 1e-6 * impulse);  // the tolerance of the iterations
  const std::vector<double>& of_box = run.column("box", "z");
  double mean = 0.0;
  const size_t n = of_box.size() / 2;
  for (size_t i = of_box.size() - n; i < of_box.size(); ++i) mean += of_box[i] / static_cast<double>(n);
  EXPECT_NEAR(mean, impulse * 1.5 / (1.5 + block_mass), 0.02 * impulse);  // it rings against the block
}

}  // namespace
}  // namespace dygita::test::superelement_faces_tests
