// output.loop closes its cycles in the steps that it was asked for, and says where they are not to be used.
#include <gtest/gtest.h>

#include "decks/engine.hpp"

namespace dygita::test::loops_tests {
namespace {

// A strap clamped on a base, pulled to and fro at two amplitudes, then shocked.
const std::string strap = R"(
local p = param{ most = 800, m = 8, shock = 0, tolerance = 1e-8, iterations = 0, named = 0, mu = 0.25 }
local metal = material.elastic{ name = "m", young = 70*GPa, poisson = 0.3, density = 2700 }
local base = substructure{ name = "base", material = metal, mesh = mesh.box{ size = { 40*mm, 10*mm, 2*mm }, cells = { 16, 1, 1 } } }
local strap = substructure{ name = "strap", material = metal, mesh = mesh.box{ origin = { 0, 0, 2*mm }, size = { 40*mm, 10*mm, 2*mm }, cells = { 16, 1, 1 } } }
local mating = interface.contact{ name = "mating", between = { base:face "zmax", strap:face "zmin" }, friction = p.mu }
local floor = support.fixed{ name = "floor", on = base:face "xmin" }
local guide = support.symmetry{ name = "guide", on = base:face "zmin" }
local press = load.pressure{ on = strap:face "zmax", history = 10*MPa }
local clamp = step.static{ name = "clamp", loads = { press } }
local F = p.most
local to_and_fro = history.piecewise{ times = { 0, 0.2, 0.4, 0.6, 0.8, 1 }, values = { 0, 0.6*F, -0.6*F, F, -F, F } }
local cycle = step.static{ name = "cycle", after = clamp, increments = 5 * p.m, loads = { press, load.force{ on = strap:face "xmax", x = to_and_fro } } }
local steps = { clamp, cycle }
if p.shock == 1 then
  steps[3] = step.dynamic{ name = "shock", after = cycle, duration = 100*us, dt = 0.5*us, loads = { press,
    load.force{ on = strap:face "xmax", x = function(t) return F * (1 + math.sin(2*math.pi * t / (20*us))) end } } }
end
local loop = output.loop{ name = "loop", on = mating, between = { base:face "xmin", strap:face "xmax" }, direction = { 1, 0, 0 },
                          after = clamp, steps = p.named == 1 and { steps[2], steps[3] } or nil }
local joint = output.joint{ name = "joint", on = mating }
problem{ name = "strap", substructures = { base, strap }, interfaces = { mating }, supports = { floor, guide }, steps = steps,
  outputs = { loop, joint }, solver = p.iterations > 0 and solver.latin{ max_iterations = p.iterations } or solver.latin{ static_tolerance = p.tolerance } }:run{}
)";

std::string line_of(const DeckRun& run) { return run.findings("loop").lines.at(0); }

TEST(Loop, ends_where_the_static_steps_end) {
  const DeckRun alone = run_text(strap).at(0), shocked = run_text(strap, {{"shock", "1"}}).at(0);
  EXPECT_EQ(line_of(alone), line_of(shocked));
  const Table &a = alone.part("loop", "cycles"), &b = shocked.part("loop", "cycles");
  ASSERT_EQ(a.n_rows(), 2);
  ASSERT_EQ(b.n_rows(), 2);
  for (int i = 0; i < 2; ++i) {
    EXPECT_GT(a.column("loss_factor")[i], 0.0);
    EXPECT_EQ(a.column("loss")[i], b.column("loss")[i]);
    EXPECT_EQ(a.column("converged")[i], 1.0);
  }
  EXPECT_EQ(alone.table("loop").n_rows(), shocked.table("loop").n_rows());
  // The last cycle loses what friction takes in it.
  const std::vector<double>& work = alone.column("joint", "friction_work");
  const double spent = work.at(5 * 8) - work.at(3 * 8);
  EXPECT_NEAR(a.column("loss").back(), spent, 0.02 * spent);
}

TEST(Loop, over_a_dynamic_step_says_so_where_cycles_gain_energy) {
  const DeckRun run = run_text(strap, {{"shock", "1"}, {"named", "1"}}).at(0);
  EXPECT_GT(run.table("loop").n_rows(), 200);
  const std::vector<double>& loss = run.part("loop", "cycles").column("loss");
  if (*std::min_element(loss.begin(), loss.end()) < 0.0) {
    ASSERT_FALSE(run.findings("loop").warnings.empty());
    EXPECT_NE(run.findings("loop").warnings[0].find("gain"), std::string::npos);
    EXPECT_EQ(line_of(run).find("loss grows"), std::string::npos);
  }
}

TEST(Loop, is_marked_where_increments_have_not_converged) {
  const DeckRun run = run_text(strap, {{"iterations", "12"}}).at(0);
  EXPECT_FALSE(run.result->converged);
  EXPECT_NE(line_of(run).find("NOT TO BE USED: "), std::string::npos) << line_of(run);
  EXPECT_GT(run.findings("loop").values.at("not_converged"), 0.0);
  const std::vector<double>& converged = run.part("loop", "cycles").column("converged");
  EXPECT_EQ(*std::min_element(converged.begin(), converged.end()), 0.0);
  EXPECT_TRUE(run.findings("loop").figures.empty());  // a study must not take it
}

// A loose tolerance is told by the estimate, by the loop, and by the energy balance without blaming the program. The
// smaller the force beside the clamping, the less of its loss is above what the tolerance leaves.
TEST(Loop, at_a_loose_tolerance_is_no_better_than_the_run_says) {
  for (const char* most : {"20", "200", "800"}) {
    const DeckRun exact = run_text(strap, {{"most", most}, {"tolerance", "1e-10"}}).at(0);
    const std::vector<double> loss_factor = exact.part("loop", "cycles").column("loss_factor");
    EXPECT_LT(exact.figure("error estimate, static, iteration [%]"), 0.001);
    for (const char* tolerance : {"1e-4", "1e-5", "1e-6"}) {
      testing::internal::CaptureStderr();
      const DeckRun loose = run_text(strap, {{"most", most}, {"tolerance", tolerance}}).at(0);
      const std::string said = testing::internal::GetCapturedStderr();
      const std::vector<double>& found = loose.part("loop", "cycles").column("loss_factor");
      ASSERT_EQ(found.size(), loss_factor.size());
      double off = 0.0;
      for (size_t i = 0; i < found.size(); ++i) off = std::max(off, std::abs(found[i] - loss_factor[i]));
      const double estimate = 0.01 * loose.figure("error estimate, static, iteration [%]");
      std::cout << most << " N, " << tolerance << ": loss factor off by " << off << ", estimate " << estimate << "\n";
      EXPECT_LT(off, estimate) << most << " N, " << tolerance;
      EXPECT_EQ(said.find("this is a bug"), std::string::npos) << said;
      EXPECT_EQ(said.find("gain"), std::string::npos) << said;
      if (estimate > 0.01) {
        EXPECT_NE(said.find("static tolerance"), std::string::npos) << said;
      }
      // Where no loss is above what is left there is no exponent of it.
      if (loss_factor.back() < 0.1 * estimate) {
        EXPECT_EQ(line_of(loose).find("loss grows"), std::string::npos);
      }
    }
  }
}

TEST(Loop, of_a_joint_that_does_not_move_has_no_stiffness) {
  const DeckRun run = run_text(R"(
local metal = material.elastic{ name = "m", young = 70*GPa, poisson = 0, density = 2700 }
local low = substructure{ name = "low", material = metal, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 2, 2, 2 } } }
local high = substructure{ name = "high", material = metal, mesh = mesh.box{ origin = { 0, 0, 10*mm }, size = { 10*mm, 10*mm, 10*mm }, cells = { 2, 2, 2 } } }
local touch = interface.contact{ name = "touch", between = { low:face "zmax", high:face "zmin" }, friction = 0.9 }
local floor = support.fixed{ name = "floor", on = low:face "zmin" }
local press = load.pressure{ on = high:face "zmax", history = 10*MPa }
local clamp = step.static{ name = "clamp", loads = { press } }
local pull = step.static{ name = "pull", after = clamp, increments = 6, loads = { press,
  load.force{ on = high:face "zmin", x = function(t) return 10 * math.sin(2 * math.pi * t) end } } }
problem{ name = "sticks", substructures = { low, high }, interfaces = { touch }, supports = { floor }, steps = { clamp, pull },
  outputs = { output.loop{ name = "loop", on = touch, direction = { 1, 0, 0 }, after = clamp } } }:run{}
)")
                          .at(0);
  EXPECT_TRUE(run.result->converged);
  EXPECT_NE(line_of(run).find("nothing moves in step 'pull'"), std::string::npos) << line_of(run);
  EXPECT_EQ(line_of(run).find("N/m"), std::string::npos);
  EXPECT_TRUE(std::isnan(run.findings("loop").values.at("stiffness")));
  EXPECT_TRUE(std::isnan(run.findings("loop").values.at("secant")));
  EXPECT_EQ(run.part("loop", "cycles").n_rows(), 0);
}

}  // namespace
}  // namespace dygita::test::loops_tests
