#include "checks/checked_assembly.hpp"

namespace dygita::balance_tests {

using Balance = CheckedAssembly;

TEST_F(Balance, tells_of_a_force_on_a_fixed_face) {
  shock->loads = {load("pressure", {Face{lower, "zmin"}}, 1e6)};
  EXPECT_EQ(only_warning(),
            "deck.lua:40: problem 'bolted': step 'shock': load.pressure on face 'lower.zmin' has no effect: a support "
            "or another load prescribes the motion of all its nodes");
}

TEST_F(Balance, tells_of_a_force_along_what_another_load_moves_and_of_no_other) {
  const Face top{upper, "zmax"};
  const auto along = [&](const char* axis) { return load("force", {top}, {{axis, 5.0}}); };
  const LoadPtr driven = load("velocity", {top}, {{"z", 1.0}});
  shock->loads = {driven, along("z")};
  EXPECT_NE(only_warning().find("load.force z on face 'upper.zmax' has no effect"), std::string::npos);
  shock->loads = {driven, along("x")};
  EXPECT_EQ(complaint(), "");
  EXPECT_TRUE(take_warnings().empty());
}

TEST_F(Balance, tells_of_a_pressure_on_a_plane_of_symmetry_not_of_a_shear_force_there) {
  auto plane = declared<Support>("plane", 21);
  plane->kind = make_support("symmetry");
  plane->on = {Face{upper, "xmin"}};
  problem.supports.push_back(plane);
  shock->loads = {load("pressure", {Face{upper, "xmin"}}, 1e6)};
  EXPECT_NE(only_warning().find("has no effect"), std::string::npos);
  shock->loads = {load("force", {Face{upper, "xmin"}}, {{"z", 1e3}})};
  EXPECT_EQ(complaint(), "");
  EXPECT_TRUE(take_warnings().empty());
}

TEST_F(Balance, is_not_asked_of_a_face_that_shares_an_edge_with_a_fixed_one) {
  shock->loads = {load("pressure", {Face{lower, "xmin"}}, 1e6)};
  EXPECT_EQ(complaint(), "");
  EXPECT_TRUE(take_warnings().empty());
}

TEST_F(Balance, refuses_preloads_in_series_that_differ) {
  auto top = declared<Support>("top", 21);
  top->kind = make_support("fixed");
  auto third = declared<Substructure>("third", 3);
  third->mesh = box_mesh(Vec3(0, 0, 2), Vec3::Ones(), {2, 2, 2});
  top->on = {Face{third, "zmax"}};
  auto other = declared<Interface>("other", 12);
  other->law = shank->law;
  other->side_1 = Face{upper, "zmax"};
  other->side_2 = Face{third, "zmin"};
  problem.substructures.push_back(third);
  problem.interfaces = {shank, other};
  problem.supports.push_back(top);
  shock->loads.clear();
  const auto preload = [&](double first, double second) {
    tighten->loads = {load("preload", {InterfacePtr(shank)}, first), load("preload", {InterfacePtr(other)}, second)};
  };
  preload(8e3, 8e3);
  EXPECT_EQ(complaint(), "");
  preload(8e3, 5e3);
  EXPECT_NE(complaint().find("only the preload of 'shank' (8 kN), 'other' (5 kN) acts along its axis on 'upper', "
                             "and 3 kN is unbalanced"),
            std::string::npos);
  problem.interfaces.push_back(mating);  // which may press the two together
  EXPECT_EQ(complaint(), "");
  problem.interfaces.pop_back();
  tighten->loads.push_back(load("pressure", {Face{upper, "xmax"}}, 1e3));  // acts there too: the run finds out
  EXPECT_EQ(complaint(), "");
}

}  // namespace dygita::balance_tests
