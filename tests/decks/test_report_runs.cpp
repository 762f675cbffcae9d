// Reports of real runs of every kind: each gives a sensible page, and watching for it changes no number.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

#include "base/log.hpp"
#include "decks/engine.hpp"
#include "drawing/svg_checks.hpp"
#include "report/report.hpp"

namespace dygita::test::report_runs_tests {
namespace {

namespace fs = std::filesystem;

// Two blocks pressed together; `steps`, `solver` and more outputs from the test.
std::string blocks(const std::string& steps, const std::string& more = "") {
  return R"(
local p = param{ n = 2 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local function block(name, z) return substructure{ name = name, material = steel,
  mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, origin = { 0, 0, z }, cells = { p.n, p.n, p.n } } } end
local low, high = block("low", 0), block("high", 10*mm)
local touch = interface.contact{ name = "touch", between = { low:face "zmax", high:face "zmin" }, friction = 0.2 }
local base = support.fixed{ name = "base", on = low:face "zmin" }
local guide = support.symmetry{ name = "guide", on = { high:face "xmin", high:face "ymin" } }
local a = output.history{ name = "top", on = high:face "zmax", quantity = "acceleration", direction = { 0, 0, 1 } }
local outputs = { a, output.joint{ name = "grip", on = touch }, output.energy{} }
local press = step.static{ name = "press", increments = 2, loads = { load.pressure{ on = high:face "zmax", history = 20*MPa } } }
local function hit(name, after, duration) return step.dynamic{ name = name, after = after, duration = duration, dt = 0.5*us, loads = {
  load.pressure{ on = high:face "zmax", history = 20*MPa },
  load.traction{ on = high:face "zmax", z = history.half_sine{ peak = 60*MPa, duration = 10*us } } } } end
)" + steps +
         more +
         R"(
problem{ name = "blocks", substructures = { low, high }, interfaces = { touch }, supports = { base, guide }, steps = steps, solver = how, outputs = outputs }:run{}
)";
}

struct Written {
  std::shared_ptr<const RunResult> result, unwatched;  // with files and without
  std::string page, record;
  std::vector<OutputPtr> outputs;  // the results' keys, which go with the deck
};

using Look = std::function<void(const fs::path& run_folder)>;

Written run_and_read(const std::string& text, const std::string& solver = "", const Look& look = {}) {
  set_progress_enabled(false);
  const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
  const fs::path folder = fs::temp_directory_path() / ("dygita_report_" + test + "_" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "deck.lua") << text;
  Written written;
  DeckOptions options;
  options.path = folder / "deck.lua";
  options.out = folder / "out";
  options.solver = solver;
  const Engine engine{[&](const Problem& problem, const RunRequest& request) {
                        RunRequest quiet = request;
                        quiet.write_files = false;
                        written.outputs = problem.outputs;
                        written.unwatched = run_problem(problem, quiet);
                        return written.result = run_problem(problem, request);
                      },
                      check_report};
  run_deck(options, engine);
  for (const auto& entry : fs::recursive_directory_iterator(options.out)) {
    std::ifstream file(entry.path(), std::ios::binary);
    if (entry.path().filename() == "report.html") written.page = {std::istreambuf_iterator<char>(file), {}};
    if (entry.path().filename() == "run.json" && look) look(entry.path().parent_path());
    if (entry.path().filename() == "run.json") written.record = {std::istreambuf_iterator<char>(file), {}};
  }
  fs::remove_all(folder);
  return written;
}

void expect_sound(const Written& written) {
  ASSERT_FALSE(written.page.empty());
  EXPECT_EQ(xml_fault(written.page, {"meta"}), "");
  EXPECT_LT(written.page.size(), 1000000u);
  EXPECT_EQ(written.page.find("is left out"), std::string::npos);
  for (const char* section : {"<h2>Verdict", "<h2>What was computed", "<h2>The assembly", "<h2>Joints", "<h2>Energy",
                              "<h2>Convergence", "<h2>Cost"})
    EXPECT_NE(written.page.find(section), std::string::npos) << section;
  // To the last bit: the recorder only looks.
  EXPECT_EQ(written.result->iterations, written.unwatched->iterations);
  for (auto a = written.result->tables.begin(), b = written.unwatched->tables.begin();
       a != written.result->tables.end(); ++a, ++b)
    EXPECT_EQ(a->second.columns, b->second.columns) << a->first->name;
}

const std::string latin = "local how = solver.latin{}\n";

TEST(ReportRuns, tightened_and_shocked_with_a_specification) {
  const Written run =
      run_and_read(blocks(latin + "local shock = hit('shock', press, 30*us) local steps = { press, shock }\n",
                          "outputs[#outputs + 1] = output.srs{ name = 's', of = a, from = 1*kHz, to = 100*kHz, "
                          "specification = { {1*kHz, 10*g0}, {100*kHz, 10*g0} } }\n"));
  expect_sound(run);
  const std::string label = "\"largest exceedance of the specification of 's' [dB]\": ";
  ASSERT_NE(run.record.find(label), std::string::npos);
  const double exceedance = std::stod(run.record.substr(run.record.find(label) + label.size()));
  const Table* spectrum = nullptr;
  for (const auto& [output, table] : run.result->tables)
    if (output->name == "s") spectrum = &table;
  ASSERT_NE(spectrum, nullptr);
  double highest = 0.0;  // of what 30 us can tell: 33 kHz and more
  for (size_t i = 0; i < spectrum->columns[0].size(); ++i)
    if (spectrum->columns[0][i] > 1.0 / 30e-6) highest = std::max(highest, spectrum->column("maximax")[i]);
  EXPECT_NEAR(exceedance, 20.0 * std::log10(highest / 98.0665), 1e-9);
  EXPECT_NE(run.page.find("Of the specification not judged: 1\u00a0kHz to 33.3\u00a0kHz"), std::string::npos);
  EXPECT_NE(run.page.find("exceeds its specification by up to +"), std::string::npos);
  EXPECT_NE(run.page.find("End of step &#39;press&#39;"), std::string::npos);
  EXPECT_NE(run.page.find("The largest strain energy in the motion, step &#39;shock&#39;"), std::string::npos);
}

TEST(ReportRuns, shows_what_the_joint_takes_and_its_loop) {
  const Written run =
      run_and_read(blocks(latin + "local shock = hit('shock', press, 30*us) local steps = { press, shock }\n", R"(
local b = output.history{ name = "behind", on = low:face "xmax", quantity = "acceleration", direction = { 0, 0, 1 } }
for _, one in ipairs{ b, output.attenuation{ name = "taken", entering = a, leaving = b, from = 50*kHz, to = 400*kHz },
  output.srs{ name = "pseudo", of = a, quantity = "pseudo_velocity", damping = 0, from = 50*kHz, to = 400*kHz },
  output.loop{ name = "loop", on = touch, direction = { 0, 0, 1 } } } do outputs[#outputs + 1] = one end
)"));
  expect_sound(run);
  for (const char* part :
       {"<h2>Through the joint", "taken: from top to behind", "<h2>Condensed models", "pseudo (undamped)",
        "maximax pseudo-velocity (", "shaded: uncertainty from iteration, time step and mesh"})
    EXPECT_NE(run.page.find(part), std::string::npos) << part;
}

// Three spectra; a specification is held against those it is meant for.
TEST(ReportRuns, are_held_against_the_specification_of_each_spectrum_by_its_name) {
  const auto flat = [](double level) {
    return std::make_shared<const Specification>(Specification{{1e3, 1e5}, {level, level}, "flat.csv"});
  };
  const auto verdicts = [](const std::string& page) {
    std::string found;
    for (const char* name : {"s", "t", "u"})
      if (page.find("Spectrum &#39;" + std::string(name) + "&#39;") != std::string::npos) found += name;
    return found;
  };
  const auto held = [&](const fs::path& folder, const std::map<std::string, std::shared_ptr<const Specification>>& by) {
    take_warnings();
    return verdicts(report_html(folder, {"", by}));
  };
  const std::string three = R"(
for i, name in ipairs{ "s", "t", "u" } do
  outputs[#outputs + 1] = output.srs{ name = name, of = a, from = 40*kHz, to = 100*kHz, specification = i == given and { {1*kHz, 1000*g0}, {100*kHz, 1000*g0} } or nil }
end
)";
  const std::string steps = latin + "local shock = hit('shock', press, 30*us) local steps = { press, shock }\n";
  run_and_read(blocks(steps, "local given = 2\n" + three), "", [&](const fs::path& folder) {
    EXPECT_EQ(held(folder, {}), "t");
    EXPECT_EQ(held(folder, {{"", flat(1.0)}}), "t");
    EXPECT_EQ(held(folder, {{"u", flat(1.0)}}), "tu");
    EXPECT_TRUE(take_warnings().empty());
    EXPECT_THROW(held(folder, {{"v", flat(1.0)}}), InputError);
  });
  run_and_read(blocks(steps, "local given = 0\n" + three), "", [&](const fs::path& folder) {
    EXPECT_EQ(held(folder, {{"u", flat(1.0)}}), "u");
    EXPECT_EQ(held(folder, {{"", flat(1.0)}}), "stu");
    const std::vector<std::string> said = take_warnings();
    ASSERT_EQ(said.size(), 1u);
    EXPECT_EQ(said[0].find("the specification is compared with every spectrum of the run, 's', 't', 'u'"), 0u)
        << said[0];
  });
}

TEST(ReportRuns, only_static) {
  const Written run = run_and_read(blocks(latin + "local steps = { press }\n"));
  expect_sound(run);
  EXPECT_NE(run.page.find("iteration error"), std::string::npos);
  EXPECT_EQ(run.page.find("largest strain energy in the motion"), std::string::npos);
}

TEST(ReportRuns, one_dynamic_increment) {
  const Written run = run_and_read(blocks(latin + "local steps = { hit('once', nil, 0.5*us) }\n"));
  expect_sound(run);
  EXPECT_NE(run.page.find("Converged: the one increment reached"), std::string::npos);
}

TEST(ReportRuns, static_between_dynamic_steps) {
  const Written run = run_and_read(blocks(latin + R"(
local first = hit("first", press, 10*us)
local again = step.static{ name = "again", after = first, increments = 2, loads = { load.pressure{ on = high:face "zmax", history = 20*MPa } } }
local steps = { press, first, again, hit("second", again, 10*us) }
)"));
  expect_sound(run);
  EXPECT_NE(run.page.find("again (static)"), std::string::npos);
}

TEST(ReportRuns, not_converged) {
  const Written run = run_and_read(
      blocks("local how = solver.latin{ max_iterations = 2 } local steps = { press, hit('shock', press, 20*us) }\n"));
  EXPECT_FALSE(run.result->converged);
  expect_sound(run);
  EXPECT_NE(run.page.find("NOT converged: "), std::string::npos);
  EXPECT_NE(run.page.find("increments missed"), std::string::npos);
}

TEST(ReportRuns, explicit_and_monolithic) {
  for (const char* solver : {"explicit", "monolithic"}) {
    const Written run = run_and_read(blocks(latin + "local steps = { press, hit('shock', press, 10*us) }\n"), solver);
    expect_sound(run);
    EXPECT_NE(run.page.find(std::string("solver ") + solver), std::string::npos);
  }
}

// Two posts pull a cap down, one harder than the other; their material has a yield.
const std::string posts = R"(
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0, density = 8000, yield = 300*MPa }
local lead = material.elastic{ name = "lead", young = 16*GPa, poisson = 0.44, density = 11340 }
local function block(name, material, x, z, size, cells) return substructure{ name = name, material = material,
  mesh = mesh.box{ origin = { x, 0, z }, size = size, cells = cells } } end
local foot, cap = block("foot", lead, 0, 0, { 50*mm, 10*mm, 5*mm }, { 5, 1, 1 }), block("cap", lead, 0, 15*mm, { 50*mm, 10*mm, 5*mm }, { 5, 1, 1 })
local a, b, pad = block("a", steel, 0, 5*mm, { 10*mm, 10*mm, 10*mm }, { 1, 1, 2 }), block("b", steel, 40*mm, 5*mm, { 10*mm, 10*mm, 10*mm }, { 1, 1, 2 }),
  block("pad", lead, 20*mm, 5*mm, { 10*mm, 10*mm, 10*mm }, { 1, 1, 2 })
local bolt_a = interface.bonded{ name = "bolt a", between = { a:face "zmax", cap:face "zmin" } }
local bolt_b = interface.bonded{ name = "bolt b", between = { b:face "zmax", cap:face "zmin" } }
local interfaces = { bolt_a, bolt_b }
for _, post in ipairs{ a, b, pad } do interfaces[#interfaces + 1] = interface.bonded{ name = "foot of " .. post.name, between = { foot:face "zmax", post:face "zmin" } } end
interfaces[#interfaces + 1] = interface.contact{ name = "seat", between = { pad:face "zmax", cap:face "zmin" } }
local base = support.fixed{ name = "base", on = foot:face "zmin" }
local first = step.static{ name = "first", increments = 2, loads = { load.shortening{ on = bolt_a, by = 2*um } } }
local second = step.static{ name = "second", after = first, increments = 2, loads = { load.shortening{ on = bolt_b, by = 1*um } } }
problem{ name = "posts", substructures = { foot, cap, a, b, pad }, interfaces = interfaces, supports = { base }, steps = { first, second }, outputs = {} }:run{}
)";

TEST(ReportRuns, is_cut_through_its_bolts_and_tells_masses_and_margins) {
  const Written run = run_and_read(posts);
  ;
  EXPECT_EQ(xml_fault(run.page, {"meta"}), "");
  for (const char* part :
       {"cut through &#39;bolt a&#39;, &#39;bolt b&#39;, the plane y = 5\u00a0mm", "50 × 10 × 20\u00a0mm",
        "<td>8\u00a0g</td>", "<td>28.35\u00a0g</td>", "84.04\u00a0g in all", "<h2>Stress against yield",
        "Not monitored, since their material has no yield: foot, cap, pad", "Force after each static step",
        "by other bolts, static loads"})
    EXPECT_NE(run.page.find(part), std::string::npos) << part;
  ASSERT_EQ(run.result->stresses.size(), 2u);
  EXPECT_NE(run.record.find("\"volume_above_yield\": 0.0"), std::string::npos);
  EXPECT_EQ(run.record.find("above the yield"), std::string::npos);
}

TEST(ReportRuns, warns_of_a_part_that_would_yield) {
  std::string text = posts;
  text.replace(text.find("300*MPa"), 7, "1*MPa");
  const Written run = run_and_read(text);
  EXPECT_NE(run.record.find("substructure 'a' reaches "), std::string::npos);
  EXPECT_NE(run.record.find("(von Mises), above the yield of 1 MPa of 'steel'"), std::string::npos);
  EXPECT_NE(run.page.find("card poor\"><small>smallest margin against yield"), std::string::npos);
}

// A block of 10 mm, pressed by 2 kN and pushed by 200 N at first, then by 600 N: friction of 0.2 holds 400 N.
const std::string pushed = R"(
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local function block(name, x, z, size) return substructure{ name = name, material = steel,
  mesh = mesh.box{ size = { size, size, 10*mm }, origin = { x, x, z }, cells = { 2, 2, 2 } } } end
local low, high, far = block("low", -5*mm, 0, 20*mm), block("high", 0, 10*mm, 10*mm), block("far", 0, 20*mm, 10*mm)
local seat = interface.contact{ name = "seat", between = { low:face "zmax", high:face "zmin" }, friction = 0.2 }
local lid = interface.contact{ name = "lid", between = { high:face "zmax", far:face "zmin" }, gap = 0.1*mm }
local base = support.fixed{ name = "base", on = { low:face "zmin", far:face "zmax" } }
local function push(x) return { load.pressure{ on = high:face "xmin", history = x }, load.pressure{ on = high:face "zmax", history = 20*MPa } } end
local press = step.static{ name = "press", increments = 2, loads = push(2*MPa) }
local shove = step.dynamic{ name = "shove", after = press, duration = 40*us, dt = 1*us, loads = push(6*MPa) }
problem{ name = "pushed", substructures = { low, high, far }, interfaces = { seat, lid }, supports = { base }, steps = { press, shove }, outputs = {} }:run{}
)";

TEST(ReportRuns, watches_every_contact_without_being_asked) {
  const Written run = run_and_read(pushed);
  ASSERT_EQ(run.result->contacts.size(), 2u);
  const ContactSummary& seat = run.result->contacts[0];
  EXPECT_EQ(seat.name, "seat");
  EXPECT_NEAR(seat.area, 1e-4, 1e-9);
  EXPECT_EQ(seat.friction, 0.2);
  ASSERT_EQ(seat.steps.size(), 2u);
  // At rest by equilibrium: half of the friction is used.
  const ContactStep& still = seat.steps[0];
  for (const double pressed : {still.lowest, still.highest}) EXPECT_NEAR(pressed, 2000.0, 2e-3);
  EXPECT_NEAR(still.shear, 200.0, 2e-3);
  EXPECT_NEAR(still.friction_used.value(), 0.5, 1e-5);
  EXPECT_LT(still.sliding.value(), 1.0);
  // 600 N against 400 N of friction move 7.8 g by 20 um in 40 us, less what the blocks shear.
  const ContactStep& moving = seat.steps[1];
  EXPECT_EQ(moving.step, 1);
  EXPECT_NEAR(moving.friction_used.value(), 1.0, 1e-3);  // less what spreads sideways
  EXPECT_EQ(moving.sliding.value(), 1.0);
  EXPECT_NEAR(moving.slip.value(), 0.5 * 200.0 / 7.8e-3 * std::pow(40e-6, 2), 5e-6);
  // What never touches.
  const ContactSummary& lid = run.result->contacts[1];
  for (const ContactStep& step : lid.steps) {
    EXPECT_EQ(step.highest, 0.0);
    EXPECT_EQ(step.closed, 0.0);
    EXPECT_EQ(step.opening, 0.0);
    EXPECT_FALSE(step.slip || step.sliding || step.friction_used);
  }
  // Where: on the seat, 10 mm across, in the picture of the block, which is the smaller of the two.
  EXPECT_NEAR(moving.slip_at[2], 10e-3, 1e-9);
  EXPECT_LE((moving.slip_at.head<2>() - Eigen::Vector2d(5e-3, 5e-3)).cwiseAbs().maxCoeff(), 5e-3 + 1e-9);
  EXPECT_NE(run.page.find("Largest slip: &#39;seat&#39;"), std::string::npos);
  EXPECT_NE(run.page.find("1 of 1 contacts slides as a whole"), std::string::npos);
  EXPECT_NE(run.page.find("Every contact (2)"), std::string::npos);
}

// A large mesh gives a page of bounded size: pictures and maps merge what is too fine to be seen.
TEST(ReportRuns, stays_small_on_a_large_mesh) {
  const Written small = run_and_read(blocks(latin + "local steps = { hit('shock', nil, 1*us) }\n"));
  std::string text = blocks(latin + "local steps = { hit('shock', nil, 1*us) }\n");
  text.replace(text.find("n = 2 }"), 7, "n = 22 }");
  const Written large = run_and_read(text);
  expect_sound(large);
  EXPECT_LT(large.page.size(), 1600000u);  // 1 MB of it is what the turning picture may take
  EXPECT_GT(large.page.size(), small.page.size());
}

}  // namespace
}  // namespace dygita::test::report_runs_tests
