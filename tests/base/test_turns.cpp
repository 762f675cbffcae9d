// Runs that take turns: what they ask for is served together, the most urgent first.
#include <gtest/gtest.h>

#include <string>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "base/turns.hpp"

namespace dygita {
namespace {

// Adds all numbers that are asked about at once; notes how many those were.
struct Sum final : Asked {
  Sum(int of, double own, std::string& together) : Asked(of), number(own), heard(together) {}
  void serve(std::span<Asked* const> all) override {
    double sum = 0.0;
    for (Asked* const one : all) sum += static_cast<Sum*>(one)->number;
    for (Asked* const one : all) static_cast<Sum*>(one)->answer = sum;
    heard += std::to_string(urgency) + ":" + std::to_string(all.size()) + " ";
    if (sum < 0.0) throw NumericalError("negative");
  }

  double number, answer = 0.0;
  std::string& heard;
};

double asked(int urgency, double number, std::string& heard) {
  Sum sum(urgency, number, heard);
  Turns::at_hand()->ask(sum);
  return sum.answer;
}

TEST(Turns, serve_what_is_most_urgent_first_and_all_of_it_together) {
  std::string heard;
  std::vector<double> found(3, 0.0), last(3, 0.0);
  std::vector<std::function<void()>> runs;
  for (int i = 0; i < 3; ++i)
    runs.emplace_back([&, i] {
      for (int k = 0; k <= i; ++k) found[static_cast<size_t>(i)] += asked(0, i + 1.0, heard);
      last[static_cast<size_t>(i)] = asked(1, 10.0 * i, heard);
    });
  std::string order;
  Turns::run(
      runs, [&](int i) { order += std::to_string(i); }, [&](int) { order += "."; });
  // The first waits at its end until the last has come there: 6, then 5, then 3.
  EXPECT_EQ(heard, "0:3 0:2 0:1 1:3 ");
  EXPECT_EQ(found, (std::vector<double>{6.0, 11.0, 14.0}));
  EXPECT_EQ(last, (std::vector<double>{30.0, 30.0, 30.0}));
  EXPECT_EQ(order, "0.1.2.0.1.2.1.2.2.0.1.2.");
  EXPECT_EQ(Turns::at_hand(), nullptr);
}

TEST(Turns, end_all_runs_before_the_first_error_is_thrown) {
  std::string heard;
  int n_ended = 0;
  std::vector<std::function<void()>> runs;
  for (int i = 0; i < 4; ++i)
    runs.emplace_back([&, i] {
      asked(0, 1.0, heard);
      if (i == 1 || i == 2) throw NumericalError("run " + std::to_string(i));
      try {
        asked(0, -1.0, heard);
      } catch (const NumericalError& error) {
        EXPECT_STREQ(error.what(), "negative");
        ++n_ended;
      }
      asked(0, 1.0, heard);  // goes on
      ++n_ended;
    });
  try {
    Turns::run(runs);
    FAIL();
  } catch (const NumericalError& error) {
    EXPECT_STREQ(error.what(), "run 1");
  }
  EXPECT_EQ(n_ended, 4);
  EXPECT_EQ(heard, "0:4 0:2 0:2 ");
}

TEST(Turns, leave_loops_on_threads_and_deep_stacks_to_each_run) {
  std::string heard;
  std::vector<double> sums(2, 0.0);
  const std::function<double(int)> deep = [&](int n) { return n == 0 ? asked(0, 1.0, heard) : deep(n - 1) + 1.0; };
  std::vector<std::function<void()>> runs;
  for (int i = 0; i < 2; ++i)
    runs.emplace_back([&, i] {
      std::vector<double> all(1000);
      parallel_for(1000, [&](int k) { all[static_cast<size_t>(k)] = k; });
      sums[static_cast<size_t>(i)] = deep(5000 + i);
      for (const double one : all) sums[static_cast<size_t>(i)] += one;
    });
  Turns::run(runs);
  EXPECT_EQ(sums, (std::vector<double>{504502.0, 504503.0}));
  EXPECT_EQ(heard, "0:2 ");
}

TEST(Turns, refuse_to_wait_in_a_handler) {
  std::string heard;
  const std::vector<std::function<void()>> runs{[&] {
    try {
      throw NumericalError("once");
    } catch (const NumericalError&) {
      asked(0, 1.0, heard);
    }
  }};
  EXPECT_THROW(Turns::run(runs), ContractError);
  EXPECT_EQ(heard, "");
}

}  // namespace
}  // namespace dygita
