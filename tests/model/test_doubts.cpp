#include "model/assembly.hpp"

namespace dygita {

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

TEST_F(Doubts, are_said_of_a_support_that_every_step_replaces) {
  tighten->supports = std::vector<SupportPtr>{};
  shock->supports = std::vector<SupportPtr>{};
  EXPECT_EQ(
      only_warning(),
      "deck.lua:20: problem 'bolted': support.fixed 'base' holds in no step: every step has 'supports' of its own");
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
            "length L: is the division by L missing?");
  for (const double none : {0.0, 2e9}) {
    harden(none);
    EXPECT_EQ(complaint(), "");
    EXPECT_TRUE(take_warnings().empty());
  }
}

}  // namespace dygita
