#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>

#include "base/progress.hpp"

namespace dygita {

namespace {
std::string progress_of(int total) {
  testing::internal::CaptureStderr();
  {
    Progress progress("shock", total);
    for (int done = 1; done <= total; ++done) progress.update(done, "5 iterations");
  }
  return testing::internal::GetCapturedStderr();
}
}  // namespace

TEST(Progress, is_a_line_at_each_tenth_in_a_log) {
  const std::string text = progress_of(200);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 10) << text;
  EXPECT_EQ(text.find("shock: 20/200  5 iterations  "), 0U) << text;
  EXPECT_NE(text.find("shock: 200/200"), std::string::npos) << text;
}

TEST(Progress, is_silent_when_disabled) {
  set_progress_enabled(false);
  EXPECT_EQ(progress_of(20), "");
  set_progress_enabled(true);
}

TEST(Interrupt, sets_a_flag_instead_of_killing) {
  catch_interrupts();
  EXPECT_FALSE(interrupt_requested());
  std::raise(SIGINT);
  EXPECT_TRUE(interrupt_requested());
  std::signal(SIGTERM, SIG_DFL);
}

}  // namespace dygita
