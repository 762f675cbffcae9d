// Members of an ensemble over what the first of them has made: to the bit what each is by itself.
#include <gtest/gtest.h>

#include "latin/coarse_correction.hpp"
#include "law/law.hpp"
#include "marching/solve.hpp"
#include "step/blocks.hpp"

namespace dygita {
namespace {

struct Numbers {
  double friction = 0.2, clamp = 2e7, peak = 3e7, shift = 0.0;
};

// Pressed, held aside by a motion, and hit.
std::vector<StepPtr> steps_of(const Problem& problem, const BlockPtr& top, const Numbers& numbers, double dt) {
  const auto press = static_step("press", 2, {number("pressure", {Face{top, "zmax"}}, numbers.clamp)});
  const auto hit = dynamic_step("hit", 12, dt,
                                {number("pressure", {Face{top, "zmax"}}, numbers.clamp),
                                 load("traction", {Face{top, "zmax"}}, History::half_sine(numbers.peak, 8.0 * dt))},
                                press);
  if (numbers.shift != 0.0)
    hit->loads.push_back(load("displacement", {Face{problem.substructures[0], "zmin"}},
                              History::half_sine(numbers.shift, 10.0 * dt), 1));
  return {press, hit};
}

Problem pressed_cubes(const Numbers& numbers, int n = 3) {
  Problem problem = two_cubes(contact(numbers.friction), {}, n);
  const BlockPtr top = std::const_pointer_cast<Substructure>(problem.substructures[1]);
  problem.steps = steps_of(problem, top, numbers, 2e-7);
  problem.solver.tolerance = 1e-6;
  problem.solver.static_tolerance = 1e-8;
  return problem;
}

struct Member {
  Watcher rows;
  SolverFigures figures;
};

Member run(const Problem& problem, SharedOperators* shared) {
  Member member;
  member.figures = solve(problem, member.rows, {}, nullptr, {{}, shared});
  for (const StepFigures& step : member.figures.steps) EXPECT_EQ(step.not_converged, 0);
  return member;
}

void expect_same_bits(const Member& one, const Member& other) {
  EXPECT_EQ(displacement_difference(one.rows, other.rows), 0.0);
  EXPECT_EQ(velocity_difference(one.rows, other.rows), 0.0);
  for (size_t i = 0; i < one.figures.steps.size(); ++i)
    EXPECT_EQ(one.figures.steps[i].iterations, other.figures.steps[i].iterations);
}

// Three members one after the other, each once more alone. Equal: of the pieces of all steps, those of a member that
// have their operator from the first. Do they share a coarse correction of the first step?
template <class Make>
bool expect_members_alone(Make&& make, int n_equal) {
  SharedOperators shared;
  int i = 0;
  for (const Numbers& numbers : {Numbers{0.2, 2e7, 3e7}, Numbers{0.1, 3e7, 5e7}, Numbers{0.4, 1e7, 1e7}}) {
    const Problem problem = make(numbers);
    const Member together = run(problem, &shared), alone = run(problem, nullptr);
    expect_same_bits(together, alone);
    if (i++ > 0) {
      EXPECT_EQ(together.figures.n_equal, n_equal);
    }
  }
  const std::shared_ptr<const CoarseCorrection> coarse = shared.coarse_of_step(0);
  return coarse && !coarse->is_empty();
}

TEST(SharedOperators, leave_each_member_as_it_is_alone) {
  expect_members_alone([](const Numbers& numbers) { return pressed_cubes(numbers); }, 4);
}

TEST(SharedOperators, leave_members_their_own_velocities) {
  expect_members_alone(
      [](const Numbers& numbers) {
        Problem problem = pressed_cubes(numbers);
        for (const SubstructurePtr& part : problem.substructures)
          std::const_pointer_cast<Substructure>(part)->velocity = Vec3(0.0, 0.0, -1e-7 * numbers.peak);
        return problem;
      },
      4);
}

TEST(SharedOperators, leave_members_with_cut_parts_as_they_are_alone) {
  const bool share_a_correction = expect_members_alone(
      [](const Numbers& numbers) {
        Problem problem = pressed_cubes(numbers, 4);
        problem.solver.pieces = 2;
        return problem;
      },
      8);
  EXPECT_TRUE(share_a_correction);
}

TEST(SharedOperators, leave_members_with_moving_supports_as_they_are_alone) {
  expect_members_alone(
      [](Numbers numbers) {
        numbers.shift = numbers.friction * 1e-5;
        Problem problem = pressed_cubes(numbers);
        for (const StepPtr& step : problem.steps)
          std::const_pointer_cast<Step>(step)->supports =
              step->is_static ? problem.supports : std::vector<SupportPtr>();
        return problem;
      },
      4);
}

TEST(SharedOperators, leave_explicit_and_mixed_members_as_they_are_alone) {
  for (const bool is_mixed : {false, true})
    expect_members_alone(
        [&](const Numbers& numbers) {
          Problem problem = pressed_cubes(numbers);
          for (SubstructurePtr& part : problem.substructures) {
            auto own = std::make_shared<Substructure>(*part);
            own->integration =
                is_mixed && part->name == "upper" ? IntegrationChoice::implicitly : IntegrationChoice::explicitly;
            part = own;
          }
          const auto between = std::make_shared<Interface>(*problem.interfaces[0]);
          between->side_1.part = problem.substructures[0];
          between->side_2.part = problem.substructures[1];
          problem.interfaces = {between};
          problem.supports = {support("fixed", {Face{problem.substructures[0], "zmin"}})};
          const auto top = std::const_pointer_cast<Substructure>(problem.substructures[1]);
          problem.steps = steps_of(problem, top, numbers, 1e-7);
          return problem;
        },
        is_mixed ? 3 : 2);
}

// A plate that is interface on both sides is solved in full.
TEST(SharedOperators, leave_members_with_pieces_solved_in_full_as_they_are_alone) {
  SharedOperators shared;
  const auto make = [](const Numbers& numbers) {
    Problem problem = pressed_cubes(numbers, 2);
    const Vec3 size(0.01, 0.01, 0.001);
    const BlockPtr lower = block("lower", Vec3::Zero(), Vec3(0.01, 0.01, 0.01), {14, 14, 2}),
                   plate = block("plate", Vec3(0, 0, 0.01), size, {14, 14, 1}),
                   upper = block("upper", Vec3(0, 0, 0.011), Vec3(0.01, 0.01, 0.01), {14, 14, 2});
    problem.substructures = {lower, plate, upper};
    problem.interfaces = {interface("below", face(lower, "zmax"), face(plate, "zmin"), contact(numbers.friction)),
                          interface("above", face(plate, "zmax"), face(upper, "zmin"), contact(numbers.friction))};
    problem.supports = {support("fixed", {face(lower, "zmin")})};
    problem.steps = steps_of(problem, upper, numbers, 2e-7);
    return problem;
  };
  for (const double friction : {0.2, 0.3}) {
    const Problem problem = make({friction, 2e7, 1e7});
    const Member together = run(problem, &shared), alone = run(problem, nullptr);
    EXPECT_GT(alone.figures.n_in_full, 0);
    expect_same_bits(together, alone);
    EXPECT_LT(together.figures.factor_bytes, friction == 0.3 ? 0.5 * alone.figures.factor_bytes : INFINITY);
  }
}

// Search directions of static steps follow the springs of laws: who has others makes operators of its own there.
TEST(SharedOperators, serve_no_static_step_whose_laws_have_other_springs) {
  const auto make = [](double stiffness) {
    Problem problem = pressed_cubes({});
    problem.interfaces = {interface("between", Face{problem.substructures[0], "zmax"},
                                    Face{problem.substructures[1], "zmin"},
                                    make_law("bushing", {{"normal", stiffness},
                                                         {"tangential", stiffness},
                                                         {"normal_damping", 0.0},
                                                         {"tangential_damping", 0.0},
                                                         {"loss", 0.0},
                                                         {"frequency", 0.0}}))};
    return problem;
  };
  SharedOperators shared;
  run(make(1e12), &shared);
  const Member same = run(make(1e12), &shared), other = run(make(3e12), &shared);
  EXPECT_EQ(same.figures.n_equal, 4);
  EXPECT_EQ(other.figures.n_equal, 2);
  expect_same_bits(other, run(make(3e12), nullptr));
}

// The plain path shares nothing but the bodies, and is the same to the tolerance.
TEST(SharedOperators, give_what_the_plain_path_gives) {
  SharedOperators shared, plain;
  for (const double friction : {0.2, 0.3}) {
    Problem problem = pressed_cubes({friction, 2e7, 3e7});
    problem.solver.tolerance = problem.solver.static_tolerance = 1e-11;
    const Member condensed = run(problem, &shared);
    problem.solver.plain = true;
    const Member full = run(problem, &plain);
    EXPECT_EQ(full.figures.n_equal, 0);
    EXPECT_LT(displacement_difference(condensed.rows, full.rows), 1e-8);
  }
}

TEST(SharedOperators, serve_no_run_whose_mass_moves_elsewhere) {
  Problem problem = pressed_cubes({});
  problem.solver.mass.is_moved_from_contact = true;
  SharedOperators shared;
  run(problem, &shared);
  EXPECT_TRUE(shared.serve(problem, make_surfaces(problem)));
  problem.interfaces = {interface("between", Face{problem.substructures[0], "zmax"},
                                  Face{problem.substructures[1], "zmin"}, plastic(1e9))};
  EXPECT_FALSE(shared.serve(problem, make_surfaces(problem)));
  expect_same_bits(run(problem, &shared), run(problem, nullptr));
}

TEST(SharedOperators, are_kept_where_twice_as_much_is_left) {
  EXPECT_TRUE(leave_room(1e9, 2e9));
  EXPECT_FALSE(leave_room(1.01e9, 2e9));
  EXPECT_TRUE(leave_room(1e9, 0.0));  // the machine does not tell
}

}  // namespace
}  // namespace dygita
