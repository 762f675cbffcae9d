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
  base->kind = SupportKind::absorbing;
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

}  // namespace dygita
