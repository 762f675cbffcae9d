// Parts that are warmer than they were made, and parts that turn: closed forms, cells and solvers.
#include <gtest/gtest.h>

#include <cmath>

#include "decks/engine.hpp"

namespace dygita::test::temperature_tests {
namespace {

constexpr double young = 200e9, expansion = 12e-6, by = 100.0, length = 0.1;

// A bar of 100 x 20 x 10 mm on planes of symmetry, free to grow, or between walls along x.
const std::string bar = R"(
local p = param{ walls = 0, order = 1, place = 0, wave = 0 }
local m = material.elastic{ name = "m", young = 200*GPa, poisson = 0.3, density = 7800, yield = 400*MPa }
local bar = substructure{ name = "bar", material = m, place = { p.place, 0, 0 },
  mesh = mesh.box{ size = { 100*mm, 20*mm, 10*mm }, cells = { 4, 2, 1 }, order = p.order } }
local supports = { support.held{ name = "x", on = p.walls == 1 and { bar:face "xmin", bar:face "xmax" } or bar:face "xmin", x = true },
  support.held{ name = "y", on = bar:face "ymin", y = true }, support.held{ name = "z", on = bar:face "zmin", z = true } }
local hot = load.temperature{ parts = { bar }, expansion = 12e-6, by = 100 }
local steps = { step.static{ name = "warm", loads = { hot } } }
if p.wave == 1 then steps[2] = step.dynamic{ name = "wait", after = steps[1], duration = 40*us, dt = 1*us, loads = { hot } } end
if p.wave == 2 then steps[2] = step.static{ name = "cool", after = steps[1] } end
problem{ name = "bar", substructures = { bar }, supports = supports, steps = steps, outputs = {
  output.history{ name = "end", on = bar:face "xmax", quantity = "displacement", direction = { 1, 0, 0 } },
  output.history{ name = "side", on = bar:face "ymax", quantity = "displacement", direction = { 0, 1, 0 } },
  output.history{ name = "stress", on = bar:face "xmax", quantity = "stress", direction = { 1, 0, 0 } },
  output.history{ name = "mises", on = bar:face "zmax", quantity = "von_mises" } } }:run{}
)";

double last(const DeckRun& run, const std::string& output) { return run.table(output).columns.back().back(); }

class EveryWay : public ::testing::TestWithParam<std::pair<const char*, const char*>> {};
INSTANTIATE_TEST_SUITE_P(Temperature, EveryWay,
                         ::testing::Values(std::pair("1", "latin"), std::pair("2", "latin"),
                                           std::pair("1", "monolithic")));

TEST_P(EveryWay, a_free_bar_grows_without_stress_wherever_it_stands) {
  for (const char* place : {"0", "7"}) {
    const DeckRun run = run_text(bar, {{"order", GetParam().first}, {"place", place}}, 1, GetParam().second).at(0);
    EXPECT_NEAR(last(run, "end"), expansion * by * length, 1e-7 * expansion * by * length);
    EXPECT_NEAR(last(run, "side"), expansion * by * 0.02, 1e-7 * expansion * by * length);
    EXPECT_NEAR(last(run, "mises") / (young * expansion * by), 0.0, 1e-6);
    EXPECT_NEAR(last(run, "stress") / (young * expansion * by), 0.0, 1e-6);
  }
}

TEST_P(EveryWay, a_bar_between_walls_is_pressed) {
  const DeckRun run = run_text(bar, {{"order", GetParam().first}, {"walls", "1"}}, 1, GetParam().second).at(0);
  EXPECT_NEAR(last(run, "stress") / (young * expansion * by), -1.0, 1e-6);
  EXPECT_NEAR(last(run, "mises") / (young * expansion * by), 1.0, 1e-6);
  EXPECT_NEAR(last(run, "side"), 1.3 * expansion * by * 0.02, 1e-6 * expansion * by * 0.02);
  EXPECT_NEAR(run.figure("smallest margin against yield [1]"), 400e6 / (young * expansion * by) - 1, 1e-5);
}

TEST(Temperature, that_lasts_moves_nothing_and_that_goes_leaves_nothing) {
  const DeckRun lasts = run_text(bar, {{"walls", "1"}, {"wave", "1"}}).at(0);
  for (const double x : lasts.table("stress").columns.back()) EXPECT_LE(x, 1.0);
  EXPECT_NEAR(last(lasts, "stress") / (young * expansion * by), -1.0, 1e-5);
  const DeckRun goes = run_text(bar, {{"walls", "1"}, {"wave", "2"}}).at(0);
  EXPECT_NEAR(last(goes, "stress") / (young * expansion * by), 0.0, 1e-6);
  EXPECT_NEAR(last(goes, "side"), 0.0, 1e-12);
}

// Two bars end to end between walls, one of them warmer and of twice the stiffness, without contraction:
// stress = - alpha T L1 / (L1/E1 + L2/E2).
TEST(Temperature, of_one_of_two_bars_presses_both) {
  const DeckRun run = run_text(R"(
local a = material.elastic{ name = "a", young = 200*GPa, poisson = 0, density = 7800 }
local b = material.elastic{ name = "b", young = 100*GPa, poisson = 0, density = 7800 }
local one = substructure{ name = "one", material = a, mesh = mesh.box{ size = { 60*mm, 10*mm, 10*mm }, cells = { 3, 1, 1 } } }
local two = substructure{ name = "two", material = b, mesh = mesh.box{ origin = { 60*mm, 0, 0 }, size = { 40*mm, 10*mm, 10*mm }, cells = { 2, 1, 1 } } }
local glue = interface.bonded{ name = "glue", between = { one:face "xmax", two:face "xmin" } }
local walls = support.fixed{ name = "walls", on = { one:face "xmin", two:face "xmax" } }
local hot = load.temperature{ parts = { one }, expansion = 12e-6, by = 100 }
problem{ name = "two", substructures = { one, two }, interfaces = { glue }, supports = { walls }, steps = { step.static{ name = "warm", loads = { hot } } },
  outputs = {
    output.history{ name = "at two", on = two:face "xmax", quantity = "stress", direction = { 1, 0, 0 } },
    output.history{ name = "glue", on = two:face "xmin", quantity = "displacement", direction = { 1, 0, 0 } } } }:run{}
)")
                          .at(0);
  const double stress = -expansion * by * 0.06 / (0.06 / 200e9 + 0.04 / 100e9);
  EXPECT_NEAR(last(run, "glue"), -stress * 0.04 / 100e9, 1e-6 * std::abs(stress) * 0.04 / 100e9);
  EXPECT_NEAR(last(run, "at two") / stress, 1.0, 1e-6);
}

// What a run says of a bar that is warm in a static step and in what follows, beside a loose one.
std::string said_of(const std::string& loads, const std::string& next, const std::string& wall = "bar:face 'xmin'") {
  testing::internal::CaptureStderr();
  run_text(R"(
local m = material.elastic{ name = "m", young = 200*GPa, poisson = 0.3, density = 7800 }
local bar = substructure{ name = "bar", material = m, mesh = mesh.box{ size = { 100*mm, 20*mm, 10*mm }, cells = { 4, 2, 1 } } }
local loose = substructure{ name = "loose", material = m, mesh = mesh.box{ origin = { 0, 1, 0 }, size = { 20*mm, 20*mm, 20*mm }, cells = { 1, 1, 1 } } }
local wall = support.fixed{ name = "wall", on = { )" +
           wall + R"( } }
local function warm(part, expansion) return load.temperature{ parts = { part }, expansion = expansion, by = 100 } end
local spin = load.spin{ speed = 10, axis = { 0, 0, 1 }, through = { 0, 0, 0 } }
local rest = step.static{ name = "rest", loads = { )" +
           loads + R"( } }
problem{ name = "warm", substructures = { bar, loose }, supports = { wall },
  steps = { rest, step.dynamic{ name = "wait", after = rest, duration = 4*us, dt = 1*us, loads = { )" +
           next + R"( } } } }:run{}
)");
  return testing::internal::GetCapturedStderr();
}

bool says(const std::string& text, const char* words) { return text.find(words) != std::string::npos; }

TEST(Temperature, touches_a_part_and_goes_on_with_another_expansion) {
  const char *untouched = "load touches substructure 'loose'", *released = "released suddenly";
  const std::string alone = said_of("warm(bar, 12e-6)", "");
  EXPECT_TRUE(says(alone, untouched)) << alone;
  EXPECT_TRUE(says(alone, "load.temperature of 'bar' stands at 100 K")) << alone;
  EXPECT_TRUE(says(alone, "list it there too")) << alone;
  const std::string both = said_of("warm(bar, 12e-6), warm(loose, 12e-6)", "warm(bar, 10e-6), warm(loose, 12e-6)");
  EXPECT_FALSE(says(both, untouched)) << both;
  EXPECT_FALSE(says(both, released)) << both;
}

TEST(Spin, that_a_dynamic_step_drops_is_not_to_be_listed_there) {
  const std::string said = said_of("spin", "", "bar:face 'xmin', loose:face 'xmin'");
  EXPECT_TRUE(says(said, "released suddenly")) << said;
  EXPECT_TRUE(says(said, "acts in static steps only")) << said;
  EXPECT_FALSE(says(said, "list it there too")) << said;
}

// A rod without contraction that turns about its end: rho w^2 L^3 / (3 E) longer, rho w^2 L^2 / 2 at the axis.
TEST(Spin, stretches_a_rod) {
  const std::string rod = R"(
local p = param{ through = 0 }
local m = material.elastic{ name = "m", young = 200*GPa, poisson = 0, density = 8000 }
local rod = substructure{ name = "rod", material = m, place = { p.through, 0, 0 }, mesh = mesh.box{ size = { 200*mm, 10*mm, 10*mm }, cells = { 10, 1, 1 }, order = 2 } }
local hub = support.held{ name = "hub", on = rod:face "xmin", x = true }
local other = support.held{ name = "rest", on = rod:face "ymin", y = true }
local flat = support.held{ name = "flat", on = rod:face "zmin", z = true }
problem{ name = "rod", substructures = { rod }, supports = { hub, other, flat },
  steps = { step.static{ name = "turn", loads = { load.spin{ speed = 500, axis = { 0, 0, -3 }, through = { p.through, 0, 0.3 } } } } },
  outputs = { output.history{ name = "end", on = rod:face "xmax", quantity = "displacement", direction = { 1, 0, 0 } },
    output.history{ name = "root", on = rod:face "xmin", quantity = "stress", direction = { 1, 0, 0 } } } }:run{}
)";
  for (const char* through : {"0", "-3"}) {
    const DeckRun run = run_text(rod, {{"through", through}}).at(0);
    const double pull = 8000 * 500.0 * 500.0;
    EXPECT_NEAR(last(run, "end") / (pull * std::pow(0.2, 3) / (3 * young)), 1.0, 1e-4) << through;
    EXPECT_NEAR(last(run, "root") / (pull * 0.2 * 0.2 / 2), 1.0, 5e-3) << through;
  }
}

}  // namespace
}  // namespace dygita::test::temperature_tests
