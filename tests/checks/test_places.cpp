#include "checks/checked_assembly.hpp"
#include "law/law_double.hpp"

namespace dygita {

using Places = CheckedAssembly;

TEST_F(Places, of_an_interface_are_on_listed_substructures) {
  problem.substructures = {lower};
  EXPECT_EQ(complaint(),
            "deck.lua:84: problem 'bolted': interface.plastic 'shank' joins substructure 'upper', which is not in "
            "'substructures'\n"
            "    add it to 'substructures'; known: lower");
}

TEST_F(Places, of_an_interface_declared_twice_name_the_other) {
  auto twin = declared<Substructure>("upper", 7);
  twin->mesh = upper->mesh;
  problem.substructures = {lower, twin};
  EXPECT_EQ(complaint(),
            "deck.lua:84: problem 'bolted': interface.plastic 'shank' joins substructure 'upper', which is not in "
            "'substructures'\n"
            "    'substructures' has another one of that name, declared at deck.lua:7: is one object declared twice?");
}

TEST_F(Places, that_the_mesh_does_not_have_get_the_closest_name) {
  mating->side_2.group = "zmn";
  EXPECT_EQ(
      complaint(),
      "deck.lua:11: problem 'bolted': interface.contact 'mating' joins face 'zmn', which substructure 'upper' does "
      "not have\n"
      "    did you mean 'zmin'? known: xmax, xmin, ymax, ymin, zmax, zmin");
}

TEST_F(Places, of_an_interface_are_two) {
  mating->side_2 = mating->side_1;
  EXPECT_EQ(complaint(),
            "deck.lua:11: problem 'bolted': interface.contact 'mating' joins lower.zmax with itself\n"
            "    'between' requires two faces that touch");
}

TEST_F(Places, of_a_support_are_on_listed_substructures) {
  auto stray = declared<Substructure>("nut", 3);
  stray->mesh = lower->mesh;
  base->on.push_back(Face{stray, "xmin"});
  EXPECT_EQ(complaint(),
            "deck.lua:84: problem 'bolted': support.fixed 'base' is on substructure 'nut', which is not in "
            "'substructures'\n"
            "    add it to 'substructures'; known: lower, upper");
}

TEST_F(Places, of_a_support_are_checked_in_the_steps_that_replace_it) {
  auto late = declared<Support>("late", 21);
  late->kind = make_support("fixed");
  shock->supports = {{late}};
  EXPECT_EQ(complaint(), "deck.lua:21: problem 'bolted': support.fixed 'late' is on nothing");
}

TEST_F(Places, of_a_wall_are_faces) {
  base->kind = a_wall();
  base->on = {Region{lower, {0, 1}}};
  EXPECT_EQ(complaint(),
            "deck.lua:20: problem 'bolted': support.wall 'base' is on a region: lower (2 nodes)\n"
            "    a region has no normal and no area: give a face (part:face \"group\"); support.fixed takes both");
}

TEST_F(Places, of_a_fixed_support_may_be_regions_that_have_nodes) {
  base->on = {Region{lower, {0, 1}}};
  EXPECT_EQ(complaint(), "");
  base->on = {Region{lower, {}}};
  EXPECT_EQ(
      complaint(),
      "deck.lua:20: problem 'bolted': support.fixed 'base' is on a region of substructure 'lower' that has no node\n"
      "    its function answered true for no node");
}

TEST_F(Places, of_a_support_are_given_once) {
  base->on.push_back(Face{lower, "zmin"});
  EXPECT_EQ(complaint(),
            "deck.lua:20: problem 'bolted': support.fixed 'base' is twice on the same place: lower.zmin, lower.zmin");
}

TEST_F(Places, are_under_one_support_in_a_step) {
  auto floor = declared<Support>("floor", 21);
  floor->kind = a_wall();
  floor->on = {Face{lower, "zmin"}};
  problem.supports.push_back(floor);
  EXPECT_EQ(
      complaint(),
      "deck.lua:21: problem 'bolted': step 'tighten': lower.zmin is under both support.fixed 'base' and support.wall "
      "'floor'\n"
      "    one support per face: 'supports' of a step replaces the problem's for that step");
}

TEST_F(Places, may_change_support_from_step_to_step) {
  auto floor = declared<Support>("floor", 21);
  floor->kind = a_wall();
  floor->on = {Face{lower, "zmin"}};
  shock->supports = {{floor}};
  EXPECT_EQ(complaint(), "");
  EXPECT_EQ(&supports_of(problem, *tighten), &problem.supports);
  EXPECT_EQ(supports_of(problem, *shock).front(), floor);
}

TEST_F(Places, of_symmetry_and_a_fixed_corner_may_share_nodes) {
  auto symmetry = declared<Support>("symmetry", 21);
  symmetry->kind = make_support("symmetry");
  symmetry->on = {Face{lower, "xmin"}, Face{lower, "ymin"}};
  problem.supports.push_back(symmetry);
  base->on = {Region{lower, {0}}};
  EXPECT_EQ(complaint(), "");
}

TEST_F(Places, of_a_law_without_an_explicit_form_are_refused_by_the_explicit_solver) {
  mating->law = std::make_shared<LawDouble>();
  EXPECT_EQ(complaint(), "");
  problem.explicit_dynamics.emplace();
  EXPECT_EQ(complaint(),
            "deck.lua:11: problem 'bolted': solver.explicit does not take interface.double 'mating': it has none\n"
            "    use solver.latin or solver.monolithic");
}

}  // namespace dygita
