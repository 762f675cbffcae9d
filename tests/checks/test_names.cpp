#include "checks/checked_assembly.hpp"

namespace dygita {

using Names = CheckedAssembly;

TEST_F(Names, of_a_sound_problem_are_accepted_without_a_word) {
  EXPECT_EQ(complaint(), "");
  EXPECT_TRUE(take_warnings().empty());
}

TEST_F(Names, are_unique_among_substructures) {
  upper->name = "lower";
  EXPECT_EQ(complaint(),
            "deck.lua:2: problem 'bolted': two substructures are called 'lower'\n"
            "    the other is declared at deck.lua:1");
}

TEST_F(Names, are_unique_among_interfaces) {
  mating->name = "shank";
  EXPECT_EQ(complaint(),
            "deck.lua:11: problem 'bolted': two interfaces are called 'shank'\n"
            "    the other is declared at deck.lua:10");
}

TEST_F(Names, are_unique_among_steps) {
  shock->name = "tighten";
  EXPECT_EQ(complaint(),
            "deck.lua:31: problem 'bolted': two steps are called 'tighten'\n"
            "    the other is declared at deck.lua:30");
}

TEST_F(Names, are_unique_among_supports_of_all_steps) {
  auto other = declared<Support>("base", 21);
  other->on = {Face{upper, "zmax"}};
  shock->supports = {{other}};
  EXPECT_EQ(complaint(),
            "deck.lua:21: problem 'bolted': two supports are called 'base'\n"
            "    the other is declared at deck.lua:20");
}

TEST_F(Names, are_unique_among_outputs_since_they_name_files) {
  below->name = "above";
  EXPECT_EQ(complaint(),
            "deck.lua:51: problem 'bolted': two outputs are called 'above'\n"
            "    the other is declared at deck.lua:50");
}

TEST_F(Names, may_be_shared_by_objects_of_different_words) {
  mating->name = "base";
  above->name = "shank";
  EXPECT_EQ(complaint(), "");
}

TEST_F(Names, of_one_object_listed_twice_are_not_called_two_objects) {
  problem.substructures.push_back(lower);
  EXPECT_EQ(complaint(), "deck.lua:84: problem 'bolted': substructure 'lower' is listed twice");
}

TEST_F(Names, cannot_be_empty) {
  above->name = "";
  EXPECT_EQ(complaint(), "deck.lua:50: problem 'bolted': output has no name");
}

TEST_F(Names, cannot_leave_the_output_directory) {
  above->name = "../above";
  EXPECT_EQ(complaint(),
            "deck.lua:50: problem 'bolted': output '../above': a name is used as a file name\n"
            "    allowed: anything without '/', '\\', control characters and a '.' in front");
}

TEST_F(Names, of_the_tables_of_the_run_are_taken) {
  above->name = "convergence";
  EXPECT_EQ(complaint(),
            "deck.lua:50: problem 'bolted': output 'convergence' would overwrite convergence.csv\n"
            "    'energy' and 'convergence' are the names of tables of the run itself");
}

TEST_F(Names, of_frames_are_taken) {
  above->name = "lower_00000.vtu";
  EXPECT_EQ(complaint(),
            "deck.lua:50: problem 'bolted': output 'lower_00000.vtu' has the name of a frame's file\n"
            "    the name of an output does not end with '.vtu' or '.pvtu'");
}

TEST_F(Names, are_utf8) {
  for (const char* good : {"Flansch \xc3\xa9", "\xe2\x82\xac", "\xf0\x9f\x94\xa9", "plain"}) {
    above->name = good;
    EXPECT_EQ(complaint(), "") << good;
  }
  for (const char* bad : {"\xff", "a\xc3", "\xc3(", "\xa9", "\xe2\x82", "\xc0\xaf"}) {
    above->name = bad;
    EXPECT_EQ(complaint(), "deck.lua:50: problem 'bolted': output: its name is not UTF-8\n    save the deck as UTF-8")
        << bad;
  }
}

TEST_F(Names, are_not_needed_by_outputs_that_come_once) {
  problem.outputs.push_back(output_double("", 52));
  EXPECT_EQ(complaint(), "");
  problem.outputs.push_back(output_double("", 53));
  EXPECT_EQ(complaint(), "deck.lua:53: problem 'bolted': 'outputs' has more than one output.double");
}

TEST_F(Names, need_a_substructure_and_a_step) {
  problem.steps.clear();
  EXPECT_EQ(complaint(),
            "deck.lua:84: problem 'bolted': 'steps' is empty\n"
            "    at least one step.static or step.dynamic is required");
  problem.substructures.clear();
  EXPECT_EQ(complaint(), "deck.lua:84: problem 'bolted': 'substructures' is empty");
}

}  // namespace dygita
