// What a deck asks of the engine, and what becomes of it.
#include <gtest/gtest.h>

#include "base/log.hpp"
#include "deck/fake_engine.hpp"

namespace dygita::test::runs_tests {

namespace {

const char* const pair =
    "problem{ name = 'pair', substructures = { low, high }, interfaces = { glue }, "
    "supports = { base }, steps = { hold, ring }, outputs = { joint } }";

DeckOutcome check_text(const std::string& text, FakeEngine& fake) {
  const Folder folder;
  DeckOptions options;
  options.path = folder.write("deck.lua", text);
  return check_deck(options, fake.engine());
}

std::vector<std::string> warnings_of(const std::string& text) {
  take_warnings();
  FakeEngine fake;
  run_text(text, fake);
  return take_warnings();
}

TEST(Run, asks_for_the_problem_with_its_identity) {
  FakeEngine fake;
  const Folder folder;
  DeckOptions options;
  options.path = folder.write("pair.lua", std::string(two_blocks) + "local p = " + pair + "\np:run{ case = 'soft' }");
  options.out = "results";
  options.threads = 3;
  const DeckOutcome outcome = run_deck(options, fake.engine());
  ASSERT_EQ(fake.requests.size(), 1u);
  EXPECT_EQ(outcome.n_runs, 1);
  const RunRequest& request = fake.requests[0];
  EXPECT_EQ(request.out, "results");
  EXPECT_EQ(request.case_name, "soft");
  EXPECT_EQ(request.threads, 3);
  EXPECT_EQ(request.identity.deck_path, options.path.string());
  EXPECT_EQ(request.identity.deck_digest.size(), 16u);
  ASSERT_EQ(request.identity.mesh_digests.size(), 2u);
  EXPECT_EQ(request.identity.mesh_digests[0].first, "low");
  EXPECT_FALSE(request.identity.mesh_digests[0].second.empty());
}

TEST(Run, goes_on_with_the_next_case) {
  FakeEngine fake;
  const DeckOutcome outcome = run_text(std::string(two_blocks) + "local p = " + pair +
                                           "\nfor i, name in ipairs { 'a', 'b' } do p:run{ case = name } end",
                                       fake);
  EXPECT_EQ(outcome.n_runs, 2);
  EXPECT_EQ(fake.requests.at(1).case_name, "b");
  EXPECT_EQ(fake.problems[0].substructures[0], fake.problems[1].substructures[0]) << "shared, not copied";
}

TEST(Run, that_did_not_converge_is_told_and_not_thrown) {
  FakeEngine fake;
  fake.converged = false;
  const DeckOutcome outcome =
      run_text(std::string(two_blocks) + "local r = " + pair + ":run{}\nassert(r.converged == false)", fake);
  EXPECT_EQ(outcome.not_converged, std::vector<std::string>{"problem 'pair', case 'base'"});
}

TEST(Run, that_the_user_stopped_ends_the_deck) {
  FakeEngine fake;
  fake.interrupted = true;
  const DeckOutcome outcome =
      run_text(std::string(two_blocks) + "local p = " + pair + "\np:run{}\np:run{ case = 'never' }", fake);
  EXPECT_TRUE(outcome.interrupted);
  EXPECT_EQ(fake.requests.size(), 1u);
}

TEST(Run, lets_the_engines_errors_out_as_they_are) {
  FakeEngine fake;
  fake.during = [](const Problem&) { throw NumericalError("the factorisation of 'low' failed"); };
  EXPECT_THROW(run_text(std::string(two_blocks) + "local r = " + pair + ":run{}", fake), NumericalError);
  fake.during = [](const Problem&) { throw std::bad_alloc(); };
  EXPECT_THROW(run_text(std::string(two_blocks) + "local r = " + pair + ":run{}", fake), std::bad_alloc);
}

TEST(Run, gives_the_engines_complaints_a_line) {
  FakeEngine fake;
  fake.during = [](const Problem&) { throw InputError("faces 'low.zmax' and 'high.zmin' do not meet"); };
  try {
    run_text(std::string(two_blocks) + "local p = " + pair + "\nlocal r = p:run{}", fake);
    FAIL() << "nothing thrown";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "deck.lua:15: problem 'pair': faces 'low.zmax' and 'high.zmin' do not meet");
  }
}

TEST(Deck, may_begin_with_a_byte_order_mark_or_the_name_of_its_program) {
  EXPECT_EQ(message_of("\xEF\xBB\xBFlocal x = 1"), "");
  EXPECT_EQ(message_of("#!/usr/bin/env dygita\nlocal x = y").substr(0, 12), "deck.lua:2: ");
}

TEST(Check, solves_nothing_and_says_what_would_be_computed) {
  FakeEngine fake;
  const DeckOutcome outcome = check_text(std::string(two_blocks) + "local r = " + pair + ":run{}", fake);
  EXPECT_EQ(outcome.n_runs, 1);
  EXPECT_EQ(fake.n_checks, 1);
  EXPECT_TRUE(fake.requests.empty());
}

TEST(Check, goes_on_past_results_that_are_not_there) {
  FakeEngine fake;
  check_text(std::string(two_blocks) + "local p = " + pair + R"(
    for i, name in ipairs { "a", "b" } do
      local r = p:run{ case = name }
      print(("%.2f %d"):format(r[joint].normal.max / kN, r.iterations))
      local x = r[joint].slip:at(2*us) + r[joint].normal:at(hold) + r[joint].opening[1] + #r[joint]
    end)",
             fake);
  EXPECT_EQ(fake.n_checks, 2);
}

TEST(Check, takes_no_failure_for_an_error_that_missing_results_cause) {
  FakeEngine fake;
  const std::string run = std::string(two_blocks) + "local r = " + pair + ":run{}\n";
  EXPECT_NO_THROW(check_text(run + "assert(r[joint].normal.max < 0, 'not pressed')", fake));
  EXPECT_NO_THROW(check_text(run + "local h = history.constant{ value = r[joint].normal.max }", fake));
}

TEST(Check, still_refuses_what_is_wrong_for_certain) {
  FakeEngine fake;
  const std::string run = std::string(two_blocks) + "local r = " + pair + ":run{}\n";
  EXPECT_THROW(check_text(run + "local x = r[joint].normal.max\nlocal h = history.constant{ valeu = 1 }", fake),
               InputError);
  EXPECT_THROW(check_text(run + "assert(1 == 2)", fake), InputError) << "no result was read before";
}

TEST(Unused, objects_are_warned_of) {
  const std::string used = std::string(two_blocks) + "local r = " + pair + ":run{}\n";
  EXPECT_TRUE(warnings_of(used).empty());
  EXPECT_EQ(warnings_of(used + "local wall = support.wall{ name = 'wall', on = high:face 'zmax' }"),
            std::vector<std::string>{"deck.lua:15: support 'wall' is declared but never used"});
}

TEST(Unused, objects_that_serve_an_unused_one_are_not_told_apart) {
  const std::string text = std::string(two_blocks) + "local r = " + pair + ":run{}\n" +
                           "local s = step.static{ name = 's', loads = { load.gravity{ z = -g0 } } }";
  EXPECT_EQ(warnings_of(text), std::vector<std::string>{"deck.lua:15: step 's' is declared but never used"});
}

TEST(Unused, parameters_are_warned_of) {
  const std::string text =
      "local p = param{ mu = 0.3, n = 4 }" + std::string(two_blocks) + "local r = " + pair + ":run{}\nlocal n = p.n";
  EXPECT_EQ(warnings_of(text), std::vector<std::string>{"deck.lua:1: parameter 'mu' is declared but never used"});
}

TEST(Unused, problems_are_those_never_run) {
  const std::vector<std::string> expected = {"deck.lua:14: problem 'pair' is declared but never run",
                                             "deck.lua runs no problem: nothing was computed"};
  EXPECT_EQ(warnings_of(std::string(two_blocks) + "local p = " + pair), expected);
}

TEST(ContractDecks, declare_without_error) {
  for (const std::string name : {"crush", "plastic_beam", "bolted_flanges"}) {
    FakeEngine fake;
    DeckOptions options;
    options.path = std::filesystem::path(DYGITA_SOURCE_DIR) / "decks" / (name + ".lua");
    take_warnings();
    EXPECT_NO_THROW(check_deck(options, fake.engine())) << name;
    EXPECT_EQ(fake.n_checks, 1) << name;
    EXPECT_EQ(take_warnings(), std::vector<std::string>{}) << name;
  }
}

}  // namespace

}  // namespace dygita::test::runs_tests
