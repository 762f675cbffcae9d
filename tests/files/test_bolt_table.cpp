// The bolts of a run as text.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "files/bolt_table.hpp"
#include "files/run_record.hpp"

namespace dygita {
namespace {

Problem two_steps() {
  Problem problem;
  auto tighten = std::make_shared<Step>();
  tighten->name = "tighten, first";
  tighten->is_static = true;
  auto shock = std::make_shared<Step>();
  shock->name = "shock";
  shock->duration = shock->dt = 1e-6;
  problem.steps = {tighten, shock};
  return problem;
}

RunResult two_bolts() {
  RunResult result;
  BoltSummary one;
  one.name = "one";
  one.area = 81e-6;
  one.after_static = {25e3};
  one.target = 25e3;
  one.tightened = 25e3;
  one.lowest = 20e3;
  one.highest = 30e3;
  one.last = 22e3;
  one.shortening = 50e-6;
  one.formula = BoltByHand{{1e-9, 3e-9}, 0.5, 100e-6};
  one.hand = 12.5e3;
  BoltSummary two = one;
  two.name = "the other";
  two.target.reset();
  two.formula.reset();
  two.hand.reset();
  two.last = 25e3;
  result.bolts = {one, two};
  return result;
}

TEST(BoltTable, is_a_csv_with_a_row_a_bolt_and_a_column_a_static_step) {
  EXPECT_EQ(
      bolts_csv(two_steps(), two_bolts()),
      "bolt,area [m^2],target [N],\"after tighten, first [N]\",lowest [N],highest [N],last [N],loss [1],shortening [m],"
      "plastic_opening [m],hand [N],hand_shortening [m],load_factor [1],loss_by_yield [1],swing [N],converged\n"
      "one,8.1e-05,25000,25000,20000,30000,22000,0.12,5e-05,0,12500,0.0001,0.75,,0,1\n"
      "the other,8.1e-05,,25000,20000,30000,25000,0,5e-05,0,,,,,0,1\n");
  RunResult missed = two_bolts();
  missed.converged = false;
  EXPECT_NE(bolts_csv(two_steps(), missed).find(",0.75,,0,0\n"), std::string::npos);
}

TEST(BoltTable, is_read_by_people) {
  const std::vector<std::string> lines = bolt_lines(two_steps(), two_bolts());
  ASSERT_EQ(lines.size(), 5u);
  EXPECT_EQ(lines[0],
            "  bolts: forces (kN) at the end of each static step, lowest and highest in the dynamic ones; loss since a "
            "bolt's own "
            "tightening");
  EXPECT_EQ(lines[1], "                target  tighten, first   lowest  highest  at the end     loss  by hand");
  EXPECT_EQ(lines[2], "    one         25.000          25.000   20.000   30.000      22.000  12.00 %   12.500");
  EXPECT_EQ(lines[3], "    the other                   25.000   20.000   30.000      25.000   0.00 %         ");
  EXPECT_EQ(lines[4],
            "    by hand (VDI 2230, 0.5 of a bolt), 'one': 100.00 um for 25.000 kN, found 50.00 um; bolt 1 kN/um, "
            "plates 0.3333 kN/um, "
            "load factor 0.750");
}

TEST(BoltTable, of_no_bolts_says_nothing) { EXPECT_TRUE(bolt_lines(two_steps(), RunResult()).empty()); }

TEST(BoltTable, is_in_the_run_record) {
  const auto json = nlohmann::json::parse(run_record(two_steps(), two_bolts(), {}, {}, {}));
  ASSERT_EQ(json["bolts"].size(), 2u);
  EXPECT_EQ(json["bolts"][0]["name"], "one");
  EXPECT_EQ(json["bolts"][0]["target"], 25e3);
  EXPECT_DOUBLE_EQ(json["bolts"][0]["loss"].get<double>(), 0.12);
  EXPECT_EQ(json["bolts"][0]["hand"]["share"], 0.5);
  EXPECT_EQ(json["bolts"][0]["hand"]["plate_resilience"], 3e-9);
  EXPECT_FALSE(json["bolts"][1].contains("hand"));
  EXPECT_FALSE(json["bolts"][1].contains("target"));
}

// A clamp that a shock pulls open carries the load's force, not its own: neither its loss nor a split of it means
// anything.
TEST(BoltTable, splits_no_loss_of_a_bolt_that_was_hardly_tightened) {
  RunResult result = two_bolts();
  for (BoltSummary& bolt : result.bolts) {
    bolt.stiffness = 1e8;
    bolt.yielded = bolt.yielded_before = 5e-6;
    bolt.before_motion = 24e3;
  }
  result.bolts[1].tightened = 100.0;
  const auto json = nlohmann::json::parse(run_record(two_steps(), result, {}, {}, {}));
  EXPECT_NEAR(json["bolts"][0]["loss_by_yield"].get<double>(), 0.02, 1e-12);
  EXPECT_NEAR(json["bolts"][0]["loss_before_motion"].get<double>(), 0.02, 1e-12);
  EXPECT_TRUE(json["bolts"][1]["loss"].is_null());
  EXPECT_FALSE(json["bolts"][1].contains("loss_by_yield"));
  EXPECT_FALSE(json["bolts"][1].contains("loss_before_motion"));
  EXPECT_NE(bolts_csv(two_steps(), result).find("the other,8.1e-05,,25000,20000,30000,25000,,5e-05,0,,,,,0,1\n"),
            std::string::npos);
}

}  // namespace
}  // namespace dygita
