// Functions of time written in the deck.
#include <gtest/gtest.h>

#include <thread>

#include "deck/fake_engine.hpp"
#include "model/load.hpp"

namespace dygita::test::functions_tests {

namespace {

std::string deck_with(const std::string& function) {
  return std::string(two_blocks) + "local push = load.pressure{ on = high:face 'zmax', history = " + function + " }\n" +
         "local s = step.dynamic{ name = 's', duration = 4*us, dt = 1*us, loads = { push } }\n" +
         "problem{ name = 'p', substructures = { low, high }, interfaces = { glue }, supports = { base }, steps = { s "
         "} }"
         ":run{}";
}

const History& history_in(const Problem& problem) { return problem.steps[0]->loads[0]->values[0]->history; }

TEST(DeckFunction, is_asked_by_the_engine) {
  FakeEngine fake;
  std::vector<double> values;
  fake.during = [&](const Problem& problem) {
    for (const double t : {0.0, 1e-6, 2e-6}) values.push_back(history_in(problem).value(t));
  };
  run_text(deck_with("function(t) return 5*MPa * t / us end"), fake);
  ASSERT_EQ(values.size(), 3u);
  EXPECT_DOUBLE_EQ(values[0], 0.0);
  EXPECT_DOUBLE_EQ(values[1], 5e6);
  EXPECT_DOUBLE_EQ(values[2], 1e7);
}

TEST(DeckFunction, can_be_asked_by_several_threads) {
  FakeEngine fake;
  std::vector<double> sums(4, 0.0);
  fake.during = [&](const Problem& problem) {
    std::vector<std::thread> threads;
    for (double& sum : sums) {
      threads.emplace_back([&] {
        for (int i = 0; i < 1000; ++i) sum += history_in(problem).value(i);
      });
    }
    for (std::thread& thread : threads) thread.join();
  };
  run_text(deck_with("function(t) return t end"), fake);
  for (const double sum : sums) EXPECT_DOUBLE_EQ(sum, 499500.0);
}

TEST(DeckFunction, gives_one_value_for_one_time) {
  for (const char* function : {"function(t) return math.random() end",
                               "(function()\n local n = 0\n return function(t) n = n + 1 return n * MPa end\nend)()"}) {
    FakeEngine fake;
    try {
      run_text(deck_with(function), fake);
      FAIL() << "nothing thrown";
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.find("deck.lua:"), 0u) << message;
      EXPECT_NE(message.find("a function of time must return the same value for the same time, but this one returned"),
                message.npos)
          << message;
      EXPECT_NE(message.find("history.piecewise"), message.npos) << message;
    }
  }
}

TEST(DeckFunction, that_fails_during_the_run_says_where) {
  FakeEngine fake;
  fake.during = [](const Problem& problem) { history_in(problem).value(3e-6); };
  try {
    run_text(deck_with("function(t)\n  if t > 2*us then return t .. nil end\n  return 0\nend"), fake);
    FAIL() << "nothing thrown";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()), "deck.lua:15: attempt to concatenate a nil value");
  }
}

TEST(DeckFunction, that_answers_no_number_later_on_says_when_before_anything_is_solved) {
  FakeEngine fake;
  try {
    run_text(deck_with("function(t) return t < 2*us and 1 or 0/0 end"), fake);
    FAIL() << "nothing thrown";
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_EQ(message.find("deck.lua:14: the function of time declared here returns"), 0u) << message;
    EXPECT_NE(message.find("at t = 2e-06 s"), std::string::npos) << message;
  }
}

TEST(DeckFunction, declares_nothing) {
  FakeEngine fake;
  fake.during = [](const Problem& problem) { history_in(problem).value(3e-6); };
  try {
    run_text(deck_with("function(t)\n  local h = t > 1*us and history.constant{ value = 1 }\n  return 0\nend"), fake);
    FAIL() << "nothing thrown";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()),
              "deck.lua:15: a function of time may only compute: it cannot declare, read or run anything");
  }
}

TEST(DeckFunction, outlives_no_deck) {
  FakeEngine fake;
  run_text(deck_with("function(t) return t end"), fake);
  EXPECT_THROW(history_in(fake.problems.at(0)).value(1.0), ContractError);
}

TEST(DeckFunction, survives_collection_while_a_load_needs_it) {
  FakeEngine fake;
  double value = 0.0;
  fake.during = [&](const Problem& problem) { value = history_in(problem).value(2.0); };
  const std::string text = deck_with("function(t) return 3*t end");
  const size_t at = text.find("problem{");
  run_text(text.substr(0, at) + "for i = 1, 200000 do local garbage = { i } end\n" + text.substr(at), fake);
  EXPECT_DOUBLE_EQ(value, 6.0);
}

}  // namespace

}  // namespace dygita::test::functions_tests
