// What nothing holds in a static step: it stays where it is on the whole, or its inertia balances the loads.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "decks/engine.hpp"

namespace dygita::test::free_motions_tests {
namespace {

constexpr const char* solvers[] = {"latin{ static_steps = 'iterated', static_tolerance = 1e-10 }",
                                   "latin{ static_steps = 'assembled' }", "monolithic{}"};

Vec3 last(const DeckRun& run, const std::string& output) {
  return {run.column(output, "x").back(), run.column(output, "y").back(), run.column(output, "z").back()};
}

// A run, and what it warned of.
std::pair<DeckRun, std::string> heard(const std::string& text, const Settings& settings, const std::string& solver) {
  testing::internal::CaptureStderr();
  DeckRun run = run_text(text, settings, 1, solver).at(0);
  return {std::move(run), testing::internal::GetCapturedStderr()};
}

// Two bonded blocks that a pressure beside the middle holds on a smooth wall: they may slide on it, and turn.
// kind 1: moved; 2: turned; 3: mirrored in x; 4: listed the other way round; 5: sides swapped.
const std::string on_wall = R"(
local p = param{ kind = 0, cells = 4 }
local n, mirror = p.cells, p.kind == 3 and -1 or 1
local soft = material.elastic{ name = "soft", young = 70*GPa, poisson = 0.33, density = 2700 }
local hard = material.elastic{ name = "hard", young = 210*GPa, poisson = 0.3, density = 7800 }
local place = nil
if p.kind == 1 then place = { 0.3, -0.2, 0.1 } end
if p.kind == 2 then place = { rotate = { axis = { 1, 2, -0.5 }, angle = 1.1, about = { 0.01, 0, 0.02 } } } end
local function block(name, metal, x, y, z, a, b, c, cells)
  local left = mirror > 0 and x or -x - a
  return substructure{ name = name, material = metal, place = place, mesh = mesh.box{ origin = { left*mm, y*mm, z*mm }, size = { a*mm, b*mm, c*mm }, cells = cells } }
end
local low = block("low", soft, 0, 0, 0, 20, 20, 12, { n, n, n })
local high = block("high", hard, 5, 10, 12, 10, 10, 8, n > 1 and { n/2, n/2, 2 } or { 1, 1, 1 })
if n == 1 then high = block("high", hard, 0, 0, 12, 20, 20, 8, { 1, 1, 1 }) end
local sides = p.kind == 5 and { high:face "zmin", low:face "zmax" } or { low:face "zmax", high:face "zmin" }
local seam = interface.bonded{ name = "seam", between = sides }
local wall = support.wall{ name = "wall", on = low:face "zmin", friction = 0 }
local press = load.pressure{ on = high:face "zmax", history = 80*MPa }
local parts = p.kind == 4 and { high, low } or { low, high }
local function moved(name, on) return output.history{ name = name, on = on, quantity = "displacement" } end
local left, right = mirror > 0 and "xmin" or "xmax", mirror > 0 and "xmax" or "xmin"
problem{ name = "on_wall", substructures = parts, interfaces = { seam }, supports = { wall }, steps = { step.static{ name = "press", increments = 2, loads = { press } } },
  outputs = { moved("left", low:face(left)), moved("right", low:face(right)), moved("back", low:face "ymax"), moved("top", high:face "zmax"), moved("side", high:face(right)),
              moved("low", low:where(function() return true end)), moved("high", high:where(function() return true end)) } }:run{}
)";

// A row of bonded blocks, held at one end and pulled at the other: so long that it bends under next to nothing.
TEST(FreeMotion, of_a_long_row_of_bonded_blocks_is_none_and_it_stretches_by_hooke) {
  const std::string row = R"(
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0, density = 7800 }
local cube = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } }
local parts, seams = {}, {}
for i = 1, 700 do
  parts[i] = substructure{ name = "p" .. i, mesh = cube, material = steel, place = { (i - 1)*10*mm, 0, 0 } }
  if i > 1 then seams[i - 1] = interface.bonded{ name = "seam" .. i, between = { parts[i - 1]:face "xmax", parts[i]:face "xmin" } } end
end
problem{ name = "row", substructures = parts, interfaces = seams, supports = { support.fixed{ name = "end", on = parts[1]:face "xmin" } },
  steps = { step.static{ name = "pull", loads = { load.pressure{ on = parts[#parts]:face "xmax", history = -1*MPa } } } },
  outputs = { output.history{ name = "tip", on = parts[#parts]:face "xmax", quantity = "displacement" } } }:run{}
)";
  const auto [run, warned] = heard(row, {}, solvers[1]);
  EXPECT_EQ(warned.find("unconstrained"), std::string::npos) << warned;
  EXPECT_EQ(warned.find("balance"), std::string::npos) << warned;
  EXPECT_NEAR(last(run, "tip")[0], 1e6 * 7.0 / 210e9, 1e-6 * 1e6 * 7.0 / 210e9);
}

TEST(FreeMotion, left_free_is_the_same_wherever_it_is_and_however_it_is_described) {
  const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(1, 2, -0.5).normalized()).toRotationMatrix();
  const DeckRun right = run_text(on_wall, {}, 1, solvers[0])[0];
  const double size = last(right, "top").norm();
  EXPECT_GT(last(right, "right")[0] - last(right, "left")[0], 0.1 * size);  // it does spread
  for (int kind = 0; kind < 6; ++kind)
    for (const char* solver : solvers) {
      const DeckRun run = run_text(on_wall, {{"kind", std::to_string(kind)}}, 1, solver)[0];
      for (const char* at : {"left", "right", "back", "top", "side"}) {
        Vec3 moved = last(run, at);
        if (kind == 2) moved = turn.transpose() * moved;
        if (kind == 3) moved[0] = -moved[0];
        EXPECT_LT((moved - last(right, at)).norm(), 1e-8 * size) << kind << " " << solver << " " << at;
      }
    }
}

// One cell each: their masses are alike at all nodes.
TEST(FreeMotion, does_not_move_the_centre_of_mass) {
  const double low = 2700 * 12.0, high = 7800 * 8.0;
  for (const char* solver : solvers) {
    const DeckRun run = run_text(on_wall, {{"cells", "1"}}, 1, solver)[0];
    const Vec3 mean = (low * last(run, "low") + high * last(run, "high")) / (low + high);
    const double size = last(run, "right").norm();
    EXPECT_GT(size, 1e-7);
    EXPECT_NEAR(mean[0], 0.0, 1e-12 * size) << solver;
    EXPECT_NEAR(mean[1], 0.0, 1e-12 * size) << solver;
  }
}

// Two blocks that a rod tightens against a sleeve beside it, free in space. kind 1: held at three nodes, by no more
// than a rigid body needs.
const std::string tightened = R"(
local p = param{ kind = 0 }
local metal = material.elastic{ name = "metal", young = 200*GPa, poisson = 0.3, density = 8000 }
local function block(name, x, z, w, h, n) return substructure{ name = name, material = metal, mesh = mesh.box{ origin = { x*mm, 0, z*mm }, size = { w*mm, 10*mm, h*mm }, cells = { n, 1, 2 } } } end
local foot, rod, sleeve, head = block("foot", 0, -10, 20, 10, 2), block("rod", 0, 0, 10, 30, 1), block("sleeve", 10, 0, 10, 30, 1), block("head", 0, 30, 20, 10, 2)
local function glued(name, low, high) return interface.bonded{ name = name, between = { low:face "zmax", high:face "zmin" } } end
local nut = glued("nut", rod, head)
local seat = interface.contact{ name = "seat", between = { sleeve:face "zmax", head:face "zmin" }, friction = 0.2 }
local function at(x, y, z) return foot:where(function(a, b, c) return math.abs(a - x) + math.abs(b - y) + math.abs(c - z) < 1e-6 end) end
local supports = {}
if p.kind == 1 then
  supports = { support.fixed{ name = "a", on = at(0, 0, -10*mm) }, support.held{ name = "b", on = at(20*mm, 0, -10*mm), y = true, z = true },
               support.held{ name = "c", on = at(0, 10*mm, -10*mm), z = true } }
end
problem{ name = "tightened", substructures = { foot, rod, sleeve, head }, supports = supports,
  interfaces = { glued("thread", foot, rod), nut, glued("feet", foot, sleeve), seat },
  steps = { step.static{ name = "tighten", increments = 2, loads = { load.shortening{ on = nut, by = 20*um } } } },
  outputs = { output.joint{ name = "nut", on = nut }, output.joint{ name = "seat", on = seat } } }:run{}
)";

TEST(FreeAssembly, is_tightened_as_one_that_is_held_and_without_a_warning) {
  const auto [held, said_of_held] = heard(tightened, {{"kind", "1"}}, solvers[0]);
  const double right = held.column("nut", "normal").back();
  EXPECT_GT(right, 1000.0);
  EXPECT_FALSE(held.result->free[0].is_whole);
  for (const char* solver : solvers) {
    const auto [run, said] = heard(tightened, {}, solver);
    EXPECT_TRUE(run.result->converged);
    EXPECT_TRUE(run.result->free[0].is_whole);
    EXPECT_EQ(said, said_of_held) << solver;
    EXPECT_EQ(said.find("unconstrained"), std::string::npos) << said;
    EXPECT_NEAR(run.column("nut", "normal").back(), right, 1e-7 * right) << solver;
    EXPECT_NEAR(run.column("seat", "normal").back(), held.column("seat", "normal").back(), 1e-7 * right) << solver;
  }
}

// kind 0: a bar pulled at one end, free; 1: then let go on under the same force.
const std::string pulled = R"(
local p = param{ kind = 0, relief = 1, order = 1 }
local metal = material.elastic{ name = "metal", young = 200*GPa, poisson = 0, density = 8000 }
local bar = substructure{ name = "bar", material = metal, mesh = mesh.box{ size = { 10*mm, 10*mm, 100*mm }, cells = { 1, 1, 5 }, cell = p.order == 2 and "hex20" or "hex8" } }
local pull = load.pressure{ on = bar:face "zmax", history = -100*MPa }
local steps = { step.static{ name = "pull", increments = 2, inertia_relief = p.relief == 1, loads = { pull } } }
if p.kind == 1 then steps[2] = step.dynamic{ name = "fly", after = steps[1], duration = 100*us, dt = 1*us, loads = { pull } } end
local outputs = {}
for i = 0, 5 do
  local at = bar:where(function(x, y, z) return math.abs(z - i * 20*mm) < 1e-6 end)
  outputs[#outputs + 1] = output.history{ name = "u" .. i, on = at, quantity = "displacement" }
  if p.kind == 1 then outputs[#outputs + 1] = output.history{ name = "v" .. i, on = at, quantity = "velocity" } end
end
problem{ name = "pulled", substructures = { bar }, steps = steps, outputs = outputs }:run{}
)";

TEST(InertiaRelief, lets_the_stress_of_a_bar_fall_to_its_free_end) {
  for (const char* solver : solvers)
    for (const char* order : {"1", "2"}) {
      const auto [run, said] = heard(pulled, {{"order", order}}, solver);
      // u = S z^2 / (2 E L), less its mean over the mass.
      const double whole = 100e6 * 0.1 / (2 * 200e9), least = run.column("u0", "z").back();
      for (int i = 0; i <= 5; ++i)
        EXPECT_NEAR(run.column("u" + std::to_string(i), "z").back() - least, whole * i * i / 25.0, 1e-9 * whole)
            << solver << order << i;
      if (order[0] == '2') {
        EXPECT_NEAR(least, -whole / 3.0, 1e-9 * whole) << solver;
      }
      ASSERT_TRUE(run.result->free[0].relief);
      const RigidAcceleration& a = *run.result->free[0].relief;
      EXPECT_NEAR(a.linear[2], 100e6 / (8000 * 0.1), 1e-6) << solver;
      EXPECT_NEAR(a.linear.head<2>().norm() + 0.1 * a.angular.norm(), 0.0, 1e-6) << solver;
      EXPECT_NEAR((a.centre - Vec3(5e-3, 5e-3, 50e-3)).norm(), 0.0, 1e-12) << solver;
      EXPECT_EQ(said, "") << solver;
    }
}

TEST(InertiaRelief, leaves_a_motion_without_vibration) {
  for (const char* solver : {"latin{ integration = 'implicit' }", "monolithic{}", "explicit{}"}) {
    const DeckRun run = run_text(pulled, {{"kind", "1"}}, 1, solver)[0];
    const double reached = 100e6 / (8000 * 0.1) * 100e-6;
    for (int i = 0; i <= 5; ++i)
      EXPECT_NEAR(run.column("v" + std::to_string(i), "z").back(), reached, 1e-6 * reached) << solver << i;
  }
}

TEST(InertiaRelief, is_named_where_nothing_holds_what_is_loaded) {
  try {
    run_text(pulled, {{"relief", "0"}}, 1);
    ADD_FAILURE();
  } catch (const InputError& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("static step 'pull': translation along z of substructure 'bar' is loaded, but no support or "
                        "interface holds it\n    nothing holds the assembly: add a support, or step.static{ "
                        "inertia_relief = true }, and the loads accelerate it"),
              std::string::npos)
        << said;
  }
}

// A box turned by 30 degrees between two planes of symmetry of its own: it slides along the edge where they meet.
TEST(FreeMotion, is_named_along_its_own_axis) {
  const std::string sliding = R"(
local p = param{ loaded = 0 }
local metal = material.elastic{ name = "metal", young = 200*GPa, poisson = 0.3, density = 8000 }
local bar = substructure{ name = "bar", material = metal, place = { rotate = { axis = { 0, 0, 1 }, angle = 30*deg } },
  mesh = mesh.box{ size = { 50*mm, 20*mm, 20*mm }, cells = { 2, 1, 1 } } }
local across = support.symmetry{ name = "across", on = bar:face "ymin" }
local below = support.symmetry{ name = "below", on = bar:face "zmin" }
local along = load.force{ on = bar:face "xmax", x = 10*p.loaded }
problem{ name = "sliding", substructures = { bar }, supports = { across, below }, steps = { step.static{ name = "pull", loads = p.loaded == 1 and { along } or {} } },
  outputs = { output.energy{} } }:run{}
)";
  try {
    run_text(sliding, {{"loaded", "1"}}, 1);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("translation along (0.866, 0.5, 0) of substructure 'bar' is loaded, but "),
              std::string::npos)
        << error.what();
  }
  testing::internal::CaptureStderr();
  run_text(sliding, {}, 1);
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_NE(told.find("translation along (0.866, 0.5, 0) of substructure 'bar' is unconstrained"), std::string::npos)
      << told;
}

// A box of two glued halves, turned, pushed at an edge: it turns, too. kind 1: held, by a wall of symmetry.
const std::string pushed = R"(
local p = param{ kind = 0 }
local metal = material.elastic{ name = "metal", young = 200*GPa, poisson = 0.3, density = 8000 }
local place = { rotate = { axis = { 1, 2, -0.5 }, angle = 1.1, about = { 0.5, 0, 0.02 } } }
local function half(name, z) return substructure{ name = name, material = metal, place = place, mesh = mesh.box{ origin = { 0, 0, z }, size = { 30*mm, 20*mm, 50*mm }, cells = { 2, 2, 2 }, cell = "hex20" } } end
local low, high = half("low", 0), half("high", 50*mm)
local seam = interface.bonded{ name = "seam", between = { low:face "zmax", high:face "zmin" } }
local push = load.force{ on = high:face "xmax", x = 1000, y = -2000, z = 500 }
problem{ name = "pushed", substructures = { low, high }, interfaces = { seam }, supports = p.kind == 1 and { support.fixed{ name = "held", on = low:face "zmin" } } or nil,
  steps = { step.static{ name = "push", inertia_relief = true, loads = { push } } },
  outputs = { output.resultant{ name = "seam", on = seam }, output.energy{} } }:run{}
)";

TEST(InertiaRelief, turns_what_is_pushed_beside_its_middle) {
  const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(1, 2, -0.5).normalized()).toRotationMatrix();
  const double mass = 8000 * 0.03 * 0.02 * 0.1;
  const Vec3 force(1000, -2000, 500), arm = turn * Vec3(15e-3, 0, 25e-3);
  const Vec3 inertia = mass / 12 * Vec3(0.02 * 0.02 + 0.1 * 0.1, 0.03 * 0.03 + 0.1 * 0.1, 0.03 * 0.03 + 0.02 * 0.02);
  const Vec3 angular = turn * inertia.cwiseInverse().asDiagonal() * turn.transpose() * arm.cross(force);
  const Vec3 of_low = 0.5 * (force + mass * angular.cross(turn * Vec3(0, 0, -25e-3)));  // m/2 times its acceleration
  for (const char* solver : solvers) {
    const DeckRun run = run_text(pushed, {}, 1, solver)[0];
    ASSERT_TRUE(run.result->free[0].relief);
    const RigidAcceleration& a = *run.result->free[0].relief;
    EXPECT_LT((a.linear - force / mass).norm(), 1e-9 * (force / mass).norm()) << solver;
    EXPECT_LT((a.angular - angular).norm(), 1e-9 * angular.norm()) << solver;
    EXPECT_LT((last(run, "seam") - of_low).norm(), 1e-7 * force.norm()) << solver << last(run, "seam").transpose();
    EXPECT_LT(run.figure("energy imbalance [%]"), 1e-6) << solver;
  }
}

TEST(InertiaRelief, of_what_is_held_has_nothing_to_do_and_says_so) {
  const std::string said = heard(pushed, {{"kind", "1"}}, "").second;
  EXPECT_NE(said.find("static step 'push': 'inertia_relief' has nothing to do: supports and interfaces hold all parts"),
            std::string::npos)
      << said;
}

// Pushed along its guides in the first of two increments only.
TEST(FreeMotion, is_not_held_while_a_load_comes_and_goes) {
  const std::string guided = R"(
local metal = material.elastic{ name = "metal", young = 200*GPa, poisson = 0, density = 8000 }
local bar = substructure{ name = "bar", material = metal, mesh = mesh.box{ size = { 10*mm, 10*mm, 100*mm }, cells = { 1, 1, 5 } } }
local guides = support.symmetry{ name = "guides", on = { bar:face "xmin", bar:face "ymin", bar:face "ymax" } }
local push = load.force{ on = bar:face "zmin", z = function(t) return t < 0.75 and 100 or 0 end }
problem{ name = "guided", substructures = { bar }, supports = { guides }, steps = { step.static{ name = "push", increments = 2, loads = { push } } } }:run{}
)";
  EXPECT_THROW(run_text(guided, {}, 1), InputError);
}

// 10 N/m: a decimetre under 1 N, however small the block; ten metres under 100 N are no small displacement.
TEST(FreeMotion, on_soft_springs_is_hookes_until_it_is_too_large_and_that_is_said) {
  const std::string soft = R"(
local p = param{ force = 1 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local block = substructure{ name = "block", material = steel, mesh = mesh.box{ size = { 20*mm, 20*mm, 20*mm }, cells = { 3, 3, 3 } } }
local spring = support.spring{ name = "spring", on = block:face "zmin", x = 10, y = 10, z = 10, about_x = 10, about_y = 10, about_z = 10 }
problem{ name = "soft", substructures = { block }, supports = { spring },
  steps = { step.static{ name = "push", increments = 2, loads = { load.force{ on = block:face "zmax", z = -p.force } } } },
  outputs = { output.history{ name = "top", on = block:face "zmax", quantity = "displacement" } } }:run{}
)";
  for (const char* solver : solvers) {
    const auto [run, said] = heard(soft, {}, solver);
    EXPECT_NEAR(run.column("top", "z").back(), -0.1, 1e-7) << solver;
    EXPECT_TRUE(run.result->converged) << solver << said;
  }
  const auto [run, said] = heard(soft, {{"force", "100"}}, "latin{}");
  EXPECT_FALSE(run.result->converged);
  EXPECT_NE(said.find("at substructure 'block', interface 'spring': it is unconstrained, springs are too soft for the "
                      "load that they hold"),
            std::string::npos)
      << said;
  try {
    run_text(soft, {{"force", "100"}}, 1, "monolithic{}");
    FAIL();
  } catch (const NumericalError& error) {
    EXPECT_NE(std::string(error.what()).find("springs are too soft for the load that they hold"), std::string::npos);
  }
}

}  // namespace
}  // namespace dygita::test::free_motions_tests
