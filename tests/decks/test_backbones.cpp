// Frequency and damping of a mode against its amplitude: a mass on Iwan's joints in closed form, by Masing's rule and
// by a whole cycle; as it rings down; turned; what is refused.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

TEST(Backbone, needs_modes_that_are_there) {
  EXPECT_THROW(run_text(sandwich, {{"early", "1"}}, 1), NumericalError);
  EXPECT_THROW(run_text(sandwich, {{"number", "9"}}, 1), NumericalError);
}

}  // namespace
}  // namespace dygita::test::backbones_tests
