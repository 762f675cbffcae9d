// Frequency and damping of a mode against its amplitude: a mass on Iwan's joints in closed form, by Masing's rule and
// by a whole cycle; as it rings down; turned; what is refused. Time steps that friction and motion ask for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/error.hpp"
#include "decks/engine.hpp"

namespace dygita::test::backbones_tests {
namespace {

// A cube between two lap joints, which holders have; the joints slip little by little along x and y.
const std::string sandwich = R"(
local p = param{ a = 400, n = 40, cycle = 0, turned = 0, number = 1, early = 0, ring = 0 }
local steel = material.elastic{ name = "steel", young = 2000*GPa, poisson = 0, density = 7800 }
local place = p.turned == 1 and { rotate = { axis = { 1, 2, 3 }, angle = 0.7 } } or nil
local function box(name, z, height, n)
  return substructure{ name = name, material = steel, place = place, mesh = mesh.box{ origin = { 0, 0, z }, size = { 10*mm, 10*mm, height }, cells = { 2, 2, n } } }
end
local low, mid, high = box("low", -4*mm, 4*mm, 1), box("mid", 0, 10*mm, 2), box("high", 10*mm, 4*mm, 1)
local function lap(name, a, b)
  return interface.iwan{ name = name, between = { a, b }, slip = 20*kPa, stiffness = 2e9, chi = -0.5, beta = 0.1, sliders = 200 }
end
local lower, upper = lap("lower", low:face "zmax", mid:face "zmin"), lap("upper", mid:face "zmax", high:face "zmin")
-- Along x alone: the three motions in the joints' plane have one frequency.
local base, guide = support.fixed{ name = "base", on = { low:face "zmin", high:face "zmax" } }, support.symmetry{ name = "guide", on = { mid:face "ymin", mid:face "ymax" } }
local rest = step.static{ name = "rest" }
local modes = output.modes{ name = "modes", n = 3, after = p.early == 0 and rest or nil }
local number = math.tointeger(p.number)
local function push(name, after, a)
  return step.static{ name = name, after = after, increments = math.tointeger(p.n),
    loads = { load.mode{ mode = modes, number = number, parts = { low, mid, high }, value = a } } }
end
local steps = { rest }
steps[#steps + 1] = push("push", steps[#steps], p.a)
if p.cycle == 1 then
  steps[3] = push("pull", steps[2], -p.a)
  steps[4] = push("back", steps[3], p.a)
end
local made = {}
for i = 2, #steps do made[#made + 1] = steps[i] end
local outputs = { modes, output.backbone{ name = "backbone", mode = modes, number = number, steps = made } }
if p.ring == 1 then    -- let go
  steps[#steps + 1] = step.dynamic{ name = "ring", after = steps[#steps], duration = 25*ms, dt = 10*us }
  local x = output.history{ name = "x", on = mid:face "xmax", quantity = "displacement", direction = { 1, 0, 0 } }
  for _, made in ipairs{ x, output.ringdown{ name = "of mode", of = x, mode = modes, number = 1 }, output.ringdown{ name = "of band", of = x, band = { 600, 1700 } } } do
    table.insert(outputs, made)
  end
end
problem{ name = "sandwich", substructures = { low, mid, high }, interfaces = { lower, upper }, supports = { base, guide }, steps = steps,
  solver = solver.latin{ static_tolerance = 1e-11 },
  outputs = outputs }:run{}
)";

constexpr double mass = 7.8e-3, area = 2e-4, stiffness = 2e9, slip = 2e4, chi = -0.5, beta = 0.1;

// Segalman's four parameters: the force of a first loading (N), and what a cycle loses (J).
double constant() {
  const double shape = beta + (chi + 1) / (chi + 2), most = slip * (1 + beta) / (stiffness * shape);
  return slip * (chi + 1) / (std::pow(most, chi + 2) * shape);
}
double force(double u) { return area * (stiffness * u - constant() * std::pow(u, chi + 2) / ((chi + 1) * (chi + 2))); }
double loss(double u) { return area * 4 * constant() * std::pow(u, chi + 3) / ((chi + 2) * (chi + 3)); }
double damping(double u) { return loss(u) / (2 * M_PI * force(u) * u); }

TEST(Backbone, of_a_mass_on_two_lap_joints_is_Iwans) {
  const DeckRun run = run_text(sandwich, {}, 1).at(0);
  const std::vector<double>&a = run.column("backbone", "acceleration"), &q = run.column("backbone", "displacement");
  ASSERT_EQ(a.size(), 40u);
  EXPECT_NEAR(a.back(), 400.0, 1e-6);
  double off_frequency = 0.0, off_damping = 0.0;
  for (size_t i = 0; i < a.size(); ++i) {
    const double frequency = std::sqrt(force(q[i]) / (mass * q[i])) / (2 * M_PI);
    off_frequency = std::max(off_frequency, std::abs(run.column("backbone", "frequency")[i] / frequency - 1));
    if (i >= 4) off_damping = std::max(off_damping, std::abs(run.column("backbone", "damping")[i] / damping(q[i]) - 1));
  }
  std::cout << "  frequency off by " << off_frequency << ", damping by " << off_damping << "\n";
  EXPECT_LT(off_frequency, 1e-3);
  EXPECT_LT(off_damping, 0.02);
  EXPECT_GT(run.column("backbone", "damping").back(), 0.05);
  const double small = std::sqrt(stiffness * area / mass) / (2 * M_PI);
  EXPECT_NEAR(run.column("modes", "frequency").front(), small, 1e-3 * small);
}

TEST(Backbone, of_a_whole_cycle_loses_what_Masing_has) {
  const DeckRun run = run_text(sandwich, {{"cycle", "1"}, {"n", "60"}}, 1).at(0);
  const double q = run.column("backbone", "displacement").back();
  const double cycle = run.findings("backbone").values.at("cycle_damping");
  std::cout << "  " << cycle << " for " << damping(q) << "\n";
  EXPECT_NEAR(cycle, damping(q), 0.02 * damping(q));
  const double frequency = std::sqrt(force(q) / (mass * q)) / (2 * M_PI);
  EXPECT_NEAR(run.findings("backbone").values.at("cycle_frequency"), frequency, 1e-3 * frequency);
  EXPECT_EQ(run.column("backbone", "displacement").size(), 60u);
}

// At a hundred times the cost.
TEST(Backbone, is_what_a_ringdown_shows) {
  const DeckRun run = run_text(sandwich, {{"ring", "1"}}, 1).at(0);
  const std::vector<double>& q = run.column("backbone", "displacement");
  for (const char* name : {"of mode", "of band"}) {
    const std::vector<double>&amplitude = run.column(name, "amplitude"), &frequency = run.column(name, "frequency"),
          &damping_found = run.column(name, "damping");
    int n_compared = 0;
    double off_frequency = 0.0, off_damping = 0.0;
    for (size_t i = 0; i < amplitude.size(); ++i) {
      if (amplitude[i] < 5e-7 || amplitude[i] > 2.6e-6) continue;
      const auto right = static_cast<size_t>(std::lower_bound(q.begin(), q.end(), amplitude[i]) - q.begin());
      ASSERT_TRUE(right > 0 && right < q.size());
      const double share = (amplitude[i] - q[right - 1]) / (q[right] - q[right - 1]);
      const auto at = [&](const char* column) {
        const std::vector<double>& values = run.column("backbone", column);
        return values[right - 1] + share * (values[right] - values[right - 1]);
      };
      off_frequency = std::max(off_frequency, std::abs(frequency[i] / at("frequency") - 1));
      off_damping = std::max(off_damping, std::abs(damping_found[i] / damping(amplitude[i]) - 1));
      ++n_compared;
    }
    std::cout << "  " << name << ": frequency off by " << off_frequency << ", damping by " << off_damping << ", in "
              << n_compared << " periods\n";
    EXPECT_GE(n_compared, 10);
    EXPECT_LT(off_frequency, 0.005);
    EXPECT_LT(off_damping, 0.1);
  }
}

TEST(Backbone, is_the_same_turned) {
  const DeckRun run = run_text(sandwich, {}, 1).at(0), other = run_text(sandwich, {{"turned", "1"}}, 1).at(0);
  EXPECT_NEAR(other.column("backbone", "frequency").back(), run.column("backbone", "frequency").back(), 1e-3);
  EXPECT_NEAR(other.column("backbone", "damping").back(), run.column("backbone", "damping").back(), 1e-6);
}

// A clamped bar along its axis: nothing rubs, and damping of the stiffness has beta w/2 at any amplitude.
TEST(Backbone, has_the_damping_of_the_materials) {
  const DeckRun run = run_text(R"(
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0, density = 8000, damping = 2e-6 }
local bar = substructure{ name = "bar", material = steel, mesh = mesh.box{ size = { 10*mm, 10*mm, 400*mm }, cells = { 1, 1, 40 } } }
local rest = step.static{ name = "rest" }
local modes = output.modes{ name = "modes", n = 1, after = rest }
local push = step.static{ name = "push", after = rest, increments = 3, loads = { load.mode{ mode = modes, number = 1, parts = { bar }, value = 10 } } }
local pull = step.static{ name = "pull", after = push, increments = 3, loads = { load.mode{ mode = modes, number = 1, parts = { bar }, value = -10 } } }
local back = step.static{ name = "back", after = pull, increments = 3, loads = { load.mode{ mode = modes, number = 1, parts = { bar }, value = 10 } } }
problem{ name = "bar", substructures = { bar }, supports = { support.fixed{ name = "base", on = bar:face "zmin" },
    support.symmetry{ name = "x", on = { bar:face "xmin", bar:face "xmax" } }, support.symmetry{ name = "y", on = { bar:face "ymin", bar:face "ymax" } } },
  steps = { rest, push, pull, back }, outputs = { modes, output.backbone{ name = "backbone", mode = modes, number = 1, steps = { push, pull, back } } } }:run{}
)",
                               {}, 1)
                          .at(0);
  const double frequency = 5000.0 / (4 * 0.4);  // quarter of a wave
  EXPECT_NEAR(run.column("backbone", "frequency").back(), frequency, 2e-4 * frequency);
  for (const char* column : {"damping", "material_damping"})
    for (const double zeta : run.column("backbone", column)) EXPECT_NEAR(zeta, 2e-6 * M_PI * frequency, 1e-5) << column;
  const std::map<std::string, double>& values = run.findings("backbone").values;
  EXPECT_NEAR(values.at("cycle_damping"), 2e-6 * M_PI * frequency, 1e-5);
  EXPECT_NEAR(values.at("cycle_frequency"), frequency, 2e-4 * frequency);
}

TEST(Backbone, needs_modes_that_are_there) {
  EXPECT_THROW(run_text(sandwich, {{"early", "1"}}, 1), NumericalError);
  EXPECT_THROW(run_text(sandwich, {{"number", "9"}}, 1), NumericalError);
}

// Two blocks; 5 mm is the shortest edge of a cell.
const std::string blocks = R"(
local p = param{ mu = 0, up_to = 0, duration = 2*ms, twice = 0 }
local metal = material.elastic{ name = "metal", young = 200*GPa, poisson = 0.25, density = 8000 }
local function block(name, z) return substructure{ name = name, material = metal,
  mesh = mesh.box{ size = { 20*mm, 20*mm, 20*mm }, cells = { 2, 2, 4 }, origin = { 0, 0, z } } } end
local a, b = block("a", 0), block("b", 20*mm)
local joint = interface.contact{ name = "joint", between = { a:face "zmax", b:face "zmin" }, friction = p.mu }
local shock = step.dynamic{ name = "shock", duration = p.duration, loads = { load.pressure{ on = b:face "zmax", history = 1*MPa } } }
local top  = output.history{ name = "top", on = b:face "zmax", quantity = "acceleration", direction = { 0, 0, 1 } }
local function run(up_to)
  local outputs = { top }
  if up_to > 0 then outputs[2] = output.srs{ name = "of top", of = top, from = 0.5*up_to, to = up_to } end
  return problem{ name = "blocks", substructures = { a, b }, interfaces = { joint }, supports = { support.fixed{ name = "base", on = a:face "zmin" } },
    steps = { shock }, outputs = outputs }
end
local first = run(p.up_to)
if p.twice == 1 then run(2*p.up_to):run{ case = "twice" } end
first:run{}
)";

int n_steps(const DeckRun& run) { return static_cast<int>(run.column("top", "time").size()); }

TEST(TimeStep, left_out_is_of_the_highest_frequency_that_an_output_asks_for) {
  EXPECT_EQ(n_steps(run_text(blocks, {{"up_to", "5000"}}, 1).at(0)), 200);
  EXPECT_EQ(n_steps(run_text(blocks, {{"up_to", "5000"}, {"mu", "0.2"}}, 1).at(0)), 400);
}

TEST(TimeStep, left_out_is_of_the_frequencies_of_a_pulse) {
  std::string pulse = blocks;
  const std::string constant = "history = 1*MPa";
  pulse.replace(pulse.find(constant), constant.size(),
                "history = history.half_sine{ peak = 1*MPa, duration = 0.5*ms }");
  // 95 % of the energy of half a sine lie below 0.91 over its duration; four durations resolve a quarter of that.
  const double a_period = 20, duration = 2e-3, pulse_length = 0.5e-3;
  EXPECT_NEAR(n_steps(run_text(pulse, {}, 1).at(0)), a_period * duration * 0.91 / pulse_length,
              a_period * duration * 0.25 / pulse_length);
}

TEST(TimeStep, left_out_is_of_what_the_mesh_carries_where_nothing_else_tells) {
  const double shear = std::sqrt(80e9 / 8000), carried = shear / (5 * 5e-3);
  EXPECT_EQ(n_steps(run_text(blocks, {{"duration", "0.1e-3"}}, 1).at(0)),
            static_cast<int>(std::ceil(0.1e-3 * carried * 20)));
}

TEST(TimeStep, left_out_is_one_for_all_problems_of_a_step) {
  EXPECT_THROW(run_text(blocks, {{"up_to", "5000"}, {"twice", "1"}}, 1), InputError);
}

// Two bars clamped at one end and pressed together, the upper one let go: they slide on each other as they swing.
const std::string bars = R"(
local p = param{ dt = 20*us, rough = 0 }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0, density = 7800 }
local function bar(name, z) return substructure{ name = name, material = steel,
  mesh = mesh.box{ origin = { 0, 0, z }, size = { 200*mm, 10*mm, 5*mm }, cells = { 16, 1, 2 } } } end
local low, high = bar("low", 0), bar("high", 5*mm)
local seam = interface.contact{ name = "seam", between = { low:face "zmax", high:face "zmin" }, friction = 0.2,
  compliance = p.rough == 1 and { normal = 1e13, tangential = 1e13 } or nil }
local base = support.fixed{ name = "base", on = { low:face "xmin", high:face "xmin" } }
local press = { load.pressure{ on = low:face "zmin", history = 2*MPa }, load.pressure{ on = high:face "zmax", history = 2*MPa } }
local clamp = step.static{ name = "clamp", loads = press }
local pull = step.static{ name = "pull", after = clamp, increments = 4, loads = { press[1], press[2], load.force{ on = high:face "xmax", z = 30 } } }
local ring = step.dynamic{ name = "ring", after = pull, duration = 10*ms, dt = p.dt, loads = press }
problem{ name = "bars", substructures = { low, high }, interfaces = { seam }, supports = { base }, steps = { clamp, pull, ring }, outputs = { output.energy{} } }:run{}
)";

// What the run says of its friction; empty: nothing.
std::string said_of_friction(const Settings& settings) {
  const DeckRun run = run_text(bars, settings, 1).at(0);
  for (const std::string& warning : run.result->warnings)
    if (warning.find("of what friction takes at 'seam' goes in slides of one or two time steps") != std::string::npos)
      return warning;
  return "";
}

TEST(TimeStep, that_is_too_long_for_friction_is_said) {
  const auto share = [](const std::string& said) {
    EXPECT_EQ(said.rfind("step 'ring': ", 0), 0u);
    return said.empty() ? 0.0 : std::atof(said.c_str() + std::string("step 'ring': ").size());
  };
  const double coarse = share(said_of_friction({{"dt", "100e-6"}})), fine = share(said_of_friction({}));
  EXPECT_GT(coarse, 40.0);
  EXPECT_LT(fine, 30.0);
  EXPECT_EQ(said_of_friction({{"rough", "1"}}), "");
}

}  // namespace
}  // namespace dygita::test::backbones_tests
