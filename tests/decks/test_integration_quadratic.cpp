// Explicit substructures of cells of order two, whose mass is a diagonal in such steps alone.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "decks/deck_prints.hpp"

namespace dygita::test::integration_quadratic_tests {
namespace {

// Three blocks, rubbing and tied, along a rough wall, with a side that lets waves out; pressed and under gravity first
// if asked, then hit or driven.
const std::string blocks = R"(
local p = param{ cell = 1, n = 2, dt = 0.05, how = 2, top = 0, mu = 0.3, duration = 6, driven = 0, pieces = 1, alpha = 0, beta = 0, press = 0, g = 0, hit = 1, parts = 1, out = 1 }
local damping = (p.alpha > 0 or p.beta > 0) and { mass = p.alpha, stiffness = p.beta } or nil
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800, damping = damping }
local soft = material.elastic{ name = "soft", young = 70*GPa, poisson = 0.3, density = 2700 }
local kinds = { "implicit", "explicit", "automatic" }
local cells = { "tet10", "hex20", "hex27", "prism15", "prism18", "hex8" }
local function box(name, z, of, how) return substructure{ name = name, material = of, integration = kinds[how],
  mesh = mesh.box{ origin = { 0, 0, z }, size = { 6*mm, 6*mm, 4*mm }, cells = { p.n, p.n, p.n }, cell = cells[p.cell] } } end
local low, middle = box("low", 0, soft, p.how), box("middle", 4*mm, steel, p.how)
local high = box("high", 8*mm, soft, p.top > 0 and p.top or p.how)
local rubbing = interface.contact{ name = "rubbing", between = { low:face "zmax", middle:face "zmin" }, friction = p.mu }
local tied = interface.bonded{ name = "tied", between = { middle:face "zmax", high:face "zmin" } }
local supports = { support.fixed{ name = "base", on = low:face "zmin" } }
if p.out == 1 then supports[2] = support.absorbing{ name = "out", on = middle:face "ymax" } end
local gravity = p.g > 0 and load.gravity{ z = -p.g*g0 } or nil
local pressure = p.press == 1 and load.pressure{ on = high:face "zmax", history = 20*MPa }
local steps, loads = {}, {}
if p.press == 1 then
  steps[1] = step.static{ name = "press", increments = 1, loads = { pressure, gravity } }
  loads = { pressure }
end
if gravity then loads[#loads + 1] = gravity end
if p.driven == 1 then loads[#loads + 1] = load.velocity{ on = high:face "zmax", z = history.haversine{ peak = -2, duration = 4*us } }
elseif p.hit == 1 then loads[#loads + 1] = load.traction{ on = high:face "zmax", x = history.half_sine{ peak = 20*MPa, duration = 3*us }, z = history.half_sine{ peak = -120*MPa, duration = 4*us } } end
for i = 1, p.parts do
  steps[#steps + 1] = step.dynamic{ name = "hit " .. i, after = steps[#steps], duration = p.duration/p.parts*us, dt = p.dt*us, loads = loads }
end
problem{ name = "blocks", substructures = { low, middle, high }, interfaces = { rubbing, tied }, supports = supports, steps = steps,
  solver = solver.latin{ tolerance = 1e-10, pieces = p.pieces },
  outputs = { output.history{ name = "corner", on = high:where(function(x, y, z) return near(x, 6*mm) and near(y, 6*mm) and near(z, 12*mm) end), quantity = "displacement" },
    output.joint{ name = "rubbing", on = rubbing }, output.joint{ name = "tied", on = tied }, output.energy{}, output.momentum{ name = "momentum" } } }:run{}
)";

constexpr const char* names[] = {"", "tet10", "hex20", "hex27", "prism15", "prism18", "hex8"};

DeckRun solved(const Settings& settings, int n_threads = 1) {
  DeckRun run = run_text(blocks, settings, n_threads).at(0);
  EXPECT_TRUE(run.result->converged);
  return run;
}

double imbalance(const DeckRun& run) {
  const std::vector<double>& balance = run.column("energy", "balance");
  return largest(balance) / std::max(largest(run.column("energy", "loads")), largest(run.column("energy", "strain")));
}

double apart(const DeckRun& one, const DeckRun& other) {
  double worst = 0.0;
  for (const char* axis : {"x", "z"})
    worst = std::max(worst, std::abs(one.column("corner", axis).back() - other.column("corner", axis).back()) /
                                largest(other.column("corner", axis)));
  return worst;
}

// With one mesh they keep a difference, that of the two masses; it goes with the cells.
TEST(QuadraticIntegration, explicit_and_implicit_become_the_same_as_cells_and_dt_go_to_zero) {
  for (const char* cell : {"1", "3"}) {
    double before = 1.0;
    for (const auto& [n, dt] : {std::pair{"1", "0.08"}, {"2", "0.04"}, {"4", "0.02"}}) {
      const DeckRun run = solved({{"cell", cell}, {"n", n}, {"dt", dt}, {"out", "0"}});
      const DeckRun other = solved({{"cell", cell}, {"n", n}, {"dt", dt}, {"how", "1"}, {"out", "0"}});
      const double error = apart(run, other);
      std::cout << "  " << names[std::atoi(cell)] << ", " << n << " cells a side: apart by " << 100 * error
                << " %, order " << std::log2(before / error) << ", imbalance " << imbalance(run) << "\n";
      EXPECT_EQ(run.result->iterations, run.result->steps.at(0).increments * long(run.result->steps[0].substeps));
      EXPECT_LT(error, before);
      EXPECT_LT(imbalance(run), 1e-8);
      before = error;
    }
    EXPECT_LT(before, 0.02);
  }
}

// Where cells have no symmetry, entries rounded to single precision leave a matrix that is symmetric to 3e-8 alone: the
// balance then closes to some 1e-9, of linear cells too; of regular hexahedra to rounding.
TEST(QuadraticIntegration, the_balance_closes_whatever_the_cells_and_loads) {
  for (const char* cell : {"2", "3"}) EXPECT_LT(imbalance(solved({{"cell", cell}})), 1e-12);
  for (const Settings& how :
       {Settings{{"cell", "1"}}, Settings{{"cell", "2"}}, Settings{{"cell", "3"}}, Settings{{"cell", "4"}},
        Settings{{"cell", "5"}}, Settings{{"driven", "1"}}, Settings{{"alpha", "2e4"}}, Settings{{"beta", "1e-8"}},
        Settings{{"pieces", "2"}}, Settings{{"press", "1"}, {"mu", "0"}}, Settings{{"g", "1e5"}},
        Settings{{"dt", "1"}, {"duration", "200"}}}) {
    const DeckRun run = solved(how);
    std::cout << "  imbalance " << imbalance(run) << ", fed in " << run.figure("energy created by the scheme [%]")
              << " %\n";
    EXPECT_LT(imbalance(run), 1e-7);
    EXPECT_LT(run.figure("energy created by the scheme [%]"), 0.1);
  }
}

TEST(QuadraticIntegration, mixed_with_implicit_ones_they_close_it_to_the_tolerance) {
  const DeckRun run = solved({{"cell", "3"}, {"top", "1"}, {"mu", "0"}});
  EXPECT_GT(run.result->iterations, run.result->steps.at(0).increments);
  EXPECT_LT(imbalance(run), 1e-8);
  EXPECT_EQ(run.result->steps.at(0).explicit_parts.size(), 2u);
}

TEST(QuadraticIntegration, a_cut_body_is_the_uncut_one_and_threads_change_no_bit) {
  for (const char* cell : {"1", "3"}) {
    const Settings settings = {{"cell", cell}, {"mu", "0"}, {"n", "3"}};
    Settings in_pieces = settings;
    in_pieces.emplace_back("pieces", "2");
    const DeckRun whole = solved(settings), cut = solved(in_pieces), three = solved(in_pieces, 3);
    for (const char* axis : {"x", "y", "z"}) {
      EXPECT_LT(difference(whole.column("corner", axis), cut.column("corner", axis)), 1e-6) << axis;
      EXPECT_EQ(cut.column("corner", axis), three.column("corner", axis)) << axis;
    }
    EXPECT_EQ(cut.column("energy", "balance"), three.column("energy", "balance"));
  }
}

// Under a pressure and a weight that the static step has spread over the nodes as the consistent mass does.
TEST(QuadraticIntegration, what_a_static_step_has_left_stays_at_rest) {
  for (const char* cell : {"1", "2", "3"})
    for (const char* press_and_g : {"0", "1e4"}) {
      const DeckRun run =
          solved({{"cell", cell}, {"press", "1"}, {"g", press_and_g}, {"hit", "0"}, {"dt", "1"}, {"duration", "50"}});
      const std::vector<double>& z = run.column("corner", "z");
      EXPECT_GT(std::abs(z.back()), 1e-7);
      EXPECT_LT(std::abs(z.back() - z.at(1)), 1e-6 * std::abs(z.back()));
      EXPECT_LT(largest(run.column("energy", "kinetic")), 1e-10 * largest(run.column("energy", "strain")));
    }
}

// A step that goes on in a second one.
TEST(QuadraticIntegration, a_step_goes_on_where_another_ended) {
  const Settings whole = {{"press", "1"}, {"g", "1e4"}, {"mu", "0"}, {"driven", "0"}, {"hit", "0"}};
  Settings parts = whole;
  parts.emplace_back("parts", "2");
  EXPECT_LT(apart(solved(whole), solved(parts)), 1e-6);
}

const std::string falling = R"(
local p = param{ cell = 1, how = 2 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local cells = { "tet10", "hex20", "hex27", "prism15", "prism18" }
local block = substructure{ name = "block", material = steel, velocity = { 10, 3, 0 }, integration = ({ "implicit", "explicit", "automatic" })[p.how],
  mesh = mesh.box{ size = { 10*mm, 10*mm, 5*mm }, cells = { 4, 4, 2 }, cell = cells[p.cell] } }
local push = load.force{ on = block:face "xmax", x = history.half_sine{ peak = 1*kN, duration = 20*us } }
problem{ name = "falling", substructures = { block }, interfaces = {}, steps = { step.dynamic{ name = "fall", duration = 50*us, dt = 1*us, loads = { load.gravity{ z = -1000*g0 }, push } } },
  outputs = { output.history{ name = "place", on = block:where(function(x, y, z) return near(x, 0) and near(y, 0) and near(z, 0) end), quantity = "displacement" },
    output.momentum{ name = "momentum" }, output.energy{} } }:run{}
)";

TEST(QuadraticIntegration, a_body_falls_as_one_and_its_momentum_is_what_it_was_given) {
  const double mass = 7800 * 10e-3 * 10e-3 * 5e-3, weight = 9.80665e3 * mass, pushed = 2.0 / M_PI * 1e3 * 20e-6;
  for (const char* cell : {"1", "2", "3", "4", "5"}) {
    const DeckRun run = run_text(falling, {{"cell", cell}}).at(0);
    EXPECT_NEAR(run.column("momentum", "x").back(), 10 * mass + pushed, 1e-7 * pushed);
    EXPECT_NEAR(run.column("momentum", "z").back(), -weight * 50e-6, 1e-8 * weight * 50e-6);
    EXPECT_NEAR(run.column("momentum", "y").back(), 3 * mass, 1e-9 * 3 * mass);
    EXPECT_EQ(run.result->steps.at(0).diagonal_parts, std::vector<std::string>{"block"});
  }
}

TEST(QuadraticIntegration, the_program_takes_tetrahedra_by_itself_and_hex20_where_asked) {
  EXPECT_EQ(solved({{"how", "3"}}).result->steps.at(0).diagonal_parts.size(), 3u);
  EXPECT_EQ(solved({{"how", "3"}, {"cell", "3"}}).result->steps.at(0).diagonal_parts.size(), 3u);
  EXPECT_TRUE(solved({{"how", "3"}, {"cell", "2"}}).result->steps.at(0).explicit_parts.empty());
  const DeckRun asked = solved({{"how", "3"}, {"top", "2"}, {"cell", "2"}});  // its bonded face has common nodes
  EXPECT_EQ(asked.result->steps.at(0).diagonal_parts, std::vector<std::string>{"high"});
}

// Thrown at a wall, a bar turns round: rho c v A = 4 kN until the wave is back, 2 L / c = 20 us.
TEST(QuadraticIntegration, a_bar_bounces_off_a_wall) {
  const std::string thrown = R"(
local p = param{ cell = 1 }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0, density = 8000 }
local bar = substructure{ name = "bar", material = steel, integration = "explicit", velocity = { 0, 0, -1 },
  mesh = mesh.box{ size = { 10*mm, 10*mm, 50*mm }, cells = { 1, 1, 20 }, cell = ({ "tet10", "hex27", "prism18" })[p.cell] } }
local wall = support.wall{ name = "wall", on = bar:face "zmin" }
problem{ name = "thrown", substructures = { bar }, supports = { wall }, steps = { step.dynamic{ name = "flight", duration = 40*us, dt = 0.2*us } },
         outputs = { output.joint{ name = "hit", on = wall } } }:run{}
)";
  for (const char* cell : {"1", "2", "3"}) {
    const DeckRun run = run_text(thrown, {{"cell", cell}}).at(0);
    const std::vector<double>& force = run.column("hit", "normal");
    double impulse = 0.0, mean = 0.0;
    for (size_t i = 0; i < force.size(); ++i) {
      impulse += force[i] * 0.2e-6;
      if (i >= 10 && i < 90) mean += force[i] / 80.0;
    }
    std::cout << "  mean force " << mean << " N, impulse " << impulse << " N s\n";
    EXPECT_NEAR(mean, -4000.0, 0.03 * 4000.0);
    EXPECT_NEAR(impulse, -0.08, 0.04 * 0.08);
    EXPECT_EQ(force.back(), 0.0);
    EXPECT_LT(run.figure("energy created by the scheme [%]"), 0.1);
  }
}

// A bar held to one direction, hit at one end, with an end that lets the wave out.
const std::string bar = R"(
local p = param{ cell = 1, how = 2, n = 20, out = 1, duration = 60 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.0, density = 7800 }
local cells = { "tet10", "hex20", "hex27", "prism15", "prism18", "hex8" }
local a = 100*mm/p.n
local bar = substructure{ name = "bar", material = steel, integration = ({ "implicit", "explicit" })[p.how],
  mesh = mesh.box{ size = { 100*mm, 2*a, 2*a }, cells = { p.n, 2, 2 }, cell = cells[p.cell] } }
local supports = { support.symmetry{ name = "y", on = { bar:face "ymin", bar:face "ymax" } }, support.symmetry{ name = "z", on = { bar:face "zmin", bar:face "zmax" } } }
if p.out == 1 then supports[3] = support.absorbing{ name = "out", on = bar:face "xmax" } end
local push = load.pressure{ on = bar:face "xmin", history = history.haversine{ peak = 100*MPa, duration = 15*us } }
problem{ name = "bar", substructures = { bar }, supports = supports, solver = solver.latin{ precision = "double" },
  steps = { step.dynamic{ name = "hit", duration = p.duration*us, dt = 0.25*us, loads = { push } } },
  outputs = { output.energy{}, output.history{ name = "end", on = bar:face "xmax", quantity = "velocity", direction = { 1, 0, 0 } } } }:run{}
)";

TEST(QuadraticIntegration, non_reflecting_supports_let_waves_out_as_they_do_of_implicit_ones) {
  for (const char* cell : {"1", "2", "3", "4", "5"}) {
    double left[2];
    for (const int how : {1, 2}) {
      const DeckRun run = run_text(bar, {{"cell", cell}, {"how", std::to_string(how)}}).at(0);
      left[how - 1] = (run.column("energy", "kinetic").back() + run.column("energy", "strain").back()) /
                      largest(run.column("energy", "loads"));
      EXPECT_LT(imbalance(run), how == 2 ? 1e-11 : 1e-8);
    }
    std::cout << "  " << names[std::atoi(cell)] << ": left of the energy " << 100 * left[1] << " % (implicit "
              << 100 * left[0] << " %)\n";
    EXPECT_LT(left[1], 2e-3);
  }
}

// The estimate of the mesh error knows what the diagonal mass does (eq. Q12): against a mesh four times as fine.
TEST(QuadraticIntegration, the_estimated_error_has_the_phase_of_the_diagonal_mass) {
  const auto at = [](const char* cell, const char* n, const char* how) {
    return run_text(bar, {{"cell", cell}, {"n", n}, {"how", how}, {"out", "0"}, {"duration", "100"}}).at(0);
  };
  const DeckRun exact = at("3", "80", "2");
  for (const char* cell : {"1", "2", "3"}) {
    const DeckRun run = at(cell, "20", "2");
    double off = 0.0, size = 0.0;
    const std::vector<double>&mine = run.column("end", "velocity"), &fine = exact.column("end", "velocity");
    for (size_t i = 0; i < mine.size(); ++i) off += std::pow(mine[i] - fine.at(i), 2), size += fine[i] * fine[i];
    const double estimated = run.figure("error estimate, mesh [%]");
    std::cout << "  " << names[std::atoi(cell)] << ": estimated " << estimated << " %, velocity of the end off by "
              << 100 * std::sqrt(off / size) << " %\n";
    EXPECT_GT(estimated, 30 * std::sqrt(off / size));
    EXPECT_LT(estimated, 600 * std::sqrt(off / size));
  }
}

// The force between two blocks that a pulse crosses, with 8 distances of nodes a side, against 16 of hex27.
TEST(QuadraticIntegration, of_a_pulse_tetrahedra_keep_what_linear_hexahedra_do_and_complete_hexahedra_more) {
  const auto force = [](const char* cell, const char* n, const char* dt, const char* is_explicit) {
    const Settings settings = {{"cell", cell}, {"n", n}, {"dt", dt}, {"tuned", "0"}, {"explicit", is_explicit}};
    return run_file(deck("verification/pulse.lua"), settings).at(0).column("ab", "normal");
  };
  const std::vector<double> fine = force("3", "16", "0.04*us", "1");
  const auto error = [&](const char* cell, const char* dt, size_t ratio, const char* is_explicit) {
    const std::vector<double> coarse = force(cell, "8", dt, is_explicit);
    double apart = 0.0, size = 0.0;
    for (size_t i = 0; i < coarse.size(); ++i) {
      double mean = 0.0;  // forces are means over a dt
      for (size_t j = 0; j < ratio; ++j) mean += fine.at(ratio * i + j) / static_cast<double>(ratio);
      apart += std::pow(coarse[i] - mean, 2);
      size += mean * mean;
    }
    return 100.0 * std::sqrt(apart / size);
  };
  std::map<std::string, double> of_explicit;
  for (const auto& [cell, name] :
       {std::pair{"1", "hex8"}, {"4", "tet10"}, {"2", "hex20"}, {"3", "hex27"}, {"5", "prism18"}}) {
    of_explicit[name] = error(cell, "0.16*us", 4, "1");
    const double same_dt = error(cell, "0.16*us", 4, "0"), longer_dt = error(cell, "0.64*us", 16, "0");
    std::cout << "  " << name << ": explicit " << of_explicit[name] << " %, implicit at dt = 0.16 us " << same_dt
              << " %, at 0.64 us " << longer_dt << " %\n";
  }
  EXPECT_LT(of_explicit["tet10"], 1.5 * of_explicit["hex8"]);
  EXPECT_LT(of_explicit["hex27"], of_explicit["hex8"]);
  EXPECT_LT(of_explicit["hex27"], of_explicit["hex20"]);
}

}  // namespace
}  // namespace dygita::test::integration_quadratic_tests
