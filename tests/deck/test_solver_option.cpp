// --solver EXPR.
#include <gtest/gtest.h>

#include "deck/fake_engine.hpp"

namespace dygita::test::solver_option_tests {

namespace {

const std::string deck =
    std::string(two_blocks) +
    "local own = solver.latin{ window = 3 }\n"
    "problem{ name = 'p', substructures = { low, high }, interfaces = { glue }, supports = { base }, steps = { hold }, "
    "solver = own }:run{}\n";

std::string message_with(const std::string& solver) {
  FakeEngine fake;
  try {
    run_text(deck, fake, {}, solver);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

testing::AssertionResult begins(const std::string& text, const std::string& start) {
  return text.rfind(start, 0) == 0 ? testing::AssertionSuccess() : testing::AssertionFailure() << text;
}

TEST(SolverOption, takes_the_place_of_the_decks_solver) {
  FakeEngine fake;
  run_text(deck, fake);
  run_text(deck, fake, {}, "latin{ tolerance = 3e-4, window = 5 }");
  run_text(deck, fake, {}, "monolithic");
  run_text(deck, fake, {}, "solver.latin{ window = \"whole\" }");
  ASSERT_EQ(fake.problems.size(), 4u);
  EXPECT_EQ(fake.problems[0].solver.window, 3);
  EXPECT_EQ(fake.problems[1].solver.window, 5);
  EXPECT_EQ(fake.problems[1].solver.tolerance, 3e-4);
  EXPECT_FALSE(fake.problems[1].monolithic);
  EXPECT_TRUE(fake.problems[2].monolithic);
  EXPECT_EQ(fake.problems[3].solver.window, 0);
}

TEST(SolverOption, reaches_the_run_record) {
  FakeEngine fake;
  run_text(deck, fake, {}, "monolithic");
  EXPECT_EQ(fake.requests.at(0).identity.solver, "monolithic");
}

TEST(SolverOption, is_checked_as_in_a_deck) {
  EXPECT_TRUE(
      begins(message_with("latin{ tolerence = 1e-4 }"),
             "deck.lua:15: --solver latin: unknown argument 'tolerence'\n    did you mean 'tolerance'? known: "));
  EXPECT_TRUE(begins(message_with("latin{ tolerance = 4 }"),
                     "deck.lua:15: --solver latin: 'tolerance' = 4 is outside the plausible range [1e-14,"));
  EXPECT_TRUE(begins(message_with("monolitic"),
                     "--solver monolitic: no solver 'monolitic'\n    did you mean 'monolithic'? known: "));
}

TEST(SolverOption, that_is_no_call_of_a_solver_is_refused) {
  const std::string refused = " is not a solver as a deck writes it, as in --solver 'latin{ tolerance = 1e-06 }'";
  for (const std::string wrong : {"latin{ tolerance = }", "latin(3)", "latin{} + 1", "latin{ f() }; print{}"})
    EXPECT_EQ(message_with(wrong), "--solver " + wrong + refused);
  EXPECT_TRUE(
      begins(message_with("latin{ tolerance = tol }"), "--solver latin{ tolerance = tol }: 'tol' is not a unit\n"));
}

}  // namespace

}  // namespace dygita::test::solver_option_tests
