// Preload by force: against exact solutions, the same shortening prescribed, the monolithic reference, and itself by
// other paths.
#include <gtest/gtest.h>

#include <cmath>

#include "decks/deck_prints.hpp"

namespace dygita::test::preload_tests {
namespace {

constexpr double tolerance = 1e-9;  // static, of LATIN

// A rod beside two sleeves between plates, tightened in two steps (by forces, or by lengths where p.by is given), then
// shocked.
const std::string bolt_deck = R"(
local p = param{ force = 400, second = -1, by = 0, by_second = 0, yield = 1e9, hardening = 5e13, gap = 0, monolithic = 0, explicit = 0, pieces = 1,
  plain = 0, increments = 2, shock = 1, twice = 0 }
local pick = p.monolithic == 1 and solver.monolithic{} or p.explicit == 1 and solver.explicit{}
  or solver.latin{ integration = 'implicit', static_tolerance = 1e-9, tolerance = 1e-8, max_iterations = 4000, pieces = p.pieces, plain = p.plain == 1 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local function box(name, x, w, z, h, cells)
  return substructure{ name = name, material = steel, mesh = mesh.box{ origin = { x, 0, z }, size = { w, 2*mm, h }, cells = cells } }
end
local l = 10*mm
local rod, left, right = box("rod", 4*mm, 2*mm, 0, l, { 2, 2, 5 }), box("left", 0, 4*mm, 0, l, { 4, 2, 5 }), box("right", 6*mm, 4*mm, 0, l, { 4, 2, 5 })
local head, foot = box("head", 0, 10*mm, l, 4*mm, { 10, 2, 2 }), box("foot", 0, 10*mm, -4*mm, 4*mm, { 10, 2, 2 })
local thread = interface.bonded{ name = "thread", between = { foot:face "zmax", rod:face "zmin" } }
local shank  = p.yield > 0 and
  interface.plastic{ name = "shank", between = { rod:face "zmax", head:face "zmin" }, yield = p.yield, hardening = p.hardening } or
  interface.bonded{ name = "shank", between = { rod:face "zmax", head:face "zmin" } }
local function seat(name, a, b, gap) return interface.contact{ name = name, between = { a, b }, friction = 0.2, gap = gap } end
local seats = { seat("left_foot", foot:face "zmax", left:face "zmin", 0), seat("left_head", left:face "zmax", head:face "zmin", p.gap),
  seat("right_foot", foot:face "zmax", right:face "zmin", 0), seat("right_head", right:face "zmax", head:face "zmin", p.gap) }
local base = support.fixed{ name = "base", on = foot:face "zmin" }
local function tighten(name, after, force, by)
  return step.static{ name = name, after = after, increments = p.increments,
    loads = { p.by ~= 0 and load.shortening{ on = shank, by = by } or load.preload{ on = shank, force = force } } }
end
local steps = { tighten("tighten", nil, p.force, p.by) }
if p.second >= 0 then steps[2] = tighten("again", steps[1], p.second, p.by_second) end
if p.shock == 1 then
  steps[#steps + 1] = step.dynamic{ name = "shock", after = steps[#steps], duration = 10*us, dt = 0.2*us, loads = { load.traction{ on = head:face "zmax",
    z = history.half_sine{ peak = 60*MPa, duration = 8*us }, x = history.half_sine{ peak = 10*MPa, duration = 6*us } } } }
end
local one = problem{ name = "bolt", substructures = { rod, left, right, head, foot }, interfaces = { thread, shank, table.unpack(seats) },
  supports = { base }, steps = steps, solver = pick,
  outputs = { output.joint{ name = "bolt", on = shank }, output.resultant{ name = "thread_force", on = thread }, output.joint{ name = "seats", on = seats },
    output.history{ name = "head_motion", quantity = "velocity", on = head:face "zmax" },
    output.history{ name = "head_place", quantity = "displacement", on = head:face "zmax" }, output.energy{} } }
local first = one:run{}
if p.twice == 1 then one:run{ case = "again", start_from = first } end
)";

DeckRun run_bolt(const Settings& settings, int threads = 0) { return run_text(bolt_deck, settings, threads).back(); }

const BoltSummary& bolt_of(const DeckRun& run) { return run.result->bolts.at(0); }

std::string text_of(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

// Largest difference of the named columns over their largest value.
double differ(const DeckRun& a, const DeckRun& b, const std::string& output, const std::vector<std::string>& columns) {
  double scale = 0.0, most = 0.0;
  for (const std::string& name : columns) {
    const std::vector<double>&x = a.column(output, name), &y = b.column(output, name);
    if (x.size() != y.size()) throw std::runtime_error("series of different lengths");
    scale = std::max(scale, largest(x));
    for (size_t i = 0; i < x.size(); ++i) most = std::max(most, std::abs(x[i] - y[i]));
  }
  EXPECT_GT(scale, 0.0) << output;
  std::cout << "  " << output << "." << columns.front() << " differs by " << most / scale << "\n";
  return most / scale;
}

void expect_equal(const DeckRun& a, const DeckRun& b, double within) {
  EXPECT_LT(differ(a, b, "bolt", {"normal", "shear"}), within);
  EXPECT_LT(differ(a, b, "thread_force", {"normal"}), within);
  EXPECT_LT(differ(a, b, "seats", {"normal", "shear"}), within);
  EXPECT_LT(differ(a, b, "head_place", {"x", "y", "z"}), within);
  EXPECT_NEAR(bolt_of(a).shortening, bolt_of(b).shortening, within * std::abs(bolt_of(a).shortening));
}

TEST(PreloadDeck, reaches_every_force_with_the_exact_shortening) {
  const PrintedRun deck = run_printing("verification/preload.lua");
  for (const DeckRun& run : deck.runs) EXPECT_TRUE(run.result->converged);
  for (const char* step : {"1", "2", "3", "4"})
    EXPECT_LT(deck.number(std::string("force asked for in step ") + step), 1e-7);
  for (const char* step : {"1", "2", "4"})
    EXPECT_LT(deck.number(std::string("shortening found in step ") + step), 2e-6);
  EXPECT_LT(deck.number("force after 100 steps"), 2e-6);
  EXPECT_LT(deck.number("force by torque"), 1e-7);
  EXPECT_LT(deck.number("force through a rod that yields"), 1e-7);
  EXPECT_LT(deck.number("its plastic opening"), 1e-6);
  EXPECT_LT(deck.number("force through a gap"), 1e-7);
  EXPECT_LT(deck.number("its shortening, error"), 2e-6);
}

// The shortenings that forces bring, prescribed in their place: the same answer, at about the same cost.
void expect_same_by_length(Settings settings) {
  settings.emplace_back("increments", "1");
  Settings first_only = settings;
  first_only.emplace_back("shock", "0");
  std::erase_if(first_only, [](const auto& s) { return s.first == "second"; });
  const DeckRun by_force = run_bolt(settings), first = run_bolt(first_only);
  EXPECT_TRUE(by_force.result->converged);
  settings.emplace_back("by", text_of(bolt_of(first).shortening));
  settings.emplace_back("by_second", text_of(bolt_of(by_force).shortening));
  const DeckRun by_length = run_bolt(settings);
  expect_equal(by_force, by_length, 1e-6);
  const long iterations = by_force.result->steps.at(0).iterations,
             prescribed = by_length.result->steps.at(0).iterations;
  std::cout << "  iterations by force " << iterations << ", by length " << prescribed << "\n";
  EXPECT_LE(iterations, 2 * prescribed);
}

TEST(Preload, is_the_shortening_that_it_finds) {
  const double near = 400.0 * 100 * tolerance;
  const DeckRun bolt = run_bolt({{"second", "150"}});
  EXPECT_NEAR(bolt_of(bolt).after_static.at(0), 400.0, near);
  EXPECT_NEAR(bolt_of(bolt).after_static.at(1), 150.0, near);
  EXPECT_EQ(bolt_of(bolt).target, 150.0);
  EXPECT_NEAR(bolt.column("bolt", "normal").at(0), 200.0, near);  // half way up
  EXPECT_NEAR(bolt.column("bolt", "normal").at(2), 275.0, near);  // and down
  expect_same_by_length({{"second", "150"}});
}

TEST(Preload, of_a_bonded_bolt_is_the_shortening_that_it_finds) {
  expect_same_by_length({{"yield", "0"}, {"second", "900"}});
}

TEST(Preload, closes_a_gap_first) {
  const DeckRun bolt = run_bolt({{"gap", "2e-6"}, {"shock", "0"}}), closed = run_bolt({{"shock", "0"}});
  EXPECT_TRUE(bolt.result->converged);
  EXPECT_NEAR(bolt_of(bolt).last, 400.0, 400.0 * 100 * tolerance);
  EXPECT_GT(bolt_of(bolt).shortening, bolt_of(closed).shortening + 1.9e-6);
  expect_same_by_length({{"gap", "2e-6"}});
}

TEST(Preload, is_reached_by_a_bolt_that_yields) {
  const DeckRun bolt = run_bolt({{"yield", "80e6"}, {"shock", "0"}});
  EXPECT_TRUE(bolt.result->converged);
  EXPECT_NEAR(bolt_of(bolt).last, 400.0, 400.0 * 100 * tolerance);  // 100 MPa
  EXPECT_GT(bolt_of(bolt).plastic_opening, 0.0);
  expect_same_by_length({{"yield", "80e6"}});
}

TEST(Preload, close_to_a_yield_without_hardening_is_reached) {
  const DeckRun bolt = run_bolt({{"yield", "100e6"}, {"hardening", "0"}, {"force", "399"}, {"shock", "0"}});
  EXPECT_TRUE(bolt.result->converged);
  EXPECT_NEAR(bolt_of(bolt).last, 399.0, 399.0 * 100 * tolerance);
  EXPECT_GT(bolt_of(bolt).plastic_opening, 0.0);
}

TEST(Preload, beyond_a_yield_without_hardening_is_refused_with_the_largest_force) {
  try {
    run_bolt({{"yield", "100e6"}, {"hardening", "0"}, {"force", "401"}});
    FAIL() << "nothing was refused";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("problem 'bolt': step 'tighten': load.preload asks for 401 N through interface.plastic "
                           "'shank', which cannot be "
                           "reached: it yields at 400 N (100 MPa on 4 mm^2) without hardening\n    the largest "
                           "force is below 400 N; or "
                           "give it 'hardening'"),
              std::string::npos)
        << message;
  }
}

// Two cubes one upon the other: nothing holds the upper one against a force between them, also where another load acts
// on it. (Where none does, the check refuses it: tests/wrong_decks.)
TEST(Preload, that_nothing_takes_is_told_with_the_largest_force) {
  for (const char* solver : {"latin", "monolithic"}) {
    try {
      run_text(R"(
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local cube = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 2, 2, 2 } }
local low = substructure{ name = "low", mesh = cube, material = steel }
local high = substructure{ name = "high", mesh = cube, material = steel, place = { 0, 0, 10*mm } }
local glue = interface.bonded{ name = "glue", between = { low:face "zmax", high:face "zmin" } }
local base = support.fixed{ name = "base", on = low:face "zmin" }
local tighten = step.static{ name = "tighten", loads = { load.preload{ on = glue, force = 10*kN }, load.force{ on = high:face "xmax", x = 1 } } }
problem{ name = "nothing", substructures = { low, high }, interfaces = { glue }, supports = { base }, steps = { tighten } }:run{}
)",
               {}, 1, solver);
      FAIL() << "nothing was told";
    } catch (const NumericalError& error) {
      EXPECT_STREQ(error.what(),
                   "step 'tighten', increment 1: load.preload asks for 10000 N through interface.bonded 'glue', and no "
                   "shortening "
                   "gives more than 0 N; likely cause: one of its sides has no reaction path (a part held by this "
                   "interface alone, a joint that cannot close)");
    }
  }
}

TEST(Preload, takes_a_history_and_other_loads_beside_it) {
  const DeckRun run = run_text(R"(
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0, density = 7800 }
local function bar(name, z)
  return substructure{ name = name, material = steel, mesh = mesh.box{ origin = { 0, 0, z }, size = { 10*mm, 10*mm, 20*mm }, cells = { 1, 1, 4 } } }
end
local low, high = bar("low", 0), bar("high", 20*mm)
local joint = interface.bonded{ name = "joint", between = { low:face "zmax", high:face "zmin" } }
local ends = support.fixed{ name = "ends", on = { low:face "zmin", high:face "zmax" } }
local first = step.static{ name = "first", increments = 4, loads = { load.preload{ on = joint, force = function(t) return 8*kN*t*t end } } }
local second = step.static{ name = "second", after = first, increments = 2,
  loads = { load.preload{ on = joint, force = 3*kN }, load.pressure{ on = low:face "xmin", history = 0 } } }
problem{ name = "bar", substructures = { low, high }, interfaces = { joint }, supports = { ends }, steps = { first, second },
  solver = solver.latin{ integration = 'implicit', static_tolerance = 1e-10 }, outputs = { output.joint{ name = "force", on = joint } } }:run{}
)")
                          .at(0);
  const std::vector<double> expected{500, 2000, 4500, 8000, 5500, 3000};
  ASSERT_EQ(run.column("force", "normal").size(), expected.size());
  for (size_t i = 0; i < expected.size(); ++i) EXPECT_NEAR(run.column("force", "normal")[i], expected[i], 1e-5) << i;
  EXPECT_NEAR(bolt_of(run).shortening, 3000.0 * 40e-3 / (210e9 * 100e-6), 1e-12);
}

TEST(Preload, of_zero_loosens_the_bolt) {
  const DeckRun bolt = run_bolt({{"second", "0"}, {"shock", "0"}});
  EXPECT_TRUE(bolt.result->converged);
  EXPECT_NEAR(bolt_of(bolt).last, 0.0, 400.0 * 100 * tolerance);
  EXPECT_NEAR(bolt.column("seats", "normal").back(), 0.0, 400.0 * 1000 * tolerance);
  EXPECT_NEAR(bolt_of(bolt).shortening, 0.0, 1e-7);  // 1.9 um when tight; friction leaves a little
}

TEST(Preload, is_the_same_by_every_path) {
  const Settings settings{{"second", "700"}, {"yield", "120e6"}};
  const auto with = [&](const char* key, const char* value) {
    Settings more = settings;
    more.emplace_back(key, value);
    return more;
  };
  const DeckRun one = run_bolt(settings, 1);
  EXPECT_TRUE(one.result->converged);
  EXPECT_GT(bolt_of(one).plastic_opening, 0.0);
  std::cout << " two threads\n";
  const DeckRun two = run_bolt(settings, 2);
  for (const auto& [output, table] : one.result->tables)  // to the last bit
    for (size_t c = 0; c < table.columns.size(); ++c) EXPECT_EQ(table.columns[c], two.table(output->name).columns[c]);
  std::cout << " plain\n";
  expect_equal(one, run_bolt(with("plain", "1")), 1e-6);
  std::cout << " pieces\n";
  expect_equal(one, run_bolt(with("pieces", "2")), 1e-6);
  std::cout << " start_from\n";
  const DeckRun again = run_bolt(with("twice", "1"));
  expect_equal(one, again, 1e-6);
  EXPECT_LT(again.result->steps.at(0).iterations, one.result->steps.at(0).iterations / 2);
}

TEST(Preload, is_that_of_the_monolithic_reference) {
  for (const Settings& settings : {Settings{{"second", "700"}, {"yield", "120e6"}},
                                   Settings{{"gap", "2e-6"}, {"second", "150"}}, Settings{{"yield", "0"}}}) {
    Settings other = settings;
    other.emplace_back("monolithic", "1");
    const DeckRun latin = run_bolt(settings), monolithic = run_bolt(other);
    EXPECT_TRUE(monolithic.result->converged);
    expect_equal(latin, monolithic, 1e-6);
    EXPECT_LT(differ(latin, monolithic, "head_motion", {"x", "z"}), 1e-6);
    EXPECT_LT(differ(latin, monolithic, "energy", {"kinetic", "strain", "loads", "friction", "plastic"}), 1e-6);
    EXPECT_NEAR(bolt_of(latin).lowest, bolt_of(monolithic).lowest, 1e-6 * 700);
    EXPECT_NEAR(bolt_of(latin).highest, bolt_of(monolithic).highest, 1e-6 * 700);
  }
}

TEST(Preload, is_that_of_the_static_steps_of_the_explicit_solver) {
  const Settings settings{{"yield", "0"}};
  Settings other = settings;
  other.emplace_back("explicit", "1");
  const DeckRun latin = run_bolt(settings), classic = run_bolt(other);
  EXPECT_NEAR(bolt_of(classic).after_static.at(0), 400.0, 1e-6 * 400);
  EXPECT_NEAR(bolt_of(classic).shortening, bolt_of(latin).shortening, 1e-6 * bolt_of(latin).shortening);
  EXPECT_NEAR(classic.column("bolt", "normal").at(2), 400.0, 4.0);  // kept when the shock begins
}

// Bounds on what the heads of the decks say.
TEST(BoltByHand, is_stiffer_than_the_hand_formula_says) {
  const PrintedRun flanges = run_printing("verification/bolt_by_hand.lua");
  const BoltSummary& bolt = flanges.runs.at(0).result->bolts.at(0);
  EXPECT_TRUE(flanges.runs.at(0).result->converged);
  EXPECT_NEAR(bolt.last, 30e3, 1e-3);
  EXPECT_NEAR(bolt.shortening, 60.90e-6, 0.01e-6);
  // Some points at the rim yield, so that the faces are a little less apart; not where nothing yields.
  EXPECT_NEAR(flanges.number("shortening found"), bolt.shortening * 1e6 - 0.05, 0.01);
  const PrintedRun elastic = run_printing("verification/bolt_by_hand.lua", {{"yield", "2000*MPa"}});
  EXPECT_NEAR(elastic.number("shortening found"), elastic.runs.at(0).result->bolts.at(0).shortening * 1e6, 0.01);
  ASSERT_TRUE(bolt.formula && bolt.hand);
  EXPECT_NEAR(bolt.formula->shortening, 68.81e-6, 0.01e-6);
  EXPECT_NEAR(*bolt.hand, 30e3 * bolt.shortening / bolt.formula->shortening, 1e-3);
}

TEST(BoltPattern, loses_force_bolt_by_bolt_and_gets_it_back_in_a_second_pass) {
  const PrintedRun pattern = run_printing("bolt_pattern.lua");
  const RunResult &together = *pattern.runs.at(0).result, &star = *pattern.runs.at(1).result;
  EXPECT_TRUE(together.converged);
  EXPECT_TRUE(star.converged);
  ASSERT_EQ(together.bolts.size(), 6u);
  for (const BoltSummary& bolt : together.bolts) {
    EXPECT_NEAR(bolt.last, 25e3, 1e-3) << bolt.name;
    EXPECT_EQ(bolt.loss(), 0.0) << bolt.name;
  }
  // Tightened first, the bolts in the middle lose most.
  ASSERT_EQ(star.bolts.at(1).after_static.size(), 12u);
  EXPECT_NEAR(star.bolts.at(1).after_static.at(0), 25e3, 1e-3);
  EXPECT_NEAR(star.bolts.at(1).after_static.at(5), 21.345e3, 5.0);
  EXPECT_NEAR(star.bolts.at(4).after_static.at(5), 22.151e3, 5.0);
  for (const int i : {0, 2, 3, 5}) EXPECT_GT(star.bolts.at(i).after_static.at(5), 24.8e3);
  for (const BoltSummary& bolt : star.bolts) {
    EXPECT_EQ(bolt.target, 25e3);
    EXPECT_NEAR(bolt.tightened, 25e3, 1e-3) << bolt.name;
    EXPECT_LT(bolt.loss().value(), 0.005) << bolt.name;
  }
  EXPECT_NEAR(star.bolts.at(1).loss().value(), 0.0042, 0.0002);
}

TEST(Preload, keeps_its_energy_balance) {
  for (const Settings& settings :
       {Settings{{"shock", "0"}}, Settings{{"shock", "0"}, {"yield", "80e6"}}, Settings{{"second", "150"}}})
    EXPECT_LT(run_bolt(settings).figure("energy imbalance [%]"), 1e-4);
}

// The forces along the normals of a cylinder add up to nothing that a bolt could carry; of half of one, to 64 %.
TEST(Preload, of_a_thread_bonded_along_its_cylinder_is_refused_with_the_cure) {
  const std::string screw = "local file = '" DYGITA_SOURCE_DIR R"(/meshes/pin_in_hole.geo'
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local function body(name, k) return substructure{ name = name, material = steel, mesh = mesh.gmsh{ file = file, set = { body = k, n = 6, rim = 30*mm } }:volume(name) } end
local pin, plate = body("pin", 1), body("plate", 2)
local thread = interface.bonded{ name = "thread", between = { pin:face "round", plate:face "hole" } }
local rim, head = support.fixed{ name = "rim", on = plate:face "rim" }, support.wall{ name = "head", on = pin:face "lower" }
local tighten = step.static{ name = "tighten", loads = { load.preload{ on = thread, force = 5*kN } } }
problem{ name = "screw", substructures = { pin, plate }, interfaces = { thread }, supports = { rim, head }, steps = { tighten } }:run{}
)";
  try {
    run_text(screw);
    FAIL() << "not refused";
  } catch (const InputError& error) {
    const std::string said = error.what();
    EXPECT_NE(
        said.find("through interface.bonded 'thread', whose faces turn: normals are up to 83 degrees off their mean, "
                  "with a projected area of 64.4 %"),
        std::string::npos)
        << said;
    EXPECT_NE(said.find("tighten the bolt at a flat section of its shank"), std::string::npos) << said;
  }
}

}  // namespace
}  // namespace dygita::test::preload_tests
