// Work that nothing interrupts, and what the user may stop nevertheless.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <stdexcept>
#include <thread>

#include "base/aside.hpp"
#include "base/progress.hpp"

namespace dygita {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

class Aside : public ::testing::Test {
 protected:
  ~Aside() override { withdraw_interrupt(); }
};

TEST_F(Aside, does_its_work_and_throws_what_that_throws) {
  int done = 0;
  do_aside([&] { done = 7; });
  EXPECT_EQ(done, 7);
  EXPECT_THROW(do_aside([] { throw std::out_of_range("far"); }), std::out_of_range);
}

TEST_F(Aside, leaves_the_work_to_itself_where_the_user_stops) {
  const MayBeAbandoned may;
  const auto done = std::make_shared<std::atomic<bool>>(false);
  std::thread user([] {
    std::this_thread::sleep_for(200ms);
    request_interrupt();
  });
  const auto start = Clock::now();
  EXPECT_THROW(do_aside([done] {
                 std::this_thread::sleep_for(4s);
                 *done = true;
               }),
               Abandoned);
  EXPECT_LT(Clock::now() - start, 2s);
  EXPECT_FALSE(*done);
  user.join();
}

TEST_F(Aside, waits_for_what_may_not_be_abandoned) {
  request_interrupt();
  bool done = false;
  do_aside([&] {
    std::this_thread::sleep_for(300ms);
    done = true;
  });
  EXPECT_TRUE(done);
}

TEST_F(Aside, is_given_up_only_where_somebody_expects_it) {
  request_interrupt();
  EXPECT_NO_THROW(give_up_if_stopped());
  {
    const MayBeAbandoned may_not(false);
    EXPECT_NO_THROW(give_up_if_stopped());
  }
  {
    const MayBeAbandoned may;
    EXPECT_THROW(give_up_if_stopped(), Abandoned);
  }
  EXPECT_NO_THROW(give_up_if_stopped());
}

}  // namespace
}  // namespace dygita
