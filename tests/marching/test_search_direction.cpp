// Search directions, the coarse correction and windows.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "latin/coarse_correction.hpp"
#include "latin/search_direction.hpp"
#include "latin/step_settings.hpp"
#include "marching/solve.hpp"
#include "step/blocks.hpp"

namespace dygita {
namespace {

constexpr double direction_dt = 0.4e-6;

// Velocities of the linear stage for data q, all pieces.
Vec linear_stage(StepModel& model, const Vec& q) {
  Vec velocity(q.size());
  for (size_t i = 0; i < model.pieces.size(); ++i)
    model.pieces[i]->interface_velocity(q.segment(model.offset[i], model.pieces[i]->n_rows()),
                                        velocity.segment(model.offset[i], model.pieces[i]->n_rows()));
  return velocity;
}
void begin(StepModel& model, const State& state) {
  model.loads->evaluate(0);
  for (size_t i = 0; i < model.pieces.size(); ++i) {
    Piece* piece = model.pieces[i].get();
    piece->begin(model.piece_force(static_cast<int>(i), state), model.motion_velocities(0), 0.0);
    piece->forward({&piece, 1});
  }
}

TEST(SearchDirections, of_a_static_step_are_the_diagonal_of_the_schur_complement) {
  const Modelled of(two_cubes(contact(0.3), {static_step("test", 1, {})}));
  const Vec k = search_directions(of.model, 1.0, 1);
  ASSERT_EQ(k.size(), of.model.n_q());
  for (size_t i = 0; i < of.model.pieces.size(); ++i) {
    const Piece& piece = *of.model.pieces[i];
    for (int r = 0; r < piece.n_rows(); ++r)
      EXPECT_DOUBLE_EQ(k[of.model.offset[i] + r],
                       std::max(piece.schur_diagonal()[r], 1e-3 * piece.rows()[r].reference_stiffness));
  }
  EXPECT_GT(k.minCoeff(), 0.0);
  EXPECT_EQ(search_directions(of.model, 3.0, 1), 3.0 * k);
}

TEST(SearchDirections, of_a_dynamic_step_stand_between_the_schur_complement_and_the_wave) {
  const Modelled of(two_cubes(contact(0.3), {dynamic_step("test", 4, direction_dt, {})}));
  const Vec k = search_directions(of.model, 1.0, 1), impedance = search_directions(of.model, 1.0, 6);
  const Elastic material = steel();
  for (const Port& port : of.model.exchange.ports)
    for (int d = 0; d < 3; ++d) {
      const Piece& piece = *of.model.pieces[port.piece];
      const int i = of.model.unknown(port, d);
      const double speed = d == 0 ? material.p_wave_speed() : material.s_wave_speed();
      const double wave = material.density * speed * port.area;
      EXPECT_DOUBLE_EQ(impedance[i], wave);  // windows of many steps
      const double step = std::hypot(0.5 * wave, piece.node_masses()[port.piece_node] / direction_dt);
      EXPECT_NEAR(k[i], std::pow(piece.schur_diagonal()[port.unknown[d]], 0.75) * std::pow(step, 0.25), 1e-12 * k[i]);
    }
}

// Faces that do not match: a bond has one k for both sides, a contact one for each.
TEST(SearchDirections, are_one_for_both_sides_of_a_bond_in_a_dynamic_step) {
  const auto ratios = [](const LawPtr& law, StepPtr step) {
    Problem problem = two_cubes(law, {std::move(step)}, 3);
    const BlockPtr top = block("top", {0.001, 0.001, 0.01}, {0.008, 0.008, 0.01}, {2, 2, 2});
    problem.substructures[1] = top;
    problem.interfaces = {interface("between", Face{problem.substructures[0], "zmax"}, face(top, "zmin"), law)};
    const Modelled of(std::move(problem));
    const Vec k = search_directions(of.model, 1.0, 1);
    std::vector<double> found;
    for (const Point& point : of.model.exchange.points)
      for (int d = 0; d < 3; ++d)
        found.push_back(k[of.model.unknown(of.model.exchange.ports[point.first_port], d)] /
                        k[of.model.unknown(of.model.exchange.ports[point.first_port_2], d)]);
    EXPECT_FALSE(found.empty());
    return found;
  };
  for (const double ratio : ratios(bonded(), dynamic_step("test", 4, direction_dt, {})))
    EXPECT_NEAR(std::abs(std::log2(ratio)), 0.0, 1.01 / 32.0);
  const std::vector<double> of_contact = ratios(contact(0.3), dynamic_step("test", 4, direction_dt, {}));
  const std::vector<double> of_static = ratios(bonded(), static_step("test", 1, {}));
  for (const std::vector<double>& others : {of_contact, of_static})
    EXPECT_GT(*std::max_element(others.begin(), others.end()), 1.1);
}

TEST(StepSettings, follow_the_table_and_what_the_deck_says) {
  Problem problem = two_cubes(bonded(), {static_step("press", 1, {}), dynamic_step("shock", 30, direction_dt, {})});
  problem.solver = {};
  problem.solver.integration = IntegrationChoice::implicitly;
  {
    const Modelled of(problem, 0);
    const StepSettings settings = step_settings(of.problem, of.model, false);
    EXPECT_EQ(settings.tolerance, 1e-8);
    EXPECT_EQ(settings.window, 1);
    EXPECT_EQ(settings.of_increment.depth, 40);
    EXPECT_EQ(settings.of_increment.relaxation, 0.8);
    EXPECT_TRUE(settings.has_correction);
    EXPECT_NEAR(settings.assembly_size, std::sqrt(0.0001 + 0.0001 + 0.0004), 1e-15);
  }
  const Modelled of(problem, 1);
  const StepSettings settings = step_settings(of.problem, of.model, false);
  EXPECT_EQ(settings.tolerance, 1e-6);
  EXPECT_EQ(settings.of_increment.depth, 10);
  EXPECT_EQ(settings.of_increment.n_problems, 20);
  EXPECT_EQ(settings.of_increment.relaxation, 0.95);
  EXPECT_FALSE(settings.has_correction);  // a wave crosses a quarter of a cube in a step
  problem.solver.window = 0;
  problem.solver.more_iterations = 7;
  const StepSettings whole = step_settings(problem, of.model, true);
  EXPECT_EQ(whole.window, 30);
  EXPECT_EQ(whole.of_window.depth, 0);  // the paper's iteration
  EXPECT_EQ(whole.of_window.relaxation, 0.8);
  EXPECT_EQ(whole.more_iterations, 7);
  EXPECT_EQ(step_settings(problem, of.model, false).more_iterations, 0);  // nothing to go on from
  problem.solver.relaxation = 0.5;
  problem.solver.anderson = 3;
  EXPECT_EQ(step_settings(problem, of.model, false).of_window.relaxation, 0.5);
  EXPECT_EQ(step_settings(problem, of.model, false).of_increment.depth, 3);
}

// Three cubes side by side, tied, in a static step: the coarse correction must leave the velocities the answer to q,
// and the forces of the ties in balance for every rigid motion of every cube.
TEST(CoarseCorrection, brings_tie_forces_into_balance_and_stays_an_answer_of_the_linear_stage) {
  Problem problem = two_cubes(bonded(), {});
  const BlockPtr third = cube("third", 0, 0, 2),
                 lower = std::const_pointer_cast<Substructure>(problem.substructures[0]);
  problem.substructures.push_back(third);
  problem.interfaces.push_back(
      interface("above", Face{problem.substructures[1], "zmax"}, face(third, "zmin"), bonded()));
  problem.steps = {static_step("pull", 1, {number("traction", {face(third, "zmax")}, 1e7, 0)})};
  Modelled of(problem);
  StepModel& model = of.model;
  ASSERT_TRUE(needs_coarse_correction(model));
  start_step(model, of.state);
  const Vec k = search_directions(model, 1.0, 1);
  fix_search_directions(model, k);
  begin(model, of.state);
  CoarseCorrection coarse(model, k);
  ASSERT_FALSE(coarse.is_empty());
  Vec q = 1e3 * random_vector(model.n_q(), 1);
  Vec velocity = linear_stage(model, q);
  // Force of each cube on its ties, along a rigid motion of that cube and what the ties make of it elsewhere.
  const auto imbalance = [&] {
    double worst = 0.0, size = 0.0;
    for (int moving = 0; moving < 3; ++moving)
      for (int m = 0; m < 6; ++m) {
        double power = 0.0;
        for (const Point& point : model.exchange.points) {
          double k_side = 0.0, v_side = 0.0;
          for (int d = 0; d < 3; ++d) {
            k_side = v_side = 0.0;
            for (int p = point.first_port; p < point.first_port_2; ++p) {
              const Port& port = model.exchange.ports[p];
              const int i = model.unknown(port, d);
              k_side += k[i];
              if (port.piece != moving) continue;
              const Vec3 x =
                  of.problem.substructures[moving]->mesh->nodes.col(port.node) - Vec3(0.005, 0.005, 0.01 * moving);
              const Vec3 motion = m < 3 ? Vec3(Vec3::Unit(m)) : Vec3(Vec3::Unit(m - 3).cross(x) / 0.01);
              v_side += k[i] * motion.dot(point.frame.col(d));
            }
            for (int p = point.first_port; p < point.first_port_2; ++p) {
              const int i = model.unknown(model.exchange.ports[p], d);
              power += (q[i] - k[i] * velocity[i]) * v_side / k_side;
              size = std::max(size, std::abs(q[i] - k[i] * velocity[i]));
            }
          }
        }
        worst = std::max(worst, std::abs(power));
      }
    return worst / size;
  };
  const double before = imbalance();
  coarse.correct(q, velocity);
  EXPECT_GT(before, 0.1);
  EXPECT_LT(imbalance(), 1e-6 * before);
  EXPECT_LT((linear_stage(model, q) - velocity).norm(), 1e-9 * velocity.norm());
  const Vec balanced = q;
  coarse.correct(q, velocity);
  EXPECT_LT((q - balanced).norm(), 2e-6 * balanced.norm());  // 1.2e-6: rounding of the coarse system
}

TEST(CoarseCorrection, is_empty_where_nothing_is_tied) {
  Modelled of(two_cubes(contact(0.3), {static_step("press", 1, {})}));
  const Vec k = search_directions(of.model, 1.0, 1);
  fix_search_directions(of.model, k);
  EXPECT_TRUE(CoarseCorrection(of.model, k).is_empty());
}

Watcher run(Problem problem, int window) {
  problem.solver.window = window;
  Watcher recorder;
  solve(problem, recorder);
  return recorder;
}

// Tolerances far below what is compared: the order in which increments are iterated must not show.
TEST(Window, of_several_time_steps_is_the_same_as_one_by_one) {
  for (const bool is_massless : {false, true}) {
    Problem problem = two_cubes(contact(0.2), {});
    const Face top = top_of(problem);
    problem.solver.mass.is_moved_from_contact = is_massless;
    const StepPtr press = static_step("press", 1, {number("pressure", {top}, 50e6)});
    problem.steps = {press, dynamic_step("strike", 12, direction_dt,
                                         {load("pressure", {top}, History::constant(50e6)),
                                          load("traction", {top}, History::half_sine(60e6, 3e-6), 0)},
                                         press)};
    const Watcher single = run(problem, 1);
    EXPECT_GT(single.rows.back().energies.friction, 0.0);
    for (const int window : {4, 5}) {
      const Watcher several = run(problem, window);
      for (const Watcher::Row& row : several.rows) EXPECT_TRUE(row.converged) << window;
      EXPECT_LT(displacement_difference(several, single), 1e-8) << window;
      EXPECT_LT(velocity_difference(several, single), 1e-7) << window;
      const Energies &one = several.rows.back().energies, &other = single.rows.back().energies;
      EXPECT_NEAR(one.scheme, other.scheme, 1e-7 * other.loads) << window;
      EXPECT_NEAR(one.friction, other.friction, 1e-7 * other.loads) << window;
    }
  }
}

// A run that keeps its fields is a start for the same run: one iteration an increment confirms it.
TEST(Latin, from_its_own_fields_has_nothing_to_do) {
  Problem problem = two_cubes(contact(0.2), {});
  problem.steps = {
      dynamic_step("strike", 10, direction_dt, {load("pressure", {top_of(problem)}, History::half_sine(60e6, 3e-6))})};
  Watcher first, again;
  const SolverFigures kept = solve(problem, first);
  problem.solver.tolerance = 1e-9;
  const SolverFigures figures = solve(problem, again, kept.interface_fields.get());
  EXPECT_EQ(figures.steps[0].iterations, 10);
  EXPECT_GT(kept.steps[0].iterations, 30);
  EXPECT_LT(displacement_difference(again, first), 1e-8);
}

// The condensed interface and full solves are two ways to the same.
TEST(Latin, solved_in_full_is_the_same) {
  Problem problem = two_cubes(contact(0.2), {});
  problem.steps = {
      dynamic_step("strike", 10, direction_dt, {load("pressure", {top_of(problem)}, History::half_sine(60e6, 3e-6))})};
  Watcher condensed, full;
  solve(problem, condensed);
  problem.solver.plain = true;
  solve(problem, full);
  EXPECT_LT(displacement_difference(full, condensed), 1e-9);
}

// Equal meshes of one material that are damped otherwise must not share a factor.
TEST(Latin, damps_each_of_two_equal_blocks_by_its_own_material) {
  Problem problem = two_cubes(contact(0.0, 1e-3), {});
  problem.supports.clear();
  const std::array damping{2e4, 1e5};
  for (const int part : {0, 1}) {
    auto& block = const_cast<Substructure&>(*problem.substructures[part]);
    block.material.damping.mass = damping[part];
    block.velocity = Vec3(1.0, 0.0, 0.0);
    block.mesh = problem.substructures[0]->mesh;
    block.place = Vec3(0.0, 0.0, 0.01 * part);
  }
  problem.steps = {dynamic_step("fly", 10, direction_dt, {})};
  {
    const Modelled of(problem);
    ASSERT_EQ(of.bodies[0].matrices, of.bodies[1].matrices);
    EXPECT_FALSE(of.model.pieces[1]->shares_operator());
  }
  Watcher flight;
  solve(problem, flight);
  for (const int part : {0, 1}) {
    const double half = 0.5 * direction_dt * damping[part];
    EXPECT_NEAR(flight.rows.back().velocity[part](0, 0), std::pow((1.0 - half) / (1.0 + half), 10), 1e-9);
  }
}

}  // namespace
}  // namespace dygita
