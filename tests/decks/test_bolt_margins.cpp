// Margins of bolts against proof load, slip and separation, by hand.
#include <gtest/gtest.h>

#include <numbers>

#include "decks/engine.hpp"
#include "files/bolt_table.hpp"

namespace dygita::test::bolt_margins_tests {
namespace {

// A rigid lid on a soft block, pressed by two slender bolts of 25 mm^2 beside it; then it is pulled and pushed aside.
std::string lid(const std::string& rating, const std::string& loads) {
  return R"(
local soft = material.elastic{ name = "soft", young = 2*GPa, poisson = 0, density = 1000 }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0, density = 7800 }
local block = substructure{ name = "block", material = soft, mesh = mesh.box{ size = { 40*mm, 40*mm, 20*mm }, cells = { 3, 2, 2 }, origin = { -20*mm, -20*mm, 0 } } }
local function bar(name, x, low, high)
  return substructure{ name = name, material = steel, mesh = mesh.box{ size = { 5*mm, 5*mm, high - low }, cells = { 1, 1, 4 }, origin = { x - 2.5*mm, -2.5*mm, low } } }
end
local low_1, high_1 = bar("low 1", -30*mm, -80*mm, -30*mm), bar("high 1", -30*mm, -30*mm, 20*mm)
local low_2, high_2 = bar("low 2", 30*mm, -80*mm, -30*mm), bar("high 2", 30*mm, -30*mm, 20*mm)
local lid = substructure.rigid{ name = "lid", on = { block:face "zmax", high_1:face "zmax", high_2:face "zmax" }, mass = 1,
  inertia = { 1e-3, 1e-3, 1e-3 }, at = { 0, 0, 25*mm } }
local shank_1 = interface.bonded{ name = "shank 1", between = { low_1:face "zmax", high_1:face "zmin" } }
local shank_2 = interface.bonded{ name = "shank 2", between = { low_2:face "zmax", high_2:face "zmin" } }
local head_1 = interface.bonded{ name = "head 1", between = { high_1:face "zmax", lid:face "high 1.zmax" } }
local head_2 = interface.bonded{ name = "head 2", between = { high_2:face "zmax", lid:face "high 2.zmax" } }
local seat = interface.contact{ name = "seat", between = { block:face "zmax", lid:face "block.zmax" }, friction = 0.3 }
local ground = support.fixed{ name = "ground", on = { block:face "zmin", low_1:face "zmin", low_2:face "zmin" } }
local tighten = step.static{ name = "tighten", loads = { load.preload{ on = { shank_1, shank_2 }, force = 10*kN, )" +
         rating + R"( } } }
local pull = step.static{ name = "pull", after = tighten, loads = { )" +
         loads + R"( } }
problem{ name = "lid", substructures = { block, low_1, high_1, low_2, high_2, lid }, interfaces = { shank_1, shank_2, head_1, head_2, seat },
  supports = { ground }, steps = { tighten, pull } }:run{}
)";
}

// Springs of the bolts (E A / l) and of the block, side by side.
constexpr double bolt = 200e9 * 25e-6 / 0.1, block = 2e9 * 1.6e-3 / 0.02, of_bolt = bolt / (2 * bolt + block),
                 force = 10e3, pulled = 6e3, shear = 2e3;
const double proof_load = 580e6 * std::numbers::pi / 4 * 5.0618e-3 * 5.0618e-3;  // M6, 8.8: 6 - 0.9382

TEST(BoltMargins, are_those_by_hand) {
  for (const double safety : {1.0, 1.25}) {
    const DeckRun run = run_text(lid("size = 'M6', class = '8.8', joint = seat, safety = " + std::to_string(safety),
                                     "load.force{ on = lid:face 'block.zmax', z = 6*kN, y = 2*kN }"))
                            .at(0);
    for (const BoltSummary& one : run.result->bolts) {
      ASSERT_TRUE(one.margins) << one.name;
      EXPECT_NEAR(one.margins->proof_load, proof_load, 1e-4 * proof_load);
      const double gained = of_bolt * pulled, lost = pulled / 2 - gained;
      EXPECT_NEAR(one.margins->largest, force + gained, 1e-3 * force);
      EXPECT_NEAR(one.margins->against_proof(one.tightened), proof_load / (force + safety * gained) - 1, 2e-3);
      EXPECT_NEAR(one.margins->against_separation().value(), force / (safety * lost) - 1, 0.02);
      EXPECT_NEAR(one.margins->slip.value(), 0.3 * (force - safety * lost) / (safety * shear / 2) - 1, 0.02);
    }
  }
}

TEST(BoltMargins, are_in_the_table_of_the_run) {
  const DeckRun run = run_text(lid("proof_load = 12*kN", "load.force{ on = lid:face 'block.zmax', z = 6*kN }")).at(0);
  const BoltMargins& margins = run.result->bolts.at(0).margins.value();
  EXPECT_EQ(margins.proof_load, 12e3);
  EXPECT_FALSE(margins.slip);
  EXPECT_FALSE(margins.against_separation());
  const std::string csv = bolts_csv(run.problem, *run.result);
  EXPECT_NE(csv.find("converged,proof_load [N],largest [N],margin_proof [1],margin_slip [1],margin_separation [1]\n"),
            std::string::npos);
  EXPECT_NE(csv.find(",1,12000,"), std::string::npos) << csv;
  EXPECT_EQ(bolts_csv(run.problem, *run.result).find("nan"), std::string::npos);
}

// 2 kN of shear are more than the friction of what is left of 10 kN under 1/4 of it, with the factor.
TEST(BoltMargins, that_are_negative_are_told) {
  testing::internal::CaptureStderr();
  run_text(lid("proof_load = 10.5*kN, joint = seat, safety = 1.25",
               "load.force{ on = lid:face 'block.zmax', z = 10*kN, y = 4*kN }"));
  const std::string told = testing::internal::GetCapturedStderr();
  EXPECT_NE(told.find("' has negative margins: proof -0.15, slip -0.26\n"), std::string::npos) << told;
}

// What slides carries no more shear than its friction, however much is asked: the margin is that or less.
TEST(BoltMargins, of_a_joint_that_slides_are_told_as_a_bound) {
  for (const char* push : {"8", "16"}) {
    testing::internal::CaptureStderr();
    run_text(lid("proof_load = 15*kN, joint = seat, safety = 1.25",
                 "load.force{ on = lid:face 'block.zmax', y = " + std::string(push) + "*kN }"));
    const std::string told = testing::internal::GetCapturedStderr();
    EXPECT_NE(told.find("slip -0.20 or less (the joint slides: it carries no more shear than its friction)"),
              std::string::npos)
        << told;
  }
}

// Half of each bolt in a model of half of it.
TEST(BoltMargins, count_the_share_of_the_bolt_that_is_modelled) {
  const DeckRun run =
      run_text(lid("size = 'M6', class = '8.8', share = 0.5", "load.force{ on = lid:face 'block.zmax', z = 6*kN }"))
          .at(0);
  EXPECT_NEAR(run.result->bolts.at(0).margins->proof_load, 0.5 * proof_load, 1e-4 * proof_load);
}

}  // namespace
}  // namespace dygita::test::bolt_margins_tests
