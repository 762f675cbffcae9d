// Blocks whose meshes do not match: constant stresses, impacts, bonds, in every solver.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/progress.hpp"
#include "marching/solve.hpp"
#include "reference/explicit.hpp"
#include "reference/monolithic.hpp"
#include "step/blocks.hpp"

namespace dygita::unlike_meshes_tests {
namespace {

constexpr double dt = 0.2e-6, side = 0.01;

Watcher run_latin(Problem problem, double tolerance = 1e-10) {
  problem.solver.tolerance = problem.solver.static_tolerance = tolerance;
  problem.solver.max_iterations = 1000;
  problem.solver.integration = IntegrationChoice::implicitly;
  Watcher recorder;
  solve(problem, recorder);
  for (const Watcher::Row& row : recorder.rows) EXPECT_TRUE(row.converged);
  return recorder;
}
Watcher run_monolithic(Problem problem) {
  problem.monolithic = MonolithicSettings{};
  problem.monolithic->tolerance = 1e-13;
  Watcher recorder;
  solve_monolithic(problem, recorder);
  return recorder;
}
Watcher run_explicit(Problem problem, double penalty) {
  problem.explicit_dynamics = ExplicitSettings{};
  problem.explicit_dynamics->penalty = penalty;
  problem.explicit_dynamics->one_point = problem.explicit_dynamics->bulk_viscosity = false;
  Watcher recorder;
  solve_explicit(problem, recorder);
  return recorder;
}

struct Pair {
  int lower, upper;
  bool reversed = false;
  Carrier points = Carrier::automatic;
};

// Two cubes, one on the other.
Problem stack(const Pair& cells, LawPtr law) {
  const BlockPtr lower = cube("lower", 0, 0, 0, cells.lower), upper = cube("upper", 0, 0, 1, cells.upper);
  auto joint = std::make_shared<Interface>();
  joint->name = "joint";
  joint->side_1 = cells.reversed ? face(upper, "zmin") : face(lower, "zmax");
  joint->side_2 = cells.reversed ? face(lower, "zmax") : face(upper, "zmin");
  joint->law = std::move(law);
  joint->points = cells.points;
  set_progress_enabled(false);
  Problem problem;
  problem.name = "stack";
  problem.substructures = {lower, upper};
  problem.interfaces = {joint};
  return problem;
}

Face face_of(const Problem& problem, int part, const char* group) {
  return {problem.substructures[static_cast<size_t>(part)], group};
}

// Held by three planes of symmetry, pressed on top and on the sides: the strain is the same everywhere.
Problem pressed(const Pair& cells, LawPtr law) {
  Problem problem = stack(cells, std::move(law));
  std::vector<FaceOrRegion> planes = {face_of(problem, 0, "zmin")};
  std::vector<Target> along_x, along_y;
  for (const int part : {0, 1}) {
    planes.emplace_back(face_of(problem, part, "xmin"));
    planes.emplace_back(face_of(problem, part, "ymin"));
    along_x.emplace_back(face_of(problem, part, "xmax"));
    along_y.emplace_back(face_of(problem, part, "ymax"));
  }
  problem.supports = {support("symmetry", planes)};
  problem.steps = {static_step("press", 1,
                               {number("pressure", along_x, 30e6), number("pressure", along_y, 20e6),
                                number("pressure", {face_of(problem, 1, "zmax")}, 50e6)})};
  return problem;
}

double patch_error(const Problem& problem, const Watcher& run) {
  const Elastic& m = problem.substructures[0]->material;
  const Vec3 stress(-30e6, -20e6, -50e6);
  double worst = 0.0, size = 0.0;
  for (size_t part = 0; part < 2; ++part) {
    const Points& x = problem.substructures[part]->mesh->nodes;
    for (Eigen::Index i = 0; i < x.cols(); ++i)
      for (int d = 0; d < 3; ++d) {
        const double strain = (stress[d] - *m.constant("poisson") * (stress.sum() - stress[d])) / m.young();
        worst = std::max(worst, std::abs(run.rows.back().displacement[part](d, i) - strain * x(d, i)));
        size = std::max(size, std::abs(strain * x(d, i)));
      }
  }
  return worst / size;
}

TEST(UnlikeMeshes, a_constant_stress_passes) {
  for (const Pair& cells : {Pair{2, 3}, Pair{3, 2}, Pair{4, 3, true}, Pair{2, 5}, Pair{3, 5, false, Carrier::second}})
    for (const bool is_bonded : {false, true}) {
      SCOPED_TRACE(testing::Message() << cells.lower << ':' << cells.upper << (is_bonded ? " bonded" : " contact"));
      const Problem problem = pressed(cells, is_bonded ? bonded() : contact(0.0));
      EXPECT_LT(patch_error(problem, run_monolithic(problem)), 1e-10);
      // With more points than nodes of a side the iteration is slow: what the coarser side is chosen for.
      if (cells.points == Carrier::automatic) {
        EXPECT_LT(patch_error(problem, run_latin(problem, 1e-12)), 1e-10);
      }
    }
}

// In balance it stays so in a dynamic step; pressures are those of the stress at every point.
TEST(UnlikeMeshes, at_rest_stay_at_rest) {
  for (const bool is_bonded : {false, true}) {
    Problem problem = pressed({2, 3}, is_bonded ? bonded() : contact(0.3));
    const std::shared_ptr<const Step> press = problem.steps[0];
    std::vector<LoadPtr> loads = press->loads;
    problem.steps.push_back(dynamic_step("rest", 20, dt, loads, press));
    for (const Watcher& run : {run_latin(problem, 1e-12), run_monolithic(problem)}) {
      EXPECT_LT(patch_error(problem, run), 1e-9);
      const std::vector<LawState>& points = run.rows.back().surfaces[0].points;
      double force = 0.0;
      for (const LawState& point : points) force -= point.force[2];
      EXPECT_NEAR(force, 50e6 * side * side, 1e-6 * force);
    }
  }
}

std::vector<StepPtr> press_and_strike(const Problem& of, int n) {
  const Face top = face_of(of, 1, "zmax");
  const StepPtr press = static_step("press", 2, {number("pressure", {top}, 50e6)});
  return {press, dynamic_step("strike", n, dt,
                              {load("pressure", {top}, History::constant(50e6)),
                               load("traction", {top}, History::half_sine(60e6, 8e-6), 0)},
                              press)};
}

void expect_that_both_agree(LawPtr law, const Pair& cells) {
  Problem problem = stack(cells, std::move(law));
  problem.supports = {support("fixed", {face_of(problem, 0, "zmin")})};
  problem.steps = press_and_strike(problem, 15);
  const Watcher latin = run_latin(problem), whole = run_monolithic(problem);
  EXPECT_LT(displacement_difference(latin, whole), 1e-6);
  EXPECT_LT(velocity_difference(latin, whole), 1e-5);
  const Energies &one = latin.rows.back().energies, &other = whole.rows.back().energies;
  EXPECT_NEAR(one.kinetic + one.strain, other.kinetic + other.strain, 1e-5 * (other.kinetic + other.strain));
  EXPECT_NEAR(one.friction, other.friction, 1e-4 * other.loads);
  EXPECT_NEAR(one.plastic, other.plastic, 1e-4 * other.loads);
  EXPECT_NEAR(other.balance(), 0.0, 1e-9 * other.loads);
  EXPECT_NEAR(one.balance(), 0.0, 1e-9 * other.loads);
}

TEST(UnlikeMeshes, bonded_are_the_same_in_latin_and_as_a_whole) { expect_that_both_agree(bonded(), {2, 3}); }
TEST(UnlikeMeshes, that_slide_are_the_same_in_latin_and_as_a_whole) { expect_that_both_agree(contact(0.2), {3, 2}); }
TEST(UnlikeMeshes, that_yield_are_the_same_in_latin_and_as_a_whole) {
  expect_that_both_agree(plastic(30e6, 1e12, true), {2, 3, true});
}

// An edge of the interface on a support that moves: what that brings to the rows is known.
TEST(UnlikeMeshes, on_a_moving_support_are_the_same_in_latin_and_as_a_whole) {
  Problem problem = stack({2, 3}, bonded());
  const StepPtr shake = dynamic_step(
      "shake", 30, dt,
      {load("velocity", {face_of(problem, 0, "xmin"), face_of(problem, 1, "xmin")}, History::half_sine(5.0, 4e-6), 0)});
  problem.steps = {shake};
  const Watcher latin = run_latin(problem), whole = run_monolithic(problem);
  EXPECT_LT(displacement_difference(latin, whole), 1e-7);
  EXPECT_LT(velocity_difference(latin, whole), 1e-6);
  for (const Watcher* run : {&latin, &whole}) {
    const Energies& e = run->rows.back().energies;
    EXPECT_GT(e.loads, 0.0);
    EXPECT_NEAR(e.balance(), 0.0, 1e-9 * e.loads);
  }
}

TEST(UnlikeMeshes, cut_into_pieces_are_those_in_one) {
  Problem problem = stack({6, 8}, contact(0.2));
  problem.supports = {support("fixed", {face_of(problem, 0, "zmin")})};
  problem.steps = press_and_strike(problem, 5);
  problem.solver.pieces = 1;
  const Watcher whole = run_latin(problem);
  problem.solver.pieces = 4;
  const std::vector<Surface> surfaces = make_surfaces(problem);
  EXPECT_GT(make_cut(problem, surfaces)->n_pieces(1), 1);
  const Watcher cut = run_latin(problem);
  EXPECT_LT(displacement_difference(cut, whole), 1e-6);
}

struct Impact {
  double highest = 0.0, momentum = 0.0, iterations = 0.0, left = 0.0;  // over what there was at the start
};

// Nothing holds the blocks: the upper one comes down at an angle.
Impact impact(const Pair& cells, double ratio = 1.0) {
  Problem problem = stack(cells, contact(0.3));
  auto upper = std::const_pointer_cast<Substructure>(problem.substructures[1]);
  upper->velocity = {2.0, 1.0, -10.0};
  const Elastic& of_both = upper->material;
  upper->material = Elastic(of_both.name, of_both.young() / ratio, *of_both.constant("poisson"), of_both.density);
  problem.steps = {dynamic_step("hit", 40, 0.5e-6, {})};
  problem.solver.integration = IntegrationChoice::implicitly;
  problem.solver.tolerance = 1e-6;
  Watcher run;
  solve(problem, run);
  Impact found;
  const double start = 0.5 * 7800.0 * 1e-6 * 105.0;
  double count = 0.0;
  for (const Watcher::Row& row : run.rows) {
    EXPECT_TRUE(row.converged);
    const Energies& e = row.energies;
    found.highest = std::max(found.highest, (e.kinetic + e.strain + e.friction) / start);
    found.iterations += row.iterations;
    count += 1.0;
  }
  found.iterations /= count;
  found.left = (run.rows.back().energies.kinetic + run.rows.back().energies.strain) / start;
  Modelled model(problem);
  Vec3 momentum = Vec3::Zero();
  for (int part = 0; part < 2; ++part)
    momentum += run.rows.back().velocity[static_cast<size_t>(part)] *
                model.model.pieces[static_cast<size_t>(model.cut->first(part))]->node_masses();
  const Vec3 given = 7800.0 * 1e-6 * upper->velocity;
  found.momentum = (momentum - given).norm() / given.norm();
  return found;
}

TEST(UnlikeMeshes, that_meet_get_no_energy_and_keep_their_momentum) {
  const Impact matching = impact({5, 5});
  double at_ratio = 0.0;  // 3:5
  for (const auto& [cells, ratio] :
       {std::pair{Pair{3, 5}, 1.0}, std::pair{Pair{3, 5, true}, 50.0}, std::pair{Pair{5, 3}, 50.0},
        std::pair{Pair{1, 5}, 1.0}, std::pair{Pair{5, 1}, 1.0}}) {
    const Impact unlike = impact(cells, ratio);
    std::printf(
        "%d:%d%s, moduli %g: energy at most %.9f of the start, %.3f left; momentum %.1e; %.1f iterations (5:5 %.1f)\n",
        cells.lower, cells.upper, cells.reversed ? " reversed" : "", ratio, unlike.highest, unlike.left,
        unlike.momentum, unlike.iterations, matching.iterations);
    EXPECT_LT(unlike.highest, 1.0 + 1e-9);
    EXPECT_LT(unlike.momentum, 1e-5);
    if (at_ratio == 0.0) at_ratio = unlike.iterations;
  }
  EXPECT_LT(at_ratio, 1.3 * matching.iterations);
}

// Three blocks tied along a line are tied once too often: a point there is left out.
TEST(UnlikeMeshes, of_three_blocks_tied_along_a_line_need_no_more_iterations) {
  const auto iterations = [](const std::array<int, 3>& n) {
    Problem problem;
    problem.name = "three";
    const BlockPtr below = block("below", {0, 0, 0}, {0.02, 0.01, 0.01}, {2 * n[0], n[0], n[0]}),
                   left = cube("left", 0, 0, 1, n[1]), right = cube("right", 1, 0, 1, n[2]);
    problem.substructures = {below, left, right};
    problem.interfaces = {interface("a", face(below, "zmax"), face(left, "zmin"), bonded()),
                          interface("b", face(below, "zmax"), face(right, "zmin"), bonded()),
                          interface("c", face(left, "xmax"), face(right, "xmin"), bonded())};
    problem.supports = {support("fixed", {face(below, "zmin")})};
    problem.steps = {static_step("press", 1,
                                 {number("pressure", {face(left, "zmax"), face(right, "zmax")}, 50e6),
                                  number("traction", {face(left, "zmax"), face(right, "zmax")}, 30e6, 0)})};
    const Watcher run = run_latin(problem, 1e-8);
    return run.rows.back().iterations;
  };
  const int unlike = iterations({4, 5, 6});
  std::printf("three tied blocks: %d iterations; matching %d\n", unlike, iterations({4, 4, 4}));
  EXPECT_LT(unlike, 60);
}

// As near as the same springs get where the meshes match.
TEST(UnlikeMeshes, explicit_comes_as_near_to_the_monolithic_solution_as_matching_ones) {
  const auto apart = [](const Pair& cells, double penalty) {
    Problem problem = stack(cells, contact(0.2));
    problem.supports = {support("fixed", {face_of(problem, 0, "zmin")})};
    problem.steps = {dynamic_step("strike", 96, 0.06e-6,
                                  {load("pressure", {face_of(problem, 1, "zmax")}, History::half_sine(100e6, 8e-6))})};
    const Watcher explicit_run = run_explicit(problem, penalty), whole = run_monolithic(problem);
    const Points &one = explicit_run.rows.back().displacement[1], &other = whole.rows.back().displacement[1];
    return (one - other).norm() / other.norm();
  };
  for (const double penalty : {0.1, 10.0}) {
    const double unlike = apart({2, 3}, penalty), reversed = apart({3, 2}, penalty), matching = apart({3, 3}, penalty);
    std::printf("explicit from monolithic, penalty %g: %.3f, %.3f; matching %.3f\n", penalty, unlike, reversed,
                matching);
    EXPECT_LT(std::max(unlike, reversed), 1.5 * matching + 0.01);
  }
}

TEST(UnlikeMeshes, explicit_ties_by_stiff_springs) {
  Problem problem = stack({2, 3}, bonded());
  problem.supports = {support("fixed", {face_of(problem, 0, "zmin")})};
  problem.steps = {dynamic_step("strike", 96, 0.06e-6,
                                {load("pressure", {face_of(problem, 1, "zmax")}, History::half_sine(100e6, 8e-6))})};
  const Watcher whole = run_monolithic(problem);
  double before = 1.0;
  for (const double penalty : {1.0, 10.0, 100.0}) {
    const Points one = run_explicit(problem, penalty).rows.back().displacement[1],
                 other = whole.rows.back().displacement[1];
    const double apart = (one - other).norm() / other.norm();
    std::printf("explicit tie, penalty %g: %.4f from monolithic\n", penalty, apart);
    EXPECT_LT(apart, before);
    before = 0.5 * apart;
  }
  EXPECT_LT(before, 0.02);
}

}  // namespace
}  // namespace dygita::unlike_meshes_tests
