// Whatever a loop throws reaches the caller, on any number of threads.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <mutex>
#include <new>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "base/error.hpp"
#include "base/fair_shares.hpp"
#include "base/parallel_by_cost.hpp"
#include "base/thread_choice.hpp"

namespace dygita {
namespace {

// Two threads, whatever the machine has.
class ParallelFor : public ::testing::Test {
 protected:
  ParallelFor() : before_(thread_limit()) { set_thread_limit(2); }
  ~ParallelFor() override { set_thread_limit(before_); }

 private:
  int before_;
};

// How many threads share a loop of n. Each waits there for as many as are expected, 5 s at most: of short work the
// caller does all.
size_t threads_that_come(size_t expected, int n, int most_threads = 0) {
  std::mutex mutex;
  std::set<std::thread::id> threads;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  parallel_for(
      n,
      [&](int) {
        for (bool are_all_here = false; !are_all_here; std::this_thread::yield()) {
          const std::scoped_lock lock(mutex);
          threads.insert(std::this_thread::get_id());
          are_all_here = threads.size() >= expected || std::chrono::steady_clock::now() > end;
        }
      },
      Schedule::evenly, most_threads);
  return threads.size();
}

template <class Error>
void expect_thrown(const Error& error) {
  for (const Schedule schedule : {Schedule::evenly, Schedule::as_free})
    for (const int failing : {0, 3, 7})
      EXPECT_THROW(parallel_for(
                       8,
                       [&](int i) {
                         if (i == failing) throw error;
                       },
                       schedule),
                   Error);
}

TEST_F(ParallelFor, brings_every_kind_of_error_back_to_the_caller) {
  expect_thrown(InputError("a cell is turned inside out"));
  expect_thrown(NumericalError("the matrix is not positive definite"));
  expect_thrown(std::bad_alloc());
  struct NoStandardException {};
  expect_thrown(NoStandardException());
  EXPECT_THROW(parallel_for(8, [](int i) { CHECK(i < 6, "six at most"); }), ContractError);
}

TEST_F(ParallelFor, throws_the_error_of_the_lowest_failing_index) {
  for (int repetition = 0; repetition < 50; ++repetition)
    for (const Schedule schedule : {Schedule::evenly, Schedule::as_free}) try {
        parallel_for(
            64,
            [](int i) {
              if (i >= 31) throw NumericalError(std::to_string(i));
            },
            schedule);
        FAIL() << "nothing was thrown";
      } catch (const NumericalError& error) {
        EXPECT_STREQ(error.what(), "31");
      }
}

TEST_F(ParallelFor, runs_every_index_once) {
  for (const Schedule schedule : {Schedule::evenly, Schedule::as_free})
    for (const int n : {0, 1, 2, 1000})
      for (const int most_threads : {0, 1, 5}) {
        std::vector<int> count(n, 0);
        parallel_for(
            n, [&](int i) { ++count[i]; }, schedule, most_threads);
        EXPECT_EQ(count, std::vector<int>(n, 1));
      }
}

TEST_F(ParallelFor, shares_the_work_among_as_many_threads_as_it_may) {
  EXPECT_EQ(threads_that_come(2, 40), 2U);
  EXPECT_EQ(threads_that_come(1, 40, 1), 1U);
  EXPECT_EQ(threads_that_come(5, 40, 5), 5U);
  EXPECT_EQ(threads_that_come(3, 3, 5), 3U);
  EXPECT_EQ(threads_that_come(2, 40), 2U);
}

TEST_F(ParallelFor, of_ranges_has_the_same_ones_on_any_number_of_threads) {
  for (const std::ptrdiff_t n : {0, 1, 1024, 1025, 9000}) {
    const auto ranges_of = [n](int threads) {
      set_thread_limit(threads);
      std::mutex mutex;
      std::set<std::pair<std::ptrdiff_t, std::ptrdiff_t>> ranges;
      parallel_for_ranges(n, [&](std::ptrdiff_t first, std::ptrdiff_t length) {
        const std::scoped_lock lock(mutex);
        ranges.emplace(first, length);
      });
      return ranges;
    };
    const auto on_one = ranges_of(1);
    std::ptrdiff_t end = 0;
    for (const auto& [first, length] : on_one) {
      EXPECT_EQ(first, end);
      end += length;
    }
    EXPECT_EQ(end, n);
    EXPECT_EQ(ranges_of(3), on_one);
  }
}

TEST_F(ParallelFor, inside_another_runs_on_one_thread_and_passes_its_error_on) {
  std::vector<int> n_elsewhere(2, 0);
  const auto inner = [&](int outer) {
    const std::thread::id own = std::this_thread::get_id();
    parallel_for(4, [&](int i) {
      n_elsewhere[outer] += std::this_thread::get_id() != own;
      if (outer == 1 && i == 2) throw InputError("inside");
    });
  };
  EXPECT_THROW(parallel_for(2, inner, Schedule::evenly), InputError);
  EXPECT_EQ(n_elsewhere, std::vector<int>(2, 0));
}

// More threads than processors: some come too late, and what was theirs is done.
TEST_F(ParallelFor, has_every_share_done_once_when_it_is_back) {
  constexpr int n_repetitions = 5000;
  for (const int n : {2, 3, 16}) {
    set_thread_limit(n);
    std::vector<int> sums(n, 0);
    for (int repetition = 0; repetition < n_repetitions; ++repetition)
      parallel_for(
          n, [&](int i) { sums[i] += repetition; }, Schedule::evenly);
    EXPECT_EQ(sums, std::vector<int>(n, n_repetitions / 2 * (n_repetitions - 1)));
  }
}

TEST_F(ParallelFor, wakes_threads_that_have_gone_to_sleep) {
  for (int repetition = 0; repetition < 20; ++repetition) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    std::vector<int> count(2, 0);
    parallel_for(
        2, [&](int i) { ++count[i]; }, Schedule::evenly);
    EXPECT_EQ(count, std::vector<int>(2, 1));
  }
}

TEST_F(ParallelFor, waits_for_a_thread_that_is_late) {
  std::atomic<bool> is_done = false;
  parallel_for(
      2,
      [&](int i) {
        if (i == 0) return;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
        is_done = true;
      },
      Schedule::evenly);
  EXPECT_TRUE(is_done);
}

TEST_F(ParallelFor, of_two_threads_at_once_is_complete_in_both) {
  std::vector<std::vector<int>> counts(2, std::vector<int>(500, 0));
  const auto count = [&](int who) {
    for (int repetition = 0; repetition < 200; ++repetition)
      parallel_for(500, [&](int i) { ++counts[static_cast<size_t>(who)][static_cast<size_t>(i)]; });
  };
  std::thread other(count, 1);
  count(0);
  other.join();
  EXPECT_EQ(counts, std::vector<std::vector<int>>(2, std::vector<int>(500, 200)));
}

TEST_F(ParallelFor, flushes_denormals_in_every_thread) {
  std::vector<double> halved(2, 1.0);
  parallel_for(
      2,
      [&](int i) {
        volatile double least = std::numeric_limits<double>::min();
        halved[i] = 0.5 * least;
      },
      Schedule::evenly);
  EXPECT_EQ(halved, std::vector<double>(2, 0.0));
}

// Loops of the choice's periods, with so many seconds a loop; how many of them took all threads.
int loops_on_all(ThreadChoice& choice, int n, double on_all, double on_one) {
  int n_all = 0;
  for (int i = 0; i < n; ++i) {
    const bool is_all = choice.threads() == ThreadChoice::all;
    n_all += is_all;
    choice.note(is_all ? on_all : on_one);
  }
  return n_all;
}

TEST(ThreadChoice, takes_what_is_faster_and_looks_again) {
  ThreadChoice choice = ThreadChoice::measured();
  EXPECT_LE(loops_on_all(choice, 800, 2.0, 1.0), 40);
  EXPECT_GE(loops_on_all(choice, 800, 1.0, 2.0), 680);  // the machine is idle now
}

TEST(ThreadChoice, may_be_none) {
  ThreadChoice one(ThreadChoice::one), all;
  EXPECT_EQ(loops_on_all(one, 100, 1.0, 2.0), 0);
  EXPECT_EQ(loops_on_all(all, 100, 2.0, 1.0), 100);
}

TEST(ParallelByCost, runs_what_outweighs_the_rest_first_and_with_all_threads_within) {
  const int threads = thread_limit();
  set_thread_limit(4);
  std::vector<size_t> within(6, 0);
  std::vector<int> count(6, 0);
  std::atomic<int> n_ended = 0;
  int ended_before_largest = -1;
  parallel_by_cost({1.0, 2.0, 100.0, 0.0, 1.0, 2.0}, [&](int i) {
    if (i == 2) ended_before_largest = n_ended;
    within[i] = threads_that_come(i == 2 ? 4 : 1, 8);
    ++count[i];
    ++n_ended;
  });
  set_thread_limit(threads);
  EXPECT_EQ(count, std::vector<int>(6, 1));
  EXPECT_EQ(ended_before_largest, 0);
  EXPECT_EQ(within[2], 4U);
  EXPECT_EQ(within[0], 1U);
}

TEST(ParallelByCost, throws_what_a_body_throws) {
  EXPECT_THROW(parallel_by_cost({1.0, 50.0, 1.0}, [](int i) { CHECK(i != 1, "not this one"); }), ContractError);
  EXPECT_THROW(parallel_by_cost({1.0, 1.0, 1.0, 1.0}, [](int i) { CHECK(i != 1, "not this one"); }), ContractError);
  parallel_by_cost({}, [](int) { FAIL(); });
}

TEST(FairShares, move_towards_equal_times) {
  FairShares shares;
  shares.divide_evenly(1000, 2);
  EXPECT_EQ(shares.bounds(), (std::vector<int>{0, 500, 1000}));
  shares.follow({1.0, 1.02});
  EXPECT_EQ(shares.bounds(), (std::vector<int>{0, 500, 1000})) << "as near as the next run is";
  // The last hundred cost nineteen times as much as the others: 900 and 1900, and a fair bound at 926.
  const auto seconds = [&] {
    const int at = shares.bounds()[1];
    const double first = std::min(at, 900) + 19.0 * std::max(0, at - 900);
    return std::vector<double>{1e-6 * first, 1e-6 * (2800.0 - first)};
  };
  for (int i = 0; i < 20; ++i) shares.follow(seconds());
  const std::vector<double> end = seconds();
  EXPECT_LT(std::abs(end[0] - end[1]), 0.1 * (end[0] + end[1]));
  // Nothing known of a share that took no time.
  shares.follow({0.0, 0.0});
  shares.follow({0.0, 1.0});
  EXPECT_TRUE(std::is_sorted(shares.bounds().begin(), shares.bounds().end()));
}

TEST_F(ParallelFor, of_fair_shares_runs_every_index_once_wherever_their_bounds_are) {
  FairShares shares;
  for (const int n : {0, 1, 2, 3, 700, 701}) {
    for (int round = 0; round < 5; ++round) {
      std::vector<int> count(static_cast<size_t>(n), 0);
      shares.run(n, 0, [&](int i) {
        for (volatile int k = 0; k < (i < n / 4 ? 400 : 0);) k = k + 1;
        ++count[static_cast<size_t>(i)];
      });
      EXPECT_EQ(count, std::vector<int>(static_cast<size_t>(n), 1));
    }
  }
  EXPECT_THROW(shares.run(100, 2, [](int i) { CHECK(i != 70, "not this one"); }), ContractError);
}

}  // namespace
}  // namespace dygita
