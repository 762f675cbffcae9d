#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <memory>

#include "base/progress.hpp"
#include "base/task.hpp"

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

TEST(Task, says_nothing_that_is_over_soon) {
  testing::internal::CaptureStderr();
  {
    Task task("meshing", 3);
    for (const char* solid : {"plate", "bolt", "nut"}) task.done(solid);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Task, ends_where_the_user_wants_it_and_it_may) {
  heed_interrupt();
  request_interrupt();
  EXPECT_NO_THROW(heed_interrupt()) << "without work";
  {
    Task task("points of interfaces", 2);
    EXPECT_THROW(heed_interrupt(), Interrupted);
    EXPECT_THROW(task.tell("joint"), Interrupted);
    EXPECT_THROW(task.done("joint"), Interrupted);
    {
      Task within("results", 0, Task::Interrupts::wait);
      EXPECT_NO_THROW(heed_interrupt());
    }
    EXPECT_THROW(heed_interrupt(), Interrupted);
    set_interrupts_heeded(false);
    EXPECT_NO_THROW(task.tell("joint"));
    set_interrupts_heeded(true);
  }
  EXPECT_NO_THROW(heed_interrupt()) << "once the work is done";
  withdraw_interrupt();
  Task task("points of interfaces", 2);
  EXPECT_NO_THROW(task.done("joint"));
}

TEST(Task, may_end_in_any_order) {
  auto first = std::make_unique<Task>("one"), second = std::make_unique<Task>("other");
  request_interrupt();
  first.reset();
  EXPECT_THROW(heed_interrupt(), Interrupted);
  second.reset();
  EXPECT_NO_THROW(heed_interrupt());
  withdraw_interrupt();
}

TEST(Interrupt, sets_a_flag_instead_of_killing) {
  catch_interrupts();
  EXPECT_FALSE(interrupt_requested());
  std::raise(SIGINT);
  EXPECT_TRUE(interrupt_requested());
  std::signal(SIGTERM, SIG_DFL);
}

}  // namespace dygita
