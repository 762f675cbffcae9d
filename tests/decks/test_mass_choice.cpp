// Lumped or tuned, as the program chooses for explicit substructures by what the loads bring.
#include <gtest/gtest.h>

#include "decks/deck_prints.hpp"
#include "partition/mass_choice.hpp"

namespace dygita::test::mass_choice_tests {
namespace {

// A bar in two halves, pulled at its end: how is up to `load`.
const std::string bar = R"(
local p = param{ load = 1, mass = 0, pieces = 1, n = 40, integration = 0, speed = 0, dt = 0.2, cell = 1 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local function half(name, z, v) return substructure{ name = name, material = steel, velocity = { 0, 0, v },
  mesh = mesh.box{ origin = { 0, 0, z }, size = { 5*mm, 5*mm, 50*mm }, cells = { 4, 4, p.n }, cell = p.cell == 1 and "hex8" or "tet4" } } end
local a, b = half("a", 0, 0), half("b", 50*mm, p.speed)
local tie = interface.bonded{ name = "tie", between = { a:face "zmax", b:face "zmin" } }
local base = support.fixed{ name = "base", on = a:face "zmin" }
local of = ({ history.half_sine{ peak = 100*MPa, duration = 400*us }, history.half_sine{ peak = 100*MPa, duration = 3*us },
              history.step{ value = 100*MPa }, 100*MPa, 0, 100*MPa, history.step{ value = 100*MPa, at = 1*us } })[p.load]
local press = step.static{ name = "press", loads = (p.load == 5 or p.load == 6) and { load.traction{ on = b:face "zmax", z = 100*MPa } } or {} }
local hit = step.dynamic{ name = "hit", after = press, duration = 24*us, dt = p.dt*us, loads = { load.traction{ on = b:face "zmax", z = of } } }
problem{ name = "bar", substructures = { a, b }, interfaces = { tie }, supports = { base }, steps = { press, hit },
  solver = solver.latin{ integration = p.integration == 1 and "implicit" or "explicit", pieces = p.pieces,
                         mass = ({ [0] = "automatic", "lumped", "tuned" })[p.mass] },
  outputs = { output.resultant{ name = "through", on = tie }, output.energy{} } }:run{}
)";

const StepSummary& hit(const DeckRun& run) { return run.result->steps.at(1); }

std::vector<std::string> tuned(const Settings& settings) { return hit(run_text(bar, settings).at(0)).tuned_parts; }

const std::vector<std::string> both{"a", "b"}, none;

TEST(MassChoice, is_tuned_where_loads_bring_waves_that_the_mesh_would_keep_back) {
  EXPECT_EQ(tuned({{"load", "1"}}), none);                  // slow
  EXPECT_EQ(tuned({{"load", "2"}}), both);                  // a short pulse
  EXPECT_EQ(tuned({{"load", "3"}}), both);                  // a front
  EXPECT_EQ(tuned({{"load", "4"}}), both);                  // a force that is there at once
  EXPECT_EQ(tuned({{"load", "5"}}), both);                  // one that is gone at once
  EXPECT_EQ(tuned({{"load", "6"}}), none);                  // one that goes on, told anew
  EXPECT_EQ(tuned({{"load", "7"}}), both);                  // one that is there at once, later
  EXPECT_EQ(tuned({{"load", "1"}, {"speed", "5"}}), both);  // halves that meet at speed
}

// A bar that falls on a wall, or on a block that is held, from `gap`, whole or (3) in two that touch; by `tied` held
// itself.
const std::string falling = R"(
local p = param{ gap = 0.1, on = 1, tied = 0 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local function half(name, z) return substructure{ name = name, material = steel,
  mesh = mesh.box{ origin = { 0, 0, z }, size = { 5*mm, 5*mm, 50*mm }, cells = { 4, 4, 20 } } } end
local a, b = half("a", 0), half("b", 50*mm)
local pair = { a:face "zmax", b:face "zmin" }
local tie = p.on == 1 and interface.bonded{ name = "tie", between = pair }
  or interface.contact{ name = "tie", between = pair, gap = p.on == 2 and p.gap*mm or 0 }
local supports = { p.on ~= 2 and support.wall{ name = "wall", on = a:face "zmin", gap = p.gap*mm }
  or support.fixed{ name = "base", on = a:face "zmin" } }
if p.tied == 1 then supports[2] = support.fixed{ name = "held", on = b:face "zmax" } end
local fall = step.dynamic{ name = "fall", duration = 100*us, dt = 0.4*us, loads = { load.gravity{ z = -9.81 } } }
problem{ name = "falling", substructures = { a, b }, interfaces = { tie }, supports = supports, steps = { fall },
  solver = solver.latin{ integration = "explicit" }, outputs = { output.energy{} } }:run{}
)";

TEST(MassChoice, foresees_what_flies_towards_a_wall_or_a_part) {
  const auto fallen = [](const Settings& settings) {
    return run_text(falling, settings).at(0).result->steps.at(0).tuned_parts;
  };
  EXPECT_EQ(fallen({}), both);
  EXPECT_EQ(fallen({{"gap", "0"}}), none);   // it stands there
  EXPECT_EQ(fallen({{"tied", "1"}}), none);  // it hangs above
  EXPECT_EQ(fallen({{"on", "2"}}), both);
  EXPECT_EQ(fallen({{"on", "2"}, {"gap", "0"}}), none);
  EXPECT_EQ(fallen({{"on", "2"}, {"tied", "1"}}), none);
  EXPECT_EQ(fallen({{"on", "3"}}), both);  // one on the other
  EXPECT_EQ(fallen({{"on", "3"}, {"tied", "1"}}), none);
}

TEST(MassChoice, is_the_deck_s_where_it_says) {
  EXPECT_EQ(tuned({{"load", "2"}, {"mass", "1"}}), none);
  EXPECT_EQ(tuned({{"load", "1"}, {"mass", "2"}}), both);
  EXPECT_TRUE(hit(run_text(bar, {{"load", "2"}, {"mass", "1"}}).at(0)).phases.empty());
}

TEST(MassChoice, leaves_lumped_what_has_other_cells_or_is_implicit) {
  EXPECT_EQ(tuned({{"load", "2"}, {"cell", "2"}}), none);
  EXPECT_EQ(tuned({{"load", "2"}, {"integration", "1"}}), none);
}

TEST(MassChoice, is_known_before_anything_is_cut) {
  EXPECT_EQ(tuned_by_choice(run_text(bar, {{"load", "1"}}).at(0).problem), none);
  EXPECT_EQ(tuned_by_choice(run_text(bar, {{"load", "2"}}).at(0).problem), both);
  EXPECT_EQ(tuned_by_choice(run_text(bar, {{"load", "2"}, {"mass", "2"}}).at(0).problem), none);  // the deck's choice
  EXPECT_EQ(tuned_by_choice(run_text(bar, {{"load", "2"}, {"integration", "1"}}).at(0).problem), none);
}

TEST(MassChoice, tells_the_phase_it_goes_by) {
  const DeckRun slow = run_text(bar, {{"load", "1"}}).at(0), quick = run_text(bar, {{"load", "3"}}).at(0);
  ASSERT_EQ(hit(slow).phases.size(), 2u);
  EXPECT_EQ(hit(slow).phases[0].first, "a");
  EXPECT_LT(hit(slow).phases[0].second, 0.1);
  // A front has what the mesh carries: five cells to the wave. h = (1.25 * 1.25 * 1.25 mm^3)^(1/3).
  const double h = 1.25e-3, c = std::sqrt(210e9 / 2.6 / 7800), w = 2 * 3.14159265358979 * c / (5 * h);
  EXPECT_NEAR(hit(quick).phases[1].second, w * 24e-6 * std::pow(w * h / c, 2) / 24, 1e-6);
}

// A pulse that a bar of eight times as many cells along it carries nearly unchanged.
TEST(MassChoice, makes_a_pulse_at_least_twice_as_accurate) {
  const auto force = [](const Settings& settings) {
    Settings all{{"load", "2"}, {"dt", "0.1"}};
    all.insert(all.end(), settings.begin(), settings.end());
    return run_text(bar, all).at(0).column("through", "normal");
  };
  const std::vector<double> fine = force({{"n", "160"}});
  const auto error = [&](const std::vector<double>& computed) {
    double off = 0.0, size = 0.0;
    for (size_t i = 0; i < fine.size(); ++i) {
      off += std::pow(computed[i] - fine[i], 2);
      size += std::pow(fine[i], 2);
    }
    return std::sqrt(off / size);
  };
  const double chosen = error(force({})), lumped = error(force({{"mass", "1"}}));
  std::cout << "force between the halves, off by " << 100 * chosen << " % tuned, " << 100 * lumped << " % lumped\n";
  EXPECT_LT(chosen, 0.5 * lumped);
  // A cut changes nothing.
  const double cut = error(force({{"pieces", "4"}}));
  std::cout << "each cut into four: " << 100 * cut << " %\n";
  EXPECT_EQ(tuned({{"load", "2"}, {"pieces", "4"}}), both);
  EXPECT_NEAR(cut, chosen, 1e-6 * chosen);
}

}  // namespace
}  // namespace dygita::test::mass_choice_tests
