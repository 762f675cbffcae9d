#include "model/assembly.hpp"

namespace dygita {

class Outputs : public Assembly {
 protected:
  std::string complaint_of(OutputKind kind, Target target, Quantity quantity = Quantity::acceleration) {
    above->kind = kind;
    above->on = {target};
    above->quantity = quantity;
    above->direction.reset();
    problem.outputs = {above};
    return complaint();
  }
};

const std::string of_above = "deck.lua:50: problem 'bolted': output.";

TEST_F(Outputs, are_on_listed_objects) {
  problem.interfaces = {shank};
  EXPECT_EQ(complaint_of(OutputKind::joint, InterfacePtr(mating)),
            "deck.lua:84: problem 'bolted': output.joint 'above' is on interface 'mating', which is not in "
            "'interfaces'\n"
            "    add it to 'interfaces'; known: shank");
}

TEST_F(Outputs, may_be_on_a_support_of_any_step) {
  auto late = declared<Support>("late", 21);
  late->kind = make_support("fixed");
  late->on = {Face{upper, "zmax"}};
  EXPECT_NE(complaint_of(OutputKind::resultant, SupportPtr(late)).find("is on support 'late', which is not in"),
            std::string::npos);
  shock->supports = {{late}};
  EXPECT_EQ(complaint(), "");
}

TEST_F(Outputs, are_on_something) {
  above->on.clear();
  EXPECT_EQ(complaint(), of_above + "history 'above' is on nothing");
}

TEST_F(Outputs, of_pressure_are_on_interfaces_and_walls) {
  EXPECT_EQ(complaint_of(OutputKind::history, InterfacePtr(mating), Quantity::pressure), "");
  EXPECT_EQ(complaint_of(OutputKind::history, Face{upper, "zmax"}, Quantity::pressure),
            of_above +
                "history 'above' cannot be on face 'upper.zmax'\n"
                "    quantity 'pressure' takes an interface or a support.wall");
  EXPECT_EQ(complaint_of(OutputKind::history, SupportPtr(base), Quantity::pressure),
            of_above +
                "history 'above' cannot be on support.fixed 'base'\n"
                "    quantity 'pressure' takes an interface or a support.wall");
  base->kind = a_wall();
  EXPECT_EQ(complaint(), "");
}

TEST_F(Outputs, of_the_body_are_on_faces_and_regions) {
  EXPECT_EQ(complaint_of(OutputKind::history, Region{upper, {3}}, Quantity::stress), "");
  EXPECT_EQ(complaint_of(OutputKind::history, InterfacePtr(mating), Quantity::von_mises),
            of_above +
                "history 'above' cannot be on interface.contact 'mating'\n"
                "    quantity 'von_mises' takes a face or a region");
}

TEST_F(Outputs, of_resultants_are_on_interfaces_and_supports) {
  EXPECT_EQ(complaint_of(OutputKind::resultant, SupportPtr(base)), "");
  EXPECT_EQ(complaint_of(OutputKind::resultant, Face{upper, "zmax"}),
            of_above +
                "resultant 'above' cannot be on face 'upper.zmax'\n"
                "    output.resultant takes an interface or a support");
}

TEST_F(Outputs, of_joints_are_on_interfaces_and_walls) {
  EXPECT_EQ(complaint_of(OutputKind::joint, InterfacePtr(shank)), "");
  EXPECT_EQ(complaint_of(OutputKind::joint, SupportPtr(base)),
            of_above +
                "joint 'above' cannot be on support.fixed 'base'\n"
                "    output.joint takes an interface or a support.wall");
}

TEST_F(Outputs, of_scalars_have_no_direction) {
  problem.outputs = {above};
  above->quantity = Quantity::von_mises;
  EXPECT_EQ(complaint(), of_above + "history 'above': quantity 'von_mises' has no direction");
}

TEST_F(Outputs, of_spectra_are_of_a_listed_history) {
  problem.outputs = {spectrum};
  EXPECT_EQ(complaint(),
            "deck.lua:84: problem 'bolted': output.srs 'spectrum' is of output 'above', which is not in 'outputs'\n"
            "    add it to 'outputs'; known: spectrum");
}

TEST_F(Outputs, of_spectra_are_of_a_scalar_acceleration) {
  const std::string of_spectrum = "deck.lua:51: problem 'bolted': output.srs 'spectrum' ";
  const std::string hint = "\n    'of' takes an output.history of quantity 'acceleration' with a 'direction'";
  above->direction.reset();
  EXPECT_EQ(complaint(), of_spectrum + "is of output.history 'above', which has no direction" + hint);
  above->quantity = Quantity::velocity;
  EXPECT_EQ(complaint(), of_spectrum + "is of output.history 'above', a velocity" + hint);
  above->kind = OutputKind::joint;
  above->on = {InterfacePtr(shank)};
  EXPECT_EQ(complaint(), of_spectrum + "is of output.joint 'above'" + hint);
  spectrum->of = nullptr;
  EXPECT_EQ(complaint(), of_spectrum + "has no 'of'" + hint);
}

TEST_F(Outputs, of_spectra_need_a_dynamic_step_and_a_range) {
  spectrum->srs.from = 1e4;
  EXPECT_EQ(complaint(),
            "deck.lua:51: problem 'bolted': output.srs 'spectrum': 'from' = 10000 Hz and 'to' = 10000 Hz must be "
            "0 < from < to");
  problem.steps = {tighten};
  EXPECT_EQ(complaint(),
            "deck.lua:51: problem 'bolted': output.srs 'spectrum': the problem has no dynamic step\n"
            "    a spectrum is of dynamic steps only");
}

TEST_F(Outputs, for_paraview_have_a_frame) {
  auto vtk = declared<Output>("", 52);
  vtk->kind = OutputKind::vtk;
  vtk->frames = 0;
  problem.outputs.push_back(vtk);
  EXPECT_EQ(complaint(), "deck.lua:52: problem 'bolted': output.vtk: 'frames' = 0, at least 1 per step is needed");
}

using Doubts = Assembly;

TEST_F(Doubts, are_said_of_a_substructure_that_nothing_touches) {
  auto nut = declared<Substructure>("nut", 3);
  nut->mesh = lower->mesh;
  problem.substructures.push_back(nut);
  EXPECT_EQ(only_warning(), "deck.lua:3: problem 'bolted': no interface, support or load touches substructure 'nut'");
}

TEST_F(Doubts, are_said_of_an_absorbing_support_without_a_dynamic_step) {
  base->kind = make_support("absorbing");
  problem.steps = {tighten};
  problem.outputs.clear();
  EXPECT_EQ(only_warning(),
            "deck.lua:20: problem 'bolted': support.absorbing 'base' acts like a fixed one: there is no dynamic step");
}

TEST_F(Doubts, are_said_of_a_velocity_without_a_dynamic_step) {
  upper->velocity = Vec3(0, 0, -1);
  problem.steps = {tighten};
  problem.outputs.clear();
  EXPECT_EQ(only_warning(),
            "deck.lua:2: problem 'bolted': the velocity of substructure 'upper' is not used: there is no dynamic step");
}

TEST_F(Doubts, are_said_of_a_history_that_stays_zero) {
  problem.steps = {tighten};
  problem.outputs = {above};
  EXPECT_EQ(only_warning(),
            "deck.lua:50: problem 'bolted': output.history 'above' is zero throughout: there is no dynamic step");
}

TEST_F(Doubts, are_said_of_a_support_that_every_step_replaces) {
  tighten->supports = std::vector<SupportPtr>{};
  shock->supports = std::vector<SupportPtr>{};
  EXPECT_EQ(
      only_warning(),
      "deck.lua:20: problem 'bolted': support.fixed 'base' holds in no step: every step has 'supports' of its own");
}

}  // namespace dygita
