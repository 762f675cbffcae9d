// The explicit reference: exact answers, LATIN's where there is none, its own limits.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "decks/deck_prints.hpp"

namespace dygita::test::explicit_tests {
namespace {

const std::string implicit = "latin{ integration = 'implicit' }";  // what LATIN iterates

const std::string full = "explicit{ integration = \"full\", bulk_viscosity = false, penalty = ";

double drift(const DeckRun& run) { return run.figure("energy imbalance [%]"); }

// Root mean square difference over that of `a` of two columns, sampled at the same times.
double rms_difference(const DeckRun& a, const DeckRun& b, const std::string& output, const std::string& column) {
  const std::vector<double>&x = a.column(output, column), &y = b.column(output, column);
  if (x.size() != y.size()) throw std::runtime_error("series of different lengths");
  double sum = 0.0, of = 0.0;
  for (size_t i = 0; i < x.size(); ++i) {
    sum += (x[i] - y[i]) * (x[i] - y[i]);
    of += x[i] * x[i];
  }
  std::cout << "  " << output << "." << column << " differs by " << std::sqrt(sum / of) << "\n";
  return std::sqrt(sum / of);
}

TEST(Explicit, a_bouncing_bar_comes_nearer_to_the_exact_one_with_a_stiffer_penalty) {
  double before = 150.0;
  for (const std::string penalty : {"0.1", "1", "10"}) {
    const PrintedRun run =
        run_printing("verification/bouncing_bar.lua", {{"n", "50"}}, "explicit{ penalty = " + penalty + " }");
    const double error = run.number("place until the release, max error");
    EXPECT_LT(error, before / 2);
    EXPECT_EQ(run.number("spells of contact in impact 1"), 1.0);
    EXPECT_LT(drift(run.runs.at(0)),
              penalty == "10" ? 7.3 : 0.2);  // what stiff springs cost at impacts, of the largest energy: measured 5.1
    before = error;
  }
  EXPECT_LT(before, 2.5);
}

TEST(Explicit, two_bars_press_each_other_with_the_exact_stress) {
  const PrintedRun run =
      run_printing("verification/two_bars.lua", {{"n", "50"}}, "explicit{ penalty = 1, safety = 0.5 }");
  EXPECT_LT(run.number("stress over the contact but 5 % at each end, rms"), 1.0);
  EXPECT_EQ(run.number("spells of contact"), 1.0);
  EXPECT_LT(drift(run.runs.at(0)), 0.2);
}

TEST(Explicit, a_yielding_interface_lets_its_yield_stress_through) {
  const PrintedRun run = run_printing("verification/yielding_interface.lua", {}, "explicit");
  EXPECT_LT(run.number("perfect: stress from 0.1 to 1.9 T after the arrival, max"), 1e-9);
  EXPECT_LT(std::abs(run.number("perfect: opening at the end")), 3.0);
  EXPECT_LT(std::abs(run.number("hardening: opening at the end")), 5.0);  // LATIN on this mesh: 3.1
}

TEST(Explicit, the_plastic_beam_transmits_its_yield_stress_and_opens_as_with_latin) {
  const DeckRun latin = run_file(deck("plastic_beam.lua"), {}, 0, implicit).at(0);
  const DeckRun run = run_file(deck("plastic_beam.lua"), {}, 0, "explicit").at(0);
  EXPECT_NEAR(largest(run.column("through", "normal")), 120e6 * 25e-6, 1e-9 * 3000);
  const double exact = largest(latin.column("yielding", "plastic_opening"));
  EXPECT_NEAR(largest(run.column("yielding", "plastic_opening")), exact, 0.02 * exact);
}

// The deck of crush.lua with dt to choose.
const std::string crush = R"(
local p = param{ n = 2, dt = 0.3*us }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.30, density = 7800 }
local polymer = material.elastic{ name = "polymer", young = 4.2*GPa, poisson = 0.35, density = 1200 }
local side, height = 10*mm, 20*mm
local function box(name, metal, z)
  return substructure{ name = name, material = metal,
    mesh = mesh.box{ origin = { 0, 0, z }, size = { side, side, height }, cells = { p.n, p.n, 2*p.n } } }
end
local specimen, punch = box("specimen", polymer, 0), box("punch", steel, height)
local touch = interface.contact{ name = "touch", between = { specimen:face "zmax", punch:face "zmin" }, friction = 0.3 }
local wall = support.wall{ name = "wall", on = specimen:face "zmin" }
local symmetry = support.symmetry{ name = "symmetry",
  on = { specimen:face "xmin", specimen:face "ymin", punch:face "xmin", punch:face "ymin" } }
local shot = step.dynamic{ name = "shot", duration = 30*us, dt = p.dt, loads = {
  load.pressure{ on = punch:face "zmax", history = history.half_sine{ peak = 80*MPa, duration = 15*us } } } }
local spread = output.history{ name = "spread", quantity = "displacement", direction = { 1, 0, 0 },
  on = specimen:where(function(x, y, z) return near(x, side) and near(y, side) and near(z, height) end) }
problem{ name = "crush", substructures = { specimen, punch }, interfaces = { touch }, supports = { wall, symmetry },
  steps = { shot }, outputs = { spread, output.joint{ name = "grip", on = touch }, output.energy{} } }:run{}
)";

TEST(Explicit, crush_with_friction_converges_to_what_latin_converges_to) {
  const Settings fine = {{"n", "4"}, {"dt", "0.03*us"}};
  const DeckRun latin = run_text(crush, fine, 0, implicit).at(0);
  double before = 1.0;
  for (const std::string penalty : {"0.1", "3", "100"}) {
    const DeckRun run = run_text(crush, fine, 0, full + penalty + ", safety = 0.3 }").at(0);
    const double error = rms_difference(latin, run, "spread", "displacement");
    EXPECT_LT(error, before / 2);
    before = error;
    if (penalty == "100") {
      EXPECT_LT(error, 0.01);
      EXPECT_LT(rms_difference(latin, run, "grip", "normal"), 0.02);
      const double friction = latin.column("grip", "friction_work").back();
      EXPECT_NEAR(run.column("grip", "friction_work").back(), friction, 0.1 * friction);
    }
    EXPECT_LT(drift(run), 0.1);
  }
}

TEST(Explicit, one_point_and_full_integration_agree_as_the_mesh_is_refined) {
  double before = 1.0;
  for (const std::string n : {"2", "4", "8"}) {
    const Settings settings = {{"n", n}, {"dt", "0.1*us"}};
    const DeckRun run = run_text(crush, settings, 0, full + "1 }").at(0);
    const DeckRun one_point = run_text(crush, settings, 0, "explicit{ bulk_viscosity = false, penalty = 1 }").at(0);
    const double difference = rms_difference(run, one_point, "spread", "displacement");
    EXPECT_LT(difference, 0.75 * before);
    before = difference;
  }
}

TEST(Explicit, bolted_flanges_lose_their_bolt_force_as_with_latin) {
  const Settings coarse = {{"size", "6*mm"}};
  const DeckRun latin = run_file(deck("bench/even_flanges.lua"), coarse, 0, implicit).at(0);
  const DeckRun run = run_file(deck("bench/even_flanges.lua"), coarse, 0, full + "10 }").at(0);
  EXPECT_NEAR(run.column("bolt", "normal").front(), latin.column("bolt", "normal").front(), 1e-3);  // N, tightened
  EXPECT_LT(rms_difference(latin, run, "bolt", "normal"), 0.04);
  EXPECT_LT(rms_difference(latin, run, "bolt", "plastic_opening"), 0.01);
  EXPECT_LT(drift(run), 0.01);
}

// A block of eight cells in free flight, at rest, or hanging: by hand.
std::string block_deck(const std::string& rest) {
  return R"(
local p = param{ dt = 0.2*us }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local block = substructure{ name = "block", material = steel, velocity = { 3, -2, 5 },
  mesh = mesh.box{ size = { 4*mm, 6*mm, 8*mm }, cells = { 2, 2, 2 } } }
local still = substructure{ name = "still", material = steel, place = { 0, 0, 8*mm },
  mesh = mesh.box{ size = { 4*mm, 6*mm, 8*mm }, cells = { 2, 2, 2 } } }
)" + rest;
}

TEST(Explicit, free_flight_under_gravity_is_exact) {
  const DeckRun run = run_text(block_deck(R"(
local fly = step.dynamic{ name = "fly", duration = 20*us, dt = p.dt, loads = { load.gravity{ z = -1e5 } } }
problem{ name = "flight", substructures = { block }, steps = { fly },
  outputs = { output.history{ name = "move", quantity = "displacement", on = block:face "xmin" }, output.energy{} } }:run{}
)"),
                               {}, 0, "explicit")
                          .at(0);
  const double t = 20e-6;
  EXPECT_NEAR(run.column("move", "x").back(), 3 * t, 1e-12 * t);
  EXPECT_NEAR(run.column("move", "y").back(), -2 * t, 1e-12 * t);
  EXPECT_NEAR(run.column("move", "z").back(), 5 * t - 0.5e5 * t * t, 1e-12 * t);
  EXPECT_LT(drift(run), 1e-10);
}

TEST(Explicit, a_prestressed_assembly_left_alone_stays_at_rest) {
  for (const std::string solver : {"explicit", "explicit{ integration = \"full\" }"}) {
    const PrintedRun patch = run_printing("verification/patch.lua", {}, solver);
    EXPECT_LT(patch.number("largest error of all"), 1e-10);
  }
}

TEST(Explicit, cutting_a_body_into_bonded_pieces_changes_nothing) {
  const PrintedRun run = run_printing("verification/bonded_is_monolithic.lua", {}, "explicit");
  EXPECT_LT(run.number("2x2x2 pieces, max difference of the largest"), 1e-11);
  EXPECT_LT(run.number("3x3x4 pieces, max difference of the largest"), 1e-11);
}

TEST(Explicit, forces_of_ties_and_supports_are_those_of_latin_at_rest) {
  const std::string hanging = block_deck(R"(
local glue = interface.bonded{ name = "glue", between = { block:face "zmax", still:face "zmin" } }
local roof = support.fixed{ name = "roof", on = still:face "zmax" }
local hang = step.static{ name = "hang", loads = { load.force{ on = block:face "zmin", x = 50, z = -200 } } }
local wait = step.dynamic{ name = "wait", after = hang, duration = 2*us, dt = p.dt,
  loads = { load.force{ on = block:face "zmin", x = 50, z = -200 } } }
problem{ name = "hanging", substructures = { block, still }, interfaces = { glue }, supports = { roof }, steps = { hang, wait },
  outputs = { output.resultant{ name = "tie", on = glue }, output.resultant{ name = "held", on = roof }, output.energy{} } }:run{}
)");
  std::string text = hanging;
  text.replace(text.find(", velocity = { 3, -2, 5 }"), 25, "");
  const DeckRun run = run_text(text, {}, 0, "explicit").at(0);
  EXPECT_NEAR(run.column("tie", "z").back(), 200.0, 1e-6);
  EXPECT_NEAR(run.column("tie", "x").back(), -50.0, 1e-6);
  EXPECT_NEAR(run.column("held", "z").back(), 200.0, 1e-6);
  EXPECT_NEAR(run.column("held", "x").back(), -50.0, 1e-6);
}

// A bar that is struck, long enough for an instability to show.
const std::string bar = R"(
local p = param{ dt = 1*us }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800, damping = { mass = MASS, stiffness = STIFFNESS } }
local bar = substructure{ name = "bar", material = steel, mesh = mesh.box{ size = { 2*mm, 3*mm, 20*mm }, cells = { 2, 2, 10 } } }
local hit = step.dynamic{ name = "hit", duration = 200*us, dt = p.dt, loads = {
  load.traction{ on = bar:face "zmax", x = history.half_sine{ peak = 10*MPa, duration = 8*us }, z = history.half_sine{ peak = 50*MPa, duration = 4*us } } } }
problem{ name = "bar", substructures = { bar }, supports = { support.fixed{ name = "root", on = bar:face "zmin" } }, steps = { hit },
  outputs = { output.history{ name = "tip", quantity = "velocity", on = bar:face "zmax" }, output.energy{} } }:run{}
)";

std::string bar_deck(const std::string& mass = "0", const std::string& stiffness = "0") {
  std::string text = bar;
  text.replace(text.find("MASS"), 4, mass);
  text.replace(text.find("STIFFNESS"), 9, stiffness);
  return text;
}

TEST(Explicit, is_stable_just_below_the_critical_step_and_says_so_above) {
  for (const std::string integration : {"one_point", "full"})
    for (const std::string viscosity : {"true", "false"}) {
      const auto solver = [&](const std::string& safety) {
        return "explicit{ integration = \"" + integration + "\", bulk_viscosity = " + viscosity +
               ", safety = " + safety + " }";
      };
      const DeckRun run = run_text(bar_deck(), {}, 0, solver("0.99")).at(0);
      EXPECT_LT(drift(run), 1.0) << integration << viscosity;
      try {
        run_text(bar_deck(), {}, 0, solver("1.2"));
        FAIL() << "1.2 times the critical step was taken: " << integration << ", " << viscosity;
      } catch (const NumericalError& error) {
        EXPECT_NE(std::string(error.what()).find("step 'hit': unstable at"), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("'safety' above 1"), std::string::npos) << error.what();
      }
    }
}

TEST(Explicit, stiffness_damping_that_lags_behind_is_stable_at_the_step_it_asks_for) {
  const DeckRun free = run_text(bar_deck(), {}, 0, "explicit{ safety = 0.99 }").at(0);
  const DeckRun damped = run_text(bar_deck("2e3", "1e-7"), {}, 0, "explicit{ safety = 0.99 }").at(0);
  EXPECT_GT(damped.figure("explicit substeps per step"), 1.5 * free.figure("explicit substeps per step"));
  EXPECT_LT(drift(damped), 1.0);
  const Settings fine = {{"dt", "0.1*us"}};
  const DeckRun latin = run_text(bar_deck("2e3", "1e-7"), fine, 0, implicit).at(0);
  const DeckRun same = run_text(bar_deck("2e3", "1e-7"), fine, 0, full + "1 }").at(0);
  EXPECT_LT(rms_difference(latin, same, "tip", "x"), 0.05);
  const double damping = latin.column("energy", "damping").back();
  EXPECT_NEAR(same.column("energy", "damping").back(), damping, 0.02 * damping);
}

// A block whose top is pulled and pushed node by node: nothing but the control of hourglass modes holds it.
TEST(Explicit, hourglass_modes_run_free_without_control_and_are_held_by_it) {
  const std::string pulled = R"(
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local block = substructure{ name = "block", material = steel, mesh = mesh.box{ size = { 6*mm, 6*mm, 6*mm }, cells = { 4, 4, 4 } } }
local function chequered(x, y, z)
  return near(z, 6*mm) and (math.floor(x / (1.5*mm) + 0.5) + math.floor(y / (1.5*mm) + 0.5)) % 2 == 0
end
local function other(x, y, z) return near(z, 6*mm) and not chequered(x, y, z) end
local up, down = block:where(chequered), block:where(other)
local pull = step.dynamic{ name = "pull", duration = 20*us, dt = 0.5*us,
  loads = { load.force{ on = up, z = history.ramp{ from = 0, to = 100, duration = 10*us } },
            load.force{ on = down, z = history.ramp{ from = 0, to = -100, duration = 10*us } } } }
problem{ name = "pulled", substructures = { block }, supports = { support.fixed{ name = "base", on = block:face "zmin" } }, steps = { pull },
  outputs = { output.history{ name = "up", quantity = "displacement", direction = { 0, 0, 1 }, on = up }, output.energy{} } }:run{}
)";
  const auto rises = [&](const std::string& solver) {
    return largest(run_text(pulled, {}, 0, solver).at(0).column("up", "displacement"));
  };
  const double exact = rises(full + "1 }"), controlled = rises("explicit"), free = rises("explicit{ hourglass = 0 }");
  std::cout << "  rises " << exact << ", controlled " << controlled << ", free " << free << "\n";
  EXPECT_LT(std::abs(controlled - exact), 0.5 * exact);
  EXPECT_GT(free, 20 * exact);
}

// What the hourglass control and the viscosities take does not depend on where steps are divided.
TEST(Explicit, one_motion_in_several_steps_has_one_set_of_books) {
  const std::string text = R"(
    local p = param{ pieces = 1 }
    local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800, damping = { mass = 200, stiffness = 1e-8 } }
    local a = substructure{ name = "a", material = steel, mesh = mesh.box{ size = { 20*mm, 10*mm, 10*mm }, cells = { 4, 2, 2 } } }
    local b = substructure{ name = "b", material = steel, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 2, 2, 2 }, origin = { 5*mm, 0, 10*mm } } }
    local joint = interface.contact{ name = "joint", between = { a, b }, friction = 0.2 }
    local pressed = load.pressure{ on = b:face "zmax", history = 10*MPa }
    local press = step.static{ name = "press", loads = { pressed } }
    local push = history.half_sine{ peak = 3*MPa, duration = 20*us }
    local steps, before, whole = { press }, press, 40*us
    for i = 1, p.pieces do
      before = step.dynamic{ name = "d" .. i, after = before, duration = whole / p.pieces, dt = 0.5*us,
        loads = { pressed, load.traction{ on = b:face "xmax", x = push:shifted(-(i - 1) * whole / p.pieces) } } }
      steps[#steps + 1] = before
    end
    problem{ name = "chain", substructures = { a, b }, interfaces = { joint }, steps = steps,
      supports = { support.fixed{ name = "base", on = a:face "zmin" } },
      outputs = { output.energy{}, output.history{ name = "top", on = b:face "zmax", quantity = "displacement" } },
      solver = solver.explicit{} }:run{}
  )";
  const DeckRun one = run_text(text).at(0);
  const double damping = one.column("energy", "damping").back();
  EXPECT_GT(damping, 0.0);
  for (const char* pieces : {"2", "4", "8"}) {
    const DeckRun some = run_text(text, {{"pieces", pieces}}).at(0);
    EXPECT_NEAR(some.column("top", "x").back(), one.column("top", "x").back(), 1e-9 * largest(one.column("top", "x")));
    for (const char* column : {"damping", "strain", "scheme", "friction"})
      EXPECT_NEAR(some.column("energy", column).back(), one.column("energy", column).back(), 1e-3 * damping)
          << column << ", " << pieces << " pieces";
  }
}

TEST(Explicit, a_released_tie_parts_and_absorbing_ends_take_the_wave_away) {
  const std::string released = block_deck(R"(
local glue = interface.bonded{ name = "glue", between = { block:face "zmax", still:face "zmin" } }
local base = support.absorbing{ name = "base", on = still:face "zmax" }
local hit = step.dynamic{ name = "hit", duration = 30*us, dt = p.dt, loads = { load.release{ on = glue, at = 4*us },
  load.traction{ on = block:face "zmin", z = history.half_sine{ peak = 50*MPa, duration = 6*us } } } }
problem{ name = "parting", substructures = { block, still }, interfaces = { glue }, supports = { base }, steps = { hit },
  outputs = { output.resultant{ name = "tie", on = glue }, output.resultant{ name = "end", on = base },
    output.history{ name = "move", quantity = "velocity", on = block:face "zmax" }, output.energy{} } }:run{}
)");
  std::string text = released;
  text.replace(text.find(", velocity = { 3, -2, 5 }"), 25, "");
  const DeckRun latin = run_text(text, {}, 0, implicit).at(0);
  const DeckRun run = run_text(text, {}, 0, full + "10 }").at(0);
  EXPECT_EQ(run.column("tie", "normal").back(), 0.0);
  EXPECT_LT(rms_difference(latin, run, "end", "z"), 0.1);
  EXPECT_LT(rms_difference(latin, run, "move", "z"), 0.1);
  EXPECT_LT(drift(run), 1.0);
}

TEST(Explicit, a_moved_support_works_as_with_latin) {
  std::string text = block_deck(R"(
local base = support.fixed{ name = "base", on = block:face "zmin" }
local shake = step.dynamic{ name = "shake", duration = 20*us, dt = 0.1*us, loads = {
  load.base_acceleration{ on = base, direction = { 1, 0, 2 }, history = history.half_sine{ peak = 1e6, duration = 8*us } } } }
problem{ name = "shaken", substructures = { block }, supports = { base }, steps = { shake },
  outputs = { output.resultant{ name = "held", on = base }, output.history{ name = "top", quantity = "velocity", on = block:face "zmax" },
    output.energy{} } }:run{}
)");
  text.replace(text.find(", velocity = { 3, -2, 5 }"), 25, "");
  const DeckRun latin = run_text(text, {}, 0, implicit).at(0),
                run = run_text(text, {}, 0, full + "1, safety = 0.2 }").at(0);
  EXPECT_LT(rms_difference(latin, run, "held", "z"), 0.02);
  EXPECT_LT(rms_difference(latin, run, "top", "x"), 0.02);
  EXPECT_LT(rms_difference(latin, run, "energy", "loads"), 0.02);
  EXPECT_LT(drift(run), 0.5);
}

TEST(Explicit, check_tells_the_substeps_that_the_run_takes) {
  const std::filesystem::path path = std::filesystem::temp_directory_path() / "dygita_test_explicit_check.lua";
  std::ofstream(path) << bar_deck();
  std::string report;
  const Engine engine{run_problem, [&](const Problem& problem) { return report = check_report(problem); }};
  DeckOptions options;
  options.path = path;
  options.solver = "explicit";
  check_deck(options, engine);
  std::filesystem::remove(path);
  const DeckRun run = run_text(bar_deck(), {}, 0, "explicit").at(0);
  const int n = static_cast<int>(run.figure("explicit substeps per step"));
  EXPECT_NE(report.find("in " + std::to_string(n) + " substeps each"), std::string::npos) << report;
}

// A bar that a push at one end makes spin, as it lies and turned with its load. In stiffnesses of single precision a
// turn had forces, like a spring about where it began.
TEST(Explicit, a_free_bar_that_spins_is_the_same_however_it_lies) {
  const std::string bar = R"(
local p = param{ angle = 0, quadratic = 0 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local axis, v = { 0.3, 0.5, 0.812403840463596 }, { 0, 50e6, 0 }
local c, s = math.cos(p.angle), math.sin(p.angle)
local along = axis[1]*v[1] + axis[2]*v[2] + axis[3]*v[3]
local push = {}
for i = 1, 3 do
  local j, k = i % 3 + 1, (i + 1) % 3 + 1
  push[i] = c*v[i] + s*(axis[j]*v[k] - axis[k]*v[j]) + (1 - c)*along*axis[i]
end
local bar = substructure{ name = "bar", material = steel, integration = "explicit", place = { rotate = { axis = axis, angle = p.angle } },
  mesh = mesh.box{ size = { 100*mm, 20*mm, 10*mm }, cells = { 20, 4, 2 }, cell = p.quadratic == 1 and "hex20" or "hex8" } }
local function pulse(peak) return history.half_sine{ peak = peak, duration = 100*us } end
problem{ name = "spin", substructures = { bar }, outputs = { output.energy{} }, steps = { step.dynamic{ name = "spin", duration = 3*ms, dt = 2*us,
  loads = { load.traction{ on = bar:face "xmax", x = pulse(push[1]), y = pulse(push[2]), z = pulse(push[3]) } } } } }:run{}
)";
  for (const std::string quadratic : {"0", "1"}) {
    const DeckRun straight = run_text(bar, {{"quadratic", quadratic}}).at(0);
    const DeckRun turned = run_text(bar, {{"quadratic", quadratic}, {"angle", "0.7"}}).at(0);
    for (const char* column : {"kinetic", "strain", "loads"}) {
      const double one = straight.column("energy", column).back(), other = turned.column("energy", column).back();
      std::cout << "  " << column << ' ' << one << ' ' << other << "\n";
      EXPECT_NEAR(other, one, 1e-4 * straight.column("energy", "strain").back()) << column << quadratic;
    }
  }
}

}  // namespace
}  // namespace dygita::test::explicit_tests
