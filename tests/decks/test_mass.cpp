// The masses an implicit solver can be asked for: tuned to the time step, and none at nodes in contact.
#include <gtest/gtest.h>

#include "decks/deck_prints.hpp"

namespace dygita::test::mass_tests {
namespace {

// A block on a shaken base, another on it in contact, a wall above it; solver as asked.
DeckRun stack(const std::string& solver) {
  return run_text(R"(
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local damped = material.elastic{ name = "damped", young = 70*GPa, poisson = 0.3, density = 2700, damping = { mass = 2000, stiffness = 1e-8 } }
local function block(name, material, from)
  return substructure{ name = name, material = material,
    mesh = mesh.box{ origin = { 0, 0, from }, size = { 20*mm, 16*mm, 12*mm }, cells = { 4, 3, 3 } } }
end
local lower, upper = block("lower", damped, 0), block("upper", steel, 12*mm)
local base = support.fixed{ name = "base", on = lower:face "zmin" }
local side = support.symmetry{ name = "side", on = { lower:face "xmin", upper:face "xmin" } }
local ceiling = support.wall{ name = "ceiling", on = upper:face "zmax", gap = 2*um }
local touch = interface.contact{ name = "touch", between = { lower:face "zmax", upper:face "zmin" }, friction = 0.3 }
local press = step.static{ name = "press", loads = { load.pressure{ on = upper:face "zmax", history = 1*MPa } } }
local shake = step.dynamic{ name = "shake", after = press, duration = 60*us, dt = 1*us, loads = {
  load.pressure{ on = upper:face "zmax", history = 1*MPa },
  load.base_acceleration{ on = base, direction = { 0, 1, 2 }, history = history.half_sine{ peak = 40000*g0, duration = 30*us } } } }
problem{ name = "stack", substructures = { lower, upper }, interfaces = { touch }, supports = { base, side, ceiling },
         steps = { press, shake }, outputs = { output.energy{}, output.resultant{ name = "push", on = touch },
         output.history{ name = "top", on = upper:face "zmax", quantity = "velocity" }, output.resultant{ name = "foot", on = base } },
         solver = solver.)" +
                  solver + " }:run{}\n")
      .at(0);
}

double imbalance(const DeckRun& run) { return run.figure("energy imbalance [%]"); }

TEST(TunedMassInARun, is_the_same_in_latin_and_in_the_monolithic_solver_under_a_moving_base) {
  const DeckRun latin = stack("latin{ integration = 'implicit', mass = \"tuned\", tolerance = 1e-9 }"),
                whole = stack("monolithic{ mass = \"tuned\" }");
  EXPECT_TRUE(latin.result->converged);
  EXPECT_LT(difference(whole.column("push", "normal"), latin.column("push", "normal")), 1e-6);
  EXPECT_LT(difference(whole.column("top", "z"), latin.column("top", "z")), 1e-6);
  EXPECT_LT(difference(whole.column("foot", "normal"), latin.column("foot", "normal")), 1e-6);
  EXPECT_LT(imbalance(latin), 1e-3);
  EXPECT_LT(imbalance(whole), 1e-3);
  // It is another mass than the lumped one.
  EXPECT_GT(difference(stack("latin{ integration = 'implicit' }").column("top", "z"), latin.column("top", "z")), 1e-3);
}

TEST(TunedMassInARun, is_the_same_with_full_solves) {
  const DeckRun condensed = stack("latin{ integration = 'implicit', mass = \"tuned\", tolerance = 1e-9 }");
  const DeckRun plain = stack("latin{ integration = 'implicit', mass = \"tuned\", tolerance = 1e-9, plain = true }");
  EXPECT_LT(difference(plain.column("push", "normal"), condensed.column("push", "normal")), 1e-6);
}

TEST(MasslessContact, closes_the_energy_balance_and_converges_to_what_other_nodes_say) {
  const DeckRun massless = stack("latin{ integration = 'implicit', massless_contact = true }");
  EXPECT_TRUE(massless.result->converged);
  EXPECT_LT(imbalance(massless), 1e-3);
  EXPECT_LT(difference(stack("latin{ integration = 'implicit' }").column("top", "z"), massless.column("top", "z")),
            0.3);
}

TEST(MasslessContact, is_the_same_in_windows_of_several_steps_and_with_full_solves) {
  const DeckRun one =
      stack("latin{ integration = 'implicit', massless_contact = true, mass = \"tuned\", tolerance = 1e-9 }");
  const DeckRun plain = stack(
      "latin{ integration = 'implicit', massless_contact = true, mass = \"tuned\", tolerance = 1e-9, plain = true }");
  const DeckRun windows = stack(
      "latin{ integration = 'implicit', massless_contact = true, mass = \"tuned\", tolerance = 1e-9, window = 5, "
      "max_iterations = 2000 }");
  EXPECT_LT(difference(one.column("push", "normal"), plain.column("push", "normal")), 1e-6);
  EXPECT_LT(difference(one.column("push", "normal"), windows.column("push", "normal")), 1e-4);
}

}  // namespace
}  // namespace dygita::test::mass_tests
