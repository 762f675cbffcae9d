// Frames of the picture that turns: how they are shared out among the steps.
#include <gtest/gtest.h>

#include <numeric>

#include "watch/skin_recorder.hpp"

namespace dygita::skin_recorder_tests {
namespace {

int sum(const std::vector<int>& values) { return std::accumulate(values.begin(), values.end(), 0); }

TEST(SharedOut, gives_static_steps_their_end_and_the_motion_the_rest) {
  EXPECT_EQ(shared_out({true, false}, 20), (std::vector<int>{1, 19}));
  EXPECT_EQ(shared_out({true, true, false, false}, 20), (std::vector<int>{1, 1, 9, 9}));
  EXPECT_EQ(shared_out({false}, 20), (std::vector<int>{20}));
  EXPECT_EQ(shared_out({true, true}, 20), (std::vector<int>{10, 10}));
}

TEST(SharedOut, passes_over_steps_evenly_where_there_are_too_many_and_never_over_the_last) {
  const std::vector<int> samples = shared_out(std::vector<bool>(50, true), 20);
  EXPECT_EQ(sum(samples), 20);
  EXPECT_EQ(samples.back(), 1);
  std::vector<bool> steps(30, true);
  steps.push_back(false);
  const std::vector<int> with_motion = shared_out(steps, 20);
  EXPECT_EQ(with_motion.back(), 14);
  EXPECT_EQ(with_motion[29], 1);
  EXPECT_EQ(sum(with_motion), 20);
}

}  // namespace
}  // namespace dygita::skin_recorder_tests
