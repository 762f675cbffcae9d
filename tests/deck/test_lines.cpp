// Messages name the line of the constructor at fault, wherever it is called from.
#include <gtest/gtest.h>

#include "deck/fake_engine.hpp"
#include "model/load.hpp"

namespace dygita::test::lines_tests {

namespace {

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

const char* const unknown = "material.elastic: unknown argument 'nme'";

TEST(Lines, of_a_call_over_several_lines_are_where_it_begins) {
  EXPECT_EQ(first_line(message_of("local a = 1\nlocal m = material.elastic{\n  young = 1,\n  nme = 'x',\n}")),
            std::string("deck.lua:2: ") + unknown);
}

TEST(Lines, of_a_tail_call_are_its_own) {
  EXPECT_EQ(first_line(message_of("local function steel()\n  local E = 1\n  return material.elastic{ nme = 'x' }\nend\n"
                                  "\nlocal m = steel()")),
            std::string("deck.lua:3: ") + unknown);
}

TEST(Lines, of_a_tail_call_are_its_own_after_its_arguments_were_computed_elsewhere) {
  EXPECT_EQ(first_line(message_of("local function half(x)\n  local y = x / 2\n  return y\nend\n"
                                  "local function steel()\n  return material.elastic{ nme = half(3) }\nend\n"
                                  "local m = steel()")),
            std::string("deck.lua:6: ") + unknown);
}

TEST(Lines, of_nested_tail_calls_are_those_of_the_innermost) {
  EXPECT_EQ(first_line(message_of("local function a() return material.elastic{ nme = 1 } end\n"
                                  "local function b() return a() end\n"
                                  "local function c()\n  return b()\nend\nlocal m = c()")),
            std::string("deck.lua:1: ") + unknown);
}

TEST(Lines, after_a_function_of_the_same_line_returned_are_still_right) {
  EXPECT_EQ(first_line(message_of("local function f()\n  local x = 2\n  return x\nend\n"
                                  "local y = f(); local m = material.elastic{ nme = 1 }")),
            std::string("deck.lua:5: ") + unknown);
}

TEST(Lines, go_with_the_objects) {
  FakeEngine fake;
  run_text(std::string(two_blocks) +
               "problem{ name = 'p', substructures = { low, high }, interfaces = { glue }, supports = { base }, "
               "steps = { hold } }:run{}",
           fake);
  const Problem& problem = fake.problems.at(0);
  EXPECT_EQ(problem.origin.prefix(), "deck.lua:14: ");
  EXPECT_EQ(problem.substructures[0]->origin.line, 4) << "in a tail call";
  EXPECT_EQ(problem.interfaces[0]->origin.line, 8);
  EXPECT_EQ(problem.steps[0]->loads[0]->origin.line, 10);
}

}  // namespace

}  // namespace dygita::test::lines_tests
