// --set NAME=VALUE.
#include <gtest/gtest.h>

#include "deck/fake_engine.hpp"

namespace dygita::test::settings_tests {

namespace {

const char* const deck = "local p = param{ mu = 0.3, n = 4, tighten = 0.06*mm }\n";

TEST(Settings, override_parameters) {
  const std::string text = std::string(deck) +
                           "assert(p.mu == 0.1 and p.n == 6 and near(p.tighten, 0.04*mm))\n"
                           "assert(math.type(p.n) == 'integer')";
  EXPECT_EQ(message_of(text, {"mu=0.1", "n=6", "tighten=0.04*mm"}), "");
}

TEST(Settings, are_expressions_in_units) {
  const std::string text = std::string(deck) + "assert(near(p.mu, 2e9 + 3*MPa))";
  EXPECT_EQ(message_of(text, {"mu = (2*GPa + 3e6)"}),
            "deck.lua:1: --set mu : the deck has no such parameter\n"
            "    did you mean 'mu'? known: mu, n, tighten");
  EXPECT_EQ(message_of(text, {"mu=(2*GPa + 3e6)"}), "");
}

TEST(Settings, of_unknown_parameters_are_refused_before_anything_runs) {
  EXPECT_EQ(
      message_of(deck, {"tigten=0.04*mm"}),
      "deck.lua:1: --set tigten: the deck has no such parameter\n    did you mean 'tighten'? known: mu, n, tighten");
  EXPECT_EQ(message_of("local x = 1", {"mu=1"}), "--set mu: deck 'deck.lua' declares no parameters with param{ ... }");
}

TEST(Settings, that_are_no_numbers_are_refused) {
  const std::string hint = " is neither a number nor an expression in units, as in --set tighten=0.04*mm";
  EXPECT_EQ(message_of(deck, {"mu=1/0"}), "--set mu=1/0" + hint);
  EXPECT_EQ(message_of(deck, {"mu=0.3*"}), "--set mu=0.3*" + hint);
  EXPECT_EQ(message_of(deck, {"mu=\"a\""}), "--set mu=\"a\"" + hint);
  EXPECT_EQ(message_of(deck, {"mu=true"}), "--set mu=true" + hint);
  EXPECT_EQ(message_of(deck, {"tighten=4*mn"}).substr(0, 39), "--set tighten=4*mn: 'mn' is not a unit\n");
}

TEST(Settings, are_split_at_the_first_equals_sign) {
  EXPECT_EQ(parse_setting("mu=0.3"), std::make_pair(std::string("mu"), std::string("0.3")));
  for (const std::string wrong : {"mu", "=3", "mu="}) EXPECT_THROW(parse_setting(wrong), InputError) << wrong;
}

TEST(Settings, reach_the_run_record) {
  FakeEngine fake;
  run_text(std::string(deck) + two_blocks +
               "problem{ name = 'p', substructures = { low, high }, interfaces = { glue }, supports = { base }, "
               "steps = { hold } }:run{}",
           fake, {"mu=0.5"});
  const std::vector<std::pair<std::string, double>> expected = {{"mu", 0.5}, {"n", 4.0}, {"tighten", 0.06e-3}};
  EXPECT_EQ(fake.requests.at(0).identity.parameters, expected);
}

}  // namespace

}  // namespace dygita::test::settings_tests
