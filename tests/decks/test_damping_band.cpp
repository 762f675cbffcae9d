// Constant damping over a band (manual, eq. D22-D25, S16): decay and frequency of bars, with every solver, implicit and
// explicit, from step to step, under moving supports, in pieces.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "decks/engine.hpp"
#include "material/elastic.hpp"

namespace dygita::test::damping_band_tests {
namespace {

constexpr double pi = std::numbers::pi;

// A bar held at one end, pulled and let go: its first mode is at `frequency` (Hz), a quarter of a wave of 5 km/s.
std::string bar(double frequency, double per_period, const std::string& damping, const std::string& more = "") {
  return R"(
local f, n = )" +
         std::to_string(frequency) + ", " + std::to_string(per_period) + R"(
local L = 5000 / (4 * f)
local steel = material.elastic{ name = "s", young = 200*GPa, poisson = 0, density = 8000, )" +
         damping + R"( }
local bar = substructure{ name = "bar", material = steel, )" +
         more + R"( mesh = mesh.box{ size = { L / 20, L / 20, L }, cells = { 1, 1, 20 } } }
local base = support.fixed{ name = "base", on = bar:face "zmin" }
local pull = load.traction{ on = bar:face "zmax", z = 10*MPa }
local hold = step.static{ name = "hold", loads = { pull } }
local ring = step.dynamic{ name = "ring", after = hold, duration = 14 / f, dt = 1 / (f * n) }
local u = output.history{ name = "u", on = bar:face "zmax", quantity = "displacement", direction = { 0, 0, 1 } }
problem{ name = "bar", substructures = { bar }, supports = { base }, steps = { hold, ring }, solver = solver.latin{ mass = "lumped" }, outputs = { u, output.energy{} } }:run{}
)";
}

// Amplitude and phase of a component (Hz) in a window of eight of its periods, which leaves nothing of the bar's
// others.
std::complex<double> component(const std::vector<double>& t, const std::vector<double>& u, double frequency,
                               double from) {
  const double width = 8.0 / frequency;
  std::complex<double> sum = 0.0;
  for (size_t i = 1; i < t.size(); ++i) {
    const double at = (t[i] - from) / width;
    if (at <= 0.0 || at >= 1.0) continue;
    sum += u[i] * (t[i] - t[i - 1]) * (1.0 - std::cos(2.0 * pi * at)) * std::polar(1.0, -2.0 * pi * frequency * t[i]);
  }
  return sum;
}

struct Decay {
  double ratio, frequency;  // of critical damping; Hz, without it
};

Decay decay_of(const DeckRun& run, double frequency) {
  const Table& table = run.table("u");
  std::vector<double> t, u;
  for (int i = 0; i < table.n_rows(); ++i)
    if (table.step[i] == 1) t.push_back(table.columns[0][i]), u.push_back(table.columns[1][i]);
  const double apart = 5.0 / frequency;
  const std::complex<double> change =
      component(t, u, frequency, t.front() + apart) / component(t, u, frequency, t.front());
  const double rate = -std::log(std::abs(change)) / apart, omega = 2.0 * pi * frequency + std::arg(change) / apart;
  return {rate / std::hypot(rate, omega), std::hypot(rate, omega) / (2.0 * pi)};
}

const char* const band = "damping_ratio = 0.015, damping_band = { 100*Hz, 10*kHz }";

// The first frequency of the bar's 20 cells with lumped mass, and of an increment that turns it too little or too far.
double of_cells(double frequency) { return frequency * std::sin(pi / 80) / (pi / 80); }
double of_trapezoids(double frequency, double dt) { return std::atan(pi * frequency * dt) / (pi * dt); }

class Band : public ::testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(DampingBand, Band, ::testing::Values(100.0, 200.0, 500.0, 1e3, 2e3, 5e3, 1e4),
                         [](const auto& tested) { return std::to_string(static_cast<int>(tested.param)) + "_Hz"; });

TEST_P(Band, has_one_ratio_from_end_to_end) {
  const double f = GetParam();
  const Damping damping = damping_over(0.015, {100.0, 1e4});
  for (const char* integration : {"implicit", "explicit"}) {
    const DeckRun run = run_text(bar(f, 160, band, "integration = '" + std::string(integration) + "',")).at(0);
    const Decay found = decay_of(run, f);
    const double expected = of_cells(f) * std::sqrt(damping.storage(f));
    RecordProperty(integration, std::to_string(found.ratio));
    EXPECT_NEAR(found.ratio, 0.015, 0.0015) << integration;
    EXPECT_NEAR(found.ratio, damping.ratio(f), 0.02 * damping.ratio(f)) << integration;  // of first order in the ratio
    EXPECT_NEAR(found.frequency, expected, 1e-3 * expected) << integration;
    EXPECT_LT(run.figure("energy imbalance [%]"), 1e-5) << integration;
    const std::vector<double>&strain = run.column("energy", "strain"), &lost = run.column("energy", "damping");
    EXPECT_GT(lost.back(), 0.8 * strain.at(1)) << integration;
  }
}

TEST(DampingBand, does_not_depend_on_the_time_step) {
  const Damping damping = damping_over(0.015, {100.0, 1e4});
  for (const double per_period : {10.0, 20.0, 40.0}) {
    const DeckRun run = run_text(bar(1e3, per_period, band, "integration = 'implicit',")).at(0);
    const Decay found = decay_of(run, 1e3);
    // The increment takes the motion, and the branches with it, as one of a frequency that is higher by what it turns
    // too little.
    EXPECT_NEAR(found.ratio, 0.015, 0.0015) << per_period;
    const double expected = of_trapezoids(of_cells(1e3) * std::sqrt(damping.storage(1e3)), 1e-3 / per_period);
    EXPECT_NEAR(found.frequency, expected, 2e-3 * expected) << per_period;
    EXPECT_LT(run.figure("energy imbalance [%]"), 1e-5);
  }
}

TEST(DampingBand, leaves_static_steps_alone) {
  const DeckRun with = run_text(bar(1e3, 20, band)).at(0), without = run_text(bar(1e3, 20, "damping = 0")).at(0);
  EXPECT_EQ(with.column("u", "displacement").at(1), without.column("u", "displacement").at(1));
  // 10 MPa / 200 GPa of 1.25 m.
  EXPECT_NEAR(with.column("u", "displacement").at(1), 62.5e-6, 1e-12);
}

// What a bar does whose foot is driven, in two steps, and then stands under a load.
std::string driven(const std::string& damping, const std::string& more, double dt, const std::string& steps) {
  return R"(
local dt = )" +
         std::to_string(1e9 * dt) + R"(*1e-9
local m = material.elastic{ name = "m", young = 70*GPa, poisson = 0.3, density = 2700, )" +
         damping + R"( }
local bar = substructure{ name = "bar", material = m, )" +
         more + R"( mesh = mesh.box{ size = { 20*mm, 20*mm, 200*mm }, cells = { 2, 2, 16 } } }
local top = substructure{ name = "top", material = m, mesh = mesh.box{ origin = { 0, 0, 200*mm }, size = { 20*mm, 20*mm, 50*mm }, cells = { 2, 2, 4 } } }
local weld = interface.bonded{ name = "weld", between = { bar:face "zmax", top:face "zmin" } }
local base = support.fixed{ name = "base", on = bar:face "zmin" }
local shakes = { load.base_acceleration{ on = base, direction = { 1, 0, 0 }, history = history.half_sine{ peak = 5000, duration = 0.5*ms } },
                 load.base_acceleration{ on = base, direction = { 0, 0, 1 }, history = history.half_sine{ peak = 8000, duration = 0.3*ms } } }
)" + steps +
         R"(
local u = output.history{ name = "u", on = top:face "zmax", quantity = "velocity", direction = { 1, 0, 0 } }
local w = output.history{ name = "w", on = top:face "zmax", quantity = "displacement", direction = { 0, 0, 1 } }
problem{ name = "bar", substructures = { bar, top }, interfaces = { weld }, supports = { base }, steps = steps, outputs = { u, w, output.energy{}, output.resultant{ name = "foot", on = base } } }:run{}
)";
}

const std::string one_step =
    "local steps = { step.dynamic{ name = 'shock', duration = 1*ms, dt = dt, loads = shakes } }\n";
const std::string two_steps = R"(
local first = step.dynamic{ name = 'shock', duration = 0.6*ms, dt = dt, loads = shakes }
local steps = { first, step.dynamic{ name = 'ring', after = first, duration = 0.4*ms, dt = dt } }
)";

double distance(const DeckRun& a, const DeckRun& b, const std::string& output, const std::string& of) {
  const std::vector<double>&x = a.column(output, of), &y = b.column(output, of);
  const size_t n = std::min({x.size(), y.size(), size_t{400}});  // a second step has a row more, of its start
  double apart = 0.0, most = 0.0;
  for (size_t i = 1; i <= n; ++i) {
    apart = std::max(apart, std::abs(x[x.size() - i] - y[y.size() - i]));
    most = std::max(most, std::abs(x[x.size() - i]));
  }
  return apart / most;
}

const char* const strong = "damping_ratio = 0.05, damping_band = { 200*Hz, 20*kHz }";

TEST(DampingBand, is_the_same_with_every_solver_as_dt_goes_to_zero) {
  const DeckRun finest =
      run_text(driven(strong, "integration = 'implicit',", 0.125e-6, one_step), {}, 0, "monolithic").at(0);
  const std::vector<std::pair<std::string, std::string>> ways{
      {"implicit", "latin{ mass = 'lumped' }"},
      {"explicit", "latin{ mass = 'lumped' }"},
      {"implicit", "monolithic"},
      {"implicit", "explicit{ bulk_viscosity = false, integration = 'full' }"}};
  for (const auto& [integration, solver] : ways) {
    double before = 0.0;
    for (const double dt : {1e-6, 0.5e-6}) {
      const DeckRun run =
          run_text(driven(strong, "integration = '" + integration + "',", dt, one_step), {}, 0, solver).at(0);
      EXPECT_LT(run.figure("energy imbalance [%]"), 1e-2) << integration << ", " << solver;
      const double imbalance = run.figure("energy imbalance [%]");
      const std::vector<double>&a = finest.column("w", "displacement"), &b = run.column("w", "displacement");
      const size_t every = (a.size() - 1) / (b.size() - 1);
      double apart = 0.0, most = 0.0;
      for (size_t i = 0; i < b.size(); ++i) {
        // The base moves on: the stretch of the bar alone.
        apart = std::max(apart, std::abs(b[i] - a[i * every]));
        most = std::max(most, std::abs(a[i * every] - a.front()));
      }
      RecordProperty(integration + " " + solver, std::to_string(apart / most) + ", " + std::to_string(imbalance));
      EXPECT_LT(apart, 3e-3 * most) << integration << ", " << solver << ", " << dt;
      EXPECT_TRUE(before == 0.0 || apart < 0.4 * before) << integration << ", " << solver;
      before = apart;
      EXPECT_NEAR(run.column("energy", "damping").back(), finest.column("energy", "damping").back(),
                  0.01 * finest.column("energy", "damping").back())
          << integration << ", " << solver;
    }
  }
}

TEST(DampingBand, goes_on_from_step_to_step) {
  for (const auto& [integration, solver] :
       {std::pair("implicit", "latin{ mass = 'lumped' }"), std::pair("explicit", "latin{ mass = 'lumped' }"),
        std::pair("implicit", "monolithic"), std::pair("implicit", "explicit")}) {
    const std::string how = "integration = '" + std::string(integration) + "',";
    const DeckRun one = run_text(driven(strong, how, 1e-6, one_step), {}, 0, solver).at(0),
                  two = run_text(driven(strong, how, 1e-6, two_steps), {}, 0, solver).at(0);
    const bool is_iterated = std::string(solver).starts_with("latin");
    EXPECT_LT(distance(one, two, "u", "velocity"), is_iterated ? 1e-4 : 1e-8) << integration << ", " << solver;
    EXPECT_LT(two.figure("energy imbalance [%]"), 1e-2) << integration << ", " << solver;
    // Forgotten elongations would show.
    EXPECT_GT(one.column("energy", "damping").back(), 0.01 * one.column("energy", "loads").back());
  }
}

TEST(DampingBand, does_not_feel_a_cut) {
  for (const char* integration : {"implicit", "explicit"}) {
    const std::string how = "integration = '" + std::string(integration) + "', ";
    const DeckRun whole = run_text(driven(strong, how, 1e-6, two_steps)).at(0),
                  cut = run_text(driven(strong, how, 1e-6, two_steps), {}, 0, "latin{ pieces = 3 }").at(0);
    EXPECT_LT(distance(whole, cut, "u", "velocity"), 1e-3) << integration;
    EXPECT_LT(distance(whole, cut, "foot", "x"), 1e-3) << integration;
    EXPECT_NEAR(cut.column("energy", "damping").back(), whole.column("energy", "damping").back(),
                1e-3 * whole.column("energy", "damping").back());
  }
}

TEST(DampingBand, is_relaxed_by_a_static_step) {
  const std::string steps = R"(
local shock = step.dynamic{ name = 'shock', duration = 0.6*ms, dt = dt, loads = shakes }
local steps = { shock, step.static{ name = 'rest', after = shock, loads = { load.pressure{ on = top:face "zmax", history = 7*MPa } } } }
)";
  for (const char* solver : {"latin", "monolithic"}) {
    const DeckRun with = run_text(driven(strong, "", 1e-6, steps), {}, 0, solver).at(0),
                  without = run_text(driven("damping = 0", "", 1e-6, steps), {}, 0, solver).at(0);
    // From where the base has been driven to, by the last pressure: 7 MPa / 70 GPa of 250 mm.
    EXPECT_NEAR(with.column("w", "displacement").back(), without.column("w", "displacement").back(), 1e-11) << solver;
    EXPECT_LT(with.figure("energy imbalance [%]"), 1e-2);
  }
}

// Modes have the damping of their frequency.
TEST(DampingBand, is_that_of_modes) {
  const DeckRun run = run_text(R"(
local m = material.elastic{ name = "m", young = 70*GPa, poisson = 0.3, density = 2700, damping_ratio = 0.02, damping_band = { 100*Hz, 10*kHz } }
local arm = substructure{ name = "arm", material = m, mesh = mesh.box{ size = { 10*mm, 20*mm, 300*mm }, cells = { 1, 2, 30 } } }
local root = support.fixed{ name = "root", on = arm:face "zmin" }
local rest = step.static{ name = "rest" }
local modes = output.modes{ name = "modes", n = 8 }
problem{ name = "arm", substructures = { arm }, supports = { root }, steps = { rest }, outputs = { modes } }:run{}
)")
                          .at(0);
  const Damping damping = damping_over(0.02, {100.0, 1e4});
  const std::vector<double>&f = run.column("modes", "frequency"), &ratio = run.column("modes", "damping");
  ASSERT_EQ(f.size(), 8u);
  for (size_t i = 0; i < f.size(); ++i) {
    EXPECT_NEAR(ratio[i], damping.ratio(f[i]), 1e-9) << f[i];
    EXPECT_TRUE(f[i] < 100.0 || f[i] > 1e4 || std::abs(ratio[i] - 0.02) < 0.001) << f[i];
  }
}

}  // namespace
}  // namespace dygita::test::damping_band_tests
