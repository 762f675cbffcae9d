// How many iterations the search takes (bounds: what was measured, rounded up by half an iteration or 5 %), and that it
// finds what the plain iteration finds: relaxation alone, no acceleration, prediction, coarse correction nor inner
// iterations.
#include <gtest/gtest.h>

#include "decks/engine.hpp"

namespace dygita::test::iterations_tests {
namespace {

// Explicit substructures are not iterated.
DeckRun brick_block(const Settings& settings, const std::string& more = "", int threads = 0) {
  return run_file(deck("verification/iterations.lua"), settings, threads,
                  "latin{ integration = 'implicit', " + more + " }")
      .at(0);
}

Settings bricks(const char* nx, const char* ny, const char* nz, const Settings& more) {
  Settings settings{{"nx", nx}, {"ny", ny}, {"nz", nz}};
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

const Settings four = bricks("1", "2", "2", {}), eight = bricks("2", "2", "2", {}),
               sixty_four = bricks("4", "4", "4", {});

Settings with(Settings settings, const Settings& more) {
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}

TEST(Iterations, stay_few_at_large_steps_and_many_pieces) {
  struct Row {
    Settings settings;
    const char* cfl;
    double most;
  };
  for (const Row& row :
       {Row{four, "1", 4.5}, Row{eight, "1", 4.5}, Row{sixty_four, "1", 4.5}, Row{four, "2", 4.7}, Row{eight, "2", 4.7},
        Row{sixty_four, "2", 4.7}, Row{four, "10", 7.3}, Row{eight, "10", 7.7}, Row{sixty_four, "10", 9.3}}) {
    const DeckRun run = brick_block(with(row.settings, {{"cfl", row.cfl}}));
    EXPECT_TRUE(run.result->converged);
    EXPECT_LE(run.result->mean_iterations, row.most) << run.problem.substructures.size() << " pieces, CFL " << row.cfl;
  }
}

TEST(Iterations, unlike_halves_cost_no_more_than_like_ones) {
  for (const char* ratio : {"50", "0.02"}) {
    EXPECT_LE(brick_block({{"ratio", ratio}, {"cfl", "1"}}).result->mean_iterations, 4.5) << ratio;
    EXPECT_LE(brick_block({{"ratio", ratio}, {"cfl", "5"}}).result->mean_iterations, 5.3) << ratio;
  }
}

// With search directions of each side's own: 11.5, 8.6 and 7.3 (manual, eq. K14).
TEST(Iterations, stay_few_where_bonded_meshes_are_unlike) {
  const auto stack = [](const Settings& settings) {
    return run_file(deck("verification/bonded_stack.lua"), settings, 0, "latin{ integration = 'implicit' }").at(0);
  };
  const Settings coarse_pad{{"young", "6*MPa"}, {"lower", "3*mm"}, {"middle", "6*mm"}, {"upper", "3*mm"}};
  for (const auto& [settings, most] : {std::pair{coarse_pad, 9.4}, {Settings{}, 6.9}, {{{"young", "200*GPa"}}, 7.1}}) {
    const DeckRun run = stack(settings);
    EXPECT_TRUE(run.result->converged);
    EXPECT_LE(run.result->mean_iterations, most);
  }
}

TEST(Iterations, of_static_steps_do_not_grow_with_the_pieces) {
  const DeckRun two = brick_block({{"nx", "1"}, {"ny", "1"}, {"static", "1"}}),
                many = brick_block(with(sixty_four, {{"static", "1"}}));
  EXPECT_TRUE(many.result->converged);
  EXPECT_LE(many.result->mean_iterations, 24.5);
  EXPECT_LE(many.result->mean_iterations, 1.3 * two.result->mean_iterations);
  const DeckRun tied = brick_block(with(sixty_four, {{"static", "1"}, {"tie", "1"}}));
  EXPECT_LE(tied.result->mean_iterations, 16.5);
}

// A stiff half that nothing but friction holds, on a soft one: slow (52 once; 37 measured now).
TEST(Iterations, a_stiff_floating_body_on_a_soft_one_converges) {
  const DeckRun run = brick_block({{"static", "1"}, {"ratio", "50"}});
  EXPECT_TRUE(run.result->converged);
  EXPECT_LE(run.result->mean_iterations, 39.0);
}

TEST(Iterations, find_what_the_plain_iteration_finds) {
  for (const Settings& settings :
       {Settings{{"cells", "8"}, {"cfl", "5"}, {"steps", "20"}}, Settings{{"cells", "8"}, {"static", "1"}},
        Settings{{"cells", "8"}, {"static", "1"}, {"ratio", "0.02"}}}) {
    const std::string tight = "tolerance = 1e-9, static_tolerance = 1e-11, max_iterations = 5000";
    const std::string plain = tight + ", anderson = 0, relaxation = 0.8";
    const DeckRun fast = brick_block(settings, tight), slow = brick_block(settings, plain);
    EXPECT_TRUE(fast.result->converged);
    EXPECT_TRUE(slow.result->converged);
    for (const char* axis : {"x", "y", "z"})
      EXPECT_LT(difference(slow.column("corner", axis), fast.column("corner", axis)), 1e-6) << axis;
    std::cout << "plain " << slow.result->mean_iterations << ", searched " << fast.result->mean_iterations
              << " iterations\n";
  }
}

// The consistent part of a tuned mass couples neighbours, which inner iterations know of (8 without them, 4.5
// measured).
TEST(Iterations, a_tuned_mass_costs_little_more) {
  const DeckRun run = run_file(deck("crush.lua"), {}, 0, "latin{ integration = 'implicit', mass = 'tuned' }").at(0);
  EXPECT_TRUE(run.result->converged);
  EXPECT_LE(run.result->mean_iterations, 5.0);
}

// Blocks that slide and rub with 1083 unknowns on their faces and long steps: what an iteration changes is answered in
// half precision, which double precision does not have.
TEST(Iterations, half_precision_within_an_increment_changes_nothing_but_digits) {
  const std::string blocks = R"(
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local function block(name, z) return substructure{ name = name, material = steel, mesh = mesh.box{ origin = { 0, 0, z }, size = { 36*mm, 36*mm, 12*mm }, cells = { 18, 18, 3 } } } end
local lower, upper = block("lower", 0), block("upper", 12*mm)
local seat = interface.contact{ name = "seat", between = { lower:face "zmax", upper:face "zmin" }, friction = 0.3 }
local held = support.fixed{ name = "held", on = lower:face "zmin" }
local press = load.pressure{ on = upper:face "zmax", history = 20*MPa }
local tighten = step.static{ name = "tighten", increments = 2, loads = { press } }
local push = history.half_sine{ peak = 8*kN, duration = 0.2*ms }
local shock = step.dynamic{ name = "shock", after = tighten, duration = 0.3*ms, dt = 10*us, loads = { press, load.force{ on = upper:face "xmin", x = push } } }
problem{ name = "blocks", substructures = { lower, upper }, interfaces = { seat }, supports = { held }, steps = { tighten, shock },
  outputs = { output.history{ name = "top", on = upper:face "zmax", quantity = "velocity", direction = { 1, 0, 0 } }, output.joint{ name = "joint", on = seat } } }:run{}
)";
  const DeckRun half = run_text(blocks, {}, 0, "latin{ integration = 'implicit' }").at(0),
                whole = run_text(blocks, {}, 0, "latin{ integration = 'implicit', precision = 'double' }").at(0);
  EXPECT_TRUE(half.result->converged);
  EXPECT_GT(half.result->mean_iterations, 5.0);  // of which those after the first two are in half precision
  EXPECT_LT(half.result->mean_iterations, 1.2 * whole.result->mean_iterations);
  EXPECT_LT(difference(whole.column("top", "velocity"), half.column("top", "velocity")), 2e-5);
  EXPECT_GT(difference(whole.column("top", "velocity"), half.column("top", "velocity")), 0.0);
}

TEST(Iterations, any_number_of_threads_gives_the_same_bits) {
  for (const Settings& settings :
       {Settings{{"cells", "8"}, {"cfl", "5"}, {"steps", "20"}}, Settings{{"cells", "8"}, {"static", "1"}}}) {
    const DeckRun one = brick_block(settings, "", 1), three = brick_block(settings, "", 3);
    EXPECT_EQ(one.column("corner", "x"), three.column("corner", "x"));
    EXPECT_EQ(one.result->iterations, three.result->iterations);
  }
}

// Two plates pressed together with 20 MPa, bent by 3 N and let go: what vibrates is 4e-5 of the energy.
const std::string plates = R"(
local p = param{ press = 20*MPa, duration = 8*ms }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local function plate(name, z)
  return substructure{ name = name, material = steel, mesh = mesh.box{ origin = { 0, 0, z }, size = { 240*mm, 20*mm, 10*mm }, cells = { 12, 2, 2 } } }
end
local lower, upper = plate("lower", 0), plate("upper", 10*mm)
local lap = interface.contact{ name = "lap", between = { lower:face "zmax", upper:face "zmin" }, friction = 0.5 }
local held = support.fixed{ name = "held", on = { lower:face "xmin", upper:face "xmin" } }
local above, below = load.pressure{ on = upper:face "zmax", history = p.press }, load.pressure{ on = lower:face "zmin", history = p.press }
local tighten = step.static{ name = "tighten", increments = 2, loads = { above, below } }
local push = step.static{ name = "push", after = tighten, increments = 2, loads = { above, below, load.force{ on = upper:face "xmax", z = 3 } } }
local ring = step.dynamic{ name = "ring", after = push, duration = p.duration, dt = 20*us, loads = { above, below, load.force{ on = upper:face "xmax", z = 0 } } }
problem{ name = "plates", substructures = { lower, upper }, interfaces = { lap }, supports = { held }, steps = { tighten, push, ring },
  outputs = { output.history{ name = "tip", on = upper:face "xmax", quantity = "displacement", direction = { 0, 0, 1 } } } }:run{}
)";

TEST(SmallMotion, about_a_large_preload_neither_grows_nor_decays) {
  const DeckRun exact = run_text(plates, {}, 0, "monolithic{}").at(0);
  for (const char* more : {"", ", pieces = 3", ", precision = 'single'", ", window = 4"}) {
    const DeckRun run = run_text(plates, {}, 0, std::string("latin{ integration = 'implicit'") + more + " }").at(0);
    EXPECT_TRUE(run.result->converged) << more;
    EXPECT_LT(difference(exact.column("tip", "displacement"), run.column("tip", "displacement")), 1e-3) << more;
    EXPECT_LT(run.figure("energy imbalance [%]"), 0.1) << more;
    std::cout << more << " " << run.result->steps.at(2).iterations << " iterations, differs by "
              << difference(exact.column("tip", "displacement"), run.column("tip", "displacement")) << ", balance "
              << run.figure("energy imbalance [%]") << " %\n";
  }
}

// The books of a motion are its own: what a gap has cost that closed before it, and what a preload stores, is told
// apart.
TEST(SmallMotion, is_not_charged_with_what_static_steps_have_lost) {
  const DeckRun run = run_text(R"(
    local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
    local post = substructure{ name = "post", material = steel, mesh = mesh.box{ size = { 10*mm, 10*mm, 40*mm }, cells = { 2, 2, 8 } } }
    local ground = support.wall{ name = "ground", on = post:face "zmin", gap = 4*um }
    local guided = support.symmetry{ name = "guided", on = { post:face "xmin", post:face "ymin" } }
    local held = support.fixed{ name = "held", on = post:face "zmax" }
    local press = step.static{ name = "press", loads = { load.force{ on = post:face "zmin", z = -20*kN } } }
    local tap = step.dynamic{ name = "tap", after = press, duration = 40*us, dt = 0.4*us,
      loads = { load.force{ on = post:face "zmin", z = -20*kN }, load.pressure{ on = post:face "xmax", history = history.half_sine{ peak = 1*MPa, duration = 10*us } } } }
    problem{ name = "post", substructures = { post }, supports = { ground, guided, held }, steps = { press, tap },
      outputs = { output.energy{} }, solver = solver.latin{ integration = "implicit" } }:run{}
  )")
                          .at(0);
  EXPECT_GT(run.figure("energy dissipated by the scheme, static [%]"), 5.0);
  EXPECT_LT(run.figure("energy dissipated by the scheme [%]"), 0.1);
  EXPECT_LT(run.figure("energy created by the scheme [%]"), 0.1);
  EXPECT_LT(run.figure("energy imbalance [%]"), 0.1);
  // Held against what the tap brings, not against what the post stores.
  EXPECT_LT(run.figure("energy of the motion [J]"), 0.01 * run.figure("largest energy [J]"));
  EXPECT_GT(run.figure("energy of the motion [J]"), 0.0);
}

}  // namespace
}  // namespace dygita::test::iterations_tests
