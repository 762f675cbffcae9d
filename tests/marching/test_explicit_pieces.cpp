// Explicit pieces in LATIN's steps: against implicit ones, alone and mixed; balances; the limit of stability.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "base/team.hpp"
#include "law/law.hpp"
#include "marching/solve.hpp"
#include "pieces/central_differences.hpp"
#include "pieces/longest_step.hpp"
#include "step/blocks.hpp"

namespace dygita {
namespace {

using enum IntegrationChoice;

Problem hit_cubes(LawPtr law, double dt, IntegrationChoice lower, IntegrationChoice upper, int n_steps = 0) {
  const double duration = 6e-6;
  Problem problem =
      two_cubes(std::move(law),
                {dynamic_step("hit", n_steps > 0 ? n_steps : static_cast<int>(std::lround(duration / dt)), dt, {})}, 3);
  problem.solver.mass = {};  // lumped, explicit and implicit: what is left is the error of time
  auto step = std::make_shared<Step>(*problem.steps[0]);
  step->loads = {load("traction", {top_of(problem)}, History::half_sine(-8e7, 3e-6), 2),
                 load("traction", {top_of(problem)}, History::half_sine(3e7, 4e-6), 0)};
  problem.steps = {step};
  const auto with = [&](int i, IntegrationChoice choice) {
    auto part = std::make_shared<Substructure>(*problem.substructures[i]);
    part->integration = choice;
    return part;
  };
  const auto one = with(0, lower), two = with(1, upper);
  problem.substructures = {one, two};
  problem.supports = {support("fixed", {Face{one, "zmin"}}), support("absorbing", {Face{two, "ymax"}})};
  auto between = std::make_shared<Interface>(*problem.interfaces[0]);
  between->side_1.part = one;
  between->side_2.part = two;
  problem.interfaces = {between};
  step->loads = {load("traction", {Face{two, "zmax"}}, History::half_sine(-8e7, 3e-6), 2),
                 load("traction", {Face{two, "zmax"}}, History::half_sine(3e7, 4e-6), 0)};
  return problem;
}

Watcher solved(const Problem& problem) {
  Watcher recorder;
  const SolverFigures figures = solve(problem, recorder);
  EXPECT_EQ(figures.steps.at(0).not_converged, 0);
  return recorder;
}

double imbalance(const Watcher& recorder) {
  double worst = 0.0, size = 0.0;
  for (const Watcher::Row& row : recorder.rows) {
    worst = std::max(worst, std::abs(row.energies.balance()));
    size = std::max(size, row.energies.loads);
  }
  return worst / size;
}

double last_difference(const Watcher& one, const Watcher& other) {
  double apart = 0.0, size = 0.0;
  for (size_t part = 0; part < one.rows.back().displacement.size(); ++part) {
    const Points &a = one.rows.back().displacement[part], &b = other.rows.back().displacement[part];
    apart = std::max(apart, (a - b).cwiseAbs().maxCoeff());
    size = std::max(size, b.cwiseAbs().maxCoeff());
  }
  return apart / size;
}

TEST(ExplicitPieces, alone_and_mixed_converge_to_what_implicit_ones_give) {
  for (const LawPtr& law : {contact(0.3), bonded(), plastic(3e7, 1e10)}) {
    const Watcher finest = solved(hit_cubes(law, 1e-8, implicitly, implicitly));
    for (const auto& [lower, upper] :
         {std::pair{explicitly, explicitly}, {implicitly, explicitly}, {explicitly, implicitly}}) {
      double before = 1.0;
      for (const double dt : {2e-7, 1e-7, 5e-8}) {
        const Watcher run = solved(hit_cubes(law, dt, lower, upper));
        const double error = last_difference(run, finest);
        std::cout << law->word() << " dt " << dt << ": " << 100 * error << " %, imbalance " << imbalance(run)
                  << ", iterations " << run.rows.back().iterations << "\n";
        EXPECT_LT(error, before);
        EXPECT_LT(imbalance(run), lower == explicitly && upper == explicitly ? 1e-12 : 1e-9);
        before = error;
      }
      EXPECT_LT(before, 0.01);
    }
  }
}

// A time step of the deck in several increments, against as many time steps.
TEST(ExplicitPieces, forces_and_reactions_are_means_over_the_time_step_of_the_deck) {
  for (const auto& [lower, upper] : {std::pair{explicitly, explicitly}, {implicitly, explicitly}}) {
    const Problem problem = hit_cubes(contact(0.3), 2e-6, lower, upper);
    const int n = Modelled(problem).model.n_substeps();
    ASSERT_GT(n, 2);
    const Watcher coarse = solved(problem), fine = solved(hit_cubes(contact(0.3), 2e-6 / n, lower, upper));
    ASSERT_EQ(fine.rows.size(), n * coarse.rows.size());
    const double exact = lower == upper ? 1e-9 : 1e-6;
    for (size_t i = 0; i < coarse.rows.size(); ++i) {
      const Watcher::Row& row = coarse.rows[i];
      const Watcher::Row& last = fine.rows[(i + 1) * n - 1];
      Points reactions = Points::Zero(3, row.reactions[0].cols());
      for (size_t p = 0; p < row.surfaces[0].points.size(); ++p) {
        Vec3 mean = Vec3::Zero();
        for (int j = 0; j < n; ++j) mean += fine.rows[i * n + j].surfaces[0].points[p].force / n;
        EXPECT_LT((row.surfaces[0].points[p].force - mean).norm(), exact * 1e3);
        EXPECT_NEAR(row.surfaces[0].points[p].gap, last.surfaces[0].points[p].gap, exact * 1e-6);
      }
      for (int j = 0; j < n; ++j) reactions += fine.rows[i * n + j].reactions[0] / n;
      EXPECT_LT((row.reactions[0] - reactions).cwiseAbs().maxCoeff(), exact * 1e3);
      if (i > 1) {
        EXPECT_GT(reactions.cwiseAbs().maxCoeff(), 1.0);
      }
      EXPECT_LT((row.displacement[1] - last.displacement[1]).cwiseAbs().maxCoeff(), exact * 1e-5);
      EXPECT_NEAR(row.energies.kinetic, last.energies.kinetic, exact * 1e-1);
      EXPECT_NEAR(row.energies.friction, last.energies.friction, exact * 1e-1);
    }
    EXPECT_EQ(coarse.rows.back().time, 6e-6);
  }
}

// A free cube with random velocities, at a part of its longest stable step.
double growth(double part_of_longest, bool is_tuned = false, double beta = 0.0, CellType cell = CellType::hex8) {
  Problem problem = hit_cubes(contact(0.0), 1e-7, explicitly, explicitly);
  auto part = std::make_shared<Substructure>(*problem.substructures[0]);
  part->material.damping.stiffness = beta;
  problem.substructures[0] = part;
  if (cell != CellType::hex8) {  // alone: the other cube is of linear cells
    part->mesh = box_mesh(Vec3::Zero(), Vec3::Constant(10e-3), {2, 2, 2}, cell);
    problem.substructures = {part};
    problem.interfaces.clear();
    problem.supports.clear();
    auto step = std::make_shared<Step>(*problem.steps[0]);
    step->loads.clear();
    problem.steps = {step};
  }
  if (!problem.supports.empty()) problem.supports.erase(problem.supports.begin());
  if (!problem.interfaces.empty()) {
    auto between = std::make_shared<Interface>(*problem.interfaces[0]);
    between->side_1.part = part;
    problem.interfaces = {between};
  }
  Modelled modelled(problem);
  PieceSetup setup;
  setup.body = &modelled.bodies[0];
  const Body& body = modelled.bodies[0];
  if (is_tuned) setup.tuned_speed = tuned_wave_speed(*body.part, {});
  const double longest = is_tuned ? longest_tuned_step(body, {}, setup.tuned_speed) : longest_explicit_step(body, {});
  setup.scheme = TimeScheme::implicit(part_of_longest * longest);
  setup.keeps_lumped.assign(static_cast<size_t>(setup.n_nodes()), 0);
  setup.what = "cube";
  CentralDifferences piece(setup, std::make_shared<const ExplicitOperator>(setup));
  const int n = setup.n_nodes();
  Points zero = Points::Zero(3, n), v(3, n);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (double& value : v.reshaped()) value = uniform(random);
  piece.set_state(zero, v, zero, zero);
  piece.set_loads(zero, {});
  const IncrementEnergy before = piece.stored_energy();
  for (int i = 0; i < 5000; ++i) {
    piece.begin(std::vector<double>{}, {});
    piece.finish(Vec(0), nullptr);
  }
  const IncrementEnergy after = piece.stored_energy();
  return (after.kinetic + after.strain) / (before.kinetic + before.strain);
}

TEST(ExplicitPieces, are_stable_up_to_the_longest_step_and_not_beyond) {
  EXPECT_NEAR(growth(0.5), 1.0, 1e-11);
  EXPECT_NEAR(growth(0.98), 1.0, 1e-10);
  EXPECT_FALSE(growth(1.01) < 1e3);
}

TEST(ExplicitPieces, with_tuned_mass_too) {
  EXPECT_NEAR(growth(0.5, true), 1.0, 1e-11);
  EXPECT_NEAR(growth(0.98, true), 1.0, 1e-10);
  EXPECT_FALSE(growth(1.01, true) < 1e3);
}

// With the diagonal mass of cells of order two. Of tetrahedra and prisms, which have no symmetry, entries in single
// precision make a matrix that is symmetric to 3e-8 alone.
TEST(ExplicitPieces, of_order_two_too) {
  for (const CellType cell :
       {CellType::tet10, CellType::hex20, CellType::hex27, CellType::prism15, CellType::prism18}) {
    const double exact = cell_shape(cell).n_corners == 8 ? 1e-10 : 1e-6;
    EXPECT_NEAR(growth(0.98, false, 0.0, cell), 1.0, exact) << cell_shape(cell).name;
    EXPECT_FALSE(growth(1.01, false, 0.0, cell) < 1e3) << cell_shape(cell).name;
    EXPECT_LT(growth(0.98, false, 1e-8, cell), 0.5) << cell_shape(cell).name;
  }
}

// What stiffness damping takes is never negative in all, and its limit is its own (manual, eq. S14).
TEST(ExplicitPieces, with_stiffness_damping_too) {
  for (const double beta : {1e-9, 1e-8, 1e-7}) {
    for (const bool is_tuned : {false, true}) {
      EXPECT_LT(growth(0.5, is_tuned, beta), 0.5) << beta;
      EXPECT_LT(growth(0.98, is_tuned, beta), 0.5) << beta;
      EXPECT_FALSE(growth(1.01, is_tuned, beta) < 1e3) << beta;
    }
  }
}

// At the limit itself: ties, friction, walls and non-reflecting supports do not shorten it.
TEST(ExplicitPieces, are_stable_there_with_friction_ties_and_supports) {
  for (const LawPtr& law : {contact(0.5), bonded()}) {
    const Problem any = hit_cubes(law, 1e-7, explicitly, explicitly);
    Modelled modelled(any);
    double limit = 1.0;
    for (const Integration::Part& part : modelled.model.integration.parts) limit = std::min(limit, part.longest);
    const Watcher run = solved(hit_cubes(law, limit, explicitly, explicitly, 4000));
    EXPECT_EQ(run.rows.back().iterations, 1);
    EXPECT_LT(imbalance(run), 1e-11);
    EXPECT_LT(run.rows.back().energies.kinetic + run.rows.back().energies.strain, run.rows.back().energies.loads);
  }
}

// Three cubes in a corner of two rough walls, nodes under several laws, one of them on a non-reflecting support.
Problem corner(IntegrationChoice choice, double dt, int pieces = 1, int n = 3) {
  Problem problem;
  problem.name = "corner";
  const BlockPtr low = cube("low", 0, 0, 0, n), middle = cube("middle", 0, 0, 1, n), top = cube("top", 0, 0, 2, n);
  for (const BlockPtr& part : {low, middle, top}) part->integration = choice;
  problem.substructures = {low, middle, top};
  problem.interfaces = {interface("rubs", face(low, "zmax"), face(middle, "zmin"), contact(0.3)),
                        interface("tied", face(middle, "zmax"), face(top, "zmin"), bonded())};
  problem.supports = {
      support("wall", {face(low, "zmin"), face(low, "xmin"), face(middle, "xmin")}, {{"friction", 0.2}, {"gap", 0.0}}),
      support("absorbing", {face(middle, "ymax")})};
  problem.steps = {dynamic_step("hit", static_cast<int>(std::lround(6e-6 / dt)), dt,
                                {load("traction", {face(top, "zmax")}, History::half_sine(-1e8, 4e-6), 2),
                                 load("traction", {face(top, "zmax")}, History::half_sine(-5e7, 3e-6), 0)})};
  problem.solver.tolerance = 1e-11;
  problem.solver.mass = {};
  problem.solver.pieces = pieces;
  return problem;
}

TEST(ExplicitPieces, take_turns_where_points_share_nodes) {
  const Watcher finest = solved(corner(implicitly, 1e-8));
  double before = 1.0;
  for (const double dt : {2e-7, 1e-7, 5e-8}) {
    const Watcher run = solved(corner(explicitly, dt));
    const double error = last_difference(run, finest);
    std::cout << "dt " << dt << ": " << 100 * error << " %, imbalance " << imbalance(run) << "\n";
    EXPECT_LT(error, 0.5 * before);
    EXPECT_LT(imbalance(run), 1e-11);
    EXPECT_GT(run.rows.back().energies.friction, 0.0);
    before = error;
  }
  EXPECT_LT(before, 0.01);
}

// Some nodes, in an order of their own, against the whole fields.
struct SomeNodes : Observer {
  double apart = 0.0, size = 0.0;

  void begin_step(const Instant&) override {}
  void accept(const Instant& instant) override {
    for (int part = 0; part < static_cast<int>(instant.model.problem->substructures.size()); ++part) {
      std::vector<int> nodes;
      for (int node = instant.displacement(part).cols() - 1; node >= 0; node -= 2) nodes.push_back(node);
      compare(instant.displacement(part, nodes), instant.displacement(part), nodes);
      compare(instant.velocity(part, nodes), instant.velocity(part), nodes);
      compare(instant.acceleration(part, nodes), instant.acceleration(part), nodes);
    }
  }
  void compare(const Points& some, const Points& whole, const std::vector<int>& nodes) {
    const double largest = whole.cwiseAbs().maxCoeff();
    apart = std::max(apart, (some - whole(Eigen::all, nodes)).cwiseAbs().maxCoeff() / (largest > 0.0 ? largest : 1.0));
    size = std::max(size, largest);
  }
};

// One face is held still, another is moved.
TEST(FieldsOfAPiece, at_some_nodes_are_those_of_all) {
  for (const IntegrationChoice choice : {implicitly, explicitly})
    for (const int pieces : {1, 3}) {
      Problem problem = corner(choice, 1e-7, pieces);
      const SubstructurePtr low = problem.substructures[0], top = problem.substructures[2];
      problem.supports.push_back(support("fixed", {Face{top, "xmax"}}));
      auto hit = std::make_shared<Step>(*problem.steps[0]);
      hit->loads.push_back(load("velocity", {Face{low, "ymax"}}, History::half_sine(1.0, 4e-6), 1));
      problem.steps = {hit};
      SomeNodes watcher;
      solve(problem, watcher);
      EXPECT_GT(watcher.size, 0.0);
      EXPECT_LT(watcher.apart, 1e-12);
    }
}

// The stiffness of each piece has no moment in a turn of that piece: its entries are rounded otherwise than those of
// the whole.
TEST(ExplicitPieces, that_are_cut_are_the_uncut_ones) {
  constexpr double rounding = 2e-7;
  const Watcher whole = solved(corner(explicitly, 1e-7)), cut = solved(corner(explicitly, 1e-7, 3));
  EXPECT_LT(displacement_difference(cut, whole), rounding);
  EXPECT_LT(velocity_difference(cut, whole), rounding);
  EXPECT_LT(imbalance(cut), 1e-11);
}

TEST(ExplicitPieces, give_the_same_bits_on_any_number_of_threads) {
  const int before = thread_limit();
  set_thread_limit(1);
  const Watcher one = solved(corner(explicitly, 2e-7, 2, 12));
  set_thread_limit(3);
  const Watcher three = solved(corner(explicitly, 2e-7, 2, 12));
  set_thread_limit(before);
  EXPECT_EQ(displacement_difference(one, three), 0.0);
  EXPECT_EQ(one.rows.back().energies.friction, three.rows.back().energies.friction);
  EXPECT_EQ(one.rows.back().energies.scheme, three.rows.back().energies.scheme);
}

TEST(ExplicitPieces, that_end_an_increment_and_begin_the_next_at_once_give_the_same_bits) {
  Problem problem = hit_cubes(contact(0.3), 2e-7, explicitly, explicitly);
  const Watcher at_once = solved(problem);
  problem.solver.plain = true;
  const Watcher one_by_one = solved(problem);
  EXPECT_EQ(last_difference(at_once, one_by_one), 0.0);
  EXPECT_EQ(at_once.rows.back().energies.balance(), one_by_one.rows.back().energies.balance());
}

// Tightened, then left alone: what the static step has left stays at rest.
TEST(ExplicitPieces, rest_where_a_static_step_has_left_them_in_balance) {
  for (const LawPtr& law : {plastic(1e9), contact(0.3)}) {
    auto press = static_step("press", 1, {});
    Problem problem = hit_cubes(law, 1e-7, explicitly, explicitly);
    const SubstructurePtr upper = problem.substructures[1];
    problem.supports.pop_back();
    press->loads = {number("pressure", {Face{upper, "zmax"}}, 3e7)};
    auto rest = dynamic_step("rest", 50, 1e-7, {number("pressure", {Face{upper, "zmax"}}, 3e7)}, press);
    problem.steps = {press, rest};
    const Watcher run = solved(problem);
    EXPECT_LT((run.rows.back().displacement[1] - run.rows.front().displacement[1]).norm(),
              1e-7 * run.rows.front().displacement[1].norm());
    EXPECT_GT(run.rows.front().displacement[1].norm(), 1e-7);
    EXPECT_LT(run.rows.back().energies.kinetic, 1e-12 * run.rows.back().energies.strain);
  }
}

// A base that shakes: nodes held by a moving support, in contact on top of it.
TEST(ExplicitPieces, follow_a_moving_support_and_book_its_work) {
  const auto shaken = [&](IntegrationChoice choice, double dt) {
    Problem problem = hit_cubes(contact(0.3), dt, choice, choice);
    auto step = std::make_shared<Step>(*problem.steps[0]);
    step->loads = {load("velocity", {Face{problem.substructures[0], "zmin"}}, History::haversine(5.0, 4e-6), 2)};
    problem.steps = {step};
    problem.supports.erase(problem.supports.begin());
    return solved(problem);
  };
  const Watcher finest = shaken(implicitly, 1e-8), run = shaken(explicitly, 5e-8);
  EXPECT_LT(last_difference(run, finest), 0.01);
  EXPECT_LT(imbalance(run), 1e-11);
  EXPECT_GT(run.rows.back().energies.loads, 0.0);
}

}  // namespace
}  // namespace dygita
