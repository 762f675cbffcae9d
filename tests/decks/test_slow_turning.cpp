// Parts of few cells turn too slowly as a whole, their masses being lumped at the nodes: said, with the share.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "decks/engine.hpp"

namespace dygita::test::slow_turning_tests {
namespace {

// A block of 30 x 20 x 10 mm in 3 x 2 x 1 cells (times n) that is let go by nothing, twisted for 20 us; or on springs.
DeckRun block(const Settings& settings) {
  return run_text(R"(
local p = param{ n = 1, order = 1, springs = 0, explicit = 0 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local block = substructure{ name = "block", material = steel, integration = p.explicit == 1 and "explicit" or "implicit",
  mesh = mesh.box{ size = { 30*mm, 20*mm, 10*mm }, cells = { 3*p.n, 2*p.n, p.n }, order = p.order } }
local ends = { block:face "xmin", block:face "xmax" }
local supports = {}
if p.springs == 1 then
  supports = { support.spring{ name = "spring", on = block:face "zmin", x = 1e6, y = 1e6, z = 1e6, about_x = 100, about_y = 100, about_z = 100 } }
end
local twist = load.torque{ on = ends, axis = { 1, 0, 0 }, history = history.half_sine{ peak = 1, duration = 20*us } }
local function at(name, y, z)
  return output.history{ name = name, on = block:where(function(X, Y, Z) return near(X, 0) and near(Y, y) and near(Z, z) end), quantity = "displacement", direction = { 0, 0, 1 } }
end
problem{ name = "spin", substructures = { block }, supports = supports, outputs = { at("left", 0, 0), at("right", 20*mm, 0), output.modes{ name = "modes", n = 8 } },
  steps = { step.dynamic{ name = "spin", duration = 400*us, dt = 1*us, loads = { twist } } } }:run{}
)",
                  settings)
      .at(0);
}

struct Said {
  DeckRun run;
  std::string warning;  // empty: none of its turning
};

Said told(const Settings& settings) {
  testing::internal::CaptureStderr();  // what is said before a run begins is not in its record
  DeckRun run = block(settings);
  const std::string all = testing::internal::GetCapturedStderr();
  const size_t at = all.find("turns as a whole");
  return {std::move(run), at == std::string::npos ? "" : all.substr(at, all.find('\n', at) - at)};
}

// rad/s: the mean slope of its second half.
double spin(const DeckRun& run) {
  const std::vector<double>&left = run.column("left", "displacement"), &right = run.column("right", "displacement"),
        &time = run.column("left", "time");
  const size_t middle = time.size() / 2;
  const auto angle = [&](size_t i) { return (right[i] - left[i]) / 0.02; };
  return (angle(time.size() - 1) - angle(middle)) / (time.back() - time[middle]);
}

constexpr double mass = 7800 * 6e-6, inertia = mass * (0.02 * 0.02 + 0.01 * 0.01) / 12.0;

TEST(SlowTurning, is_told_as_it_is_of_a_block_that_spins) {
  // Two torques of half a sine.
  const double free = 2.0 * (2.0 / std::numbers::pi) * 20e-6 / inertia;
  struct Case {
    const char *n, *order;
    double ratio;
  };
  for (const Case& now : {Case{"1", "1", 1.8}, Case{"2", "1", 1.2}, Case{"1", "2", 1.0}}) {
    const auto [run, said] = told({{"n", now.n}, {"order", now.order}});
    std::cout << now.n << " order " << now.order << ": spins at " << spin(run) / free << " of a rigid block; " << said
              << "\n";
    EXPECT_NEAR(spin(run) / free, 1.0 / now.ratio, 0.02);
    if (now.ratio == 1.0) {
      EXPECT_EQ(said, "");
    } else {
      EXPECT_NE(said.find(fmt::format("under a torque it spins {:.2g} % too slowly", 100 * (1 - 1 / now.ratio))),
                std::string::npos);
    }
  }
}

// Explicit cells of order two have masses at their nodes alone, and spin as these do.
TEST(SlowTurning, is_told_of_explicit_cells_of_order_two) {
  const double free = 2.0 * (2.0 / std::numbers::pi) * 20e-6 / inertia;
  const auto [run, said] = told({{"order", "2"}, {"explicit", "1"}});
  const double slow = 1.0 - spin(run) / free;
  std::cout << "order 2, explicit: " << slow << " too slow; " << said << "\n";
  EXPECT_GT(slow, 0.05);
  const size_t at = said.find("it spins ");
  ASSERT_NE(at, std::string::npos);
  EXPECT_NEAR(std::stod(said.substr(at + 9)), 100.0 * slow, 2.0);
  EXPECT_NE(said.find("or integration = \"implicit\""), std::string::npos);
}

// On springs, as far as it is rigid: the modes that turn.
TEST(SlowTurning, is_told_of_a_block_on_springs) {
  const auto frequencies = [](const char* order) {
    const Said said = told({{"springs", "1"}, {"order", order}});
    EXPECT_EQ(said.warning.empty(), std::string(order) == "2");
    return said.run.column("modes", "frequency");
  };
  const std::vector<double> lumped = frequencies("1"), consistent = frequencies("2");
  double worst = 1.0;
  for (int i = 0; i < 6; ++i) worst = std::min(worst, lumped[i] / consistent[i]);
  std::cout << "modes on springs, " << worst << " of those of a consistent mass\n";
  EXPECT_LT(worst, 0.9);
  EXPECT_GT(worst, 0.98 / std::sqrt(1.8));
}

TEST(SlowTurning, is_not_told_of_a_block_that_is_held_in_all_its_static_steps) {
  testing::internal::CaptureStderr();
  run_text(R"(
local alu = material.elastic{ name = "alu", young = 70*GPa, poisson = 0.3, density = 2800 }
local block = substructure{ name = "block", material = alu, mesh = mesh.box{ size = { 20*mm, 20*mm, 60*mm }, cells = { 2, 2, 6 } } }
local first = step.static{ name = "first" }
problem{ name = "held", substructures = { block }, supports = { support.fixed{ name = "ground", on = block:face "zmin" } },
  steps = { first, step.static{ name = "second", after = first } }, outputs = { output.modes{ name = "modes", n = 4 } } }:run{}
)",
           {}, 1);
  EXPECT_EQ(testing::internal::GetCapturedStderr().find("turns as a whole"), std::string::npos);
}

}  // namespace
}  // namespace dygita::test::slow_turning_tests
