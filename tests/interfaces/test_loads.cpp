// What each load does to the nodes under it, against hand values, and how its value runs through steps.
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "interfaces/loads.hpp"
#include "model/assembly.hpp"

namespace dygita::loads_tests {

namespace {

// A block of 2 x 3 x 4 m, one corner at (10, 20, 30), in a step of one second.
class LoadsOfABlock : public ::testing::Test {
 protected:
  std::shared_ptr<Substructure> block = declared<Substructure>("block", 1);
  std::shared_ptr<Step> first = declared<Step>("first", 2), second = declared<Step>("second", 3);
  Problem problem;
  State start;
  Vec mass;
  const Vec3 top_centre = Vec3(11.0, 21.5, 34.0);

  LoadsOfABlock() {
    block->mesh = box_mesh(Vec3::Zero(), Vec3(2, 3, 4), {2, 3, 5});
    block->place = Vec3(10, 20, 30);
    first->duration = second->duration = 1.0;
    first->dt = second->dt = 0.25;
    second->after = first;
    problem.substructures = {block};
    problem.steps = {first, second};
    mass = Vec::LinSpaced(block->mesh->n_nodes(), 1.0, 2.0);
  }

  Face face(const std::string& group) const { return {block, group}; }

  Loads loads_of(const Step& step) const {
    return Loads(problem, step, start, [&](int, const Points& a) { return Points(a * mass.asDiagonal()); });
  }

  Loads loads_of_first(std::vector<LoadPtr> loads) {
    first->loads = std::move(loads);
    return loads_of(*first);
  }

  // The force (N) on each node in the middle of the first step.
  Points forces(std::vector<LoadPtr> loads) {
    Loads all = loads_of_first(std::move(loads));
    all.evaluate(1);
    Points force = Points::Zero(3, block->mesh->n_nodes());
    all.add_forces(0, force);
    return force;
  }

  Vec3 place_of(int node) const { return block->mesh->nodes.col(node) + block->place; }

  Vec3 moment(const Points& forces, const Vec3& about) const {
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < forces.cols(); ++i) sum += (place_of(i) - about).cross(forces.col(i));
    return sum;
  }

  // The first value of a step, increment by increment.
  static std::vector<double> values(Loads& loads, int n) {
    std::vector<double> all;
    for (int i = 0; i < n; ++i) {
      loads.evaluate(i);
      all.push_back(loads.values().front());
    }
    return all;
  }
};

constexpr double round_off = 1e-12;

TEST_F(LoadsOfABlock, of_pressure_push_against_the_normal_through_the_middle_of_the_face) {
  const Points top = forces({load("pressure", {face("zmax")}, 5.0)});
  EXPECT_LT((top.rowwise().sum() - Vec3(0, 0, -5.0 * 6.0)).norm(), round_off);
  EXPECT_LT(moment(top, top_centre).norm(), round_off);
  const Points side = forces({load("pressure", {face("xmin")}, 5.0)});
  EXPECT_LT((side.rowwise().sum() - Vec3(5.0 * 12.0, 0, 0)).norm(), round_off);
  const Points around = forces(
      {load("pressure", {face("xmin"), face("xmax"), face("ymin"), face("ymax"), face("zmin"), face("zmax")}, 5.0)});
  EXPECT_LT(around.rowwise().sum().norm(), 1e-11);
}

TEST_F(LoadsOfABlock, of_traction_are_force_per_area_along_the_axes) {
  const Points force = forces({load("traction", {face("zmax")}, {{"x", 3.0}, {"z", -2.0}})});
  EXPECT_LT((force.rowwise().sum() - 6.0 * Vec3(3, 0, -2)).norm(), round_off);
  EXPECT_LT(moment(force, top_centre).norm(), 1e-11);
}

TEST_F(LoadsOfABlock, of_force_are_spread_over_areas_or_nodes_to_the_whole_force) {
  const Points on_face = forces({load("force", {face("xmax")}, {{"y", 12.0}})});
  EXPECT_LT((on_face.rowwise().sum() - Vec3(0, 12, 0)).norm(), round_off);
  EXPECT_LT(moment(on_face, Vec3(12, 21.5, 32)).norm(), 1e-11);
  const Points on_nodes = forces({load("force", {Region{block, {4, 7, 9}}}, {{"y", 12.0}})});
  for (const int node : {4, 7, 9}) EXPECT_EQ(on_nodes.col(node), Vec3(0, 4, 0));
  EXPECT_EQ(on_nodes.norm(), Vec3(4, 4, 4).norm());
}

TEST_F(LoadsOfABlock, of_torque_turn_about_the_centroid_with_no_resultant) {
  const Points force = forces({load("torque", {face("zmax")}, 7.0)});
  EXPECT_LT(force.rowwise().sum().norm(), round_off);
  EXPECT_LT((moment(force, Vec3::Zero()) - Vec3(0, 0, 7)).norm(), 1e-11);
  // On nodes of equal area the force grows with the radius, across it.
  int n_inside = 0;
  double ratio = 0.0;
  for (int i = 0; i < force.cols(); ++i) {
    const Vec3 r = place_of(i) - top_centre;
    if (std::abs(r[2]) > 0.1 || std::abs(r[0]) > 0.9 || std::abs(r[1]) > 1.4) continue;
    EXPECT_LT(std::abs(force.col(i).dot(r)), round_off);
    const double now = force.col(i).norm() / r.norm();
    if (n_inside++ > 0) {
      EXPECT_NEAR(now, ratio, round_off);
    }
    ratio = now;
  }
  EXPECT_EQ(n_inside, 2);
}

TEST_F(LoadsOfABlock, of_torque_turn_about_a_given_axis) {
  GivenArguments arguments("load.torque", {});
  arguments.on = {face("xmax")};
  arguments.lists = {{"axis", {2, 0, 0}}, {"through", {0, 20, 30}}};
  arguments.values_of_time["history"] = {History::constant(-7.0), true};
  const Points force = forces({make_load(arguments)});
  EXPECT_NEAR(moment(force, Vec3(0, 20, 30))[0], -7.0, round_off);
  // In all the face is pushed across the way to its middle.
  EXPECT_NEAR(force.rowwise().sum().dot(Vec3(0, 1.5, 2)), 0.0, round_off);
  EXPECT_GT(force.rowwise().sum().norm(), 1.0);
}

TEST_F(LoadsOfABlock, of_gravity_are_the_masses_times_the_acceleration) {
  const Points force = forces({load("gravity", {}, {{"x", 2.0}, {"z", -9.0}})});
  for (int i = 0; i < force.cols(); ++i) EXPECT_EQ(force.col(i), mass[i] * Vec3(2, 0, -9));
}

TEST_F(LoadsOfABlock, add_up) {
  const LoadPtr push = load("pressure", {face("zmax")}, 5.0), pull = load("force", {face("zmax")}, {{"z", 7.0}});
  EXPECT_LT((forces({push, pull}) - forces({push}) - forces({pull})).norm(), round_off);
}

TEST_F(LoadsOfABlock, given_as_numbers_ramp_in_a_static_step_from_what_they_had) {
  first->is_static = second->is_static = true;
  first->increments = second->increments = 4;
  Loads loads = loads_of_first({load("pressure", {face("zmax")}, 8.0)});
  EXPECT_EQ(values(loads, 4), (std::vector<double>{2, 4, 6, 8}));
  start.reached = loads.reached();
  second->loads = {load("pressure", {face("zmax")}, 0.0)};
  Loads later = loads_of(*second);
  EXPECT_EQ(values(later, 4), (std::vector<double>{6, 4, 2, 0}));
}

TEST_F(LoadsOfABlock, no_longer_listed_in_a_static_step_are_taken_off_in_a_ramp) {
  second->is_static = true;
  second->increments = 4;
  start.reached =
      loads_of_first({load("force", {Region{block, {3, 5}}}, {{"y", 8.0}}), load("gravity", {}, {{"z", 4.0}})})
          .reached();
  Loads loads = loads_of(*second);
  ASSERT_EQ(loads.patterns().size(), 2U);
  EXPECT_EQ(loads.patterns()[0].nodes.size(), 2U);
  EXPECT_EQ(loads.patterns()[1].nodes.size(), static_cast<size_t>(block->mesh->n_nodes()));
  EXPECT_EQ(values(loads, 4), (std::vector<double>{6, 4, 2, 0}));
  EXPECT_EQ(loads.values().back(), 0.0);
}

TEST_F(LoadsOfABlock, given_as_histories_act_by_their_mean_over_a_time_step) {
  GivenArguments arguments("load.pressure", {});
  arguments.on = {face("zmax")};
  arguments.values_of_time["history"] = {History::ramp(0.0, 8.0, 1.0), false};
  Loads loads = loads_of_first({make_load(arguments)});
  const std::vector<double> found = values(loads, 4);
  for (int i = 0; i < 4; ++i) EXPECT_DOUBLE_EQ(found[i], 2.0 * i + 1.0);
  EXPECT_DOUBLE_EQ(loads.reached().begin()->second, 8.0);
}

TEST_F(LoadsOfABlock, of_displacement_leave_what_they_reached_to_the_next_step) {
  first->is_static = true;
  first->increments = 2;
  const auto reached =
      loads_of_first({load("displacement", {face("zmax")}, {{"z", 3e-3}}), load("velocity", {face("zmin")})}).reached();
  ASSERT_EQ(reached.size(), 1U);
  EXPECT_EQ(reached.begin()->second, 3e-3);
}

}  // namespace

}  // namespace dygita::loads_tests
