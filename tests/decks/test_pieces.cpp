// Substructures that the program itself cuts into pieces (solver.latin{ pieces }) give the answers of uncut ones.
#include <gtest/gtest.h>

#include <cstring>

#include "decks/deck_prints.hpp"

namespace dygita::test::pieces_tests {
namespace {

// Largest difference of any column of any output, relative to the largest value of its table's columns of the same
// unit; indicators of the iteration's own (energy balance, scheme) are left out.
double largest_difference(const DeckRun& a, const DeckRun& b) {
  double worst = 0.0;
  std::string where;
  for (const OutputPtr& output : a.problem.outputs) {
    const std::string name = output->name;
    const Table &of_a = a.table(name), &of_b = b.table(name);
    for (size_t c = 0; c < of_a.columns.size(); ++c) {
      if (of_a.names[c] == "balance" || of_a.names[c] == "status" || of_a.units[c].empty()) continue;
      double scale = 0.0, difference = 0.0;
      for (size_t d = 0; d < of_a.columns.size(); ++d)
        if (of_a.units[d] == of_a.units[c]) scale = std::max(scale, largest(of_a.columns[d]));
      EXPECT_EQ(of_a.columns[c].size(), of_b.columns[c].size());
      for (size_t i = 0; i < of_a.columns[c].size(); ++i)
        difference = std::max(difference, std::abs(of_a.columns[c][i] - of_b.columns[c][i]));
      if (scale > 0.0 && difference / scale > worst) {
        worst = difference / scale;
        where = name + "." + of_a.names[c];
      }
    }
  }
  std::cout << "largest difference " << worst << " in " << where << ", " << b.result->mean_iterations
            << " iterations per increment\n";
  return worst;
}

// A plate slides with friction on a fixed and shaken base; a bolt beside them is tied to both and shortened. Gravity,
// pressure, traction, material damping: everything that acts on a node which a cut may have doubled.
const std::string clamped = R"(
local p = param{ pieces = 1, tuned = 0 }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local alloy = material.elastic{ name = "alloy", young = 70*GPa, poisson = 0.3, density = 2700, damping = { mass = 2000, stiffness = 1e-8 } }
local function box(name, material, origin, size, cells)
  return substructure{ name = name, material = material, mesh = mesh.box{ origin = origin, size = size, cells = cells } }
end
local base  = box("base", alloy, { 0, 0, 0 }, { 6*mm, 6*mm, 4*mm }, { 6, 6, 4 })
local plate = box("plate", steel, { 0, 0, 4*mm }, { 6*mm, 6*mm, 3*mm }, { 6, 6, 3 })
local nut   = box("nut", steel, { 6*mm, 0, 0 }, { 2*mm, 6*mm, 3*mm }, { 2, 6, 3 })
local head  = box("head", steel, { 6*mm, 0, 3*mm }, { 2*mm, 6*mm, 4*mm }, { 2, 6, 4 })
local contact = interface.contact{ name = "contact", between = { base:face "zmax", plate:face "zmin" }, friction = 0.2 }
local thread  = interface.bonded{ name = "thread", between = { base:face "xmax", nut:face "xmin" } }
local seat    = interface.bonded{ name = "seat", between = { plate:face "xmax", head:face "xmin" } }
local shank   = interface.bonded{ name = "shank", between = { nut:face "zmax", head:face "zmin" } }
local ground  = support.fixed{ name = "ground", on = base:face "zmin" }
local slide   = support.symmetry{ name = "slide", on = { base:face "ymin", plate:face "ymin" } }
local tighten = step.static{ name = "tighten", increments = 2, loads = {
  load.shortening{ on = shank, by = 3*um }, load.gravity{ z = -9.81 }, load.pressure{ on = plate:face "zmax", history = 5*MPa } } }
local shock = step.dynamic{ name = "shock", after = tighten, duration = 6*us, dt = 0.2*us, loads = {
  load.gravity{ z = -9.81 }, load.pressure{ on = plate:face "zmax", history = 5*MPa },
  load.traction{ on = plate:face "ymax", y = history.half_sine{ peak = 60*MPa, duration = 3*us }, x = history.half_sine{ peak = -30*MPa, duration = 2*us } },
  load.base_acceleration{ on = ground, direction = { 1, 0, 2 }, history = history.half_sine{ peak = 2e6, duration = 4*us } } } }
problem{ name = "clamped", substructures = { base, plate, nut, head }, interfaces = { contact, thread, seat, shank },
  supports = { ground, slide }, steps = { tighten, shock },
  solver = solver.latin{ integration = 'implicit', tolerance = 1e-9, static_tolerance = 1e-10, max_iterations = 3000, pieces = p.pieces, mass = p.tuned == 1 and "tuned" or "lumped" },
  outputs = { output.history{ name = "moves", on = plate:face "zmax", quantity = "displacement" },
    output.history{ name = "accelerates", on = plate:face "ymax", quantity = "acceleration" },
    output.history{ name = "corner", quantity = "velocity", on = plate:where(function(x, y, z) return near(x, 0) and near(y, 6*mm) and near(z, 7*mm) end) },
    output.history{ name = "stress", on = plate:face "zmin", quantity = "stress" },
    output.joint{ name = "joint", on = contact }, output.joint{ name = "bolt", on = shank }, output.resultant{ name = "glue", on = thread },
    output.resultant{ name = "foot", on = ground }, output.resultant{ name = "guide", on = slide }, output.energy{} } }:run{}
)";

TEST(Pieces, a_bolted_joint_that_is_tightened_and_shaken_is_the_same_in_any_number_of_pieces) {
  const DeckRun whole = run_text(clamped).at(0);
  EXPECT_TRUE(whole.result->converged);
  EXPECT_EQ(whole.result->pieces, (std::vector<int>{1, 1, 1, 1}));
  for (const char* pieces : {"2", "3", "8"}) {
    const DeckRun cut = run_text(clamped, {{"pieces", pieces}}).at(0);
    EXPECT_TRUE(cut.result->converged);
    EXPECT_GE(cut.result->pieces.at(0), std::stoi(pieces));
    EXPECT_EQ(whole.result->n_dofs, cut.result->n_dofs);
    EXPECT_LT(largest_difference(whole, cut), 1e-6) << pieces;
    EXPECT_LT(cut.figure("energy imbalance [%]"), 1e-3) << pieces;
    for (const char* name :
         {"error estimate, time step [%]", "error estimate, mesh [%]", "error estimate, static, mesh [%]"})
      EXPECT_NEAR(cut.figure(name), whole.figure(name), 1e-4 * whole.figure(name)) << name;
  }
}

TEST(Pieces, with_tuned_mass_too) {
  const DeckRun whole = run_text(clamped, {{"tuned", "1"}}).at(0),
                cut = run_text(clamped, {{"tuned", "1"}, {"pieces", "4"}}).at(0);
  EXPECT_LT(largest_difference(whole, cut), 1e-6);
  EXPECT_GT(largest_difference(run_text(clamped).at(0), whole), 1e-3);  // it is another mass
}

TEST(Pieces, agree_with_the_monolithic_solver_that_cuts_nothing) {
  const DeckRun whole = run_text(clamped, {{"pieces", "5"}}, 0, "monolithic").at(0),
                cut = run_text(clamped, {{"pieces", "5"}}).at(0);
  EXPECT_TRUE(whole.result->pieces.empty());
  EXPECT_LT(largest_difference(whole, cut), 1e-6);
}

TEST(Pieces, give_the_same_bits_for_any_number_of_threads) {
  const Settings settings{{"pieces", "5"}};
  const DeckRun one = run_text(clamped, settings, 1).at(0);
  for (const int threads : {2, 3}) {
    const DeckRun other = run_text(clamped, settings, threads).at(0);
    for (const auto& [output, table] : one.result->tables)
      EXPECT_EQ(table.columns, other.table(output->name).columns) << output->name << " " << threads;
  }
}

// A block between a wall with friction and an absorbing support that holds it in the static step; one end of it is led,
// by a displacement and then by a velocity; a second block is thrown at it.
const std::string led = R"(
local p = param{ pieces = 1, window = 1, plain = 0 }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local block = substructure{ name = "block", material = steel, mesh = mesh.box{ size = { 4*mm, 6*mm, 8*mm }, cells = { 4, 6, 8 } } }
local ball = substructure{ name = "ball", material = steel, velocity = { 0, -2, -4 },
  mesh = mesh.box{ origin = { 0, 1*mm, 8*mm }, size = { 3*mm, 3*mm, 3*mm }, cells = { 3, 3, 3 } } }
local floor = support.wall{ name = "floor", on = block:face "zmin", friction = 0.3 }
local out = support.absorbing{ name = "out", on = block:face "xmin" }
local hit = interface.contact{ name = "hit", between = { block:face "zmax", ball:face "zmin" }, gap = 0.5*um, friction = 0.1 }
local end_ = block:where(function(x, y, z) return near(y, 6*mm) and z > 4.5*mm and x > 0.5*mm end)
local lean = step.static{ name = "lean", increments = 2, loads = { load.displacement{ on = end_, y = -1*um }, load.pressure{ on = block:face "ymin", history = 10*MPa } } }
local go = step.dynamic{ name = "go", after = lean, duration = 5*us, dt = 0.2*us, loads = {
  load.velocity{ on = end_, y = history.ramp{ from = 0, to = 2, duration = 2*us } }, load.pressure{ on = block:face "ymin", history = 10*MPa } } }
problem{ name = "led", substructures = { block, ball }, interfaces = { hit }, supports = { floor, out }, steps = { lean, go },
  solver = solver.latin{ integration = 'implicit', tolerance = 1e-9, static_tolerance = 1e-10, max_iterations = 3000, pieces = p.pieces, window = p.window, plain = p.plain == 1 },
  outputs = { output.history{ name = "moves", on = block:face "zmax", quantity = "displacement" },
    output.history{ name = "speeds", on = ball:face "zmax", quantity = "velocity" }, output.joint{ name = "foot", on = floor },
    output.joint{ name = "touch", on = hit }, output.resultant{ name = "soil", on = out }, output.energy{} } }:run{}
)";

TEST(Pieces, led_nodes_absorbing_supports_walls_and_impacts_are_cut_too) {
  const DeckRun whole = run_text(led).at(0);
  EXPECT_TRUE(whole.result->converged);
  EXPECT_GT(largest(whole.column("touch", "normal")), 0.0);
  EXPECT_GT(largest(whole.column("soil", "normal")), 0.0);
  for (const char* pieces : {"2", "3", "8"}) {
    const DeckRun cut = run_text(led, {{"pieces", pieces}}).at(0);
    EXPECT_TRUE(cut.result->converged);
    EXPECT_LT(largest_difference(whole, cut), 1e-6) << pieces;
    EXPECT_LT(cut.figure("energy imbalance [%]"), 1e-3) << pieces;
  }
}

TEST(Pieces, windows_and_full_solves_are_cut_too) {
  const DeckRun whole = run_text(led).at(0);
  EXPECT_LT(largest_difference(whole, run_text(led, {{"pieces", "3"}, {"plain", "1"}}).at(0)), 1e-6);
  EXPECT_LT(largest_difference(whole, run_text(led, {{"pieces", "8"}, {"window", "8"}}).at(0)), 1e-6);
}

// Prisms and tetrahedra: a bar that is leant on and struck.
TEST(Pieces, any_kind_of_cell_can_be_cut) {
  for (const char* cells : {"0", "1"}) {
    const std::string text = R"(
local p = param{ pieces = 1 }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local bar = substructure{ name = "bar", material = steel, mesh = mesh.gmsh{ file = ")" +
                             std::string(DYGITA_SOURCE_DIR) + R"(/meshes/bar.geo", set = { n = 60, cells = )" + cells +
                             R"( } }:volume "bar" }
local base = support.fixed{ name = "base", on = bar:face "zmin" }
local lean = step.static{ name = "lean", loads = { load.traction{ on = bar:face "zmax", x = 1*MPa } } }
local strike = step.dynamic{ name = "strike", after = lean, duration = 20*us, dt = 0.4*us, loads = {
  load.traction{ on = bar:face "zmax", z = history.haversine{ peak = -50*MPa, duration = 6*us } } } }
problem{ name = "bar", substructures = { bar }, supports = { base }, steps = { lean, strike },
  solver = solver.latin{ integration = 'implicit', tolerance = 1e-9, static_tolerance = 1e-10, max_iterations = 3000, pieces = p.pieces },
  outputs = { output.history{ name = "tip", on = bar:face "zmax", quantity = "displacement" }, output.history{ name = "side", on = bar:face "xmin",
    quantity = "stress" }, output.resultant{ name = "foot", on = base }, output.energy{} } }:run{}
)";
    const DeckRun whole = run_text(text).at(0);
    EXPECT_EQ(whole.result->mean_iterations, 1.0);  // nothing to iterate on
    for (const char* pieces : {"2", "5"}) {
      const DeckRun cut = run_text(text, {{"pieces", pieces}}).at(0);
      EXPECT_TRUE(cut.result->converged);
      EXPECT_LT(largest_difference(whole, cut), 1e-6) << cells << " " << pieces;
    }
  }
}

// What a step leaves to the next: static after dynamic (velocities are dropped), a support that comes and one that
// goes.
TEST(Pieces, steps_follow_one_another_with_the_energies_of_the_whole) {
  const std::string chain = R"(
local p = param{ pieces = 1 }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local block = substructure{ name = "block", material = steel, mesh = mesh.box{ size = { 5*mm, 5*mm, 10*mm }, cells = { 5, 5, 10 } } }
local base, clamp = support.fixed{ name = "base", on = block:face "zmin" }, support.fixed{ name = "clamp", on = block:face "xmax" }
local top = block:face "zmax"
local press = step.static{ name = "press", loads = { load.traction{ on = top, x = 4*MPa, z = -20*MPa } }, supports = { base } }
local twist = step.static{ name = "twist", after = press, loads = { load.traction{ on = top, y = 9*MPa } }, supports = { base } }
local hit = step.dynamic{ name = "hit", after = twist, duration = 4*us, dt = 0.2*us, supports = { base },
  loads = { load.pressure{ on = top, history = history.haversine{ peak = 80*MPa, duration = 3*us } } } }
local hold = step.static{ name = "hold", after = hit, loads = { load.traction{ on = block:face "ymax", y = 3*MPa } }, supports = { base, clamp } }
local shake = step.dynamic{ name = "shake", after = hold, duration = 4*us, dt = 0.2*us, supports = { clamp } }
problem{ name = "chain", substructures = { block }, supports = { base, clamp }, steps = { press, twist, hit, hold, shake },
  solver = solver.latin{ integration = 'implicit', tolerance = 1e-10, static_tolerance = 1e-11, max_iterations = 5000, pieces = p.pieces },
  outputs = { output.history{ name = "moves", on = top, quantity = "displacement" }, output.resultant{ name = "foot", on = base },
    output.resultant{ name = "side", on = clamp }, output.energy{} } }:run{}
)";
  const DeckRun whole = run_text(chain).at(0);
  for (const char* pieces : {"2", "7"}) {
    const DeckRun cut = run_text(chain, {{"pieces", pieces}}).at(0);
    EXPECT_TRUE(cut.result->converged);
    EXPECT_LT(largest_difference(whole, cut), 1e-6) << pieces;
  }
}

TEST(Pieces, a_case_starts_from_the_interface_fields_of_one_cut_alike) {
  std::string text = clamped;
  text.replace(text.find("problem{"), 8, "local clamp = problem{");
  text.replace(text.find("}:run{}"), 7,
               "}\nlocal first = clamp:run{ case = 'first' }\nclamp:run{ case = 'again', start_from = first }");
  const std::vector<DeckRun> runs = run_text(text, {{"pieces", "3"}});
  EXPECT_EQ(runs.at(1).result->mean_iterations, 1.0);
  EXPECT_LT(largest_difference(runs.at(0), runs.at(1)), 1e-6);
}

// The cut that is made by itself: only of what is large.
TEST(Pieces, large_bodies_are_cut_unless_the_deck_says_otherwise) {
  const std::string text = R"(
local p = param{ auto = 1 }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local large = substructure{ name = "large", material = steel, mesh = mesh.box{ size = { 19*mm, 19*mm, 19*mm }, cells = { 19, 19, 19 } } }
local small = substructure{ name = "small", material = steel, mesh = mesh.box{ origin = { 0, 0, 19*mm }, size = { 19*mm, 19*mm, 2*mm }, cells = { 19, 19, 2 } } }
local touch = interface.contact{ name = "touch", between = { large:face "zmax", small:face "zmin" }, friction = 0.3 }
local hit = step.dynamic{ name = "hit", duration = 3*us, dt = 0.3*us, loads = {
  load.traction{ on = small:face "zmax", x = 20*MPa, z = history.half_sine{ peak = -100*MPa, duration = 2*us } } } }
problem{ name = "large", substructures = { large, small }, interfaces = { touch }, steps = { hit },
  solver = p.auto == 1 and solver.latin{ integration = 'implicit', tolerance = 1e-8 } or solver.latin{ integration = 'implicit', tolerance = 1e-8, pieces = 1 },
  outputs = { output.history{ name = "top", on = small:face "zmax", quantity = "velocity" }, output.joint{ name = "joint", on = touch }, output.energy{} } }:run{}
)";
  const DeckRun cut = run_text(text).at(0), whole = run_text(text, {{"auto", "0"}}).at(0);
  EXPECT_GT(cut.result->pieces.at(0), 1);
  EXPECT_EQ(cut.result->pieces.at(1), 1);
  EXPECT_EQ(whole.result->pieces, (std::vector<int>{1, 1}));
  EXPECT_LT(largest_difference(whole, cut), 1e-6);
}

TEST(Pieces, cost_few_iterations_however_many_they_are) {
  const PrintedRun cube = run_printing("verification/pieces.lua", {{"n", "10"}, {"most", "32"}});
  for (const char* pieces : {"2 pieces", "4 pieces", "8 pieces", "16 pieces", "32 pieces"}) {
    EXPECT_LT(cube.number(pieces), 8.0) << pieces;
    const size_t at = cube.text.find(std::string("\n") + pieces);
    const auto after = [&](const char* label) {
      return std::strtod(cube.text.c_str() + cube.text.find(label, at) + std::strlen(label), nullptr);
    };
    EXPECT_LT(after("top's velocity: "), 1e-5) << pieces;
    EXPECT_LT(after("force on the wall: "), 1e-5) << pieces;
  }
}

}  // namespace
}  // namespace dygita::test::pieces_tests
