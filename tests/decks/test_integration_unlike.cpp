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

// Eight blocks of two kinds tied all around the edges where they meet, thrown at a wall: ties in a loop, at nodes that
// several of them share.
const std::string grid = R"(
local p = param{ plain = 0 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local parts, joints, floor, grid = {}, {}, {}, {}
for k = 0, 1 do for j = 0, 1 do for i = 0, 1 do
  local n = (i + j + k) % 2 == 0 and 3 or 4
  local b = substructure{ name = ("b%d%d%d"):format(i, j, k), material = steel, velocity = { 0, 0, -10 }, integration = "explicit",
    mesh = mesh.box{ origin = { i*6*mm, j*6*mm, k*6*mm }, size = { 6*mm, 6*mm, 6*mm }, cells = { n, n, n } } }
  parts[#parts + 1], grid[i .. j .. k] = b, b
  if k == 0 then floor[#floor + 1] = b:face "zmin" end
end end end
local function join(a, of_a, b, of_b, touches)
  if not b then return end
  local name, between = "j" .. #joints + 1, { a:face(of_a), b:face(of_b) }
  joints[#joints + 1] = touches and interface.contact{ name = name, between = between, friction = 0.2 } or interface.bonded{ name = name, between = between }
end
for k = 0, 1 do for j = 0, 1 do for i = 0, 1 do
  local a = grid[i .. j .. k]
  join(a, "xmax", grid[i + 1 .. j .. k], "xmin")
  join(a, "ymax", grid[i .. j + 1 .. k], "ymin")
  join(a, "zmax", grid[i .. j .. k + 1], "zmin", true)
end end end
local wall = support.wall{ name = "wall", on = floor, gap = 0.01*mm, friction = 0.1 }
local fall = step.dynamic{ name = "fall", duration = 2*us, dt = 0.2*us }
problem{ name = "grid", substructures = parts, interfaces = joints, supports = { wall }, steps = { fall },
  solver = solver.latin{ plain = p.plain == 1, mass = "lumped" }, outputs = { output.resultant{ name = "push", on = wall }, output.energy{} } }:run{}
)";

// In flight forces are nothing but rounding; then rounds that are mixed end where plain ones do, and where those creep
// on beyond the last round that they are given.
TEST(UnlikeIntegration, ties_in_loops_converge_in_flight_and_on_the_wall) {
  const DeckRun mixed = run_text(grid).at(0), plain = run_text(grid, {{"plain", "1"}}).at(0);
  EXPECT_TRUE(mixed.result->converged);
  const std::vector<double>&push = mixed.column("push", "normal"), &other = plain.column("push", "normal");
  EXPECT_GT(largest(push), 1e3);
  for (size_t i = 0; i < push.size(); ++i) EXPECT_NEAR(push[i], other[i], 1e-5 * largest(push)) << i;
}

// Two halves of a block rub on the rod above them and press each other: forces that go around the three change nothing
// but by a hundred thousandth of the velocities, and creep until a point slides or opens.
constexpr const char* split_anvil = R"(
local p = param{ n = 4, m = 1, friction = 0.6, noise = 1e-3 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local function block(name, origin, size, cells)
  return substructure{ name = name, material = steel, mesh = mesh.box{ origin = origin, size = size, cells = cells } }
end
local rod   = block("rod", { 0, 0, 0 }, { 10*mm, 10*mm, 60*mm }, { p.n, p.n, 6*p.n })
local left  = block("left", { -4*mm, -4*mm, -10*mm }, { 9*mm, 18*mm, 10*mm }, { p.m, 2*p.m, p.m })
local right = block("right", { 5*mm, -4*mm, -10*mm }, { 9*mm, 18*mm, 10*mm }, { p.m, 2*p.m, p.m })
local function contact(name, a, b) return interface.contact{ name = name, between = { a, b }, friction = p.friction } end
local halves = contact("halves", left:face "xmax", right:face "xmin")
local on_left, on_right = contact("on left", left:face "zmax", rod:face "zmin"), contact("on right", right:face "zmax", rod:face "zmin")
local base = support.fixed{ name = "base", on = { left:face "zmin", right:face "zmin" } }
local hit = step.dynamic{ name = "hit", duration = 20*us, dt = 0.2*us, loads = {
  load.pressure{ on = rod:face "zmax", history = history.half_sine{ peak = 100*MPa, duration = 4*us } },
  load.pressure{ on = rod:face "xmin", history = history.half_sine{ peak = p.noise*MPa, duration = 30*us } } } }
problem{ name = "anvil", substructures = { rod, left, right }, interfaces = { halves, on_left, on_right }, supports = { base }, steps = { hit },
  solver = solver.latin{ integration = "explicit", mass = "lumped" },
  outputs = { output.joint{ name = "left", on = on_left }, output.joint{ name = "right", on = on_right }, output.energy{} } }:run{}
)";

TEST(UnlikeIntegration, friction_in_a_loop_of_contacts_converges_in_every_increment) {
  for (const char* friction : {"0.3", "0.6"})
    for (const char* noise : {"1e-12", "1e-6", "1e-3"})
      for (const char* n : {"2", "3", "4"})
        EXPECT_TRUE(
            run_text(split_anvil,
                     {{"n", n}, {"m", n == std::string("3") ? "3" : "1"}, {"friction", friction}, {"noise", noise}})
                .at(0)
                .result->converged)
            << friction << " " << noise << " " << n;
}

}  // namespace
}  // namespace dygita::test::integration_unlike_tests
