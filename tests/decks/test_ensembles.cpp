// Ensembles: members are what they would be alone, and what they come to is what mathematics says.
#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "decks/deck_prints.hpp"
#include "estimates/scatter.hpp"
#include "files/csv.hpp"

namespace dygita::test::ensembles_tests {
namespace {

// What a deck prints: the number after "name: ".
struct Printed {
  std::string text;
  double operator[](const std::string& name) const { return PrintedRun{{}, text}.number(name); }
};

Printed printed_by(const std::string& deck, const Settings& settings = {}) {
  testing::internal::CaptureStdout();
  try {
    run_text(deck, settings, 1);
  } catch (...) {
    std::cout << testing::internal::GetCapturedStdout();
    throw;
  }
  Printed printed{testing::internal::GetCapturedStdout()};
  if (printed.text.size() < 100000) std::cout << printed.text;
  return printed;
}

// A bar that is hit: linear, so that its spectra have the logarithms of the pulse but for a constant.
const std::string linear_bar = R"(
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0, density = 7800 }
local bar = substructure{ name = "bar", material = steel, mesh = mesh.box{ size = { 100*mm, 10*mm, 10*mm }, cells = { 10, 1, 1 } } }
local a = output.history{ name = "a", on = bar:face "xmin", quantity = "acceleration", direction = { 1, 0, 0 } }
local srs = output.srs{ name = "srs", of = a, q_factor = 10, from = 10*kHz, to = 40*kHz, specification = { { 1*kHz, 1e5 }, { 100*kHz, 1e5 } }, margin = 2 }
local drawn = {}
local function hit(v)
  drawn[#drawn + 1] = { v.peak, v.idle }
  return problem{ name = "bar", substructures = { bar }, outputs = { a, srs },
    steps = { step.dynamic{ name = "hit", duration = 300*us, dt = 1*us,
      loads = { load.pressure{ on = bar:face "xmax", history = history.half_sine{ peak = v.peak, duration = 20*us } } } } } }
end
local r = ensemble{ n = 12, seed = 3, vary = { peak = lognormal(50, 0.3)*MPa, idle = uniform(0, 1) }, of = hit }:run{}
)";

TEST(Ensemble, the_limit_of_a_linear_bar_is_that_of_its_pulse) {
  const Printed printed = printed_by(linear_bar + R"(
local logs = {}
for i = 1, #r do print(("peak %d: %.17g"):format(i, drawn[i][1])) end
for i, f in ipairs{ 10*kHz, 20*kHz, 40*kHz } do
  print(("base %d: %.17g"):format(i, r[1][srs].maximax:at(f) / drawn[1][1]))
  print(("limit %d: %.17g"):format(i, r[srs].p95_50:at(f)))
  print(("median %d: %.17g"):format(i, r[srs].median:at(f)))
  print(("highest %d: %.17g"):format(i, r[srs].maximax.highest:at(f)))
  print(("spread %d: %.17g"):format(i, r[srs].spread:at(f)))
  print(("mu %d: %.17g"):format(i, r.drives[srs].peak:at(f)))
end
print(("driver is peak: %d"):format(r.drives[srs][1].parameter == "peak" and 1 or 0))
print(("correlation of it: %.17g"):format(r.drives[srs][1].correlation))
print(("sample: %.17g, how many: %d"):format(r[a].max:quantile(1) / r[a].max.max, #r))
)");
  std::vector<double> logs, peaks;
  for (int i = 1; i <= 12; ++i) {
    peaks.push_back(printed["peak " + std::to_string(i)]);
    logs.push_back(std::log(peaks.back()));
  }
  // Each of twelve strata of the logarithm once: its mean is the median's within a third of a stratum.
  EXPECT_NEAR(sample_mean(logs), std::log(50e6), 0.03);
  for (const std::string i : {"1", "2", "3"}) {
    const double base = printed["base " + i];
    EXPECT_NEAR(
        printed["limit " + i] / (base * std::exp(sample_mean(logs) + tolerance_factor(12) * sample_deviation(logs))),
        1.0, 1e-6);
    EXPECT_NEAR(printed["median " + i] / (base * sample_quantile(peaks, 0.5)), 1.0, 1e-6);
    EXPECT_NEAR(printed["highest " + i] / (base * sample_quantile(peaks, 1.0)), 1.0, 1e-6);
    EXPECT_NEAR(printed["spread " + i], 20.0 / std::log(10.0) * sample_deviation(logs), 1e-5);
    EXPECT_NEAR(printed["mu " + i], 1.0, 1e-12);
  }
  EXPECT_EQ(printed["driver is peak"], 1.0);
  EXPECT_NEAR(printed["correlation of it"], 1.0, 1e-12);
  EXPECT_EQ(printed["sample"], 1.0);
  EXPECT_EQ(printed["how many"], 12.0);
  EXPECT_NE(printed.text.find("P95/50 exceeds its specification by"), std::string::npos);
  EXPECT_NE(printed.text.find("2 dB of margin are asked for, which it misses"), std::string::npos);
  EXPECT_NE(printed.text.find("100 % of the spread there is peak"), std::string::npos);
}

// Two blocks pressed together and shaken: each member again alone, at the parameters that it drew.
const std::string blocks = R"(
local p = param{ explicit = 0 }
local metal = material.elastic{ name = "metal", young = 70*GPa, poisson = 0.3, density = 2700 }
local function block(name, z) return substructure{ name = name, material = metal,
  mesh = mesh.box{ size = { 20*mm, 20*mm, 10*mm }, cells = { 4, 4, 2 }, origin = { 0, 0, z } } } end
local low, up = block("low", 0), block("up", 10*mm)
local drawn, of_members, j = {}, {}, nil
local function joint(v)
  local c = interface.contact{ name = "c", between = { low:face "zmax", up:face "zmin" }, friction = v.mu }
  local clamp = load.pressure{ on = up:face "zmax", history = v.clamp }
  local press = step.static{ name = "press", loads = { clamp } }
  local shake = step.dynamic{ name = "shake", after = press, duration = 60*us, dt = 1*us,
    loads = { clamp, load.traction{ on = up:face "zmax", x = history.half_sine{ peak = 0.4*v.clamp, duration = 40*us } } } }
  j = output.joint{ name = "j", on = c }
  of_members[#of_members + 1] = j
  drawn[#drawn + 1] = { mu = v.mu, clamp = v.clamp }
  return problem{ name = "blocks", substructures = { low, up }, interfaces = { c }, supports = { support.fixed{ name = "base", on = low:face "zmin" } },
    steps = { press, shake }, outputs = { j, output.energy{} },
    solver = solver.latin{ tolerance = 1e-8, static_tolerance = 1e-10, integration = p.explicit == 1 and "explicit" or "implicit" } }
end
local r = ensemble{ n = 5, seed = 2, vary = { mu = uniform(0.1, 0.4), clamp = normal(20, 4)*MPa }, of = joint }:run{}
for i = 1, #r do
  local alone = joint(drawn[i]):run{ case = "alone " .. i }
  local worst = 0
  for _, column in ipairs{ "normal", "shear", "slip", "friction_work" } do
    local a, b, size = r[i][of_members[i]][column], alone[j][column], 0
    for row = 1, #b do size = math.max(size, math.abs(b[row])) end
    for row = 1, #b do worst = math.max(worst, math.abs(a[row] - b[row]) / size) end
  end
  print(("worst %d: %.3g"):format(i, worst))
  print(("slip %d: %.6g, own: %.6g"):format(i, alone[j].slip.last, drawn[i].mu))
end
print(("slips of members: %.6g"):format(r[j].slip.last.max - r[j].slip.last.min))
print(("median of slips: %.6g, by rows: %.6g"):format(r[j].slip.last.median, r[j].slip.median.last))
)";

void expect_members_alone(const Printed& printed) {
  for (int i = 1; i <= 5; ++i) EXPECT_LT(printed["worst " + std::to_string(i)], 1e-5) << i;
  EXPECT_GT(printed["slips of members"], 1e-8);  // they do differ
  EXPECT_NEAR(printed["median of slips"] / printed["by rows"], 1.0, 1e-5);
}

TEST(Ensemble, each_member_is_what_it_is_alone) { expect_members_alone(printed_by(blocks)); }

TEST(Ensemble, each_explicit_member_is_what_it_is_alone) {
  expect_members_alone(printed_by(blocks, {{"explicit", "1"}}));
}

// The same members twice: side by side, and with files of their own and therefore one after the other.
const std::string both_ways = R"(
local p = param{ explicit = 0, window = 0, most = 0, n = 7 }
local metal = material.elastic{ name = "metal", young = 70*GPa, poisson = 0.3, density = 2700 }
local function block(name, z) return substructure{ name = name, material = metal,
  mesh = mesh.box{ size = { 20*mm, 20*mm, 10*mm }, cells = { 6, 6, 3 }, origin = { 0, 0, z } } } end
local low, up = block("low", 0), block("up", 10*mm)
local j
local function joint(v)
  local c = interface.contact{ name = "c", between = { low:face "zmax", up:face "zmin" }, friction = v.mu }
  local clamp = load.pressure{ on = up:face "zmax", history = v.clamp }
  local press = step.static{ name = "press", loads = { clamp } }
  local shake = step.dynamic{ name = "shake", after = press, duration = 60*us, dt = 1*us,
    loads = { clamp, load.traction{ on = up:face "zmax", x = history.half_sine{ peak = 0.4*v.clamp, duration = 40*us } } } }
  j = output.joint{ name = "j", on = c }
  return problem{ name = "blocks", substructures = { low, up }, interfaces = { c }, supports = { support.fixed{ name = "base", on = low:face "zmin" } },
    steps = { press, shake }, outputs = { j, output.energy{} },
    solver = solver.latin{ tolerance = 1e-7, static_tolerance = 1e-9, integration = p.explicit == 1 and "explicit" or "implicit",
      window = p.window > 0 and p.window or nil, max_iterations = p.most > 0 and p.most or nil } }
end
local function members(case, by_themselves)
  local js = {}
  local r = ensemble{ n = p.n, seed = 2, vary = { mu = uniform(0.1, 0.4), clamp = normal(20, 4)*MPa },
    of = function(v) local own = joint(v); js[#js + 1] = j; return own end }:run{ case = case, members = by_themselves }
  return r, js
end
local together, js = members "together"
local alone, ja = members("alone", true)
local worst = 0
for i = 1, #alone do
  if alone[i].converged ~= together[i].converged then print "one converges, the other does not: 1" end
  for _, column in ipairs{ "normal", "shear", "slip", "friction_work" } do
    local a, b, size = together[i][js[i]][column], alone[i][ja[i]][column], 0
    for row = 1, #b do size = math.max(size, math.abs(b[row])) end
    for row = 1, #b do worst = math.max(worst, math.abs(a[row] - b[row]) / size) end
  end
end
local n = 0
for i = 1, #alone do n = n + (alone[i].converged and 1 or 0) end
print(("worst: %.3g"):format(worst))
print(("worst, with converged: %d"):format(n))
)";

double compare_ways(const Settings& settings, double converged = 7.0) {
  const Printed printed = printed_by(both_ways, settings);
  EXPECT_EQ(printed.text.find("one converges"), std::string::npos);
  EXPECT_EQ(printed["worst, with converged"], converged);
  return printed["worst"];
}

// To the tolerance, and not to the bits: sums of products are taken in another order.
TEST(Ensemble, members_side_by_side_are_what_they_are_one_after_the_other) {
  const double worst = compare_ways({});
  EXPECT_LT(worst, 1e-5);
  EXPECT_GT(worst, 0.0);
}

TEST(Ensemble, members_side_by_side_go_through_windows) { EXPECT_LT(compare_ways({{"window", "4"}}), 1e-5); }

TEST(Ensemble, explicit_members_side_by_side_are_what_they_are_one_after_the_other) {
  EXPECT_LT(compare_ways({{"explicit", "1"}}), 1e-5);
}

TEST(Ensemble, more_members_than_are_solved_together_are_what_they_are_one_after_the_other) {
  EXPECT_LT(compare_ways({{"n", "19"}}, 19.0), 1e-5);
}

TEST(Ensemble, draws_for_each_item_of_a_list_and_of_lists_and_corners) {
  const std::string start = R"(
local cube = substructure{ name = "cube", material = material.elastic{ name = "m", young = 200*GPa, poisson = 0, density = 7800 },
  mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } } }
local u = output.history{ name = "u", on = cube:face "zmax", quantity = "displacement", direction = { 0, 0, 1 } }
local function of(pressure)
  return problem{ name = "cube", substructures = { cube }, supports = { support.fixed{ name = "base", on = cube:face "zmin" } }, outputs = { u },
    steps = { step.static{ name = "push", loads = { load.pressure{ on = cube:face "zmax", history = pressure } } } } }
end
)";
  const Printed each = printed_by(start + R"(
local r = ensemble{ n = 4, vary = { p = { uniform(1, 2)*MPa, each = { "a", "b", "c" } }, q = { 1, 3 } },
  of = function(v) return of((v.p[1] + v.p[2] + v.p[3]) * v.q) end }:run{}
print(("lowest: %.9g, highest: %.9g"):format(-r[u].last.max / (10*mm) * 200*GPa, -r[u].last.min / (10*mm) * 200*GPa))
print(r.drives[u])
)");
  EXPECT_GT(each["lowest"], 3e6);
  EXPECT_LT(each["lowest"], 6e6);
  EXPECT_GT(each["highest"], 9e6);
  EXPECT_LT(each["highest"], 18e6);
  EXPECT_NE(each.text.find("u.displacement largest: q, rank correlation"), std::string::npos);
  const Printed corners = printed_by(start + R"(
local r = ensemble{ method = "corners", vary = { a = uniform(1, 2)*MPa, b = triangular(1, 2, 5) }, of = function(v) return of(v.a * v.b) end }:run{}
print(("lowest: %.9g, highest: %.9g, how many: %d"):format(-r[u].last.max / (10*mm) * 200*GPa, -r[u].last.min / (10*mm) * 200*GPa, #r))
)");
  EXPECT_NEAR(corners["lowest"], 1e6, 1.0);
  EXPECT_NEAR(corners["highest"], 10e6, 10.0);
  EXPECT_EQ(corners["how many"], 4.0);
}

// An oscillator whose levels are lognormal: 95 % of all units stay below unit exp(1.645 sigma), and half of all
// ensembles have a P95/50 above that.
TEST(Ensemble, half_of_five_hundred_limits_are_above_the_level_of_95_percent) {
  const Printed printed = printed_by(R"(
local cube = substructure{ name = "cube", material = material.elastic{ name = "m", young = 200*GPa, poisson = 0, density = 7800 },
  mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } } }
local base = support.fixed{ name = "base", on = cube:face "xmin" }
local a = output.history{ name = "a", on = cube:face "xmax", quantity = "acceleration", direction = { 1, 0, 0 } }
local srs = output.srs{ name = "srs", of = a, q_factor = 10, from = 50*kHz, to = 100*kHz }
local drawn
local function hit(v)
  drawn = v.peak
  return problem{ name = "cube", substructures = { cube }, supports = { base }, outputs = { a, srs },
    steps = { step.dynamic{ name = "hit", duration = 20*us, dt = 1*us, loads = { load.pressure{ on = cube:face "xmax", history = v.peak } } } } }
end
local covered, n = 0, 5
for i = 1, 500 do
  local r = ensemble{ n = n, seed = i, method = "random", vary = { peak = lognormal(1, 0.3)*MPa }, of = hit }:run{ case = "e" .. i }
  local truth = r[n][srs].maximax:at(70*kHz) / drawn * 1*MPa * math.exp(0.3 * 1.6448536269514722)
  if r[srs].p95_50:at(70*kHz) >= truth then covered = covered + 1 end
end
print(("covered: %d"):format(covered))
)");
  const double deviation = std::sqrt(500 * 0.25);
  EXPECT_NEAR(printed["covered"], 250.0, 3.5 * deviation);
}

// A folder of its own, where a deck runs as a user runs it.
std::filesystem::path own_folder() {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("dygita_ensemble_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  return folder;
}

DeckOutcome run_in(const std::filesystem::path& folder, const std::string& text) {
  std::ofstream(folder / "bar.lua") << text;
  set_progress_enabled(false);
  DeckOptions options;
  options.path = folder / "bar.lua";
  options.out = folder / "out";
  options.threads = 1;
  return run_deck(options, Engine{run_problem, check_report});
}

// What a smaller ensemble of other outputs leaves of the one before: nothing but what somebody else put there.
TEST(Ensemble, leaves_nothing_of_an_earlier_one_in_its_folder) {
  const std::filesystem::path folder = own_folder(), out = folder / "out" / "cube";
  const auto run = [&](const std::string& how) {
    run_in(folder, R"(
local cube = substructure{ name = "cube", material = material.elastic{ name = "m", young = 200*GPa, poisson = 0, density = 7800 },
  mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } } }
local function ensemble_of(n, name)
  local u = output.history{ name = name, on = cube:face "zmax", quantity = "displacement", direction = { 0, 0, 1 } }
  return ensemble{ n = n, vary = { p = uniform(1, 2)*MPa }, of = function(v) return problem{ name = "cube", substructures = { cube },
    supports = { support.fixed{ name = "base", on = cube:face "zmin" } }, outputs = { u },
    steps = { step.static{ name = "push", loads = { load.pressure{ on = cube:face "zmax", history = v.p } } } } } end }
end
)" + how);
  };
  run("ensemble_of(12, 'u'):run{ members = true }");
  EXPECT_TRUE(std::filesystem::exists(out / "ensemble" / "u.csv"));
  EXPECT_TRUE(std::filesystem::exists(out / "ensemble_12" / "run.json"));
  EXPECT_TRUE(std::filesystem::exists(out / "ensemble_07" / "run.json"));
  std::ofstream(out / "ensemble_12" / "notes.txt") << "mine";
  std::ofstream(out / "ensemble" / "notes.txt") << "mine";
  run("ensemble_of(11, 'w'):run{ members = true }");
  EXPECT_FALSE(std::filesystem::exists(out / "ensemble" / "u.csv"));
  EXPECT_TRUE(std::filesystem::exists(out / "ensemble" / "w.csv"));
  EXPECT_TRUE(std::filesystem::exists(out / "ensemble" / "notes.txt"));
  EXPECT_TRUE(std::filesystem::exists(out / "ensemble_07" / "run.json"));
  EXPECT_FALSE(std::filesystem::exists(out / "ensemble_12" / "run.json"));
  EXPECT_TRUE(std::filesystem::exists(out / "ensemble_12" / "notes.txt"));
  run("ensemble_of(3, 'w'):run{}");
  EXPECT_FALSE(std::filesystem::exists(out / "ensemble_07"));
  std::filesystem::remove_all(folder);
}

// What a continued ensemble reads back of members that ran before is what an uninterrupted one counts.
TEST(Ensemble, counts_what_the_tables_of_its_members_have) {
  const std::filesystem::path folder = own_folder();
  std::string deck = linear_bar;
  deck.replace(deck.rfind(":run{}"), 6, ":run{ members = true }");
  testing::internal::CaptureStdout();
  run_in(folder, deck + R"(
for _, f in ipairs{ 10*kHz, 20*kHz, 40*kHz } do print(("limit %d: %.17g"):format(f, r[srs].p95_50:at(f))) end
for i = 1, #r do print(("largest %d: %.17g"):format(i, r[i][a].max)) end
print(("of all members: %.17g"):format(r[a].max.max))
)");
  const Printed printed{testing::internal::GetCapturedStdout()};
  std::vector<Table> spectra;
  std::vector<const std::vector<double>*> columns;
  double highest = 0.0;
  for (int i = 1; i <= 12; ++i) {
    const std::filesystem::path member = folder / "out" / "bar" / fmt::format("ensemble_{:02}", i);
    spectra.push_back(read_csv(member / "srs.csv", {}));
    const std::vector<double> a = read_csv(member / "a.csv", {"hit"}).column("acceleration");
    const double largest = *std::max_element(a.begin(), a.end());
    EXPECT_EQ(printed["largest " + std::to_string(i)], largest);
    highest = std::max(highest, largest);
  }
  EXPECT_EQ(printed["of all members"], highest);
  for (const Table& table : spectra) columns.push_back(&table.column("maximax"));
  const std::vector<double>& at = spectra[0].columns[0];
  const Table limits =
      scatter_of({"frequency", "Hz"}, at, {}, columns, {"maximax", "m/s^2"}, true, tolerance_factor(12));
  for (const double f : {10e3, 20e3, 40e3})
    for (size_t row = 0; row < at.size(); ++row)
      if (std::abs(at[row] - f) < 1e-6 * f) {
        EXPECT_EQ(printed[fmt::format("limit {:.0f}", f)], limits.column("p95_50")[row]) << f;
      }
  std::filesystem::remove_all(folder);
}

// A stop that half of the units reach: their spectra are 40 dB above those of the others.
TEST(Ensemble, of_two_regimes_is_told_with_its_groups) {
  const auto ensemble_of = [](const std::string& peak) {
    std::string deck = linear_bar;
    deck.replace(deck.find("lognormal(50, 0.3)*MPa"), 22, peak);
    return deck;
  };
  const auto warnings_of = [](const std::string& deck) {
    testing::internal::CaptureStderr();
    printed_by(deck);
    return testing::internal::GetCapturedStderr();
  };
  const std::string two = warnings_of(ensemble_of("{ 1*MPa, 1.1*MPa, 1.2*MPa, 1e8, 1.1e8, 1.2e8 }"));
  EXPECT_NE(two.find("spectrum 'srs': 6 of 12 members lie 38 dB or more above the others at "), std::string::npos)
      << two;
  EXPECT_NE(two.find("(there are two groups from 10 kHz to 40 kHz): two regimes"), std::string::npos) << two;
  EXPECT_NE(two.find("dB above all members"), std::string::npos) << two;
  const std::string one = warnings_of(ensemble_of("lognormal(50, 1.5)*MPa"));
  EXPECT_EQ(one.find("regimes"), std::string::npos) << one;
}

// As a run that does not converge: no fault of the deck.
TEST(Ensemble, without_a_member_that_converged_says_so_and_ends_the_deck) {
  const std::filesystem::path folder = own_folder();
  std::string deck = blocks.substr(0, blocks.find("for i = 1, #r"));
  deck.replace(deck.find("tolerance = 1e-8"), 16, "max_iterations = 2, tolerance = 1e-8");
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  const DeckOutcome outcome = run_in(folder, deck + "print(r[j].slip.last.median)\nprint 'not reached'");
  const std::string warned = testing::internal::GetCapturedStderr(), said = testing::internal::GetCapturedStdout();
  EXPECT_EQ(outcome.not_converged.size(), 5u);
  EXPECT_NE(warned.find("the deck ends here: bar.lua:"), std::string::npos) << warned;
  EXPECT_NE(warned.find("none of the 5 members of ensemble 'ensemble' converged, so it has no statistics"),
            std::string::npos)
      << warned;
  EXPECT_EQ(said.find("not reached"), std::string::npos);
  std::filesystem::remove_all(folder);
}

// Of twelve members a correlation of what has no influence says nothing.
TEST(Ensemble, tells_what_drives_from_what_is_not_distinguishable_from_none) {
  const Printed printed = printed_by(linear_bar + R"(
print(r.drives[srs])
for _, drive in ipairs(r.drives[srs]) do print(("%s is clear: %d"):format(drive.parameter, drive.clear and 1 or 0)) end
)");
  EXPECT_EQ(printed["peak is clear"], 1.0);
  EXPECT_EQ(printed["idle is clear"], 0.0);
  EXPECT_NE(printed.text.find("), not distinguishable from none"), std::string::npos);
  EXPECT_NE(printed.text.find("rank correlation 1.00 ("), std::string::npos);
}

// Along y the bar moves by rounding, whose ranks go with the pulse that scales it.
TEST(Ensemble, finds_no_driver_of_rounding) {
  std::string deck = linear_bar;
  deck.replace(deck.find("poisson = 0,"), 12, "poisson = 0.3,");
  deck.replace(deck.find("outputs = { a, srs }"), 20, "outputs = { a, srs, d }");
  deck.replace(deck.find("local drawn"), 11,
               R"(local d = output.history{ name = "d", on = bar:face "xmin", quantity = "displacement" }
local drawn)");
  const Printed printed = printed_by(deck + R"(
for _, drive in ipairs(r.drives[d]) do print(("of %s: %d"):format(drive.figure, 1)) end
)");
  EXPECT_NE(printed.text.find("of d.x largest: 1"), std::string::npos);
  EXPECT_EQ(printed.text.find("of d.y"), std::string::npos);
}

// Twelve members warn of the end of their records, each with its own frequencies and velocities.
TEST(Ensemble, shows_warnings_of_members_that_differ_by_numbers_once) {
  testing::internal::CaptureStderr();
  const Printed printed = printed_by(linear_bar);
  const std::string warnings = testing::internal::GetCapturedStderr(), of_record = "depends on where its record ends";
  const size_t first = warnings.find(of_record);
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(warnings.find(of_record, first + 1), std::string::npos);
  EXPECT_NE(printed.text.find("differ from those above by numbers alone are not shown"), std::string::npos);
}

TEST(Ensemble, writes_its_statistics) {
  const std::filesystem::path folder = own_folder();
  run_in(folder, linear_bar);
  const std::filesystem::path own = folder / "out" / "bar" / "ensemble";
  const auto lines = [&](const char* name) {
    std::ifstream file(own / name);
    std::vector<std::string> all;
    for (std::string line; std::getline(file, line);) all.push_back(line);
    return all;
  };
  EXPECT_EQ(lines("srs.csv").at(0).rfind("frequency [Hz],maximax median [m/s^2],maximax lowest [m/s^2],maximax highest "
                                         "[m/s^2],maximax p95_50 [m/s^2],maximax spread [dB],positive median [m/s^2]",
                                         0),
            0u);
  EXPECT_EQ(lines("srs_drives.csv").at(0), "frequency [Hz],idle,peak");
  EXPECT_EQ(lines("a.csv").at(0),
            "time [s],step,acceleration median [m/s^2],acceleration lowest [m/s^2],acceleration highest [m/s^2]");
  EXPECT_EQ(lines("ensemble_members.csv").size(), 13u);
  EXPECT_EQ(lines("ensemble_members.csv").at(0).rfind("member,idle,peak,", 0), 0u);
  EXPECT_EQ(lines("ensemble_drives.csv").at(0), "figure,parameter,rank_correlation,lowest,highest,share,clear");
  EXPECT_NE(lines("srs.svg").at(0).find("<svg"), std::string::npos);
  std::ostringstream page;
  page << std::ifstream(own / "report.html").rdbuf();
  for (const char* text :
       {"12 members (latin hypercube, seed 3)", "spectrum &#39;srs&#39;: P95/50 exceeds its specification by",
        "P95/50 is mean + 1.69 deviations of the logarithms of 12 members", "<td>a.acceleration largest</td>",
        "% of the spread is peak (rank correlation 1.00", "<td>ensemble_12</td>"})
    EXPECT_NE(page.str().find(text), std::string::npos) << text;
  std::ostringstream record;
  record << std::ifstream(own / "ensemble.json").rdbuf();
  EXPECT_NE(record.str().find("\"method\": \"latin hypercube\""), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "out" / "bar" / "ensemble_01"));  // members on request only
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace dygita::test::ensembles_tests
