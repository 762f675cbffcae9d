#include "model/assembly.hpp"

namespace dygita::balance_tests {

using Balance = Assembly;

TEST_F(Balance, tells_of_a_force_on_a_fixed_face) {
  shock->loads = {load("pressure", {Face{lower, "zmin"}}, 1e6)};
  EXPECT_EQ(
      only_warning(),
      "deck.lua:40: problem 'bolted': step 'shock': load.pressure on face 'lower.zmin' moves nothing: a support or "
      "another load prescribes the motion of all nodes it acts on");
}

TEST_F(Balance, tells_of_a_force_along_what_another_load_moves_and_of_no_other) {
  const Face top{upper, "zmax"};
  const auto along = [&](const char* axis) { return load("force", {top}, {{axis, 5.0}}); };
  const LoadPtr driven = load("velocity", {top}, {{"z", 1.0}});
  shock->loads = {driven, along("z")};
  EXPECT_NE(only_warning().find("load.force z on face 'upper.zmax' moves nothing"), std::string::npos);
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
  EXPECT_NE(only_warning().find("moves nothing"), std::string::npos);
  shock->loads = {load("force", {Face{upper, "xmin"}}, {{"z", 1e3}})};
  EXPECT_EQ(complaint(), "");
  EXPECT_TRUE(take_warnings().empty());
}

TEST_F(Balance, is_not_asked_of_a_face_that_shares_an_edge_with_a_fixed_one) {
  shock->loads = {load("pressure", {Face{lower, "xmin"}}, 1e6)};
  EXPECT_EQ(complaint(), "");
  EXPECT_TRUE(take_warnings().empty());
}

TEST_F(Balance, refuses_a_preload_that_nothing_bears) {
  tighten->loads = {load("preload", {InterfacePtr(shank)}, 8e3)};
  EXPECT_EQ(complaint(), "");  // the mating faces do
  problem.interfaces = {shank};
  EXPECT_EQ(
      complaint(),
      "deck.lua:40: problem 'bolted': step 'tighten': nothing but the preload of 'shank' (8 kN) acts along its axis "
      "on 'upper', and 8 kN of it are left over: there is no equilibrium\n"
      "    a bolt pulls against something: is a contact or a support missing?");
}

TEST_F(Balance, allows_a_preload_that_a_load_may_bear) {
  tighten->loads = {load("preload", {InterfacePtr(shank)}, 8e3), load("pressure", {Face{upper, "zmax"}}, -8e3)};
  problem.interfaces = {shank};
  EXPECT_EQ(complaint(), "");
}

}  // namespace dygita::balance_tests
