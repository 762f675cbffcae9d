#include "checks/checked_assembly.hpp"

namespace dygita {

using Doubts = CheckedAssembly;

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

TEST_F(Doubts, are_said_of_a_support_that_every_step_replaces) {
  tighten->supports = std::vector<SupportPtr>{};
  shock->supports = std::vector<SupportPtr>{};
  EXPECT_EQ(only_warning(),
            "deck.lua:20: problem 'bolted': support.fixed 'base' is not used: every step has its own 'supports'");
}

TEST_F(Doubts, are_said_of_a_hardening_without_a_length) {
  lower->material = upper->material = {"steel", 2e11, 0.3, 7800.0, {}};
  shock->loads.clear();
  const auto harden = [&](double hardening) {
    shank->law = make_law("plastic", {{"yield", 5e8}, {"hardening", hardening}, {"compression", 0.0}});
  };
  harden(1e8);  // over one metre: E / 2000
  EXPECT_EQ(only_warning(),
            "deck.lua:10: problem 'bolted': interface.plastic 'shank': 'hardening' = 1e+08 Pa/m over the 1000 mm of "
            "'lower' is a plastic modulus of 100 MPa, 0.05 % of its Young's modulus; it is H/L, for a modulus H over a "
            "length L: was the division by L forgotten?");
  for (const double none : {0.0, 2e9}) {
    harden(none);
    EXPECT_EQ(complaint(), "");
    EXPECT_TRUE(take_warnings().empty());
  }
}

TEST_F(Doubts, are_said_of_a_whole_bolt_in_half_a_model) {
  auto cut = declared<Support>("cut", 21);
  cut->kind = make_support("symmetry");
  cut->on = {Face{lower, "ymin"}};
  problem.supports.push_back(cut);
  EXPECT_EQ(complaint(), "");
  EXPECT_TRUE(take_warnings().empty());
  upper->mesh = box_mesh(Vec3(0, -0.3, 1), Vec3::Ones(), {2, 2, 2});
  EXPECT_EQ(only_warning(),
            "deck.lua:21: problem 'bolted': 'upper', which a load tightens, lies on both sides of the plane of "
            "support.symmetry 'cut', 300 mm beyond it: in a half model, model half of a bolt on the plane, with half "
            "its preload");
}

TEST_F(Doubts, are_said_of_a_load_that_a_dynamic_step_drops) {
  const Face top{upper, "zmax"};
  tighten->loads.push_back(load("pressure", {top}, 2e5));
  shock->loads = {load("pressure", {Face{upper, "xmax"}}, 1e6)};
  EXPECT_EQ(only_warning(),
            "deck.lua:40: problem 'bolted': load.pressure on face 'upper.zmax' stands at 2e+05 Pa at the end of step "
            "'tighten' and is not listed in the dynamic step 'shock', where it is released suddenly, which is itself a "
            "shock; list it there too, or with the value 0 if the release is intended");
  for (const double value : {2e5, 0.0}) {  // kept, or let go on purpose
    shock->loads = {load("pressure", {top}, value)};
    EXPECT_EQ(complaint(), "");
    EXPECT_TRUE(take_warnings().empty()) << value;
  }
  shock->loads.clear();
  shock->is_static = true;  // ramped off
  problem.outputs.clear();
  EXPECT_EQ(complaint(), "");
  EXPECT_TRUE(take_warnings().empty());
}

// Of all loads the one that lets go in a static step too: nothing is ramped.
TEST_F(Doubts, are_said_of_displacements_that_the_next_step_lets_go) {
  const Target top = Face{upper, "zmax"};
  const auto displaced = [&](double value) { return load("displacement", {top}, {{"z", value}}); };
  tighten->loads.push_back(displaced(1e-5));
  EXPECT_EQ(
      only_warning(),
      "deck.lua:40: problem 'bolted': load.displacement z on face 'upper.zmax' stands at 1e-05 m at the end of "
      "step 'tighten' and is not listed in the dynamic step 'shock', where nothing holds these nodes: they are "
      "released suddenly, which is itself a shock; list it there too to hold them, unless the release is intended");
  for (const double value : {1e-5, 0.0}) {  // kept, or brought back
    shock->loads = {displaced(value)};
    EXPECT_EQ(complaint(), "");
    EXPECT_TRUE(take_warnings().empty()) << value;
  }
  shock->loads = {load("displacement", {top}, {{"x", 1e-5}})};  // along another axis
  EXPECT_EQ(complaint(), "");
  EXPECT_EQ(take_warnings().size(), 1u);
  shock->loads.clear();
  tighten->loads.back() = displaced(0.0);  // held, not moved
  EXPECT_EQ(complaint(), "");
  EXPECT_TRUE(take_warnings().empty());
  tighten->loads.back() = displaced(1e-5);
  shock->is_static = true;
  problem.outputs.clear();
  EXPECT_EQ(only_warning().find("deck.lua:40: problem 'bolted': load.displacement z on face 'upper.zmax' stands"), 0u);
}

TEST_F(Doubts, are_said_of_gravity_that_a_dynamic_step_drops) {
  tighten->loads.push_back(load("gravity", {}, {{"z", -9.81}}));
  const std::string start = "deck.lua:40: problem 'bolted': load.gravity z stands at -9.81 m/s^2 at the end of step";
  EXPECT_EQ(only_warning().substr(0, start.size()), start);
}

TEST_F(Doubts, are_said_of_mass_damping_where_parts_fly_or_are_driven) {
  lower->material = upper->material = {"steel", 2e11, 0.3, 7800.0, {100.0, 1e-7}};
  shock->duration = 1e-3;
  EXPECT_EQ(complaint(), "");
  EXPECT_TRUE(take_warnings().empty());  // held, not driven
  upper->velocity = Vec3(0, 0, -1);
  EXPECT_EQ(only_warning(),
            "deck.lua:1: problem 'bolted': damping of material 'steel' at two frequencies has a mass-proportional "
            "part, 100 1/s, which also damps rigid motion: 9.5 % of a free velocity in the 1 ms of the dynamic "
            "steps, and a force that shows in reactions and momentum; a ratio at one frequency has no such part");
}

TEST_F(Doubts, are_said_of_a_modulus_in_the_wrong_unit) {
  lower->material = upper->material = {"steel", 210e6, 0.3, 7800.0, {}};
  EXPECT_EQ(only_warning(),
            "deck.lua:1: problem 'bolted': a bar of material 'steel' (young 0.21 GPa, density 7800 kg/m^3) has a wave "
            "speed of 164 m/s, like rubber: is the modulus in GPa?");
}

TEST_F(Doubts, are_said_of_a_bolt_that_is_shortened_by_its_length) {
  tighten->loads = {load("shortening", {InterfacePtr(shank)}, 0.03)};
  EXPECT_EQ(
      only_warning(),
      "deck.lua:40: problem 'bolted': step 'tighten': load.shortening of 30 mm on interface.plastic 'shank' is 3 % "
      "of the 1000 mm of the longer part it joins, beyond any bolt; was a unit forgotten?");
}

TEST_F(Doubts, are_said_of_a_static_step_that_stops_what_moves) {
  auto rest = declared<Step>("rest", 32);
  rest->is_static = true;
  rest->after = shock;
  rest->loads = shock->loads;
  problem.steps.push_back(rest);
  EXPECT_EQ(only_warning(),
            "deck.lua:32: problem 'bolted': static step 'rest' follows the dynamic step 'shock': all motion stops at "
            "its start, and the kinetic energy counts as numerical dissipation");
}

}  // namespace dygita
