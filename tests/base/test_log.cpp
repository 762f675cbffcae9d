#include <gtest/gtest.h>

#include "base/log.hpp"

namespace dygita {

TEST(Log, says_plain_lines_on_standard_output) {
  testing::internal::CaptureStdout();
  say("12 substructures");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "12 substructures\n");
}

TEST(Log, warns_on_standard_error_and_keeps_the_warning) {
  take_warnings();
  testing::internal::CaptureStderr();
  warn("the part is 300 m long");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "warning: the part is 300 m long\n");
  EXPECT_EQ(take_warnings(), std::vector<std::string>{"the part is 300 m long"});
}

TEST(Log, says_a_repeated_warning_once_until_it_is_taken) {
  take_warnings();
  testing::internal::CaptureStderr();
  warn("first");
  warn("second");
  warn("first");
  EXPECT_EQ(take_warnings(), (std::vector<std::string>{"first", "second"}));
  EXPECT_TRUE(take_warnings().empty());
  warn("first");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "warning: first\nwarning: second\nwarning: first\n");
  EXPECT_EQ(take_warnings().size(), 1U);
}

}  // namespace dygita
