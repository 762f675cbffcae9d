// Explicit substructures between meshes that do not match: points that share nodes all over an interface.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.hpp"
#include "decks/deck_prints.hpp"

namespace dygita::test::integration_unlike_tests {
namespace {

// Three blocks with grids of other sizes, rubbing and tied, along a rough wall, with a side that lets waves out; the
// lowest one is held, or driven, along a side whose nodes belong to the rubbing face too.
const std::string unlike = R"(
local p = param{ dt = 0.05, how = 2, n = 3, m = 4, mu = 0.3, duration = 6, driven = 0, pieces = 1, tuned = 0, quadratic = 0, top = 0, press = 0 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local soft = material.elastic{ name = "soft", young = 70*GPa, poisson = 0.3, density = 2700 }
local kinds = { "implicit", "explicit", "automatic" }
local function box(name, z, of, n, how, order) return substructure{ name = name, material = of, integration = kinds[how],
  mesh = mesh.box{ origin = { 0, 0, z }, size = { 6*mm, 6*mm, 4*mm }, cells = { n, n, 3 }, order = order } } end
local low, middle = box("low", 0, soft, p.n, p.how), box("middle", 4*mm, steel, p.m, p.how)
local high = box("high", 8*mm, soft, p.n, p.top > 0 and p.top or p.how, p.quadratic == 1 and 2 or nil)
local rubbing = interface.contact{ name = "rubbing", between = { low:face "zmax", middle:face "zmin" }, friction = p.mu }
local tied = interface.bonded{ name = "tied", between = { middle:face "zmax", high:face "zmin" } }
local side = support.wall{ name = "side", on = middle:face "xmin", friction = 0.5 * p.mu }
local supports = { side, support.absorbing{ name = "out", on = middle:face "ymax" } }
local loads = { load.traction{ on = high:face "zmax", x = history.half_sine{ peak = 20*MPa, duration = 3*us }, z = history.half_sine{ peak = -120*MPa, duration = 4*us } } }
if p.driven == 1 then
  loads[2] = load.velocity{ on = low:face "xmax", z = history.haversine{ peak = 2, duration = 4*us } }
else
  supports[3] = support.fixed{ name = "base", on = low:face "zmin" }
end
local steps = {}
if p.press == 1 then
  local press = load.pressure{ on = high:face "zmax", history = 20*MPa }
  steps[1] = step.static{ name = "press", increments = 1, loads = { press } }
  loads = { press }
end
steps[#steps + 1] = step.dynamic{ name = "hit", after = steps[1], duration = p.duration*us, dt = p.dt*us, loads = loads }
problem{ name = "unlike", substructures = { low, middle, high }, interfaces = { rubbing, tied }, supports = supports, steps = steps,
  solver = solver.latin{ tolerance = 1e-10, pieces = p.pieces, mass = p.tuned == 1 and "tuned" or "lumped" },
  outputs = { output.history{ name = "corner", on = high:where(function(x, y, z) return near(x, 6*mm) and near(y, 6*mm) and near(z, 12*mm) end), quantity = "displacement" },
    output.joint{ name = "rubbing", on = rubbing }, output.joint{ name = "tied", on = tied }, output.joint{ name = "side", on = side }, output.energy{} } }:run{}
)";

DeckRun solved(const Settings& settings, int n_threads = 1) {
  DeckRun run = run_text(unlike, settings, n_threads).at(0);
  EXPECT_TRUE(run.result->converged);
  return run;
}

double imbalance(const DeckRun& run) {
  const std::vector<double>& balance = run.column("energy", "balance");
  return largest(balance) / std::max(largest(run.column("energy", "loads")), largest(run.column("energy", "strain")));
}

TEST(UnlikeIntegration, explicit_and_implicit_become_the_same_as_dt_goes_to_zero) {
  for (const char* driven : {"0", "1"}) {
    const DeckRun finest = solved({{"dt", "0.00625"}, {"how", "1"}, {"driven", driven}});
    double before = 1.0;
    for (const char* dt : {"0.1", "0.05", "0.025"}) {
      const DeckRun run = solved({{"dt", dt}, {"driven", driven}});
      EXPECT_EQ(run.result->iterations, run.result->steps.at(0).increments);  // nothing is iterated
      double worst = 0.0;
      for (const auto& [output, column] : {std::pair{"corner", "z"}, {"corner", "x"}, {"energy", "friction"}}) {
        const double exact = finest.column(output, column).back();
        worst = std::max(worst, std::abs(run.column(output, column).back() / exact - 1.0));
      }
      std::cout << "  driven " << driven << ", dt " << dt << " us: off by " << 100 * worst << " %, imbalance "
                << imbalance(run) << "\n";
      EXPECT_LT(worst, before);
      EXPECT_LT(imbalance(run), 1e-10);
      before = worst;
    }
    EXPECT_LT(before, 0.01);
    EXPECT_GT(largest(finest.column("rubbing", "normal")), 100.0);
    EXPECT_GT(finest.column("energy", "friction").back(), 0.0);
  }
}

TEST(UnlikeIntegration, the_balance_closes_with_tuned_masses_and_at_the_limit_of_stability) {
  for (const Settings& how : {Settings{{"tuned", "1"}}, Settings{{"dt", "1"}, {"duration", "200"}},
                              Settings{{"tuned", "1"}, {"dt", "1"}, {"duration", "200"}}, Settings{{"m", "7"}}}) {
    const DeckRun run = solved(how);
    std::cout << "  imbalance " << imbalance(run) << ", fed in " << run.figure("energy created by the scheme [%]")
              << " %\n";
    EXPECT_LT(imbalance(run), 1e-9);
    EXPECT_LT(run.figure("energy created by the scheme [%]"), 0.1);
  }
}

TEST(UnlikeIntegration, a_cut_body_is_the_uncut_one_and_threads_change_no_bit) {
  const DeckRun whole = solved({{"mu", "0"}}), cut = solved({{"mu", "0"}, {"pieces", "2"}});
  for (const char* axis : {"x", "y", "z"})
    EXPECT_LT(difference(whole.column("corner", axis), cut.column("corner", axis)), 1e-7) << axis;
  EXPECT_LT(difference(whole.column("tied", "normal"), cut.column("tied", "normal")), 1e-6);
  const DeckRun one = solved({{"pieces", "2"}}, 1), three = solved({{"pieces", "2"}}, 3);
  for (const char* column : {"kinetic", "strain", "friction", "balance"})
    EXPECT_EQ(one.column("energy", column), three.column("energy", column)) << column;
}

TEST(UnlikeIntegration, what_a_static_step_has_pressed_stays_at_rest) {
  const DeckRun run = solved({{"press", "1"}, {"dt", "1"}, {"duration", "50"}});
  const std::vector<double>& z = run.column("corner", "z");
  EXPECT_GT(std::abs(z.back()), 1e-7);
  EXPECT_LT(std::abs(z.back() - z.at(1)), 1e-6 * std::abs(z.back()));  // the first is at the start, at zero
  EXPECT_LT(largest(run.column("energy", "kinetic")), 1e-10 * largest(run.column("energy", "strain")));
}

std::string complaint(const Settings& settings) {
  try {
    run_text(unlike, settings);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// All of them or none: an implicit one binds those that it meets; so does one of hex20, unless it is asked for.
TEST(UnlikeIntegration, those_bound_together_are_all_explicit_or_none_is) {
  const std::string mixed = complaint({{"top", "1"}});
  EXPECT_NE(mixed.find("substructure 'low': integration = \"explicit\" is not possible"), std::string::npos) << mixed;
  EXPECT_NE(mixed.find("binds it to 'high', which is implicit"), std::string::npos) << mixed;
  const DeckRun together = solved({{"top", "3"}});  // chosen together with those that must be
  EXPECT_EQ(together.result->iterations, together.result->steps.at(0).increments);
  const DeckRun all_implicit = solved({{"how", "3"}, {"quadratic", "1"}});
  EXPECT_TRUE(all_implicit.result->steps.at(0).explicit_parts.empty());
  const DeckRun of_two_orders = solved({{"how", "3"}, {"top", "2"}, {"quadratic", "1"}});
  EXPECT_EQ(of_two_orders.result->steps.at(0).explicit_parts.size(), 3u);
  EXPECT_EQ(of_two_orders.result->steps.at(0).diagonal_parts, std::vector<std::string>{"high"});
  EXPECT_LT(imbalance(of_two_orders), 1e-9);
}

}  // namespace
}  // namespace dygita::test::integration_unlike_tests
