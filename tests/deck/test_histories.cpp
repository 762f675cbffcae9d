// Histories in a deck: their arithmetic, their units, what is said of them.
#include <gtest/gtest.h>

#include "base/log.hpp"
#include "deck/fake_engine.hpp"
#include "model/load.hpp"

namespace dygita::test::histories_tests {

namespace {

// A deck that drives the blocks by `history`, an expression of the deck with `signal`, `other` and `f` at hand.
std::string deck_with_history(const std::string& history, const std::string& word = "pressure") {
  const std::string on = word == "pressure" ? "on = high:face 'zmax'" : "on = base, direction = { 0, 0, 1 }";
  return std::string(two_blocks) + R"(
local signal = history.piecewise{ times = { 0, 1*us, 4*us }, values = { 0, 2, 0 } }
local other = history.half_sine{ peak = 3, duration = 4*us }
local f = function(t) return t / us end
local twice = 2*f
local push = load.)" +
         word + "{ " + on + ", history = " + history + R"( }
local s = step.dynamic{ name = 's', duration = 4*us, dt = 1*us, loads = { push } }
problem{ name = 'p', substructures = { low, high }, interfaces = { glue }, supports = { base }, steps = { s } }:run{}
)";
}

double value_of(const std::string& history, double t) {
  FakeEngine fake;
  double value = 0.0;
  fake.during = [&](const Problem& problem) { value = problem.steps[0]->loads[0]->values[0]->history.value(t); };
  run_text(deck_with_history(history), fake);
  return value;
}

TEST(DeckHistory, is_scaled_added_and_moved) {
  const double us = 1e-6;
  EXPECT_DOUBLE_EQ(value_of("2*signal", us), 4.0);
  EXPECT_DOUBLE_EQ(value_of("signal*g0", us), 2.0 * 9.80665);
  EXPECT_DOUBLE_EQ(value_of("signal/4", us), 0.5);
  EXPECT_DOUBLE_EQ(value_of("-signal", us), -2.0);
  EXPECT_DOUBLE_EQ(value_of("signal + other", 2 * us), 4.0 / 3.0 + 3.0);
  EXPECT_DOUBLE_EQ(value_of("signal - other", 2 * us), 4.0 / 3.0 - 3.0);
  EXPECT_DOUBLE_EQ(value_of("signal + 5", us), 7.0);
  EXPECT_DOUBLE_EQ(value_of("5 - signal", us), 3.0);
  EXPECT_DOUBLE_EQ(value_of("signal:shifted(2*us)", 3 * us), 2.0);
  EXPECT_DOUBLE_EQ(value_of("signal:scaled(2)", 2 * us), 2.0);
  EXPECT_DOUBLE_EQ(value_of("(3*(signal + other)):shifted(1*us)", 3 * us), 3.0 * (4.0 / 3.0 + 3.0));
}

TEST(DeckHistory, takes_functions_of_time_as_terms) {
  const double us = 1e-6;
  EXPECT_DOUBLE_EQ(value_of("2*f", 3 * us), 6.0);
  EXPECT_DOUBLE_EQ(value_of("-f", 3 * us), -3.0);
  EXPECT_DOUBLE_EQ(value_of("signal + f", us), 3.0);
  EXPECT_DOUBLE_EQ(value_of("f + f", us), 2.0);
  EXPECT_DOUBLE_EQ(value_of("f:shifted(1*us)", 3 * us), 2.0);
  EXPECT_DOUBLE_EQ(value_of("function(t) return signal(t)^2 * twice(t) end", us), 8.0);
}

TEST(DeckHistory, is_asked_for_a_value_where_the_deck_wants_one) {
  EXPECT_EQ(
      message_of(
          std::string(two_blocks) +
          "local signal = history.ramp{ to = 8, duration = 4 }\nassert((2*signal)(1) == 4)\nassert(signal(2) == 4)"),
      "");
}

TEST(DeckHistory, that_was_used_in_another_is_used) {
  take_warnings();
  FakeEngine fake;
  run_text(deck_with_history("2*signal + other*f(1)"), fake);
  for (const std::string& warning : take_warnings()) EXPECT_EQ(warning.find("history"), std::string::npos) << warning;
}

// Said on standard output while the deck is run with a file beside it, and the warnings.
std::pair<std::string, std::vector<std::string>> said_with(const std::string& csv, const std::string& history) {
  const Folder folder;
  folder.write("shot.csv", csv);
  DeckOptions options;
  options.path = folder.write("deck.lua", deck_with_history(history, "base_acceleration"));
  take_warnings();
  FakeEngine fake;
  testing::internal::CaptureStdout();
  run_deck(options, fake.engine());
  const std::string said = testing::internal::GetCapturedStdout();
  return {said, take_warnings()};
}

TEST(DeckHistory, from_a_file_is_told_with_its_peak_and_what_holds_beyond_its_ends) {
  const std::string csv = "t [ms],a [g]\n0,0\n0.001,-100\n0.004,1\n";
  const auto [said, warnings] = said_with(csv, "history.file{ file = 'shot.csv' }");
  EXPECT_EQ(said,
            "signal 'shot.csv': 3 points from 0 to 0.004 ms, peak -100 g at 0.001 ms (-980.7 m/s^2); before them 0 g "
            "holds, after them 1 g\n");
  const std::string plain = said_with("0,0\n1e-6,5\n4e-6,0\n", "g0*history.file{ file = 'shot.csv' }").first;
  EXPECT_EQ(
      plain,
      "signal 'shot.csv': 3 points from 0 to 0.004 ms, peak 5 at 0.001 ms, of no unit; before them 0 holds, after "
      "them 0\n");
}

bool says(const std::string& message, const std::string& part) { return message.find(part) != std::string::npos; }

// g taken for m/s^2 in silence is a tenth of the shock.
TEST(DeckHistory, of_an_acceleration_has_a_unit_in_the_file_or_the_deck) {
  const std::string plain = "t,a\n0,0\n1e-6,100\n4e-6,0\n", in_g = "t [s],a [g]\n0,0\n1e-6,100\n4e-6,0\n";
  const auto refused = [](const std::string& csv, const std::string& history) -> std::string {
    try {
      said_with(csv, history);
    } catch (const InputError& error) {
      testing::internal::GetCapturedStdout();
      return error.what();
    }
    return "";
  };
  for (const char* history :
       {"history.file{ file = 'shot.csv' }", "-history.file{ file = 'shot.csv' }:shifted(1e-6)"}) {
    EXPECT_TRUE(says(refused(plain, history), "takes m/s^2, and the file of its history gives no unit")) << history;
    EXPECT_TRUE(says(refused(plain, history), "history.file{ ..., unit = g0 } where its values are in g")) << history;
  }
  const auto doubts = [](const std::string& csv, const std::string& history) {
    int n = 0;
    for (const std::string& warning : said_with(csv, history).second) n += says(warning, "gives no unit");
    return n;
  };
  EXPECT_EQ(doubts(plain, "g0*history.file{ file = 'shot.csv' }"), 0);
  EXPECT_EQ(doubts(plain, "history.file{ file = 'shot.csv', unit = g0 }"), 0);
  EXPECT_EQ(doubts(plain, "0.5*history.file{ file = 'shot.csv', unit = 1 }"), 0);
  EXPECT_EQ(doubts(plain, "0.5*history.file{ file = 'shot.csv' }"), 1);
  EXPECT_TRUE(says(refused(in_g, "history.file{ file = 'shot.csv', unit = g0 }"),
                   "history.file: the file gives the unit of its values, [g]: leave out 'unit'"));
}

TEST(DeckHistory, in_g_that_is_multiplied_by_g0_is_doubted) {
  const auto doubts = [](const std::string& csv, const std::string& history) {
    int n = 0;
    for (const std::string& warning : said_with(csv, history).second)
      n += warning.find("states a unit of acceleration") != std::string::npos;
    return n;
  };
  const std::string in_g = "t [us],a [g]\n0,0\n1,100\n4,0\n", plain = "t,a\n0,0\n1e-6,100\n4e-6,0\n";
  EXPECT_EQ(doubts(in_g, "g0 * history.file{ file = 'shot.csv' }"), 1);
  EXPECT_EQ(doubts(in_g, "history.file{ file = 'shot.csv' } * 9.81"), 1);
  EXPECT_EQ(doubts(in_g, "2 * history.file{ file = 'shot.csv' }"), 0);
  EXPECT_EQ(doubts(plain, "g0 * history.file{ file = 'shot.csv' }"), 0);
}

std::vector<std::string> warnings_of(const std::string& text) {
  take_warnings();
  FakeEngine fake;
  run_text(text, fake);
  return take_warnings();
}

int count(const std::vector<std::string>& warnings, const std::string& text) {
  return static_cast<int>(std::count_if(warnings.begin(), warnings.end(),
                                        [&](const auto& w) { return w.find(text) != std::string::npos; }));
}

TEST(Unusual, values_are_warned_of) {
  EXPECT_EQ(count(warnings_of(deck_with_history("2e6*g0", "base_acceleration")),
                  "'history' = 1.96133e+07 m/s^2 is unusual: beyond 100000 g; is it in m/s^2 already?"),
            1);
  EXPECT_EQ(count(warnings_of(deck_with_history("1e6*g0*other", "base_acceleration")),
                  "'history (largest value)' = 2.942e+07 m/s^2 is unusual"),
            1);
  EXPECT_EQ(count(warnings_of(deck_with_history("500*g0", "base_acceleration")), "unusual"), 0);
  const std::string contact =
      "local touch = interface.contact{ name = 'touch', between = { low:face 'xmax', high:face 'xmin' }, friction = ";
  EXPECT_EQ(count(warnings_of(std::string(two_blocks) + contact + "30 }"),
                  "deck.lua:14: interface.contact: 'friction' = 30 is unusual: metals have 0.05 to 1"),
            1);
  EXPECT_EQ(count(warnings_of(std::string(two_blocks) + contact + "2 }"), "unusual"), 0);
}

TEST(Refused, deck_is_not_said_to_be_computed) {
  take_warnings();
  const std::string text =
      std::string(two_blocks) +
      "local s = step.dynamic{ name = 's', duration = 2.5*us, dt = 1*us }\n"
      "problem{ name = 'p', substructures = { low, high }, interfaces = { glue }, supports = { base }, "
      "steps = { s } }:run{}";
  EXPECT_NE(message_of(text).find("'duration' = 2.5e-06 s is not a multiple of 'dt' = 1e-06 s"), std::string::npos);
  EXPECT_EQ(count(take_warnings(), "computed"), 0);
}

}  // namespace

}  // namespace dygita::test::histories_tests
