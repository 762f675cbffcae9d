// Tightening, contact, friction and supports against hand solutions.
#include <gtest/gtest.h>

#include <cmath>

#include "decks/engine.hpp"

namespace dygita::test::joints_tests {
namespace {

// A rod in a sleeve, one-dimensional by layout (nu = 0, frictionless): heads join them at both ends.
//   sleeve: 8 x 4 frame made of one box beside the rod's box; the heads are two plates across both.
const std::string rod_in_sleeve = R"(
local p = param{ shorten = 20*um, pull = 0, back = 0, rest = 0 }
local rod_metal    = material.elastic{ name = "rod metal",    young = 2*GPa,   poisson = 0, density = 7800 }
local sleeve_metal = material.elastic{ name = "sleeve metal", young = 0.7*GPa,  poisson = 0, density = 2700 }
local rigid        = material.elastic{ name = "head metal",   young = 200*GPa,  poisson = 0, density = 7800 }
local l = 20*mm
local function box(x, w, z, h, cells) return mesh.box{ origin = { x, 0, z }, size = { w, 2*mm, h }, cells = cells } end
-- Two sleeve halves left and right of the rod: nothing bends.
local rod   = substructure{ name = "rod", material = rod_metal, mesh = box(4*mm, 2*mm, 0, l, { 2, 2, 10 }) }
local left  = substructure{ name = "left", material = sleeve_metal, mesh = box(0, 4*mm, 0, l, { 4, 2, 10 }) }
local right = substructure{ name = "right", material = sleeve_metal, mesh = box(6*mm, 4*mm, 0, l, { 4, 2, 10 }) }
local head  = substructure{ name = "head", material = rigid, mesh = box(0, 10*mm, l, 8*mm, { 10, 2, 2 }) }
local foot  = substructure{ name = "foot", material = rigid, mesh = box(0, 10*mm, -8*mm, 8*mm, { 10, 2, 2 }) }
local thread = interface.bonded{ name = "thread", between = { foot:face "zmax", rod:face "zmin" } }
local shank  = interface.bonded{ name = "shank", between = { rod:face "zmax", head:face "zmin" } }
local seats = {}
for name, half in pairs{ left = left, right = right } do
  seats[#seats + 1] = interface.contact{ name = name .. "_foot", between = { foot:face "zmax", half:face "zmin" } }
  seats[#seats + 1] = interface.contact{ name = name .. "_head", between = { half:face "zmax", head:face "zmin" } }
end
table.sort(seats, function(a, b) return a.name < b.name end)
local base = support.fixed{ name = "base", on = foot:face "zmin" }
-- Frictionless halves slide: hold them sideways without holding them along z.
local guides = support.symmetry{ name = "guides", on = { left:face "xmin", left:face "ymin", right:face "xmax", right:face "ymin" } }
local tighten = step.static{ name = "tighten", increments = 2, loads = { load.shortening{ on = shank, by = p.shorten } } }
local steps = { tighten }
local function pull(name, after, force, increments)
  local s = step.static{ name = name, after = after, increments = increments, loads = { load.force{ on = head:face "zmax", z = force } } }
  steps[#steps + 1] = s
  return s
end
local last = tighten
if p.pull ~= 0 then last = pull("pull", last, p.pull, 4) end
if p.back ~= 0 then last = pull("back", last, 0, 2) end
if p.rest ~= 0 then
  steps[#steps + 1] = step.dynamic{ name = "rest", after = last, duration = 200*0.1*us, dt = 0.1*us }
end
problem{ name = "rod_in_sleeve", substructures = { rod, left, right, head, foot },
  interfaces = { thread, shank, table.unpack(seats) }, supports = { base, guides }, steps = steps,
  solver = solver.latin{ static_tolerance = 1e-10 },
  outputs = { output.resultant{ name = "bolt", on = shank }, output.resultant{ name = "clamp", on = seats },
    output.joint{ name = "seat", on = seats[1] }, output.resultant{ name = "held", on = base },
    output.history{ name = "rod_velocity", on = rod:face "zmax", quantity = "velocity" }, output.energy{} } }:run{}
)";

// k = E A / L of rod and sleeve.
constexpr double k_rod = 2e9 * 4e-6 / 20e-3, k_sleeve = 0.7e9 * 16e-6 / 20e-3;

TEST(RodInSleeve, carries_the_force_of_the_two_springs) {
  const DeckRun run = run_text(rod_in_sleeve).at(0);
  const double force = 20e-6 / (1 / k_rod + 1 / k_sleeve), bolt = run.column("bolt", "normal").back();
  EXPECT_TRUE(run.result->converged);
  EXPECT_NEAR(bolt, force, 0.005 * force);  // the heads, a hundred times stiffer, give a little
  EXPECT_NEAR(run.column("clamp", "normal").back(), -2.0 * bolt, 1e-7 * force);  // at both ends of the sleeve
  EXPECT_NEAR(run.column("held", "z").back(), 0.0, 5e-7 * force);
  EXPECT_NEAR(run.column("bolt", "normal").front(), 0.5 * bolt, 1e-7 * force);
}

TEST(RodInSleeve, shares_a_pull_by_stiffness_opens_beyond_the_separation_load_and_comes_back) {
  const double force = run_text(rod_in_sleeve).at(0).column("bolt", "normal").back();
  const double separation = force * (1 + k_rod / k_sleeve);
  const DeckRun below = run_text(rod_in_sleeve, {{"pull", std::to_string(0.8 * separation)}}).at(0);
  EXPECT_NEAR(below.column("bolt", "normal").back(), force + 0.8 * separation * k_rod / (k_rod + k_sleeve),
              0.005 * force);
  EXPECT_EQ(below.column("seat", "open_area").back(), 0.0);
  const DeckRun beyond =
      run_text(rod_in_sleeve, {{"pull", std::to_string(1.5 * separation)}, {"back", "1"}, {"rest", "1"}}).at(0);
  const std::vector<double>& bolt = beyond.column("bolt", "normal");
  EXPECT_TRUE(beyond.result->converged);
  EXPECT_NEAR(bolt.at(5), 1.5 * separation, 1e-6 * separation);
  EXPECT_NEAR(beyond.column("seat", "normal").at(5), 0.0, 1e-12);
  EXPECT_GE(beyond.column("seat", "open_area").at(5), 7.5e-6);  // the sleeve is loose and may touch with a corner
  EXPECT_NEAR(bolt.at(7), force, 1e-6 * force);
  // Left alone it stays at rest: velocity against wave speed times strain.
  const double scale = std::sqrt(2e9 / 7800) * force / (2e9 * 4e-6);
  EXPECT_EQ(beyond.result->steps.back().increments, 200);
  EXPECT_LT(largest(beyond.column("rod_velocity", "z")), 1e-6 * scale);
  EXPECT_LT(beyond.figure("energy imbalance [%]"), 0.5);
}

TEST(BoltedFlanges, stays_at_rest_when_nothing_loads_it) {
  // The contract deck with its pull taken off.
  std::ifstream file(deck("bench/even_flanges.lua"));
  std::string text((std::istreambuf_iterator<char>(file)), {});
  const auto replace = [&](const std::string& from, const std::string& to) {
    const size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos);
    text.replace(at, from.size(), to);
  };
  replace("peak = 100*MPa", "peak = 0");
  replace("\"../../meshes/bolted_flanges.geo\"",
          "\"" + (std::filesystem::path(DYGITA_SOURCE_DIR) / "meshes/bolted_flanges.geo").string() + "\"");
  replace("a_in, a_out, srs_in, srs_out,",
          "a_in, a_out, output.history{ name = 'motion', on = upper:face 'top', quantity = 'velocity' }, "
          "output.history{ name = 'rod', on = rod:face 'head_end', quantity = 'velocity' },");
  replace("local srs_in  = output.srs{ name = \"srs_above\", of = a_in,  q_factor = 10, from = 1*kHz, to = 100*kHz }",
          "");
  replace("local srs_out = output.srs{ name = \"srs_below\", of = a_out, q_factor = 10, from = 1*kHz, to = 100*kHz }",
          "");
  const DeckRun run = run_text(text).at(0);
  EXPECT_EQ(run.result->steps.at(1).increments, 200);
  // Strain of the rod: force / (E A).
  const double strain = run.column("bolt", "normal").at(1) / (210e9 * 110e-6);
  const double wave_speed = std::sqrt(210e9 / 7800);
  double motion = 0.0;
  for (const char* where : {"motion", "rod"})
    for (const char* axis : {"x", "y", "z"}) motion = std::max(motion, largest(run.column(where, axis)));
  std::cout << "largest velocity " << motion << " m/s, " << motion / (wave_speed * strain)
            << " of wave speed times strain\n";
  EXPECT_LT(motion, 1e-6 * wave_speed * strain);
}

// Two plates pressed into a gap that is too small, in one static step.
TEST(PressFit, presses_out_its_interference) {
  const DeckRun run = run_text(R"(
local m = material.elastic{ name = "m", young = 100*GPa, poisson = 0, density = 5000 }
local a = substructure{ name = "a", material = m, mesh = mesh.box{ size = { 2*mm, 2*mm, 10*mm }, cells = { 1, 1, 5 } } }
local b = substructure{ name = "b", material = m, mesh = mesh.box{ origin = { 0, 0, 10*mm }, size = { 2*mm, 2*mm, 10*mm }, cells = { 1, 1, 5 } } }
local fit = interface.contact{ name = "fit", between = { a:face "zmax", b:face "zmin" }, gap = -10*um, friction = 0.2 }
local ends = support.fixed{ name = "ends", on = { a:face "zmin", b:face "zmax" } }
problem{ name = "press", substructures = { a, b }, interfaces = { fit }, supports = { ends },
  steps = { step.static{ name = "fit", increments = 1 } },
  outputs = { output.resultant{ name = "force", on = fit }, output.energy{} } }:run{}
)")
                          .at(0);
  const double force = 100e9 * 4e-6 * 10e-6 / 20e-3;
  EXPECT_NEAR(run.column("force", "normal").back(), -force, 1e-6 * force);
  EXPECT_LT(run.figure("energy imbalance [%]"), 0.5);
  EXPECT_NEAR(run.column("energy", "strain").back(), 0.5 * force * 10e-6, 1e-6 * 0.5 * force * 10e-6);
  EXPECT_NEAR(run.column("energy", "loads").back(), 0.5 * force * 10e-6, 1e-6 * 0.5 * force * 10e-6);
}

// A stiff block thrown along a rough wall under gravity stops after v^2 / (2 mu g).
TEST(SlidingBlock, stops_after_its_braking_distance) {
  const DeckRun run = run_text(R"(
local m = material.elastic{ name = "m", young = 1*GPa, poisson = 0, density = 1000 }
local block = substructure{ name = "block", material = m, velocity = { 0.5, 0, 0 },
  mesh = mesh.box{ size = { 20*mm, 20*mm, 10*mm }, cells = { 2, 2, 1 } } }
local floor = support.wall{ name = "floor", on = block:face "zmin", friction = 0.5 }
local guide = support.symmetry{ name = "guide", on = block:face "ymin" }
local slide = step.dynamic{ name = "slide", duration = 1500*us, dt = 1*us, loads = { load.gravity{ z = -1000 } } }
problem{ name = "slide", substructures = { block }, supports = { floor, guide }, steps = { slide },
  outputs = { output.history{ name = "way", on = block:face "zmin", quantity = "displacement", direction = { 1, 0, 0 } },
              output.history{ name = "speed", on = block:face "zmin", quantity = "velocity", direction = { 1, 0, 0 } },
              output.joint{ name = "sole", on = floor }, output.energy{} } }:run{}
)")
                          .at(0);
  const double distance = 0.5 * 0.5 / (2 * 0.5 * 1000);
  EXPECT_TRUE(run.result->converged);
  EXPECT_NEAR(run.column("way", "displacement").back(), distance, 0.03 * distance);
  EXPECT_LT(std::abs(run.column("speed", "velocity").back()), 0.02);
  const double kinetic = 0.5 * 1000 * 4e-6 * 0.25;
  EXPECT_NEAR(run.column("sole", "friction_work").back(), kinetic, 0.05 * kinetic);
  EXPECT_LT(run.figure("energy imbalance [%]"), 0.5);
}

const std::string bar = R"(
local m = material.elastic{ name = "m", young = 200*GPa, poisson = 0, density = 8000 }
local a = substructure{ name = "a", material = m, mesh = mesh.box{ size = { 1*mm, 1*mm, 50*mm }, cells = { 1, 1, 50 } } }
local b = substructure{ name = "b", material = m, mesh = mesh.box{ origin = { 0, 0, 50*mm }, size = { 1*mm, 1*mm, 50*mm }, cells = { 1, 1, 50 } } }
)";

// c = 5000 m/s, rho c = 4e7: a pulse of 40 MPa travels with 1 m/s.
TEST(Absorbing, lets_the_wave_out) {
  const DeckRun run = run_text(bar + R"(
local weld = interface.bonded{ name = "weld", between = { a:face "zmax", b:face "zmin" } }
local out = support.absorbing{ name = "out", on = a:face "zmin" }
local hit = step.dynamic{ name = "hit", duration = 40*us, dt = 0.2*us, loads = { load.pressure{ on = b:face "zmax", history = history.haversine{ peak = 40*MPa, duration = 8*us } } } }
problem{ name = "out", substructures = { a, b }, interfaces = { weld }, supports = { out }, steps = { hit },
  outputs = { output.history{ name = "v", on = b:face "zmin", quantity = "velocity", direction = { 0, 0, 1 } }, output.energy{},
              output.resultant{ name = "passed", on = out } } }:run{}
)")
                          .at(0);
  EXPECT_NEAR(largest(run.column("v", "velocity")), 1.0, 0.03);
  EXPECT_LT(run.column("energy", "kinetic").back() + run.column("energy", "strain").back(),
            1e-3 * run.column("energy", "loads").back());
  EXPECT_NEAR(largest(run.column("passed", "normal")), 40.0, 1.5);
  EXPECT_LT(run.figure("energy imbalance [%]"), 0.5);
}

TEST(BaseAcceleration, moves_the_base_and_leaves_it_its_velocity) {
  const DeckRun run = run_text(bar + R"(
local weld = interface.bonded{ name = "weld", between = { a:face "zmax", b:face "zmin" } }
local base = support.fixed{ name = "base", on = a:face "zmin" }
local shake = step.dynamic{ name = "shake", duration = 100*us, dt = 0.5*us, loads = {
  load.base_acceleration{ on = base, direction = { 0, 0, 1 }, history = history.half_sine{ peak = 1e5, duration = 50*us } } } }
local coast = step.dynamic{ name = "coast", after = shake, duration = 50*us, dt = 0.5*us }
problem{ name = "shake", substructures = { a, b }, interfaces = { weld }, supports = { base }, steps = { shake, coast },
  outputs = { output.history{ name = "foot", on = a:face "zmin", quantity = "velocity", direction = { 0, 0, 1 } },
              output.history{ name = "way", on = a:face "zmin", quantity = "displacement", direction = { 0, 0, 1 } },
              output.resultant{ name = "force", on = base }, output.energy{} } }:run{}
)")
                          .at(0);
  const double v = 1e5 * 50e-6 * 2 / M_PI;
  EXPECT_NEAR(run.column("foot", "velocity").back(), v, 1e-9 * v);
  EXPECT_NEAR(run.column("way", "displacement").back(), v * (150e-6 - 25e-6), 1e-3 * v * 150e-6);
  EXPECT_LT(run.figure("energy imbalance [%]"), 0.5);
  // Momentum of the bar is the impulse of the base.
  double impulse = 0.0;
  for (const double f : run.column("force", "z")) impulse += f * 0.5e-6;
  EXPECT_GT(impulse, 0.0);
}

TEST(PrescribedMotion, pulls_with_the_impedance_of_the_bar) {
  const DeckRun run = run_text(bar + R"(
local weld = interface.bonded{ name = "weld", between = { a:face "zmax", b:face "zmin" } }
local out = support.absorbing{ name = "out", on = a:face "zmin" }
local pull = step.dynamic{ name = "pull", duration = 30*us, dt = 0.2*us, loads = { load.velocity{ on = b:face "zmax", z = history.ramp{ from = 0, to = 1, duration = 10*us } } } }
local v = output.history{ name = "v", on = b:face "zmax", quantity = "velocity", direction = { 0, 0, 1 } }
problem{ name = "pull", substructures = { a, b }, interfaces = { weld }, supports = { out }, steps = { pull },
  outputs = { v, output.history{ name = "s", on = b:where(function(x, y, z) return near(z, 75*mm) end), quantity = "stress", direction = { 0, 0, 1 } }, output.energy{} } }:run{}
)")
                          .at(0);
  EXPECT_NEAR(run.column("v", "velocity").back(), 1.0, 1e-12);
  EXPECT_NEAR(run.column("s", "stress").back(), 4e7, 0.01 * 4e7);
  EXPECT_LT(run.figure("energy imbalance [%]"), 0.5);
}

TEST(Chain, supports_loads_and_interfaces_change_from_step_to_step) {
  const DeckRun run = run_text(bar + R"(
local weld = interface.bonded{ name = "weld", between = { a:face "zmax", b:face "zmin" } }
local foot = support.fixed{ name = "foot", on = a:face "zmin" }
local guide = support.symmetry{ name = "guide", on = { a:face "xmin", a:face "ymin", b:face "xmin", b:face "ymin" } }
local hand = load.force{ on = b:face "zmax", z = 100 }
local stretch = step.static{ name = "stretch", increments = 2, loads = { hand } }
local half    = step.static{ name = "half", after = stretch, loads = { load.force{ on = b:face "zmax", z = 50 } } }
local snap    = step.dynamic{ name = "snap", after = half, duration = 60*us, dt = 0.2*us,
                              loads = { hand, load.release{ on = weld, at = 10*us } } }
local free    = step.dynamic{ name = "free", after = snap, duration = 10*us, dt = 0.1*us, supports = { guide } }
problem{ name = "chain", substructures = { a, b }, interfaces = { weld }, supports = { foot, guide }, steps = { stretch, half, snap, free },
  outputs = { output.resultant{ name = "weld", on = weld }, output.history{ name = "end", on = b:face "zmax", quantity = "displacement", direction = { 0, 0, 1 } },
              output.resultant{ name = "foot", on = foot }, output.energy{} } }:run{}
)")
                          .at(0);
  EXPECT_TRUE(run.result->converged);
  const std::vector<double>& weld = run.column("weld", "normal");
  EXPECT_NEAR(weld.at(1), 100.0, 1e-5);
  EXPECT_NEAR(weld.at(2), 50.0, 1e-5);
  EXPECT_NEAR(run.column("foot", "z").at(2), -50.0, 1e-5);
  EXPECT_NEAR(run.column("end", "displacement").at(3), 50.0 / 1e-6 / 200e9 * 100e-3, 1e-9);
  // After 10 us the weld carries nothing.
  const Table& table = run.table("weld");
  for (int i = 0; i < table.n_rows(); ++i)
    if (table.step[i] >= 2 && table.columns[0][i] > 10.2e-6) {
      ASSERT_EQ(table.column("normal")[i], 0.0);
    }
  EXPECT_LT(run.figure("energy imbalance [%]"), 0.5);
  EXPECT_EQ(run.column("foot", "z").back(), 0.0);  // no longer a support
}

TEST(Damping, mass_and_stiffness_damping_dissipate_what_the_ledger_says) {
  const DeckRun run = run_text(R"(
local m = material.elastic{ name = "m", young = 200*GPa, poisson = 0, density = 8000, damping = { mass = 5e3, stiffness = 1e-7 } }
local a = substructure{ name = "a", material = m, mesh = mesh.box{ size = { 1*mm, 1*mm, 50*mm }, cells = { 1, 1, 25 } } }
local b = substructure{ name = "b", material = m, mesh = mesh.box{ origin = { 0, 0, 50*mm }, size = { 1*mm, 1*mm, 50*mm }, cells = { 1, 1, 25 } } }
local weld = interface.bonded{ name = "weld", between = { a:face "zmax", b:face "zmin" } }
local base = support.fixed{ name = "base", on = a:face "zmin" }
local hit = step.dynamic{ name = "hit", duration = 100*us, dt = 0.4*us, loads = { load.pressure{ on = b:face "zmax", history = history.haversine{ peak = 40*MPa, duration = 10*us } } } }
problem{ name = "damp", substructures = { a, b }, interfaces = { weld }, supports = { base }, steps = { hit },
  solver = solver.latin{ numerical_damping = 0.05 }, outputs = { output.energy{} } }:run{}
)")
                          .at(0);
  EXPECT_GT(run.column("energy", "damping").back(), 0.1 * run.column("energy", "loads").back());
  EXPECT_GT(run.column("energy", "scheme").back(), 0.0);
  EXPECT_LT(run.figure("energy imbalance [%]"), 0.01);
}

// A block pushed into the corner of two frictionless walls: two laws with different normals at the edge's nodes.
TEST(Corner, a_node_under_two_laws_has_a_force_for_each) {
  const DeckRun run = run_text(R"(
local m = material.elastic{ name = "m", young = 10*GPa, poisson = 0.3, density = 1000 }
local block = substructure{ name = "block", material = m, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 3, 3, 3 } } }
local floor = support.wall{ name = "floor", on = block:face "zmin" }
local side = support.wall{ name = "side", on = block:face "xmin" }
local guide = support.symmetry{ name = "guide", on = block:face "ymin" }
local push = step.static{ name = "push", loads = { load.pressure{ on = block:face "zmax", history = 10*MPa }, load.pressure{ on = block:face "xmax", history = 5*MPa } } }
problem{ name = "corner", substructures = { block }, supports = { floor, side, guide }, steps = { push },
  outputs = { output.resultant{ name = "floor", on = floor }, output.resultant{ name = "side", on = side }, output.history{ name = "u", on = block:face "zmax", quantity = "displacement", direction = { 0, 0, 1 } } } }:run{}
)")
                          .at(0);
  EXPECT_TRUE(run.result->converged);
  EXPECT_NEAR(run.column("floor", "normal").back(), -1000.0, 1e-3);
  EXPECT_NEAR(run.column("side", "normal").back(), -500.0, 1e-3);
  // Uniform stress -10 and -5 MPa: strain zz = (s_zz - nu s_xx) / E.
  EXPECT_NEAR(run.column("u", "displacement").back(), (-10e6 + 0.3 * 5e6) / 10e9 * 10e-3, 1e-12);
}

TEST(StaticStep, names_a_rigid_motion_that_is_loaded_and_leaves_one_that_is_not) {
  const std::string floating = R"(
local p = param{ push = 0 }
local m = material.elastic{ name = "m", young = 10*GPa, poisson = 0.3, density = 1000 }
local block = substructure{ name = "block", material = m, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 2, 2, 2 } } }
local floor = support.wall{ name = "floor", on = block:face "zmin" }
local push = step.static{ name = "push", loads = { load.pressure{ on = block:face "zmax", history = 10*MPa }, load.force{ on = block:face "xmax", x = p.push } } }
problem{ name = "floating", substructures = { block }, supports = { floor }, steps = { push },
  outputs = { output.resultant{ name = "floor", on = floor }, output.history{ name = "s", on = block:face "xmax", quantity = "stress", direction = { 1, 0, 0 } } } }:run{}
)";
  const DeckRun run = run_text(floating).at(0);
  EXPECT_NEAR(run.column("floor", "normal").back(), -1000.0, 1e-3);
  EXPECT_NEAR(run.column("s", "stress").back(), 0.0, 1e-2);  // the pins carry nothing
  try {
    run_text(floating, {{"push", "1"}});
    FAIL() << "a loaded rigid motion went unnoticed";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("substructure 'block' is loaded, but no support or interface holds it"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace dygita::test::joints_tests
