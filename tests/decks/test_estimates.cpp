// A run's own estimates of its errors, held against its true ones; and what it says where the physics asks for more
// than dt, mesh or tolerance can give.
#include <gtest/gtest.h>

#include "decks/effectivity.hpp"

namespace dygita::test {
namespace {

class Pulse : public testing::Test {
 protected:
  void SetUp() override {
    const std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();  // tests run side by side
    path_ = std::filesystem::temp_directory_path() / ("dygita_test_pulse_" + name + ".lua");
    std::ofstream(path_) << pulse;
  }
  void TearDown() override { std::filesystem::remove(path_); }

  std::filesystem::path path_;
};

void expect_effective(double estimated, double truth) {
  EXPECT_GT(estimated, 0.5 * truth);
  EXPECT_LT(estimated, 3.0 * truth);
}

TEST_F(Pulse, knows_what_its_tolerance_leaves) {
  const EstimatedRun converged = run_estimated(path_, {}, 1e-11);
  for (const double tolerance : {1e-2, 1e-4}) {
    const EstimatedRun run = run_estimated(path_, {}, tolerance);
    expect_effective(run.figures.iteration_error.value(), true_error(run, converged));
  }
}

TEST_F(Pulse, knows_what_its_time_step_leaves) {
  for (const char* steps : {"96", "384"}) {
    const EstimatedRun run = run_estimated(path_, {{"steps", steps}});
    const EstimatedRun fine = run_estimated(path_, {{"steps", std::to_string(8 * std::stoi(steps))}});
    expect_effective(run.figures.time_step_error.value(), true_error(run, fine));
  }
}

TEST_F(Pulse, knows_what_its_mesh_leaves) {
  for (const int n : {20, 60}) {
    const Settings settings = {{"n", std::to_string(n)}, {"steps", "960"}};
    const EstimatedRun run = run_estimated(path_, settings);
    const EstimatedRun fine = run_estimated(path_, {{"n", std::to_string(8 * n)}, {"steps", "960"}});
    expect_effective(run.figures.mesh_error.value(), true_error(run, fine, n / 2, 4 * n));
  }
}

// A bar under a half-sine; what the run warned of.
std::string warnings(const Settings& settings) {
  testing::internal::CaptureStderr();
  run_text(R"(
local p = param{ n = 50, dt = 0.1*us, pulse = 10*us, tolerance = 1e-6 }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local function bar(name, from)
  return substructure{ name = name, material = steel,
    mesh = mesh.box{ origin = { 0, 0, from }, size = { 5*mm, 5*mm, 50*mm }, cells = { 1, 1, p.n } } }
end
local a, b = bar("a", 0), bar("b", 50*mm)
local touch = interface.contact{ name = "touch", between = { a:face "zmax", b:face "zmin" }, friction = 0.3 }
local hit = step.dynamic{ name = "hit", duration = 30*us, dt = p.dt, loads = {
  load.pressure{ on = b:face "zmax", history = history.half_sine{ peak = 100*MPa, duration = p.pulse } } } }
problem{ name = "bar", substructures = { a, b }, interfaces = { touch }, steps = { hit },
         solver = solver.latin{ tolerance = p.tolerance } }:run{}
)",
           settings, 1);
  return testing::internal::GetCapturedStderr();
}

TEST(Warnings, are_none_where_mesh_step_and_tolerance_carry_the_load) { EXPECT_EQ(warnings({}), ""); }

TEST(Warnings, name_a_time_step_too_large_for_the_load_and_the_one_that_would_do) {
  const std::string said = warnings({{"dt", "5*us"}});
  EXPECT_NE(said.find("95 % of the energy of load.pressure on face 'b.zmax' lies below"), std::string::npos) << said;
  EXPECT_NE(said.find("time steps per period there: 10 are wanted, dt = "), std::string::npos) << said;
}

TEST(Warnings, name_a_mesh_too_coarse_for_the_wavelength) {
  const std::string said = warnings({{"n", "3"}, {"pulse", "1*us"}, {"dt", "0.01*us"}});
  EXPECT_NE(said.find("the cells of substructure 'a', 5 mm along their shortest edge"), std::string::npos) << said;
  EXPECT_NE(said.find("the mesh leaves an error of about"), std::string::npos) << said;
}

TEST(Warnings, name_a_tolerance_too_loose_and_one_that_would_do) {
  const std::string said = warnings({{"tolerance", "0.05"}});
  EXPECT_NE(said.find("the tolerance 0.05 leaves an error of about"), std::string::npos) << said;
  EXPECT_NE(said.find("would leave 0.1 %"), std::string::npos) << said;
}

}  // namespace
}  // namespace dygita::test
