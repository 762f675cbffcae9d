// Momentum of parts: the impulse given, what two blocks exchange, in every solver.
#include <gtest/gtest.h>

#include "decks/engine.hpp"

namespace dygita::test::momentum_tests {
namespace {

// A pushed block (1 N s by the end of the push) meets a heavier one at rest; nothing holds either.
const std::string two_blocks = R"(
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local lead = material.elastic{ name = "lead", young = 16*GPa, poisson = 0.44, density = 11300 }
local mesh = mesh.box{ size = { 10*mm, 10*mm, 20*mm }, cells = { 2, 2, 4 } }
local ram = substructure{ name = "ram", material = steel, mesh = mesh }
local target = substructure{ name = "target", material = lead, mesh = mesh, place = { 0, 0, 20*mm } }
local meet = interface.contact{ name = "meet", between = { ram:face "zmax", target:face "zmin" }, gap = 0.05*mm }
local push = load.force{ on = ram:face "zmin", z = history.piecewise{ times = { 0, 10*us, 20*us }, values = { 0, 100*kN, 0 } } }
local shove = step.dynamic{ name = "shove", duration = 60*us, dt = 0.25*us, loads = { push } }
problem{ name = "blocks", substructures = { ram, target }, interfaces = { meet }, steps = { shove },
  outputs = { output.momentum{ name = "all" }, output.momentum{ name = "struck", of = target },
              output.momentum{ name = "both", of = { target, ram } }, output.resultant{ name = "force", on = meet } } }:run{}
)";

class Momentum : public ::testing::TestWithParam<const char*> {};

TEST_P(Momentum, is_the_impulse_that_was_given) {
  const DeckRun run = run_text(two_blocks, {}, 0, GetParam()).at(0);
  const std::vector<double>&all = run.column("all", "z"), &struck = run.column("struck", "z");
  EXPECT_EQ(all.front(), 0.0);
  EXPECT_NEAR(all.back(), 1.0, 1e-5);
  EXPECT_EQ(run.column("both", "z").back(), all.back());
  EXPECT_LT(std::abs(run.column("all", "x").back()), 1e-7);
  // The struck block has what the interface has transmitted, N s.
  double transmitted = 0.0;
  for (const double force : run.column("force", "normal")) transmitted += std::abs(force) * 0.25e-6;
  EXPECT_GT(struck.back(), 0.5);
  EXPECT_NEAR(struck.back(), transmitted, 2e-4);
}

TEST_P(Momentum, of_a_moving_part_is_mass_times_velocity) {
  const DeckRun run = run_text(R"(
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local block = substructure{ name = "block", material = steel, velocity = { 3, -2, 0.5 },
  mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 2, 2, 2 } } }
problem{ name = "flight", substructures = { block },
  steps = { step.dynamic{ name = "fly", duration = 5*us, dt = 0.25*us } }, outputs = { output.momentum{ name = "p" } } }:run{}
)",
                               {}, 0, GetParam())
                          .at(0);
  for (const char* column : {"x", "y", "z"})
    for (const double p : run.column("p", column))
      EXPECT_NEAR(p, 7.8e-3 * (column[0] == 'x' ? 3.0 : column[0] == 'y' ? -2.0 : 0.5), 1e-8);
}

INSTANTIATE_TEST_SUITE_P(Solvers, Momentum,
                         ::testing::Values("latin{ tolerance = 1e-8 }", "monolithic{}", "explicit{}"),
                         [](const auto& info) {
                           return std::string(info.param).substr(0, std::string(info.param).find('{'));
                         });

}  // namespace
}  // namespace dygita::test::momentum_tests
