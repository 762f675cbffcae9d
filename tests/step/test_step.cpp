// What a step holds, moves and loads, and what it takes over and leaves.
#include <gtest/gtest.h>

#include <functional>
#include <set>

#include "base/error.hpp"
#include "base/progress.hpp"
#include "step/blocks.hpp"
#include "step/expected_iterations.hpp"

namespace dygita::step_tests {
namespace {

constexpr double step_dt = 0.5e-6;

Problem one_cube(std::vector<StepPtr> steps) {
  Problem problem;
  problem.solver.integration = IntegrationChoice::implicitly;
  problem.substructures = {cube("cube", 0, 0, 0)};
  problem.steps = std::move(steps);
  set_progress_enabled(false);
  return problem;
}
BlockPtr part_of(const Problem& problem) { return std::const_pointer_cast<Substructure>(problem.substructures[0]); }

TEST(Conditions, hold_all_of_a_fixed_face_and_the_normal_of_a_symmetry) {
  Problem problem = one_cube({dynamic_step("test", 1, step_dt, {})});
  const BlockPtr part = part_of(problem);
  problem.supports = {support("fixed", {face(part, "zmin")}), support("symmetry", {face(part, "xmin")})};
  const Modelled of(problem);
  const Conditions& conditions = of.model.conditions;
  const auto held_at = [&](const Vec3& place) { return conditions.at(0, of.node_at(0, place)); };
  EXPECT_EQ(held_at({0.01, 0.01, 0.01}), nullptr);
  ASSERT_NE(held_at({0.01, 0.0, 0.0}), nullptr);
  EXPECT_EQ(held_at({0.01, 0.0, 0.0})->n, 3);
  EXPECT_EQ(held_at({0.0, 0.0, 0.0})->n, 3);  // the symmetry adds nothing to what is fixed
  ASSERT_NE(held_at({0.0, 0.005, 0.01}), nullptr);
  EXPECT_EQ(held_at({0.0, 0.005, 0.01})->n, 1);
  EXPECT_NEAR(std::abs(held_at({0.0, 0.005, 0.01})->directions(0, 0)), 1.0, 1e-12);
  EXPECT_TRUE(conditions.motions.empty());
}

TEST(Conditions, hold_what_absorbs_in_a_static_step_and_let_it_go_in_a_dynamic_one) {
  const StepPtr press = static_step("press", 1, {});
  Problem problem = one_cube({press, dynamic_step("shock", 1, step_dt, {}, press)});
  problem.supports = {support("absorbing", {face(part_of(problem), "zmin")})};
  const Modelled at_rest(problem, 0), in_motion(problem, 1);
  EXPECT_EQ(at_rest.model.conditions.held[0].size(), 9U);
  EXPECT_TRUE(in_motion.model.conditions.held[0].empty());
  // rho c A of the whole face, along its normal and across.
  const Elastic material = steel();
  Mat3 sum = Mat3::Zero();
  const auto& piece = dynamic_cast<const ImplicitPiece&>(*in_motion.model.pieces[0]);
  for (const auto& [node, impedance] : piece.op().absorbing()) sum += impedance;
  const double across = 7800.0 * material.s_wave_speed() * 1e-4, along = 7800.0 * material.p_wave_speed() * 1e-4;
  EXPECT_LT((sum - Mat3(Vec3(across, across, along).asDiagonal())).norm(), 1e-9 * along);
  EXPECT_TRUE(dynamic_cast<const ImplicitPiece&>(*at_rest.model.pieces[0]).op().absorbing().empty());
}

// How closely an increment is iterated and how its factors are stored is no matter of what is computed.
TEST(Integration, is_chosen_whatever_the_tolerance_and_the_precision) {
  const auto is_explicit = [](double dt, const std::function<void(LatinSettings&)>& ask) {
    Problem problem = two_cubes(contact(0.2), {dynamic_step("shock", 100000, dt, {})}, 8);
    problem.solver.integration = IntegrationChoice::as_cheapest;
    ask(problem.solver);
    const Modelled of(std::move(problem));
    std::vector<bool> parts;
    for (const Integration::Part& part : of.model.integration.parts) parts.push_back(part.is_explicit);
    return parts;
  };
  std::set<std::vector<bool>> seen;
  for (const double dt : {0.5e-6, 1e-6, 1.25e-6, 1.5e-6, 1.75e-6, 2e-6, 3e-6, 6e-6}) {
    const std::vector<bool> usual = is_explicit(dt, [](LatinSettings&) {});
    seen.insert(usual);
    EXPECT_EQ(is_explicit(dt, [](LatinSettings& s) { s.tolerance = 1e-9; }), usual) << dt;
    EXPECT_EQ(is_explicit(dt, [](LatinSettings& s) { s.precision = Precision::double_precision; }), usual) << dt;
  }
  EXPECT_GE(seen.size(), 2U);  // near where the choice turns
}

TEST(Conditions, move_a_face_by_its_velocity_at_the_end_of_an_increment) {
  Problem problem = one_cube({});
  const Face top{problem.substructures[0], "zmax"};
  problem.steps = {
      dynamic_step("test", 4, step_dt, {load("velocity", {top}, History::ramp(0.0, 8.0, 4 * step_dt), 2)})};
  const Modelled of(problem);
  ASSERT_EQ(of.model.conditions.motions.size(), 1U);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(of.model.motion_velocities(i)[0], 2.0 * (i + 1), 1e-12);
  const Held* held = of.model.conditions.at(0, of.node_at(0, {0.0, 0.0, 0.01}));
  ASSERT_NE(held, nullptr);
  EXPECT_EQ(held->n, 1);
  EXPECT_NEAR(held->directions(2, 0), 1.0, 1e-12);
}

TEST(Conditions, refuse_a_motion_of_what_is_held) {
  Problem problem = one_cube({});
  const Face top{problem.substructures[0], "zmax"};
  problem.supports = {support("fixed", {top})};
  problem.steps = {dynamic_step("test", 4, step_dt, {load("velocity", {top}, History::constant(1.0), 2)})};
  EXPECT_THROW(Modelled{problem}, InputError);
}

TEST(Loads, of_a_face_are_pressure_traction_and_force) {
  for (const char* word : {"pressure", "traction", "force"}) {
    Problem problem = one_cube({});
    const Face top{problem.substructures[0], "zmax"};
    const int axis = std::string(word) == "pressure" ? 0 : 2;
    problem.steps = {
        dynamic_step("test", 4, step_dt, {load(word, {top}, History::ramp(0.0, 80.0, 4 * step_dt), axis)})};
    const Modelled of(problem);
    of.model.loads->evaluate(1);  // mean over the second increment: 30
    const Points force = of.model.external_force(0, of.state);
    const double expected = axis == 0 ? -30.0 * 1e-4 : std::string(word) == "force" ? 30.0 : 30.0 * 1e-4;
    EXPECT_NEAR(force.row(2).sum(), expected, 1e-12) << word;
    EXPECT_NEAR(force.topRows<2>().norm(), 0.0, 1e-12) << word;
    for (int node = 0; node < force.cols(); ++node) {
      const bool is_on_top = of.problem.substructures[0]->mesh->nodes(2, node) > 0.0099;
      EXPECT_EQ(force(2, node) != 0.0, is_on_top) << word;
    }
  }
}

TEST(Loads, of_gravity_are_the_weight_of_every_node) {
  Problem problem = one_cube({});
  problem.steps = {static_step("rest", 4, {number("gravity", {}, -9.81, 2)})};
  problem.supports = {support("fixed", {face(part_of(problem), "zmin")})};
  const Modelled of(problem);
  for (int i = 0; i < 4; ++i) {
    of.model.loads->evaluate(i);  // a number is ramped in a static step
    const double weight = 7800.0 * 1e-6 * 9.81;
    EXPECT_NEAR(of.model.external_force(0, of.state).row(2).sum(), -0.25 * (i + 1) * weight, 1e-12);
  }
}

TEST(Loads, that_a_later_static_step_does_not_list_fade_away_in_it) {
  Problem problem = one_cube({});
  const Face top{problem.substructures[0], "zmax"};
  const StepPtr press = static_step("press", 2, {number("pressure", {top}, 40.0)});
  problem.steps = {press, static_step("let go", 2, {}, press)};
  problem.supports = {support("fixed", {face(part_of(problem), "zmin")})};
  Modelled of(problem);
  of.state.reached = of.model.loads->reached();
  StepModel next = make_step_model(of.problem, *of.problem.steps[1], of.surfaces, of.bodies, of.state, of.cut);
  next.loads->evaluate(0);
  EXPECT_NEAR(next.external_force(0, of.state).row(2).sum(), -20.0 * 1e-4, 1e-12);
  next.loads->evaluate(1);
  EXPECT_NEAR(next.external_force(0, of.state).row(2).sum(), 0.0, 1e-15);
}

TEST(StepEnds, give_initial_velocities_to_the_first_dynamic_step_alone) {
  Problem problem = one_cube({});
  part_of(problem)->velocity = {0.0, 0.0, -3.0};
  const StepPtr rest = static_step("rest", 1, {}), fly = dynamic_step("fly", 2, step_dt, {}, rest);
  problem.steps = {rest, fly, dynamic_step("fly on", 2, step_dt, {}, fly)};
  const double kinetic = 0.5 * 7800.0 * 1e-6 * 9.0;
  Modelled of(problem);
  start_step(of.model, of.state);
  EXPECT_TRUE(of.state.velocity[0].isZero(0.0));
  EXPECT_FALSE(of.state.has_moved);
  end_step(of.model, of.state);
  for (const int i : {1, 2}) {
    StepModel model = make_step_model(of.problem, *of.problem.steps[i], of.surfaces, of.bodies, of.state, of.cut);
    start_step(model, of.state);
    EXPECT_TRUE(of.state.has_moved);
    EXPECT_LT((of.state.velocity[0].colwise() - Vec3(0.0, 0.0, -3.0)).norm(), 1e-14);
    EXPECT_NEAR(of.state.energies.kinetic, kinetic, 1e-12 * kinetic);
    EXPECT_NEAR(of.state.energies.start, kinetic, 1e-12 * kinetic);
    EXPECT_EQ(of.state.energies.scheme, 0.0);
    end_step(model, of.state);
  }
}

TEST(StepEnds, leave_the_fields_of_the_pieces) {
  Problem problem = one_cube({dynamic_step("test", 1, step_dt, {})});
  problem.substructures = {cube("cube", 0, 0, 0, 4)};
  for (const int pieces : {1, 2}) {
    problem.solver.pieces = pieces;
    Modelled of(problem);
    ASSERT_EQ(static_cast<int>(of.model.pieces.size()), pieces);
    for (int i = 0; i < pieces; ++i) {
      of.state.displacement[i] = of.cut->on_piece(i, 1e-6 * random_points(125, 1));
      of.state.velocity[i] = of.cut->on_piece(i, random_points(125, 2));
    }
    start_step(of.model, of.state);
    State end = of.state;
    for (int i = 0; i < pieces; ++i) {
      end.displacement[i].setZero();
      end.velocity[i].setZero();
    }
    end_step(of.model, end);
    for (int i = 0; i < pieces; ++i) {
      EXPECT_LT((end.displacement[i] - of.cut->on_piece(i, 1e-6 * random_points(125, 1))).norm(), 1e-20);
      EXPECT_LT((end.velocity[i] - of.cut->on_piece(i, random_points(125, 2))).norm(), 1e-14);
    }
    EXPECT_GT(end.energies.kinetic, 0.0);
  }
}

// Energy that a new support takes away is the scheme's.
TEST(StepEnds, book_what_a_new_support_stops) {
  Problem problem = one_cube({});
  part_of(problem)->velocity = {0.0, 0.0, -3.0};
  const StepPtr fly = dynamic_step("fly", 2, step_dt, {});
  auto caught = dynamic_step("caught", 2, step_dt, {}, fly);
  caught->supports.emplace();
  caught->supports->push_back(support("fixed", {face(part_of(problem), "zmin")}));
  problem.steps = {fly, caught};
  Modelled of(problem);
  start_step(of.model, of.state);
  end_step(of.model, of.state);
  const double before = of.state.energies.kinetic;
  StepModel model = make_step_model(of.problem, *caught, of.surfaces, of.bodies, of.state, of.cut);
  start_step(model, of.state);
  EXPECT_LT(of.state.energies.kinetic, 0.9 * before);
  EXPECT_NEAR(of.state.energies.scheme, before - of.state.energies.kinetic, 1e-12 * before);
  EXPECT_NEAR(of.state.energies.balance(), 0.0, 1e-12 * before);
}

TEST(StepSize, is_predicted_without_a_factor) {
  const Modelled of(two_cubes(contact(0.3), {dynamic_step("test", 1, step_dt, {})}, 4));
  const StepSize size = predict_step(of.problem, *of.problem.steps[0], of.surfaces, of.bodies, of.state, of.cut);
  EXPECT_EQ(size.n_unknowns, of.model.n_q());
  double bytes = 0.0;
  for (const auto& piece : of.model.pieces) {
    piece->set_search_directions(Vec::Ones(piece->n_rows()));
    bytes += piece->figures().bytes;
  }
  EXPECT_NEAR(size.bytes, bytes, 0.15 * bytes);
}

// P waves go 5.87 mm in a microsecond.
TEST(ExpectedIterations, are_more_where_waves_cross_parts_of_a_centimetre_many_times_in_dt) {
  const auto expected = [](double dt) {
    const Modelled of(two_cubes(contact(0.3), {dynamic_step("test", 1, dt, {})}, 2));
    return expected_iterations(of.problem, *of.problem.steps[0], of.surfaces, of.model.integration);
  };
  EXPECT_EQ(expected(1e-6).most, 15.0);
  EXPECT_NEAR(expected(10e-6).most, 12.0 * 5.87, 0.5);
  EXPECT_EQ(expected(1e-3).most, 200.0);
  EXPECT_EQ(expected(1e-3).fewest, 7.0);
}

}  // namespace
}  // namespace dygita::step_tests
