// What a step takes by the speed of the machine.
#include <gtest/gtest.h>

#include "run/machine_speed.hpp"

namespace dygita {
namespace {

StepCost cost() {
  StepCost cost;
  cost.once = {4e9, 1e10};
  cost.a_round = {2e9, 0.0};
  cost.fewest = 1.0;
  cost.most = 4.0;
  return cost;
}

TEST(MachineSpeed, is_measured_and_that_of_a_computer) {
  const MachineSpeed& speed = machine_speed();
  EXPECT_GT(speed.operations, 1e8);
  EXPECT_LT(speed.operations, 1e12);
  EXPECT_GT(speed.bytes, 1e8);
  EXPECT_LT(speed.bytes, 1e12);
  EXPECT_EQ(&machine_speed(), &speed) << "once";
}

TEST(MachineSpeed, gives_the_time_of_what_is_done_once_and_in_rounds) {
  const MachineSpeed speed{2e9, 1e10};
  const auto [least, most] = time_of(cost(), speed, 1);
  EXPECT_DOUBLE_EQ(least, 3.0 + 1.0);
  EXPECT_DOUBLE_EQ(most, 3.0 + 4.0);
  const auto on_two = time_of(cost(), speed, 2);
  EXPECT_GT(on_two.first, 0.5 * least);
  EXPECT_LT(on_two.first, least);
}

TEST(MachineSpeed, has_words_for_a_time_and_for_a_range) {
  EXPECT_EQ(in_words({12.4, 12.1}), "about 12 s");
  EXPECT_EQ(in_words({3.0, 21.0}), "about 3 to 21 s");
  EXPECT_EQ(in_words({60.0, 600.0}), "about 1 to 10 min");
  EXPECT_EQ(in_words({9000.0, 9000.0}), "about 2.5 h");
  EXPECT_EQ(in_words({0.031, 0.031}), "about 0.031 s");
}

}  // namespace
}  // namespace dygita
