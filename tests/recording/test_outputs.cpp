// What outputs check, whatever solver answers them.
#include "checks/checked_assembly.hpp"
#include "recording/given_output.hpp"

namespace dygita::outputs_tests {

class Outputs : public CheckedAssembly {
 protected:
  Outputs() { declare(Vec3::UnitZ()); }

  // A history on top, and a spectrum of it.
  void declare(const std::optional<Vec3>& direction, const std::string& quantity = "acceleration") {
    of = make_history("above", {Face{upper, "zmax"}}, quantity, direction);
    GivenArguments arguments = given_spectrum("srs", "spectrum");
    arguments.outputs["of"] = of;
    problem.outputs = {of, make_output(arguments)};
  }

  std::string complaint_of(const OutputPtr& output) {
    problem.outputs = {output};
    return complaint();
  }
  std::string complaint_of(const std::string& word, Target target) {
    return complaint_of(make_output(given_output(word, "above", {target})));
  }
  std::string complaint_of_history(const std::string& quantity, Target target) {
    return complaint_of(make_history("above", {target}, quantity));
  }

  OutputPtr of;
};

const std::string of_above = "deck.lua:50: problem 'bolted': output.";

TEST_F(Outputs, of_a_sound_problem_are_accepted_without_a_word) {
  EXPECT_EQ(complaint(), "");
  EXPECT_TRUE(take_warnings().empty());
}

TEST_F(Outputs, are_on_listed_objects) {
  problem.interfaces = {shank};
  EXPECT_EQ(complaint_of("joint", InterfacePtr(mating)),
            "deck.lua:84: problem 'bolted': output.joint 'above' is on interface 'mating', which is not in "
            "'interfaces'\n"
            "    add it to 'interfaces'; known: shank");
}

TEST_F(Outputs, may_be_on_a_support_of_any_step) {
  auto late = declared<Support>("late", 21);
  late->kind = make_support("fixed");
  late->on = {Face{upper, "zmax"}};
  EXPECT_NE(complaint_of("resultant", SupportPtr(late)).find("is on support 'late', which is not in"),
            std::string::npos);
  shock->supports = {{late}};
  EXPECT_EQ(complaint(), "");
}

TEST_F(Outputs, are_on_something) {
  EXPECT_EQ(complaint_of(make_history("above", {}, "acceleration")), of_above + "history 'above' is on nothing");
}

TEST_F(Outputs, of_pressure_are_on_interfaces_and_walls) {
  EXPECT_EQ(complaint_of_history("pressure", InterfacePtr(mating)), "");
  EXPECT_EQ(complaint_of_history("pressure", Face{upper, "zmax"}),
            of_above +
                "history 'above' cannot be on face 'upper.zmax'\n"
                "    quantity 'pressure' takes an interface or a support.wall");
  EXPECT_EQ(complaint_of_history("pressure", SupportPtr(base)),
            of_above +
                "history 'above' cannot be on support.fixed 'base'\n"
                "    quantity 'pressure' takes an interface or a support.wall");
  base->kind = a_wall();
  EXPECT_EQ(complaint(), "");
}

TEST_F(Outputs, of_the_body_are_on_faces_and_regions) {
  EXPECT_EQ(complaint_of_history("stress", Region{upper, {3}}), "");
  EXPECT_EQ(complaint_of_history("von_mises", InterfacePtr(mating)),
            of_above +
                "history 'above' cannot be on interface.contact 'mating'\n"
                "    quantity 'von_mises' takes a face or a region");
}

TEST_F(Outputs, of_resultants_are_on_interfaces_and_supports) {
  EXPECT_EQ(complaint_of("resultant", SupportPtr(base)), "");
  EXPECT_EQ(complaint_of("resultant", Face{upper, "zmax"}), of_above +
                                                                "resultant 'above' cannot be on face 'upper.zmax'\n"
                                                                "    output.resultant takes an interface or a support");
}

TEST_F(Outputs, of_joints_are_on_interfaces_and_walls) {
  EXPECT_EQ(complaint_of("joint", InterfacePtr(shank)), "");
  EXPECT_EQ(complaint_of("joint", SupportPtr(base)), of_above +
                                                         "joint 'above' cannot be on support.fixed 'base'\n"
                                                         "    output.joint takes an interface or a support.wall");
}

TEST_F(Outputs, of_momentum_are_of_listed_parts_each_once) {
  GivenArguments arguments = given_output("momentum", "rebound");
  problem.outputs = {make_output(arguments)};
  EXPECT_EQ(complaint(), "");
  arguments.parts = {upper, upper};
  problem.outputs = {make_output(arguments)};
  EXPECT_EQ(complaint(),
            "deck.lua:50: problem 'bolted': output.momentum 'rebound': substructure 'upper' occurs twice in 'of'");
  arguments.parts = {std::make_shared<Substructure>(*upper)};
  problem.outputs = {make_output(arguments)};
  EXPECT_NE(complaint().find("output.momentum 'rebound' is of substructure 'upper', which is not in 'substructures'"),
            std::string::npos);
  arguments.parts = {};
  problem.outputs = {make_output(arguments)};
  problem.steps = {tighten};
  EXPECT_EQ(only_warning(),
            "deck.lua:50: problem 'bolted': output.momentum 'rebound' is zero throughout: there is no dynamic step");
}

TEST_F(Outputs, of_scalars_have_no_direction) {
  declare(Vec3::UnitZ(), "von_mises");
  EXPECT_EQ(complaint(), of_above + "history 'above': quantity 'von_mises' has no direction");
}

TEST_F(Outputs, of_spectra_are_of_a_listed_history) {
  problem.outputs.erase(problem.outputs.begin());
  EXPECT_EQ(complaint(),
            "deck.lua:84: problem 'bolted': output.srs 'spectrum' is of output 'above', which is not in 'outputs'\n"
            "    add it to 'outputs'; known: spectrum");
}

TEST_F(Outputs, of_spectra_are_of_a_scalar_acceleration) {
  const std::string of_spectrum = "deck.lua:51: problem 'bolted': output.srs 'spectrum' ";
  const std::string hint = "\n    'of' takes an output.history of quantity 'acceleration' with a 'direction'";
  declare({});
  EXPECT_EQ(complaint(), of_spectrum + "is of output.history 'above', which has no direction" + hint);
  declare({}, "velocity");
  EXPECT_EQ(complaint(), of_spectrum + "is of output.history 'above', a velocity" + hint);
  GivenArguments arguments = given_spectrum("srs", "spectrum");
  arguments.outputs["of"] = make_output(given_output("joint", "above", {InterfacePtr(shank)}));
  problem.outputs = {arguments.outputs["of"], make_output(arguments)};
  EXPECT_EQ(complaint(), of_spectrum + "is of output.joint 'above'" + hint);
  problem.outputs = {make_output(given_spectrum("srs", "spectrum"))};
  EXPECT_EQ(complaint(), of_spectrum + "has no 'of'" + hint);
}

TEST_F(Outputs, of_spectra_need_a_dynamic_step_and_a_range) {
  EXPECT_THROW(make_output(given_spectrum("srs", "spectrum", 1e4, 1e4)), InputError);
  problem.steps = {tighten};
  EXPECT_EQ(complaint(),
            "deck.lua:51: problem 'bolted': output.srs 'spectrum': the problem has no dynamic step\n"
            "    a spectrum requires a dynamic step");
}

TEST_F(Outputs, for_paraview_have_a_frame) {
  GivenArguments arguments = given_output("vtk", "", {}, 52);
  arguments.values_of_time["frames"] = given_number(0.0);
  arguments.word_lists["fields"] = {};
  problem.outputs.push_back(make_output(arguments));
  EXPECT_EQ(complaint(), "deck.lua:52: problem 'bolted': output.vtk: 'frames' = 0, at least 1 per step is needed");
}

TEST_F(Outputs, that_stay_zero_are_doubted) {
  problem.steps = {tighten};
  problem.outputs = {of};
  EXPECT_EQ(only_warning(),
            "deck.lua:50: problem 'bolted': output.history 'above' is zero throughout: there is no dynamic step");
}

TEST_F(Outputs, without_a_name_are_called_by_their_word) {
  const OutputPtr energy = make_output(given_output("energy", ""));
  EXPECT_EQ(energy->name, "energy");
  EXPECT_FALSE(energy->is_named);
  EXPECT_TRUE(of->is_named);
}

TEST(OutputTable, has_every_output_under_its_word) {
  std::vector<std::string> words;
  for (const OutputEntry& entry : output_table()) words.push_back(entry.word);
  EXPECT_EQ(words, (std::vector<std::string>{"attenuation", "backbone", "energy", "footprint", "history", "joint",
                                             "loop", "modes", "momentum", "resultant", "ringdown", "srs", "srs_field",
                                             "superelement", "vtk"}));
  EXPECT_EQ(output_entry("srs")->display.as, Display::As::spectrum);
  EXPECT_EQ(output_entry("vacuum"), nullptr);
}

}  // namespace dygita::outputs_tests
