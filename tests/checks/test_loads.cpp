#include "checks/checked_assembly.hpp"
#include "law/law.hpp"

namespace dygita {

class LoadRules : public CheckedAssembly {
 protected:
  std::string complaint_of(const LoadPtr& load_of_shock) {
    shock->loads = {load_of_shock};
    return complaint();
  }
  std::string complaint_of_static(const LoadPtr& load_of_tighten) {
    tighten->loads = {load_of_tighten};
    return complaint();
  }
};

const std::string in_shock = "deck.lua:40: problem 'bolted': step 'shock': ";

TEST_F(LoadRules, are_on_listed_interfaces) {
  problem.interfaces = {mating};
  EXPECT_EQ(complaint(),
            "deck.lua:84: problem 'bolted': step 'tighten' loads interface 'shank', which is not in 'interfaces'\n"
            "    add it to 'interfaces'; known: mating");
}

TEST_F(LoadRules, are_on_listed_substructures) {
  auto stray = declared<Substructure>("nut", 3);
  stray->mesh = lower->mesh;
  EXPECT_EQ(complaint_of(load("force", {Face{stray, "xmin"}})),
            "deck.lua:84: problem 'bolted': step 'shock' loads substructure 'nut', which is not in 'substructures'\n"
            "    add it to 'substructures'; known: lower, upper");
}

TEST_F(LoadRules, are_on_supports_in_force_in_their_step) {
  shock->supports = std::vector<SupportPtr>{};
  EXPECT_EQ(complaint_of(load("base_acceleration", {SupportPtr(base)})),
            "deck.lua:84: problem 'bolted': step 'shock' loads support 'base', which is not in 'supports'\n"
            "    add it to 'supports'; known: none");
}

TEST_F(LoadRules, of_each_kind_act_on_what_they_can) {
  const Face face{upper, "zmax"};
  const Region region{upper, {0, 1}};
  const InterfacePtr bolt = shank, contact = mating;
  const SupportPtr fixed = base;
  EXPECT_EQ(complaint_of(load("pressure", {region})),
            in_shock + "load.pressure cannot act on a region of 'upper'\n    load.pressure acts on a face");
  EXPECT_EQ(complaint_of(load("traction", {bolt})),
            in_shock + "load.traction cannot act on interface.plastic 'shank'\n    load.traction acts on a face");
  EXPECT_EQ(complaint_of(load("force", {fixed})),
            in_shock + "load.force cannot act on support.fixed 'base'\n    load.force acts on a face or a region");
  EXPECT_EQ(complaint_of(load("velocity", {bolt})), in_shock +
                                                        "load.velocity cannot act on interface.plastic 'shank'\n"
                                                        "    load.velocity acts on a face or a region");
  EXPECT_EQ(complaint_of(load("displacement", {fixed})), in_shock +
                                                             "load.displacement cannot act on support.fixed 'base'\n"
                                                             "    load.displacement acts on a face or a region");
  EXPECT_EQ(complaint_of(load("base_acceleration", {face})),
            in_shock +
                "load.base_acceleration cannot act on face 'upper.zmax'\n"
                "    load.base_acceleration acts on a support.fixed or a support.held or a support.symmetry");
  EXPECT_EQ(complaint_of(load("release", {face})),
            in_shock + "load.release cannot act on face 'upper.zmax'\n    load.release acts on an interface");
  EXPECT_EQ(complaint_of(load("gravity", {face})), in_shock +
                                                       "load.gravity cannot act on face 'upper.zmax'\n"
                                                       "    load.gravity acts on every substructure, without 'on'");
  EXPECT_EQ(complaint_of_static(load("shortening", {contact})),
            "deck.lua:40: problem 'bolted': step 'tighten': load.shortening cannot act on interface.contact 'mating'\n"
            "    load.shortening acts on an interface.bonded or an interface.bushing or an interface.plastic");
}

TEST_F(LoadRules, of_each_kind_are_accepted_where_they_act) {
  const Region region{upper, {0, 1}};
  const Face face{upper, "zmax"};
  EXPECT_EQ(complaint_of(load("traction", {face})), "");
  EXPECT_EQ(complaint_of(load("force", {region})), "");
  EXPECT_EQ(complaint_of(load("velocity", {region})), "");
  EXPECT_EQ(complaint_of(load("displacement", {face})), "");
  EXPECT_EQ(complaint_of(load("base_acceleration", {SupportPtr(base)})), "");
  EXPECT_EQ(complaint_of(load("release", {InterfacePtr(mating)}, 1e-5)), "");
  EXPECT_EQ(complaint_of(load("gravity", {})), "");
  shank->law = make_law("bonded");
  EXPECT_EQ(complaint(), "");
}

TEST_F(LoadRules, of_base_acceleration_need_a_support_that_holds) {
  base->kind = a_wall();
  EXPECT_NE(complaint_of(load("base_acceleration", {SupportPtr(base)})).find("cannot act on support.wall"),
            std::string::npos);
  base->kind = make_support("symmetry");
  EXPECT_EQ(complaint(), "");
}

TEST_F(LoadRules, are_on_something) {
  EXPECT_EQ(complaint_of(load("pressure", {})),
            in_shock + "load.pressure is on nothing\n    load.pressure acts on a face");
}

TEST_F(LoadRules, are_on_a_place_once) {
  const Face face{upper, "zmax"};
  EXPECT_EQ(complaint_of(load("pressure", {face, face})), in_shock + "load.pressure is twice on face 'upper.zmax'");
}

TEST_F(LoadRules, are_listed_once) {
  shock->loads.push_back(shock->loads.front());
  EXPECT_EQ(complaint(), in_shock + "one load.pressure is listed twice");
}

TEST_F(LoadRules, have_a_value) {
  EXPECT_EQ(complaint_of(load("traction", {Face{upper, "zmax"}}, std::map<std::string, double>())),
            in_shock + "load.traction has no value\n    give at least one of x, y, z");
  EXPECT_EQ(complaint_of(load("pressure", {Face{upper, "zmax"}}, {{"y", 1.0}})),
            in_shock + "load.pressure has no value");
}

TEST_F(LoadRules, that_shorten_a_bolt_act_in_static_steps) {
  EXPECT_EQ(complaint_of(load("shortening", {InterfacePtr(shank)})),
            in_shock +
                "load.shortening acts in static steps only, and this one is dynamic\n"
                "    tighten in a preceding step.static; the bolt keeps its length afterwards");
}

TEST_F(LoadRules, that_need_time_act_in_dynamic_steps) {
  EXPECT_EQ(
      complaint_of_static(load("base_acceleration", {SupportPtr(base)})),
      "deck.lua:40: problem 'bolted': step 'tighten': load.base_acceleration acts in dynamic steps only, and this "
      "one is static\n"
      "    use load.gravity for a steady acceleration of the whole assembly");
  EXPECT_EQ(complaint_of_static(load("velocity", {Face{upper, "zmax"}})),
            "deck.lua:40: problem 'bolted': step 'tighten': load.velocity acts in dynamic steps only, and this one is "
            "static\n"
            "    a static step has no physical time: use load.displacement");
}

TEST_F(LoadRules, release_within_their_step) {
  EXPECT_EQ(complaint_of(load("release", {InterfacePtr(shank)}, 3e-4)),
            in_shock +
                "load.release.at = 0.0003, outside the step [0, 0.0002]\n"
                "    'at' counts in seconds from the step's start");
}

TEST_F(LoadRules, prescribe_a_direction_once) {
  const Face face{upper, "zmax"};
  shock->loads = {load("velocity", {face}), load("displacement", {face})};
  EXPECT_EQ(complaint(),
            in_shock + "load.velocity and load.displacement both prescribe the motion of face 'upper.zmax' along x");
  shock->loads.back() = load("displacement", {face}, {{"y", 0.0}});
  EXPECT_EQ(complaint(), "");
  shock->loads.back() = load("displacement", {Region{upper, {26}}});
  EXPECT_NE(complaint().find("the motion of a region of 'upper' along x"), std::string::npos);
}

const std::string give_their_sum = "\n    give their sum in one load; a history may be a function(t)";

TEST_F(LoadRules, shorten_a_bolt_once_a_step) {
  tighten->loads.push_back(load("shortening", {InterfacePtr(shank)}, 2e-5));
  EXPECT_EQ(complaint(),
            "deck.lua:40: problem 'bolted': step 'tighten': two load.shortening on interface.plastic 'shank'" +
                give_their_sum);
}

TEST_F(LoadRules, of_one_kind_on_one_place_are_given_as_one) {
  const Face face{upper, "zmax"};
  shock->loads = {load("pressure", {face}), load("pressure", {face})};
  EXPECT_EQ(complaint(), in_shock + "two load.pressure on face 'upper.zmax'" + give_their_sum);
  shock->loads = {load("gravity", {}), load("gravity", {})};
  EXPECT_EQ(complaint(), in_shock + "two load.gravity" + give_their_sum);
}

TEST_F(LoadRules, of_different_kinds_places_or_directions_add_up) {
  const Face face{upper, "zmax"};
  shock->loads = {load("pressure", {face}), load("pressure", {Face{upper, "xmax"}}), load("traction", {face}),
                  load("traction", {face}, {{"y", 1.0}})};
  EXPECT_EQ(complaint(), "");
}

TEST_F(LoadRules, turn_a_face_about_several_axes) {
  const Face face{upper, "zmax"};
  shock->loads = {load("torque", {face}), load("torque", {face})};
  EXPECT_EQ(complaint(), in_shock + "two load.torque on face 'upper.zmax'" + give_their_sum);
  shock->loads.back() = load("torque", {face}, {{"history", 1.0}}, Vec3::UnitX());
  EXPECT_EQ(complaint(), "");
}

TEST_F(LoadRules, shake_a_base_in_perpendicular_directions) {
  const LoadPtr along_z = load("base_acceleration", {SupportPtr(base)});
  shock->loads = {along_z, load("base_acceleration", {SupportPtr(base)})};
  EXPECT_EQ(complaint(), in_shock + "two load.base_acceleration on support.fixed 'base'" + give_their_sum);
  shock->loads.back() = load("base_acceleration", {SupportPtr(base)}, {{"history", 1.0}}, Vec3::UnitX());
  EXPECT_EQ(complaint(), "");
}

TEST_F(LoadRules, do_not_move_what_a_support_holds) {
  EXPECT_EQ(complaint_of(load("displacement", {Face{lower, "zmin"}})),
            in_shock +
                "load.displacement moves face 'lower.zmin' along x, where support.fixed 'base' holds it\n"
                "    take the support out of the step's 'supports', or move the support itself with "
                "load.base_acceleration");
  shock->supports = std::vector<SupportPtr>{};
  EXPECT_EQ(complaint(), "");
}

TEST_F(LoadRules, may_slide_along_a_plane_of_symmetry_but_not_leave_it) {
  base->kind = make_support("symmetry");
  EXPECT_EQ(complaint_of(load("displacement", {Face{lower, "zmin"}})), "");
  EXPECT_NE(complaint_of(load("displacement", {Face{lower, "zmin"}}, {{"z", 1e-6}}))
                .find("moves face 'lower.zmin' along z, where support.symmetry 'base' holds it"),
            std::string::npos);
}

}  // namespace dygita
