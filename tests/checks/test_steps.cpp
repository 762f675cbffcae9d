#include "checks/checked_assembly.hpp"
#include "law/law.hpp"

namespace dygita {

using Steps = CheckedAssembly;

TEST_F(Steps, start_from_the_undeformed_state) {
  problem.steps = {shock, tighten};
  EXPECT_EQ(complaint(),
            "deck.lua:31: problem 'bolted': step 'shock' is listed first but follows 'tighten'\n"
            "    list the steps in the order they happen");
}

TEST_F(Steps, come_after_a_listed_one) {
  problem.steps = {shock};
  EXPECT_EQ(complaint(),
            "deck.lua:84: problem 'bolted': step 'shock' comes after 'tighten', which is not in 'steps'\n"
            "    add it to 'steps'; known: shock");
}

TEST_F(Steps, after_the_first_say_what_they_come_after) {
  shock->after = nullptr;
  EXPECT_EQ(complaint(),
            "deck.lua:31: problem 'bolted': step 'shock' has no 'after', so it starts from the undeformed state, but "
            "'tighten' is listed before it\n"
            "    write after = the step 'tighten', or make two problems");
}

TEST_F(Steps, do_not_fork) {
  auto pull = declared<Step>("pull", 32);
  pull->after = tighten;
  pull->duration = pull->dt = 1e-6;
  problem.steps.push_back(pull);
  EXPECT_EQ(complaint(),
            "deck.lua:32: problem 'bolted': step 'pull' comes after 'tighten', but 'shock' is listed before it\n"
            "    steps form one sequence in the order listed; use two problems for a branch");
}

TEST_F(Steps, when_static_have_an_increment) {
  tighten->increments = 0;
  EXPECT_EQ(complaint(), "deck.lua:30: problem 'bolted': step 'tighten': 'increments' = 0, at least 1 is needed");
}

TEST_F(Steps, when_dynamic_have_a_positive_duration_and_dt) {
  shock->dt = 0.0;
  EXPECT_EQ(complaint(), "deck.lua:31: problem 'bolted': step 'shock': 'dt' = 0 s, it must be positive");
  shock->duration = -1.0;
  EXPECT_EQ(complaint(), "deck.lua:31: problem 'bolted': step 'shock': 'duration' = -1 s, it must be positive");
}

TEST_F(Steps, are_not_shorter_than_dt) {
  shock->dt = 1e-3;
  EXPECT_EQ(complaint(),
            "deck.lua:31: problem 'bolted': step 'shock': 'dt' = 0.001 s is longer than 'duration' = 0.0002 s");
}

TEST_F(Steps, last_a_whole_number_of_dt_and_the_nearest_is_proposed) {
  shock->dt = 0.3e-6;
  EXPECT_EQ(complaint(),
            "deck.lua:31: problem 'bolted': step 'shock': 'duration' = 0.0002 s is not a multiple of 'dt' = 3e-07 s "
            "(666.667 increments)\n"
            "    nearest: duration = 0.0002001 s, or dt = 2.99850075e-07 s (667 increments)");
}

TEST_F(Steps, count_their_increments_up_to_rounding) {
  shock->duration = 24 * 1e-6;
  shock->dt = 0.1 * 1e-6;
  EXPECT_EQ(complaint(), "");
  EXPECT_EQ(shock->n_increments(), 240);
  tighten->increments = 3;
  EXPECT_EQ(tighten->n_increments(), 3);
}

TEST_F(Steps, with_absurdly_many_increments_ask_for_the_unit) {
  shock->duration = 200;
  EXPECT_EQ(complaint(),
            "deck.lua:31: problem 'bolted': step 'shock': 'duration' / 'dt' is 2e+08 increments, more than 1e+08\n"
            "    was a unit forgotten?");
}

TEST_F(Steps, with_an_interference_begin_with_a_static_one) {
  mating->law = make_law("contact", {{"friction", 0.0}, {"gap", -1e-5}});
  EXPECT_EQ(complaint(), "");
  shock->after = nullptr;
  problem.steps = {shock};
  EXPECT_EQ(complaint(),
            "deck.lua:11: problem 'bolted': interface.contact 'mating' has 'gap' = -1e-05 m, an interference, but the "
            "first step, 'shock', is dynamic\n"
            "    put a step.static before it to press the parts apart");
}

TEST_F(Steps, with_an_interference_at_a_wall_begin_with_a_static_one) {
  base->kind = make_support("wall", {{"friction", 0.0}, {"gap", -2e-5}});
  shock->after = nullptr;
  problem.steps = {shock};
  EXPECT_NE(complaint().find("deck.lua:20: problem 'bolted': support.wall 'base' has 'gap' = -2e-05 m"),
            std::string::npos);
}

}  // namespace dygita
