#include <gtest/gtest.h>

#include "base/log.hpp"
#include "base/warnings.hpp"

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

TEST(Log, says_what_differs_by_numbers_alone_once_where_it_is_asked_to) {
  take_warnings();
  testing::internal::CaptureStderr();
  {
    const SayAlikeOnce once;
    warn("spectrum 'a1' rises by 1.5e-3 dB at (-2, 3.5) mm");
    warn("spectrum 'a1' rises by 12 dB at (2, 1e+04) mm");
    warn("spectrum 'b1' rises by 12 dB at (2, 1e+04) mm");
    EXPECT_EQ(once.n_unsaid(), 1);
  }
  warn("spectrum 'a1' rises by 13 dB at (2, 1e+04) mm");
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "warning: spectrum 'a1' rises by 1.5e-3 dB at (-2, 3.5) mm\n"
            "warning: spectrum 'b1' rises by 12 dB at (2, 1e+04) mm\n"
            "warning: spectrum 'a1' rises by 13 dB at (2, 1e+04) mm\n");
  EXPECT_EQ(take_warnings().size(), 4U);
}

TEST(Log, tells_warnings_of_one_kind_together_serious_ones_first) {
  take_warnings();
  testing::internal::CaptureStderr();
  for (int i = 1; i <= 8; ++i)
    warn(fmt::format("dt is {} times too long for {}", i == 3 ? 9 : i, i), {"dt", i == 3 ? 9.0 : i, std::to_string(i)});
  warn("a and b overlap by 2 mm", {"overlap", 2.0, "a and b", true});
  warn("c and d overlap by 1 mm", {"overlap", 1.0, "c and d", true});
  warn("c and d overlap by 1 mm", {"overlap", 1.0, "c and d", true});
  warn("a mesh is coarse", {"mesh", 1.0, "a"});
  warn("told at once");
  const std::vector<std::string> expected = {
      "a and b overlap by 2 mm\n    the worst of 2 of this kind; the other: c and d", "told at once",
      "dt is 9 times too long for 3\n    the worst of 8 of this kind; the others: 8, 7, 6, 5, 4 and 2 more",
      "a mesh is coarse"};
  EXPECT_EQ(take_warnings(), expected);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "warning: told at once\nwarning: " + expected[0] + "\nwarning: " +
                                                        expected[2] + "\nwarning: " + expected[3] + "\n");
  EXPECT_TRUE(take_warnings().empty());
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
