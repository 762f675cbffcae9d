// What steps hold, move and load, and what one of them leaves to the next: every case was a wrong number at some time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "decks/engine.hpp"
#include "result/watched_figures.hpp"

namespace dygita::test::conditions_tests {
namespace {

const std::string metal = R"(
local p = param{ kind = 0 }
local metal = material.elastic{ name = "metal", young = 200*GPa, poisson = 0, density = 8000 }
)";

DeckRun run_kind(const std::string& text, int kind, const std::string& solver = "") {
  return run_text(metal + text, {{"kind", std::to_string(kind)}}, 0, solver).at(0);
}

std::string error_of(const std::string& text, int kind = 0) {
  try {
    run_kind(text, kind);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

class FunctionOfTime : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Solvers, FunctionOfTime, testing::Values("latin{}", "monolithic{}", "explicit{}"));

// Kind 0: a half-sine; 1: the same as a function; 2: a sum that has the function in it. 500 time steps, of which the
// pulse takes 50.
const std::string shaken = R"(
local b = substructure{ name = "b", material = metal, mesh = mesh.box{ size = { 20*mm, 20*mm, 10*mm }, cells = { 1, 1, 1 } } }
local base = support.fixed{ name = "base", on = b:face "zmin" }
local shot = history.half_sine{ peak = 1000, duration = 0.5*ms }
local function as_function(t) return t < 0.5*ms and 1000 * math.sin(math.pi * t / (0.5*ms)) or 0 end
local signal = ({ [0] = shot, as_function, 0.5 * shot + function(t) return 0.5 * as_function(t) end })[p.kind]
local shock = step.dynamic{ name = "shock", duration = 5*ms, dt = 10*us, loads = { load.base_acceleration{ on = base, direction = { 0, 0, 1 }, history = signal } } }
local after = step.dynamic{ name = "after", after = shock, duration = 100*us, dt = 10*us }
problem{ name = "p", substructures = { b }, supports = { base }, steps = { shock, after },
  outputs = { output.history{ name = "v", on = b:face "zmin", quantity = "velocity", direction = { 0, 0, 1 } } } }:run{}
)";

TEST_P(FunctionOfTime, shakes_a_base_as_the_same_signal_does) {
  const std::vector<double> exact = run_kind(shaken, 0, GetParam()).column("v", "velocity");
  const double reached = 2.0 / M_PI * 1000.0 * 0.5e-3;
  EXPECT_NEAR(exact.back(), reached, 1e-9 * reached);
  for (const int kind : {1, 2}) {
    const std::vector<double> v = run_kind(shaken, kind, GetParam()).column("v", "velocity");
    ASSERT_EQ(v.size(), exact.size());
    for (size_t i = 0; i < v.size(); ++i) EXPECT_NEAR(v[i], exact[i], 1e-6 * reached) << i;
  }
}

// Kind 0: a bar held along one axis on each of three sides, and pulled along z; 1: the same by planes of symmetry; 2:
// held along two axes by one support, on a region.
const std::string held_along_axes = R"(
local soft = material.elastic{ name = "soft", young = 1*GPa, poisson = 0.4, density = 1000 }
local b = substructure{ name = "b", material = soft, mesh = mesh.box{ size = { 10*mm, 20*mm, 50*mm }, cells = { 2, 3, 4 } } }
local along_x, along_y, along_z
if p.kind == 1 then
  along_x = support.symmetry{ name = "x", on = b:face "xmin" }
  along_y = support.symmetry{ name = "y", on = b:face "ymin" }
  along_z = support.symmetry{ name = "z", on = b:face "zmin" }
elseif p.kind == 0 then
  along_x = support.held{ name = "x", on = b:face "xmin", x = true }
  along_y = support.held{ name = "y", on = b:face "ymin", y = true }
  along_z = support.held{ name = "z", on = b:face "zmin", z = true }
else
  along_x = support.held{ name = "x", on = b:face "xmin", x = true }
  along_y = support.held{ name = "y", on = b:where(function(x, y, z) return y < 1*um end), y = true }
  along_z = support.held{ name = "z", on = b:face "zmin", z = true }
end
local pull = step.static{ name = "pull", increments = 1, loads = { load.traction{ on = b:face "zmax", z = 10*MPa } } }
problem{ name = "p", substructures = { b }, supports = { along_x, along_y, along_z }, steps = { pull },
  outputs = { output.history{ name = "x", on = b:face "xmax", quantity = "displacement" },
              output.history{ name = "y", on = b:face "ymax", quantity = "displacement" },
              output.history{ name = "z", on = b:face "zmax", quantity = "displacement" },
              output.resultant{ name = "r", on = along_z } } }:run{}
)";

TEST(HeldAlongAxes, stretches_a_bar_as_planes_of_symmetry_do) {
  for (const int kind : {0, 1, 2}) {
    const DeckRun run = run_kind(held_along_axes, kind);
    EXPECT_NEAR(run.column("z", "z").back(), 0.5e-3, 1e-12) << kind;
    EXPECT_NEAR(run.column("x", "x").back(), -0.4 * 0.01 * 10e-3, 1e-12) << kind;
    EXPECT_NEAR(run.column("y", "y").back(), -0.4 * 0.01 * 20e-3, 1e-12) << kind;
    EXPECT_NEAR(run.column("r", "z").back(), -2000.0, 1e-6) << kind;
  }
}

// Kind 0: a base held along all axes, shaken along two; 1: fixed; 2: held along z alone and shaken across.
const std::string shaken_along_axes = R"(
local b = substructure{ name = "b", material = metal, mesh = mesh.box{ size = { 20*mm, 20*mm, 40*mm }, cells = { 2, 2, 3 } } }
local base = p.kind == 1 and support.fixed{ name = "base", on = b:face "zmin" }
  or support.held{ name = "base", on = b:face "zmin", x = p.kind == 0, y = p.kind == 0, z = true }
local direction = p.kind == 2 and { 1, 0, 0 } or { 0.6, 0, 0.8 }
local shock = step.dynamic{ name = "shock", duration = 200*us, dt = 1*us,
  loads = { load.base_acceleration{ on = base, direction = direction, history = history.half_sine{ peak = 1000*g0, duration = 100*us } } } }
problem{ name = "p", substructures = { b }, supports = { base }, steps = { shock },
  outputs = { output.history{ name = "top", on = b:face "zmax", quantity = "velocity" }, output.energy{} } }:run{}
)";

TEST(HeldAlongAxes, all_of_them_is_fixed_where_it_is_shaken_too) {
  const DeckRun held = run_kind(shaken_along_axes, 0), fixed = run_kind(shaken_along_axes, 1);
  for (const char* column : {"x", "y", "z"})
    EXPECT_EQ(held.column("top", column), fixed.column("top", column)) << column;
}

TEST(HeldAlongAxes, is_not_shaken_where_it_holds_nothing) {
  EXPECT_NE(error_of(shaken_along_axes, 2).find("where it holds nothing\n    it holds only along some axes"),
            std::string::npos)
      << error_of(shaken_along_axes, 2);
}

// Kind 0 and 1: the order in which two supports are listed that share nodes; 2: the absorbing one leaves.
const std::string absorbed = R"(
local b = substructure{ name = "b", material = metal, mesh = mesh.box{ size = { 10*mm, 10*mm, 50*mm }, cells = { 2, 2, 5 } } }
local foot = support.absorbing{ name = "foot", on = b:face "zmin" }
local guide = support.symmetry{ name = "guide", on = { b:face "xmin", b:face "ymin", b:face "xmax", b:face "ymax" } }
local press = load.pressure{ on = b:face "zmax", history = 5*MPa }
local pre = step.static{ name = "pre", loads = { press } }
local go = step.dynamic{ name = "go", after = pre, duration = 60*us, dt = 1*us, loads = { press }, supports = p.kind == 2 and { guide } or nil }
problem{ name = "p", substructures = { b }, supports = p.kind == 1 and { guide, foot } or { foot, guide }, steps = { pre, go },
  outputs = { output.momentum{ name = "m" }, output.history{ name = "v", on = b:face "zmax", quantity = "velocity", direction = { 0, 0, 1 } } } }:run{}
)";

class AbsorbingSupport : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Solvers, AbsorbingSupport, testing::Values("latin{}", "monolithic{}", "explicit{}"));

TEST_P(AbsorbingSupport, keeps_its_static_reaction_whatever_else_holds_its_nodes) {
  for (const int kind : {0, 1}) {
    const DeckRun run = run_kind(absorbed, kind, GetParam());
    EXPECT_NEAR(run.column("v", "velocity").back(), 0.0, 1e-6) << kind;
  }
}

TEST_P(AbsorbingSupport, pushes_no_more_where_a_step_leaves_it_out) {
  const DeckRun run = run_kind(absorbed, 2, GetParam());
  EXPECT_NEAR(run.column("m", "z").back(), -500.0 * 60e-6, 1e-6 * 500.0 * 60e-6);
}

// Two faces that were picked by a function each have the same label.
TEST(PickedFaces, each_remember_what_loads_on_them_have_reached) {
  const std::string text = R"(
local b = substructure{ name = "b", material = metal, mesh = mesh.box{ size = { 30*mm, 10*mm, 20*mm }, cells = { 3, 1, 2 } } }
local base = support.fixed{ name = "base", on = b:face "zmin" }
local left = b:face{ normal = { 0, 0, 1 }, where = function(x) return x < 10.1*mm end }
local right = b:face{ normal = { 0, 0, 1 }, where = function(x) return x > 19.9*mm end }
local function to(face) return p.kind == 0 and load.displacement{ on = face, z = 20*um } or load.force{ on = face, z = 1*kN } end
local on_left, on_right = to(left), to(right)
local one = step.static{ name = "one", loads = { on_left } }
local two = step.static{ name = "two", after = one, increments = 4, loads = { on_left, on_right } }
local function moved(name, face) return output.history{ name = name, on = face, quantity = "displacement", direction = { 0, 0, 1 } } end
problem{ name = "p", substructures = { b }, supports = { base }, steps = { one, two },
  outputs = { moved("left", left), moved("right", right), output.resultant{ name = "r", on = base } } }:run{}
)";
  const DeckRun moved = run_kind(text, 0);
  EXPECT_NEAR(moved.column("right", "displacement").back(), 20e-6, 1e-12);
  EXPECT_NEAR(moved.column("left", "displacement").back(), 20e-6, 1e-12);
  const DeckRun pulled = run_kind(text, 1);
  const std::vector<double>& z = pulled.column("r", "z");
  ASSERT_EQ(z.size(), 5u);
  for (size_t i = 0; i < z.size(); ++i) EXPECT_NEAR(z[i], -1000.0 * (1.0 + 0.25 * static_cast<double>(i)), 1e-5) << i;
}

// Kind 0: a force has stretched the bar before; 1: the same nodes, as a region; 2: they are to come back to where they
// began; 3: a signal.
TEST(PrescribedDisplacement, of_a_static_step_is_where_the_nodes_end) {
  const std::string text = R"(
local b = substructure{ name = "b", material = metal, mesh = mesh.box{ size = { 10*mm, 10*mm, 100*mm }, cells = { 1, 1, 10 } } }
local base = support.fixed{ name = "base", on = b:face "zmin" }
local top = b:face "zmax"
local same = b:where(function(x, y, z) return near(z, 100*mm) end)
local first = p.kind == 1 and load.displacement{ on = top, z = 20*um } or load.force{ on = top, z = 10*kN }
local drive = load.displacement{ on = p.kind == 1 and same or top, z = ({ [0] = 20*um, 20*um, 0, function(t) return 20*um * t * t end })[p.kind] }
local one = step.static{ name = "one", loads = { first } }
local two = step.static{ name = "two", after = one, increments = 4, loads = { drive } }
problem{ name = "p", substructures = { b }, supports = { base }, steps = { one, two },
  outputs = { output.history{ name = "u", on = top, quantity = "displacement", direction = { 0, 0, 1 } }, output.resultant{ name = "r", on = base } } }:run{}
)";
  for (const int kind : {0, 1, 2, 3})
    for (const char* solver : {"latin{}", "monolithic{}"}) {
      const DeckRun run = run_kind(text, kind, solver);
      const double end = kind == 2 ? 0.0 : 20e-6;
      EXPECT_NEAR(run.column("u", "displacement").back(), end, 1e-11) << kind << solver;
      EXPECT_NEAR(run.column("r", "z").back(), -end * 200e9 * 1e-4 / 0.1, 1e-2) << kind << solver;
      if (kind != 0) continue;
      EXPECT_NEAR(run.column("u", "displacement").end()[-2], 0.25 * 50e-6 + 0.75 * 20e-6, 1e-11);
    }
}

// Kind 0: a list of two faces; 1: one face with both planes.
// 100 MPa on sides of 20 x 20 mm: 40 kN each, whether they are one face around an edge or a list.
TEST(Pressure, on_a_face_around_an_edge_is_that_on_each_of_its_sides) {
  for (const char* cells : {"order = 1", "order = 2"}) {
    const DeckRun run = run_kind(std::string(R"(
local b = substructure{ name = "b", material = metal, mesh = mesh.box{ size = { 20*mm, 20*mm, 20*mm }, cells = { 2, 2, 2 }, )") +
                                     cells + R"( } }
local three = b:face{ where = function(x, y, z) return near(x, 20*mm) or near(y, 20*mm) or near(z, 20*mm) end }
local base = support.fixed{ name = "base", on = b:face "zmin" }
local press = step.static{ name = "press", loads = { load.pressure{ on = three, history = 100*MPa } } }
problem{ name = "p", substructures = { b }, supports = { base }, steps = { press }, outputs = { output.resultant{ name = "r", on = base } } }:run{}
)",
                                 0);
    for (const char* along : {"x", "y", "z"})
      EXPECT_NEAR(run.column("r", along).back(), 40000.0, 1e-3) << cells << along;
  }
}

class MovedEnd : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Solvers, MovedEnd,
                         testing::Values("latin{ integration = 'implicit' }", "latin{ integration = 'explicit' }",
                                         "monolithic{}", "explicit{}"));

// A half-sine of 10 um in 20 us, whose speed jumps at its start; 0.5 m/s from the first instant on.
TEST_P(MovedEnd, is_where_its_load_has_it) {
  const std::string bar = R"(
local b = substructure{ name = "b", material = metal, mesh = mesh.box{ size = { 5*mm, 5*mm, 50*mm }, cells = { 1, 1, 10 } } }
local top = b:face "zmax"
local base = support.fixed{ name = "base", on = b:face "zmin" }
local by = ({ [0] = load.displacement{ on = top, z = history.half_sine{ peak = 10*um, duration = 20*us } }, load.velocity{ on = top, z = 0.5 } })[p.kind]
local move = step.dynamic{ name = "move", duration = 40*us, dt = 1*us, loads = { by } }
problem{ name = "p", substructures = { b }, supports = { base }, steps = { move },
  outputs = { output.history{ name = "u", on = top, quantity = "displacement", direction = { 0, 0, 1 } }, output.energy{} } }:run{}
)";
  for (const int kind : {0, 1}) {
    const DeckRun run = run_kind(bar, kind, GetParam());
    const std::vector<double> u = run.column("u", "displacement");
    EXPECT_NEAR(u.back(), kind == 0 ? 0.0 : 20e-6, 1e-11) << kind;
    if (kind == 0) {
      EXPECT_NEAR(*std::max_element(u.begin(), u.end()), 10e-6, 0.05e-6);
    }
    EXPECT_LT(run.result->figures.energy_imbalance.value(), GetParam()[0] == 'e' ? 1.0 : 1e-6) << kind;
  }
}

TEST(SymmetrySupport, holds_the_edge_of_two_planes_along_both) {
  const std::string text = R"(
local b = substructure{ name = "b", material = metal, mesh = mesh.box{ size = { 20*mm, 20*mm, 40*mm }, cells = { 2, 2, 4 } } }
local planes = p.kind == 0 and { b:face "xmin", b:face "ymin" } or b:face{ where = function(x, y) return x < 1*um or y < 1*um end }
local held = { support.symmetry{ name = "bottom", on = b:face "zmin" }, support.symmetry{ name = "planes", on = planes } }
local edge = b:where(function(x, y, z) return near(x, 0) and near(y, 0) and near(z, 40*mm) end)
local pull = step.static{ name = "pull", loads = { load.traction{ on = b:face "xmax", y = 10*MPa }, load.traction{ on = b:face "ymax", y = 50*MPa } } }
problem{ name = "p", substructures = { b }, supports = held, steps = { pull },
  outputs = { output.history{ name = "edge", on = edge, quantity = "displacement" }, output.history{ name = "u", on = b:face "ymax", quantity = "displacement" } } }:run{}
)";
  const DeckRun list = run_kind(text, 0), one = run_kind(text, 1);
  for (const char* axis : {"x", "y"}) EXPECT_NEAR(one.column("edge", axis).back(), 0.0, 1e-15) << axis;
  EXPECT_NEAR(one.column("u", "y").back(), list.column("u", "y").back(), 1e-12);
}

// Gravity of a static step that a dynamic one takes away, value 0 (kind 0) or left out (kind 1), or keeps (kind 2).
TEST(Gravity, of_cells_of_order_two_goes_as_it_is_told) {
  const std::string text = R"(
local soft = material.elastic{ name = "soft", young = 10*GPa, poisson = 0.3, density = 8000, damping = 5e-6 }
local b = substructure{ name = "b", material = soft, integration = "explicit", mesh = mesh.box{ size = { 20*mm, 20*mm, 20*mm }, cells = { 2, 2, 2 }, order = 2, cell = "tet10" } }
local base = support.fixed{ name = "base", on = b:face "zmin" }
local weight = step.static{ name = "weight", loads = { load.gravity{ z = -1e5 } } }
local go = step.dynamic{ name = "go", after = weight, duration = 1*ms, dt = 2*us, supports = p.kind < 2 and {} or nil,
  loads = ({ [0] = { load.gravity{ z = 0 } }, {}, { load.gravity{ z = -1e5 } } })[p.kind] }
problem{ name = "p", substructures = { b }, supports = { base }, steps = { weight, go }, outputs = { output.energy{} } }:run{}
)";
  for (const int kind : {0, 1, 2}) {
    const DeckRun run = run_kind(text, kind);
    const std::vector<double>&strain = run.column("energy", "strain"), &loads = run.column("energy", "loads");
    const double stored = strain.at(1);
    EXPECT_GT(stored, 1e-4);
    EXPECT_NEAR(strain.back(), kind == 2 ? stored : 0.0, 1e-6 * stored) << kind;
    EXPECT_NEAR(loads.back(), loads.at(1), 1e-6 * stored) << kind;
  }
}

// The force on one of two faces was half of the load.
TEST(Force, on_fewer_faces_than_before_goes_on_from_what_they_had) {
  const DeckRun run = run_kind(R"(
local b = substructure{ name = "b", material = metal, mesh = mesh.box{ size = { 10*mm, 10*mm, 50*mm }, cells = { 1, 1, 5 } } }
local base = support.fixed{ name = "base", on = b:face "zmin" }
local one = step.static{ name = "one", loads = { load.force{ on = { b:face "xmin", b:face "xmax" }, z = 1000 } } }
local two = step.static{ name = "two", after = one, increments = 4, loads = { load.force{ on = b:face "xmax", z = 1000 } } }
problem{ name = "p", substructures = { b }, supports = { base }, steps = { one, two }, outputs = { output.resultant{ name = "r", on = base } } }:run{}
)",
                               0);
  for (const double z : run.column("r", "z")) EXPECT_NEAR(z, -1000.0, 1e-5);
}

TEST(Supports, that_share_nodes_are_shaken_alike_or_not_at_all) {
  const std::string text = R"(
local b = substructure{ name = "b", material = metal, mesh = mesh.box{ size = { 30*mm, 20*mm, 40*mm }, cells = { 3, 2, 4 } } }
local fix = support.fixed{ name = "fix", on = b:face "zmin" }
local plane = support.symmetry{ name = "plane", on = b:face "xmin" }
local shake = load.base_acceleration{ on = p.kind == 0 and fix or p.kind == 3 and plane or { fix, plane }, direction = p.kind == 3 and { 0, 0, 1 } or { 1, 0, 0 },
  history = history.half_sine{ peak = 1000, duration = 0.2*ms } }
local shock = step.dynamic{ name = "shock", duration = 20*us, dt = 1*us, loads = { shake } }
problem{ name = "p", substructures = { b }, supports = p.kind == 1 and { plane, fix } or { fix, plane }, steps = { shock }, outputs = { output.energy{} } }:run{}
)";
  EXPECT_NE(error_of(text, 0).find("prescribes two different motions"), std::string::npos);
  EXPECT_NE(error_of(text, 0).find("supports 'fix' and 'plane'"), std::string::npos);
  EXPECT_EQ(error_of(text, 1), "");
  EXPECT_EQ(error_of(text, 2), "");
  EXPECT_NE(error_of(text, 3).find("where it holds nothing"), std::string::npos);
}

// A half model shaken along its plane of symmetry, turned about the direction of the shock: normals are known to
// rounding.
TEST(Supports, shaken_along_an_oblique_plane_of_symmetry_are_as_along_one_on_an_axis) {
  const std::string text = R"(
local turn = { rotate = { axis = { 0, 0, 1 }, angle = ({ 0, 17, 73 })[p.kind + 1]*deg } }
local b = substructure{ name = "b", material = metal, mesh = mesh.box{ size = { 20*mm, 20*mm, 40*mm }, cells = { 2, 2, 4 } }, place = turn }
local root = support.fixed{ name = "root", on = b:face "zmin" }
local plane = support.symmetry{ name = "plane", on = b:face "ymin" }
local shock = step.dynamic{ name = "shock", duration = 40*us, dt = 2*us, loads = { load.base_acceleration{ on = root, direction = { 0, 0, 1 }, history = 1000 } } }
local top = output.history{ name = "top", on = b:face "zmax", quantity = "velocity" }
problem{ name = "p", substructures = { b }, supports = { root, plane }, steps = { shock }, outputs = { top }, solver = solver.latin{ tolerance = 1e-9 } }:run{}
)";
  const DeckRun straight = run_kind(text, 0);
  for (const int turned : {1, 2})
    EXPECT_LT(difference(straight.column("top", "z"), run_kind(text, turned).column("top", "z")), 1e-6) << turned;
}

TEST(Release, at_the_end_of_a_step_has_let_go_in_the_next) {
  const DeckRun run = run_kind(R"(
local function block(name, z) return substructure{ name = name, material = metal, mesh = mesh.box{ origin = { 0, 0, z }, size = { 10*mm, 10*mm, 20*mm }, cells = { 1, 1, 4 } } } end
local a, b = block("a", 0), block("b", 20*mm)
local weld = interface.bonded{ name = "weld", between = { a:face "zmax", b:face "zmin" } }
local ends = support.fixed{ name = "ends", on = { a:face "zmin", b:face "zmax" } }
local pull = load.force{ on = a:where(function(x, y, z) return near(z, 10*mm) end), z = 1000 }
local one = step.static{ name = "one", loads = { pull } }
local two = step.dynamic{ name = "two", after = one, duration = 10*us, dt = 1*us, loads = { pull, load.release{ on = weld, at = 10*us } } }
local three = step.dynamic{ name = "three", after = two, duration = 20*us, dt = 1*us, loads = { pull } }
problem{ name = "p", substructures = { a, b }, interfaces = { weld }, supports = { ends }, steps = { one, two, three },
  outputs = { output.resultant{ name = "r", on = weld } } }:run{}
)",
                               0);
  const std::vector<double>& z = run.column("r", "z");
  EXPECT_NEAR(z.at(10), -250.0, 1e-3);
  EXPECT_EQ(z.back(), 0.0);
}

// A block in a pocket with a corner, one interface: pressed along x, then along y as well. The pocket of tetrahedra,
// and of hexahedra whose nodes are those of the block.
constexpr const char* pockets[] = {R"(
L = 0.01;
Point(1) = {-L, -L, 0}; Point(2) = {L, -L, 0}; Point(3) = {L, 0, 0}; Point(4) = {0, 0, 0}; Point(5) = {0, L, 0}; Point(6) = {-L, L, 0};
For i In {1:6}
  Line(i) = {i, (i % 6) + 1};
EndFor
Curve Loop(1) = {1:6};
Plane Surface(1) = {1};
out[] = Extrude {0, 0, L} { Surface{1}; };
Physical Volume("pocket") = {out[1]};
Mesh.MeshSizeMax = 0.005;
)",
                                   R"(
L = 0.01;
For i In {0:2}
  For j In {0:2}
    Point(1 + 3 * i + j) = {(i - 1) * L, (j - 1) * L, 0};
  EndFor
EndFor
Line(1) = {1, 4}; Line(2) = {4, 5}; Line(3) = {5, 2}; Line(4) = {2, 1};
Line(5) = {4, 7}; Line(6) = {7, 8}; Line(7) = {8, 5};
Line(8) = {5, 6}; Line(9) = {6, 3}; Line(10) = {3, 2};
Curve Loop(1) = {1, 2, 3, 4}; Curve Loop(2) = {5, 6, 7, -2}; Curve Loop(3) = {-3, 8, 9, 10};
Plane Surface(1) = {1}; Plane Surface(2) = {2}; Plane Surface(3) = {3};
Transfinite Curve{1:10} = 4; Transfinite Surface{1:3}; Recombine Surface{1:3};
out[] = Extrude {0, 0, L} { Surface{1:3}; Layers{3}; Recombine; };
Physical Volume("pocket") = Volume{:};
)"};

class Pocket : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Meshes, Pocket, testing::ValuesIn(pockets));

TEST_P(Pocket, pushes_along_the_normal_of_each_face) {
  const std::filesystem::path geo =
      std::filesystem::temp_directory_path() / ("dygita_test_pocket_" + std::to_string(getpid()) + ".geo");
  std::ofstream(geo) << GetParam();
  const std::string text = "local file = mesh.gmsh{ file = \"" + geo.string() + R"(" }
local block = substructure{ name = "block", material = metal, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 3, 3, 3 } } }
local pocket = substructure{ name = "pocket", material = metal, mesh = file:volume "pocket" }
local touch = interface.contact{ name = "touch", between = { block, pocket }, friction = 0 }
local base = support.fixed{ name = "base", on = { pocket:face{ normal = { -1, 0, 0 }, at = 10*mm }, pocket:face{ normal = { 0, -1, 0 }, at = 10*mm } } }
local flat = support.symmetry{ name = "flat", on = block:face "zmin" }
local loads = { load.pressure{ on = block:face "xmax", history = 1*MPa } }
if p.kind == 1 then loads[2] = load.pressure{ on = block:face "ymax", history = 2*MPa } end
problem{ name = "p", substructures = { block, pocket }, interfaces = { touch }, supports = { base, flat },
  steps = { step.static{ name = "press", loads = loads } }, outputs = { output.resultant{ name = "r", on = touch }, output.footprint{ name = "f", on = touch } } }:run{}
)";
  const DeckRun one = run_kind(text, 0), two = run_kind(text, 1);
  EXPECT_NEAR(one.column("r", "normal").back(), -100.0, 1e-4);
  EXPECT_NEAR(one.column("r", "shear").back(), 0.0, 1e-4);
  EXPECT_NEAR(one.column("f", "area").back(), 1e-4, 4e-6);  // a point of the other face may just touch
  EXPECT_NEAR(two.column("r", "normal").back(), -300.0, 1e-3);
  EXPECT_NEAR(two.column("f", "area").back(), 2e-4, 1e-9);
  std::filesystem::remove(geo);
}

// Kind 0: a wall, 1: a plane of symmetry, each on one face around an edge; 2: a plane of symmetry on two faces.
TEST(Resultant, of_planes_that_meet_at_an_edge_has_no_shear) {
  const std::string text = R"(
local b = substructure{ name = "b", material = metal, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 2, 2, 2 } } }
local around = b:face{ where = function(x, y) return x < 1*um or y < 1*um end }
local held = p.kind == 0 and support.wall{ name = "held", on = around } or support.symmetry{ name = "held", on = p.kind == 1 and around or { b:face "xmin", b:face "ymin" } }
local flat = support.symmetry{ name = "flat", on = b:face "zmin" }
local press = step.static{ name = "press", loads = { load.pressure{ on = b:face "xmax", history = 1*MPa }, load.pressure{ on = b:face "ymax", history = 2*MPa } } }
problem{ name = "p", substructures = { b }, supports = { held, flat }, steps = { press }, outputs = { output.resultant{ name = "r", on = held } } }:run{}
)";
  for (const int kind : {0, 1, 2}) {
    const DeckRun run = run_kind(text, kind);
    EXPECT_NEAR(run.column("r", "normal").back(), -300.0, 1e-4) << kind;
    EXPECT_NEAR(run.column("r", "shear").back(), 0.0, 1e-4) << kind;
    EXPECT_NEAR(run.column("r", "y").back(), 200.0, 1e-4) << kind;
  }
}

// A bar one cell across in guides: every node carries a support, and its motion along the guides is free.
TEST(FreeMotion, is_pinned_at_a_node_with_supports_where_there_is_no_other) {
  const std::string bar = R"(
local b = substructure{ name = "b", material = metal, mesh = mesh.box{ size = { 5*mm, 5*mm, 100*mm }, cells = { 1, 1, 10 } } }
local guides = support.symmetry{ name = "guides", on = { b:face "xmin", b:face "xmax", b:face "ymin", b:face "ymax" } }
local pull = step.static{ name = "pull", loads = { load.force{ on = b:face "zmin", z = -1000 }, load.force{ on = b:face "zmax", z = 1000 } } }
local function moved(face) return output.history{ name = face, on = b:face(face), quantity = "displacement" } end
problem{ name = "p", substructures = { b }, supports = { guides }, steps = { pull }, outputs = { moved "zmin", moved "zmax" } }:run{}
)";
  for (const char* solver : {"latin{}", "monolithic{}"}) {
    const DeckRun run = run_kind(bar, 0, solver);
    EXPECT_NEAR(run.column("zmax", "z").back() - run.column("zmin", "z").back(), 20e-6, 1e-12) << solver;
  }
}

// Two glued blocks pulled by 19 um, then the glue lets go: what they had stored is lost, and booked.
TEST(Release, in_a_static_step_closes_the_balance_with_every_solver) {
  const std::string glued = R"(
local function block(name, z) return substructure{ name = name, material = metal, mesh = mesh.box{ origin = { 0, 0, z }, size = { 10*mm, 10*mm, 20*mm }, cells = { 2, 2, 4 } } } end
local low, high = block("low", 0), block("high", 20*mm)
local glue = interface.bonded{ name = "glue", between = { low:face "zmax", high:face "zmin" } }
local base = support.fixed{ name = "base", on = low:face "zmin" }
local pull = load.displacement{ on = high:face "zmax", x = 0, y = 0, z = 19*um }
local one = step.static{ name = "one", increments = 2, loads = { pull } }
local two = step.static{ name = "two", after = one, increments = 2, loads = { pull, load.release{ on = glue, at = 0.5 } } }
problem{ name = "p", substructures = { low, high }, interfaces = { glue }, supports = { base }, steps = { one, two }, outputs = { output.energy{} } }:run{}
)";
  for (const char* solver :
       {"latin{ static_steps = 'iterated' }", "latin{ static_steps = 'assembled' }", "monolithic{}"}) {
    const DeckRun run = run_kind(glued, 0, solver);
    EXPECT_NEAR(run.column("energy", "scheme").back(), 0.5 * 200e9 * 1e-4 / 40e-3 * 19e-6 * 19e-6, 1e-7) << solver;
    EXPECT_LT(run.figure("energy imbalance [%]"), 1e-4) << solver;
  }
}

// A cube that stands turned about z and is held and driven along its own axes: x and y by the frame, z free at its
// ends.
TEST(Frames, turn_what_is_held_and_driven) {
  const auto run = [](const std::string& angle) {
    return run_text("local site = frame{ angle = " + angle + R"( }
local m = material.elastic{ name = "m", young = 200*GPa, poisson = 0.3, density = 7800 }
local cube = substructure{ name = "cube", material = m, place = { rotate = { axis = { 0, 0, 1 }, angle = )" +
                    angle + R"( } },
  mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 2, 2, 2 } } }
local low = cube:face{ frame = site, normal = { -1, 0, 0 }, at = 0 }
local high = cube:face{ frame = site, normal = { 1, 0, 0 }, at = 10*mm }
local foot = support.held{ name = "foot", on = low, frame = site, x = true, y = true }
local under = support.held{ name = "under", on = cube:face{ normal = { 0, 0, -1 }, at = 0 }, frame = site, z = true }
local pull = step.static{ name = "pull", loads = { load.displacement{ on = high, frame = site, x = 10*um, y = 2*um } } }
local go = step.dynamic{ name = "go", after = pull, duration = 2*us, dt = 0.1*us, loads = { load.velocity{ on = high, frame = site, x = 3, y = -0.5 } } }
problem{ name = "cube", substructures = { cube }, supports = { foot, under }, steps = { pull, go },
  outputs = { output.resultant{ name = "r", on = foot }, output.history{ name = "u", on = high, quantity = "displacement" } } }:run{}
)")
        .at(0);
  };
  const DeckRun straight = run("0"), turned = run("30*deg");
  const double c = std::cos(M_PI / 6), s = std::sin(M_PI / 6);
  for (const char* name : {"r", "u"}) {
    const auto &x = straight.column(name, "x"), &y = straight.column(name, "y"), &z = straight.column(name, "z");
    for (size_t i = 0; i < x.size(); ++i) {
      const double size = 1e-6 * std::max(std::abs(x.back()), std::abs(x[i]));
      EXPECT_NEAR(turned.column(name, "x")[i], c * x[i] - s * y[i], size) << name << i;
      EXPECT_NEAR(turned.column(name, "y")[i], s * x[i] + c * y[i], size) << name << i;
      EXPECT_NEAR(turned.column(name, "z")[i], z[i], size) << name << i;
    }
  }
  EXPECT_NEAR(straight.column("u", "x").back(), 10e-6 + 3 * 2e-6, 1e-9);
  EXPECT_NEAR(straight.column("u", "y").back(), 2e-6 - 0.5 * 2e-6, 1e-9);
}

// A bolt through a sleeve: tightened, once more by the same force, and loosened.
// Lists that loops fill may be empty.
TEST(Lists, of_interfaces_may_have_empty_ones_in_them) {
  const std::string deck = R"(local m = material.elastic{ name = "m", young = 200*GPa, poisson = 0.3, density = 7800 }
local cube = substructure{ name = "cube", material = m, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } } }
local base = support.fixed{ name = "base", on = cube:face "zmin" }
problem{ name = "one", substructures = { {}, cube, { {} } }, interfaces = { {} }, supports = { {}, base },
  steps = { step.static{ name = "pull", loads = { {}, load.pressure{ on = cube:face "zmax", history = 1*MPa } } } },
  outputs = { {}, output.resultant{ name = "r", on = base } } }:run{}
)";
  EXPECT_NEAR(run_text(deck).at(0).column("r", "z").back(), 100.0, 1e-6);
}

// A thrown block and a mass on it: their velocities are along the axes of the frame that they are placed in.
TEST(Frames, turn_velocities_at_the_start) {
  const DeckRun run = run_text(R"(local site = frame{ axis = { 0, 0, 1 }, angle = 90*deg, origin = { 5*mm, 0, 0 } }
local m = material.elastic{ name = "m", young = 200*GPa, poisson = 0.3, density = 7800 }
local cube = substructure{ name = "cube", material = m, frame = site, velocity = { 3, 0, 1 },
  mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } } }
local box = mass.point{ name = "box", on = cube:face "zmax", mass = 0.01, frame = site, at = { 5*mm, 5*mm, 12*mm },
  velocity = { 3, 0, 1 } }
problem{ name = "thrown", substructures = { cube, box }, steps = { step.dynamic{ name = "fly", duration = 1*us, dt = 0.1*us } },
  outputs = { output.momentum{ name = "p", of = { cube, box } } } }:run{}
)")
                          .at(0);
  const double mass = 7800 * 1e-6 + 0.01;
  EXPECT_NEAR(run.column("p", "x").back(), 0.0, 1e-9);
  EXPECT_NEAR(run.column("p", "y").back(), 3.0 * mass, 1e-9);
  EXPECT_NEAR(run.column("p", "z").back(), mass, 1e-9);
}

TEST(Preload, of_nothing_loosens_once_and_of_the_same_force_raises_no_alarm) {
  const std::string bolted = R"(
local function block(name, x, z, w, h, n) return substructure{ name = name, material = metal, mesh = mesh.box{ origin = { x*mm, 0, z*mm }, size = { w*mm, 10*mm, h*mm }, cells = { n, 1, 3 } } } end
local foot, rod, left, right, head = block("foot", -10, -20, 30, 20, 3), block("rod", 0, 0, 10, 30, 1), block("left", -10, 0, 10, 30, 1), block("right", 10, 0, 10, 30, 1), block("head", -10, 30, 30, 20, 3)
local function glued(name, low, high) return interface.bonded{ name = name, between = { low:face "zmax", high:face "zmin" } } end
local shank = glued("shank", rod, head)
local function seat(name, low) return interface.contact{ name = name, between = { low:face "zmax", head:face "zmin" }, friction = 0.2 } end
local base = support.fixed{ name = "base", on = foot:face "zmin" }
local steps = {}
for i, force in ipairs{ 5000, 5000, 0, 0, 5000 } do
  steps[i] = step.static{ name = "pass" .. i, after = steps[i - 1], increments = 2, loads = { load.preload{ on = shank, force = force } } }
end
problem{ name = "p", substructures = { foot, rod, left, right, head }, supports = { base }, steps = steps,
  interfaces = { glued("thread", foot, rod), shank, glued("feet", foot, left), glued("feet2", foot, right), seat("seat", left), seat("seat2", right) },
  outputs = { output.joint{ name = "shank", on = shank } } }:run{}
)";
  for (const char* solver : {"latin{}", "monolithic{}"}) {
    const DeckRun run = run_kind(bolted, 0, solver);
    const std::vector<double>& force = run.column("shank", "normal");
    EXPECT_NEAR(force.at(1), 5000.0, 1e-2) << solver;
    EXPECT_NEAR(force.at(3), 5000.0, 1e-2) << solver;
    EXPECT_NEAR(force.at(5), 0.0, 1e-2) << solver;
    EXPECT_NEAR(force.at(7), 0.0, 1e-2) << solver;
    EXPECT_NEAR(force.back(), 5000.0, 1e-2) << solver;
    EXPECT_LE(run.result->steps.at(3).iterations, 40) << solver;  // loose already: nothing to find
    EXPECT_LT(run.result->figures.static_iteration_error.value(), 0.1) << solver;
  }
}

// Kind 0: bonded, 1: plastic; 2: what lies on a wall that the next step leaves out.
TEST(Joint, opens_and_slides_on_when_it_has_let_go) {
  const std::string text = R"(
local a = substructure{ name = "a", material = metal, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } } }
local b = substructure{ name = "b", material = metal, mesh = mesh.box{ origin = { 0, 0, 10*mm }, size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } } }
local between = { a:face "zmax", b:face "zmin" }
local weld = p.kind == 1 and interface.plastic{ name = "weld", between = between, yield = 500*MPa } or interface.bonded{ name = "weld", between = between }
local wall = support.wall{ name = "wall", on = b:face "zmax" }
local base = support.fixed{ name = "base", on = a:face "zmin" }
local pull = load.force{ on = b:face "zmax", z = 80 }
local hold = step.static{ name = "hold", loads = { pull } }
local fly = step.dynamic{ name = "fly", after = hold, duration = 100*us, dt = 1*us, supports = { base }, loads = { pull, load.release{ on = weld, at = 0 } } }
local function z(name, on) return output.history{ name = name, on = on, quantity = "displacement", direction = { 0, 0, 1 } } end
problem{ name = "p", substructures = { a, b }, interfaces = { weld }, supports = p.kind == 2 and { base, wall } or { base }, steps = { hold, fly },
  outputs = { output.joint{ name = "joint", on = p.kind == 2 and wall or weld }, z("top", b:face "zmin"), z("roof", b:face "zmax"), z("low", a:face "zmax") } }:run{}
)";
  for (const int kind : {0, 1, 2}) {
    const DeckRun run = run_kind(text, kind);
    const auto last = [&](const char* name) {
      const std::vector<double>& u = run.column(name, "displacement");
      return 0.5 * (u.back() + u.end()[-2]);  // joints tell means over a time step
    };
    const double opening = kind == 2 ? -last("roof") : last("top") - last("low");
    EXPECT_GT(std::abs(opening), 40e-6) << kind;
    EXPECT_NEAR(run.column("joint", "opening").back(), opening, 1e-3 * std::abs(opening)) << kind;
    EXPECT_NEAR(run.column("joint", "slip").back(), 0.0, 1e-9) << kind;
  }
}

TEST(Facets, are_in_one_interface_or_wall_alone_and_once_in_a_list) {
  const std::string text = R"(
local function plate(name, z, n) return substructure{ name = name, material = metal, mesh = mesh.box{ origin = { 0, 0, z }, size = { 20*mm, 20*mm, 10*mm }, cells = { n, n, 1 } } } end
local a, b = plate("a", 0, 4), plate("b", 10*mm, 5)
local weld = interface.bonded{ name = "weld", between = { a:face "zmax", b:face "zmin" } }
local supports = { support.fixed{ name = "base", on = a:face "zmin" } }
if p.kind == 1 then supports[2] = support.wall{ name = "wall", on = a:face "zmax" } end
local half = b:face{ normal = { 0, 0, 1 }, where = function(x) return x < 9*mm end }
local pull = step.static{ name = "pull", loads = { load.pressure{ on = p.kind == 2 and { b:face "zmax", half } or b:face "zmax", history = -1e5 } } }
local u = output.history{ name = "u", on = p.kind == 3 and { b:face "zmax", half } or b:face "zmax", quantity = "displacement" }
problem{ name = "p", substructures = { a, b }, interfaces = { weld }, supports = supports, steps = { pull }, outputs = { u } }:run{}
)";
  EXPECT_EQ(error_of(text, 0), "");
  EXPECT_NE(error_of(text, 1).find("share facets of substructure 'a'"), std::string::npos);
  EXPECT_NE(error_of(text, 2).find("it would act there twice"), std::string::npos);
  EXPECT_NE(error_of(text, 3).find("would count twice in the mean"), std::string::npos);
}

TEST(Mean, of_a_watched_column_is_over_the_time_of_motion) {
  const DeckRun run = run_kind(R"(
local b = substructure{ name = "b", material = metal, mesh = mesh.box{ size = { 10*mm, 10*mm, 20*mm }, cells = { 1, 1, 2 } } }
local base = support.fixed{ name = "base", on = b:face "zmin" }
local function pull(z) return { load.force{ on = b:face "zmax", z = z } } end
local one = step.static{ name = "one", increments = 3, loads = pull(200) }
local two = step.dynamic{ name = "two", after = one, duration = 8*us, dt = 1*us, loads = pull(200) }
problem{ name = "p", substructures = { b }, supports = { base }, steps = { one, two }, outputs = { output.resultant{ name = "r", on = base } } }:run{}
)",
                               0);
  EXPECT_NEAR(WatchedName(run.problem, "r.z.mean", "--output").of(*run.result)->values.at(0), -200.0, 1e-6);
}

// A block in flight at 1 m/s for 10 us, in five time steps: 5 um in the mean, its ends counted for half.
TEST(Mean, of_a_watched_column_counts_the_ends_of_the_motion_for_half) {
  const DeckRun run = run_kind(R"(
local b = substructure{ name = "b", material = metal, mesh = mesh.box{ size = { 10*mm, 10*mm, 20*mm }, cells = { 1, 1, 2 } }, velocity = { 0, 0, 1 } }
local fly, on = step.dynamic{ name = "fly", duration = 6*us, dt = 2*us }, nil
on = step.dynamic{ name = "on", after = fly, duration = 4*us, dt = 2*us }
problem{ name = "p", substructures = { b }, steps = { fly, on }, outputs = { output.history{ name = "u", on = b:face "zmax", quantity = "displacement", direction = { 0, 0, 1 } } } }:run{}
)",
                               0);
  EXPECT_NEAR(WatchedName(run.problem, "u.displacement.mean", "--output").of(*run.result)->values.at(0), 5e-6, 1e-12);
}

// 0.1 mm of flight towards a wall 0.05 mm away that only the second step has.
TEST(Wall, that_appears_where_a_part_is_says_so) {
  const auto warned = [](const std::string& of_flight) {
    const DeckRun run = run_kind(R"(
local b = substructure{ name = "b", material = metal, velocity = { 0, 0, -1 }, mesh = mesh.box{ size = { 20*mm, 20*mm, 20*mm }, cells = { 2, 2, 2 } } }
local wall = support.wall{ name = "wall", on = b:face "zmin", gap = 0.05*mm }
local fly = step.dynamic{ name = "fly", duration = 100*us, dt = 2*us, supports = { )" +
                                     of_flight +
                                     R"( } }
local hit = step.dynamic{ name = "hit", after = fly, duration = 4*us, dt = 2*us, supports = { wall } }
problem{ name = "p", substructures = { b }, supports = { wall }, steps = { fly, hit }, outputs = { output.energy{} } }:run{}
)",
                                 0);
    for (const std::string& warning : run.result->warnings)
      if (warning.find("'wall' appears where 'b' already is, up to 0.05 mm behind it") != std::string::npos)
        return true;
    return false;
  };
  EXPECT_TRUE(warned(""));
  EXPECT_FALSE(warned("wall"));
}

TEST(History, is_a_mean_over_faces_or_over_regions) {
  const std::string text = R"(
local b = substructure{ name = "b", material = metal, mesh = mesh.box{ size = { 10*mm, 10*mm, 20*mm }, cells = { 1, 1, 2 } } }
local base = support.fixed{ name = "base", on = b:face "zmin" }
local pull = step.static{ name = "pull", loads = { load.force{ on = b:face "zmax", z = 1000 } } }
problem{ name = "p", substructures = { b }, supports = { base }, steps = { pull },
  outputs = { output.history{ name = "u", on = { b:face "zmax", b:where(function() return true end) }, quantity = "displacement" } } }:run{}
)";
  EXPECT_NE(error_of(text).find("not over both"), std::string::npos);
}

// A bar without load after it was loaded: both its strain energy and its stress error are rounding.
TEST(StaticEstimates, are_not_those_of_nothing) {
  const DeckRun run = run_kind(R"(
local b = substructure{ name = "b", material = metal, mesh = mesh.box{ size = { 10*mm, 10*mm, 50*mm }, cells = { 1, 1, 5 } } }
local base = support.fixed{ name = "base", on = b:face "zmin" }
local function pull(z) return { load.force{ on = b:face "zmax", z = z } } end
local one = step.static{ name = "one", loads = pull(8000) }
local two = step.static{ name = "two", after = one, loads = pull(4000) }
local three = step.static{ name = "three", after = two, loads = pull(0) }
problem{ name = "p", substructures = { b }, supports = { base }, steps = { one, two, three }, outputs = { output.energy{} } }:run{}
)",
                               0);
  EXPECT_LT(run.result->figures.static_mesh_error.value(), 1e-3);
}

// A block taken off another one and turned aside: a millimetre of its motion, and of strain what the iteration leaves.
TEST(StaticEstimates, are_not_those_of_parts_that_are_carried) {
  const DeckRun run = run_kind(R"(
local a = substructure{ name = "a", material = metal, mesh = mesh.box{ size = { 20*mm, 20*mm, 20*mm }, cells = { 4, 4, 4 } } }
local b = substructure{ name = "b", material = metal, mesh = mesh.box{ origin = { 0, 0, 20*mm }, size = { 20*mm, 20*mm, 20*mm }, cells = { 4, 4, 4 } } }
local seat = interface.contact{ name = "seat", between = { a:face "zmax", b:face "zmin" }, friction = 0.2 }
local base = support.fixed{ name = "base", on = a:face "zmin" }
local lift = step.static{ name = "lift", increments = 2, loads = { load.displacement{ on = b:face "zmax", x = 0, y = 0, z = 1*mm } } }
local aside = step.static{ name = "aside", after = lift, increments = 2, loads = { load.displacement{ on = b:face "zmax", x = 0.3*mm, y = 0, z = 1*mm } } }
problem{ name = "p", substructures = { a, b }, interfaces = { seat }, supports = { base }, steps = { lift, aside }, outputs = { output.energy{} } }:run{}
)",
                               0);
  const Figures& figures = run.result->figures;
  EXPECT_LT(figures.largest_energy.value(), 1e-10);
  EXPECT_EQ(figures.energy_imbalance.value(), 0.0);
  EXPECT_EQ(figures.energy_gain.value(), 0.0);
  EXPECT_EQ(figures.static_iteration_error.value(), 0.0);
}

// A block pressed by 100 N and dragged along y by the nodes of its own foot, friction 0.2, so that 20 N act. Kind 0: on
// a wall; 1: on a plate of the same mesh; 2, 3: of a coarser and of a finer one, held throughout; +10: in a dynamic
// step.
const std::string driven = R"(
local on, is_dynamic = p.kind % 10, p.kind >= 10
local block = substructure{ name = "block", material = metal, mesh = mesh.box{ size = { 1*mm, 1*mm, 1*mm }, cells = { 2, 2, 2 } } }
local foot, top = block:face "zmin", block:face "zmax"
local bodies, joints, supports, seat = { block }, {}, {}, nil
if on == 0 then
  seat = support.wall{ name = "seat", on = foot, friction = 0.2 }
  supports = { seat }
else
  local n = ({ 2, 1, 5 })[on]
  local plate = substructure{ name = "plate", material = metal, mesh = on == 1
    and mesh.box{ size = { 1*mm, 1*mm, 1*mm }, cells = { 2, 2, 1 }, origin = { 0, 0, -1*mm } }
    or mesh.box{ size = { 3*mm, 3*mm, 1*mm }, cells = { n, n, 1 }, origin = { -1*mm, -1*mm, -1*mm } } }
  seat = interface.contact{ name = "seat", between = { foot, plate:face "zmax" }, friction = 0.2 }
  bodies, joints = { block, plate }, { seat }
  supports = { support.fixed{ name = "ground", on = plate:where(function() return true end) } }
end
local push = load.pressure{ on = top, history = 100*MPa }
local press = step.static{ name = "press", increments = 2, loads = { push, load.displacement{ on = top, x = 0, y = 0 } } }
local drag = is_dynamic
  and step.dynamic{ name = "drag", after = press, duration = 20*us, dt = 0.05*us, loads = { push, load.displacement{ on = foot, x = 0, y = history.ramp{ to = 20*um, duration = 20*us } } } }
  or step.static{ name = "drag", after = press, increments = 4, loads = { push, load.displacement{ on = foot, x = 0, y = 20*um } } }
local hold = step.static{ name = "hold", after = drag, loads = { push, load.displacement{ on = foot, x = 0, y = 20*um } } }
local outputs = { output.resultant{ name = "seat", on = seat }, output.joint{ name = "joint", on = seat }, output.energy{} }
if on > 0 then outputs[#outputs + 1] = output.resultant{ name = "ground", on = supports[1] } end
problem{ name = "driven", substructures = bodies, interfaces = joints, supports = supports, steps = is_dynamic and { press, drag } or { press, drag, hold }, outputs = outputs }:run{}
)";

class Driven : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Solvers, Driven, testing::Values("latin{}", "monolithic{}", "explicit{}"));

TEST_P(Driven, side_of_a_contact_rubs_on_what_is_held) {
  for (const int kind : {0, 1, 2, 3, 10, 11, 12, 13}) {
    const DeckRun run = run_kind(driven, kind, GetParam());
    const bool is_dynamic = kind >= 10, has_springs = is_dynamic && GetParam() == std::string("explicit{}");
    EXPECT_TRUE(run.result->converged) << kind;
    const std::vector<double>&normal = run.column("seat", "normal"), &shear = run.column("seat", "y");
    // Steps that press, and where the springs of the explicit code give way before they slide.
    const size_t first = has_springs ? 100 : is_dynamic ? 4 : 3;
    for (size_t i = first; i < shear.size(); ++i)
      EXPECT_NEAR(std::abs(shear[i]), 0.2 * std::abs(normal[i]), 1e-6 * 20.0) << kind << " " << i;
    EXPECT_NEAR(normal.back(), -100.0, 1e-3) << kind;
    EXPECT_NEAR(std::abs(shear.back()), 20.0, 1e-3) << kind;  // statics: held where it is, it keeps what it has
    EXPECT_NEAR(run.column("joint", "slip").back(), 20e-6, (has_springs ? 0.15 : 0.005) * 20e-6) << kind;
    // The force of a static increment grows along it, from nothing in the first of four.
    const double work = 20.0 * 20e-6 * (is_dynamic ? 1.0 : 3.5 / 4.0);
    EXPECT_NEAR(run.column("joint", "friction_work").back(), work, (has_springs ? 0.15 : 0.005) * work) << kind;
    EXPECT_LT(run.figure("energy imbalance [%]"), has_springs ? 0.05 : 1e-6) << kind;
    if (kind % 10 == 0) continue;
    const std::vector<double>& ground = run.column("ground", "y");
    for (size_t i = first; i < shear.size(); ++i)
      EXPECT_NEAR(std::abs(ground[i]), std::abs(shear[i]), 1e-6 * 20.0) << kind << " " << i;
  }
}

// A post without friction between a plate and a bar that a bolt pulls down beside it: it may slide, and turn about
// itself. One cell high, it has no node that is not at a contact.
const std::string post = R"(
local axes = { { 0, 0, 1 }, { 1, 0, 0 }, { -0.845156, -0.572766, -0.393743 }, { 1, 1, 0 }, { 0.2, -0.9, 0.4 }, { -0.3, 0.1, 0.95 }, { 0.1, 0.2, 0.3 } }
local turned = { rotate = { axis = axes[p.kind + 1], angle = 2.401282 * p.kind / 3, about = { 0, 0, 0 } } }
local function box(name, young, poisson, size, cells, x, z, cell)
  return substructure{ name = name, material = material.elastic{ name = name, young = young*GPa, poisson = poisson, density = 2700 },
    mesh = mesh.box{ size = { size[1]*mm, size[2]*mm, size[3]*mm }, cells = cells, origin = { x*mm, 0, z*mm }, cell = cell }, place = turned }
end
local plate = box("plate", 167.25, 0, { 36, 4, 4 }, { 3, 4, 1 }, 0, 0, "hex8")
local bar = box("bar", 167.25, 0, { 36, 4, 6 }, { 4, 3, 2 }, 0, 12, "hex8")
local post = box("post", 69.2, 0, { 4, 4, 8 }, { 4, 1, 1 }, 0, 4, "prism6")
local shank = box("shank", 25.34, 0.3, { 4, 4, 8 }, { 1, 2, 1 }, 8, 4, "hex8")
local foot = interface.contact{ name = "foot", between = { plate:face "zmax", post:face "zmin" } }
local head = interface.contact{ name = "head", between = { post:face "zmax", bar:face "zmin" }, gap = 1*um }
local low = interface.bonded{ name = "low", between = { plate:face "zmax", shank:face "zmin" } }
local nut = interface.plastic{ name = "nut", between = { shank:face "zmax", bar:face "zmin" }, yield = 299*MPa, hardening = 1e12 }
local base = support.fixed{ name = "base", on = plate:face "zmin" }
local tighten = step.static{ name = "tighten", increments = 2, loads = { load.shortening{ on = nut, by = 25.2575*um } } }
problem{ name = "post", substructures = { plate, bar, post, shank }, interfaces = { foot, head, low, nut }, supports = { base }, steps = { tighten },
  outputs = { output.resultant{ name = "foot", on = foot }, output.resultant{ name = "head", on = head }, output.resultant{ name = "base", on = base } } }:run{}
)";

TEST(FreeMotion, carries_nothing_however_it_is_turned) {
  const double right = run_kind(post, 0, "latin{ static_tolerance = 1e-10 }").column("foot", "normal").back();
  EXPECT_NEAR(right, -46.1, 0.1);
  for (int kind = 0; kind < 7; ++kind)
    for (const char* solver : {"latin{ static_tolerance = 1e-10 }", "monolithic{}"}) {
      const DeckRun run = run_kind(post, kind, solver);
      EXPECT_TRUE(run.result->converged) << kind << solver;
      for (const char* joint : {"foot", "head"}) {
        EXPECT_NEAR(run.column(joint, "normal").back(), right, 1e-5 * 46.1) << kind << solver;
        EXPECT_LT(run.column(joint, "shear").back(), 1e-6 * 46.1) << kind << solver;  // there is no friction
      }
      for (const char* axis : {"x", "y", "z"}) {
        EXPECT_NEAR(run.column("foot", axis).back(), run.column("head", axis).back(), 1e-5 * 46.1) << kind << solver;
        EXPECT_NEAR(run.column("base", axis).back(), 0.0, 1e-5 * 46.1) << kind << solver;
      }
    }
}

// Who holds the nodes that a load is to move, and where they are.
TEST(Motion, of_nodes_that_are_held_names_what_holds_them) {
  const std::string message = error_of(R"(
local bar = substructure{ name = "bar", material = metal, place = { 0, 5*mm, 0 }, mesh = mesh.box{ size = { 20*mm, 10*mm, 10*mm }, cells = { 2, 1, 1 } } }
problem{ name = "p", substructures = { bar }, supports = { support.fixed{ name = "wall", on = bar:face "xmin" } },
  steps = { step.static{ name = "pull", loads = { load.displacement{ on = bar:face "ymin", x = 1*um } } } } }:run{}
)");
  EXPECT_NE(message.find("load.displacement moves a node of substructure 'bar' at (0, 5, "), std::string::npos)
      << message;
  EXPECT_NE(message.find(") mm along (1, 0, 0), which support 'wall' already holds in that direction\n"),
            std::string::npos)
      << message;
}

// Kind 0: a bond between unlike meshes whose lower nodes are held on one side and driven on the other; 1: the same at
// nodes that both have, in a static step; 2: both sides stand on one support, which is shaken.
const std::string torn = R"(
local foot = substructure{ name = "foot", material = metal, mesh = mesh.box{ size = { 8*mm, 6*mm, 6*mm }, cells = { 1, 1, 1 } } }
local arm = substructure{ name = "arm", material = metal, mesh = mesh.box{ origin = { 8*mm, 0, 0 }, size = { 6*mm, 6*mm, (p.kind == 0 and 4 or 6)*mm }, cells = { 1, 1, 1 } } }
local between = { foot:face "xmax", arm:face "xmin" }
local glue = p.kind == 3 and interface.iwan{ name = "glue", between = between, slip = 1*MPa, stiffness = 1e13, chi = -0.5, beta = 0.1 } or interface.bonded{ name = "glue", between = between }
local base = support.fixed{ name = "base", on = { foot:face "zmin", p.kind == 2 and arm:face "zmin" or nil } }
local drive = load.velocity{ on = arm:face "xmin", x = -0.2 }
local steps = ({ [0] = function() return step.dynamic{ name = "shock", duration = 10*us, dt = 1*us, loads = { drive } } end,
  function() return step.static{ name = "lift", loads = { load.displacement{ on = arm:face "zmin", z = 10*um } } } end,
  function() return step.dynamic{ name = "shock", duration = 10*us, dt = 1*us, loads = { load.base_acceleration{ on = base, direction = { 1, 0, 0 }, history = 1e4 } } } end,
  function() return step.dynamic{ name = "shock", duration = 10*us, dt = 1*us, loads = { drive } } end,
  function() return step.dynamic{ name = "shock", duration = 10*us, dt = 1*us, loads = { drive, load.release{ on = glue, at = 5*us } } } end,
  function() return step.dynamic{ name = "shock", duration = 10*us, dt = 1*us, loads = { drive, load.release{ on = glue, at = 0 } } } end })[p.kind]()
problem{ name = "torn", substructures = { foot, arm }, interfaces = { glue }, supports = { base }, steps = { steps }, outputs = { output.joint{ name = "bond", on = glue } } }:run{}
)";

TEST(TornBond, is_refused_where_supports_and_loads_move_its_sides_apart) {
  EXPECT_NE(error_of(torn, 0).find("step 'shock': 'glue' joins its sides, but they are moved apart along (1, 0, 0) at "
                                   "(8, 0, 0) mm: 'foot' by support 'base', 'arm' by a prescribed motion"),
            std::string::npos)
      << error_of(torn, 0);
  EXPECT_NE(error_of(torn, 1).find("step 'lift': 'glue' joins its sides, but they are moved apart along (0, 0, 1) at "),
            std::string::npos)
      << error_of(torn, 1);
  for (const int kind : {3, 4})
    EXPECT_NE(error_of(torn, kind).find("'glue' joins its sides, but they are moved apart along "), std::string::npos)
        << kind << error_of(torn, kind);
  for (const int kind : {2, 5}) EXPECT_EQ(error_of(torn, kind), "");
}

}  // namespace
}  // namespace dygita::test::conditions_tests
