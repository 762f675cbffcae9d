// The local stage: every law through two sides of one node each, against its closed form; image and indicator.
#include <gtest/gtest.h>

#include <cmath>

#include "base/progress.hpp"
#include "latin/local_stage.hpp"
#include "step/blocks.hpp"

namespace dygita {
namespace {

constexpr double local_dt = 0.5e-6;

// A point of the local stage as its user sees it: data, velocities and image of both sides, in the point's frame.
struct Sides {
  Vec3 k_1, k_2, q_1, q_2, v_1, v_2, image_1, image_2;

  Vec3 r_1() const { return 2.0 * v_1 - q_1.cwiseQuotient(k_1); }
  Vec3 r_2() const { return 2.0 * v_2 - q_2.cwiseQuotient(k_2); }
  Vec3 s() const { return r_2() - r_1(); }
  Vec3 y() const { return k_1.cwiseInverse() + k_2.cwiseInverse(); }
  // Of an image F_hat + k W_hat with W_hat = r + F_hat/k: on side 1 as it is, on side 2 with the other sign.
  Vec3 force_1() const { return 0.5 * (image_1 - k_1.cwiseProduct(r_1())); }
  Vec3 force_2() const { return 0.5 * (image_2 - k_2.cwiseProduct(r_2())); }
  Vec3 rate() const { return (r_2() + force_2().cwiseQuotient(k_2)) - (r_1() + force_1().cwiseQuotient(k_1)); }
};

// One local stage between two cubes of one cell, at data of about `force` newtons.
struct Stage {
  Modelled of;
  Vec k, q, velocity, image;
  std::unique_ptr<LocalStage> local;
  IndicatorSums sums;

  explicit Stage(Problem problem, double force = 1e3, double pressing = 0.0) : of(std::move(problem)) {
    const int n = of.model.n_q();
    start_step(of.model, of.state);
    k = 1e3 * (2.0 + random_vector(n, 1).array()).matrix();
    q = force * random_vector(n, 2);
    velocity = 1e-3 * force * random_vector(n, 3);
    for (const Point& point : of.model.exchange.points)
      for (int p = point.first_port; p < point.end_port; ++p)
        if (const int i = of.model.unknown(of.model.exchange.ports[p], 0); i >= 0)
          velocity[i] += (p < point.first_port_2 ? 0.5 : -0.5) * pressing;
    local = std::make_unique<LocalStage>(of.model, of.state, k);
    for (const auto& piece : of.model.pieces) piece->set_search_directions(Vec::Ones(piece->n_rows()));
    begin(0);
    run();
  }
  void begin(int increment) { local->begin(increment, of.model.motion_velocities(increment), true); }
  void run() { sums = local->run(velocity, q, image); }

  const Point& point(int i) const { return of.model.exchange.points[i]; }
  int n_points() const { return static_cast<int>(of.model.exchange.points.size()); }
  Sides sides(int i) const {
    const auto of_port = [&](const Vec& all, int p) {
      Vec3 values = Vec3::Ones();  // where there is no unknown: no force and no rate between the sides
      for (int d = 0; d < 3; ++d)
        if (const int at = of.model.unknown(of.model.exchange.ports[p], d); at >= 0) values[d] = all[at];
      return values;
    };
    const int p = point(i).first_port, p_2 = point(i).first_port_2;
    return {of_port(k, p),        of_port(k, p_2),        of_port(q, p),     of_port(q, p_2),
            of_port(velocity, p), of_port(velocity, p_2), of_port(image, p), of_port(image, p_2)};
  }
};

Problem problem_of(LawPtr law, bool is_static = false, std::vector<LoadPtr> loads = {}) {
  Problem problem = two_cubes(std::move(law), {}, 1);
  problem.steps = {is_static ? static_step("test", 2, std::move(loads))
                             : dynamic_step("test", 10, local_dt, std::move(loads))};
  return problem;
}
// Loads on the interface between the cubes.
Problem loaded(LawPtr law, bool is_static, const char* kind, double value) {
  Problem problem = problem_of(std::move(law), is_static);
  auto step = std::make_shared<Step>(*problem.steps[0]);
  step->loads = {number(kind, {problem.interfaces[0]}, value)};
  problem.steps = {step};
  return problem;
}

void expect_near(const Vec3& found, const Vec3& expected, double tolerance) {
  EXPECT_LT((found - expected).norm(), tolerance) << found.transpose() << " instead of " << expected.transpose();
}

TEST(LocalStage, of_a_shortened_tie_closes_the_jump_and_the_shortening) {
  const double d = 3e-7;  // m, half of it in the first of two increments
  const Stage stage(loaded(bonded(), true, "shortening", d));
  ASSERT_EQ(stage.n_points(), 4);
  for (int i = 0; i < 4; ++i) {
    const Sides s = stage.sides(i);
    expect_near(s.force_1(), -s.force_2(), 1e-9);
    expect_near(s.rate(), Vec3(-0.5 * d, 0.0, 0.0), 1e-15);  // a static rate is an increment
    expect_near(s.force_1(), (s.s() + Vec3(0.5 * d, 0.0, 0.0)).cwiseQuotient(s.y()), 1e-9);
  }
}

TEST(LocalStage, of_a_contact_that_opens_has_no_force) {
  const Stage stage(problem_of(contact(0.3)), 1e3, -20.0);
  for (int i = 0; i < 4; ++i) {
    const Sides s = stage.sides(i);
    EXPECT_GT(s.s()[0], 0.0);
    expect_near(s.force_1(), Vec3::Zero(), 1e-9);
    expect_near(s.force_2(), Vec3::Zero(), 1e-9);
  }
}

TEST(LocalStage, of_a_closed_contact_sticks_or_slides_at_the_limit_of_friction) {
  for (const double friction : {0.005, 10.0}) {
    const Stage stage(problem_of(contact(friction)), 1e3, 20.0);
    for (int i = 0; i < 4; ++i) {
      const Sides s = stage.sides(i);
      const Vec3 force = s.force_1(), rate = s.rate();
      expect_near(s.force_2(), -force, 1e-9);
      EXPECT_LT(s.s()[0], 0.0);
      EXPECT_NEAR(force[0], s.s()[0] / s.y()[0], 1e-9);
      EXPECT_NEAR(rate[0], 0.0, 1e-12);
      const double limit = friction * std::abs(force[0]);
      if (friction > 1.0) {
        EXPECT_LT(force.tail<2>().norm(), limit);
        EXPECT_LT(rate.tail<2>().norm(), 1e-12);
      } else {  // against the motion of side 1 in side 2, with the force that the slip asks for
        EXPECT_NEAR(force.tail<2>().norm(), limit, 1e-9);
        EXPECT_GT(rate.tail<2>().norm(), 1e-3);
        EXPECT_NEAR(rate[1] * force[2] - rate[2] * force[1], 0.0, 1e-9 * limit);
        EXPECT_GT(rate.tail<2>().dot(force.tail<2>()), 0.0);
      }
    }
  }
}

TEST(LocalStage, of_a_contact_with_a_gap_lets_it_close_and_no_more) {
  const double gap = 1e-6;
  const Stage slow(problem_of(contact(0.0, gap)), 0.0, 1.0), fast(problem_of(contact(0.0, gap)), 0.0, 10.0);
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(slow.sides(i).force_1()[0], 0.0, 1e-12);  // 2 m/s x 0.5 us is the gap, just
    EXPECT_NEAR(fast.sides(i).rate()[0], -gap / local_dt, 1e-12);
    EXPECT_LT(fast.sides(i).force_1()[0], 0.0);
  }
}

TEST(LocalStage, of_a_plastic_interface_carries_its_yield_and_opens) {
  const double yield = 20e6, area = 1e-4 / 4.0;
  const Stage stage(problem_of(plastic(yield)), 1e3, -20.0);
  for (int i = 0; i < 4; ++i) {
    const Sides s = stage.sides(i);
    EXPECT_NEAR(stage.point(i).area, area, 1e-18);
    EXPECT_NEAR(s.force_1()[0], std::min(yield * area, s.s()[0] / s.y()[0]), 1e-9);
    EXPECT_NEAR(s.force_1()[0], yield * area, 1e-9);
    EXPECT_GT(s.rate()[0], 0.0);
    expect_near(Vec3(0.0, s.rate()[1], s.rate()[2]), Vec3::Zero(), 1e-12);  // bonded along its tangents
  }
}

TEST(LocalStage, of_a_released_interface_has_no_force) {
  Problem problem = problem_of(bonded());
  auto step = std::make_shared<Step>(*problem.steps[0]);
  step->loads = {load("release", {problem.interfaces[0]}, History::constant(0.0))};
  problem.steps = {step};
  const Stage stage(problem);
  for (int i = 0; i < 4; ++i) expect_near(stage.sides(i).force_1(), Vec3::Zero(), 1e-9);
}

TEST(LocalStage, measures_the_distance_between_both_stages) {
  const Stage stage(problem_of(contact(0.2)), 1e3, 3.0);
  IndicatorSums expected;
  for (int i = 0; i < 4; ++i) {
    const Sides s = stage.sides(i);
    const auto add = [&](const Vec3& k, const Vec3& q, const Vec3& v, const Vec3& r, const Vec3& f_hat) {
      for (int d = 0; d < 3; ++d) {
        const double f = q[d] - k[d] * v[d], w_hat = r[d] + f_hat[d] / k[d];
        expected.force_distance += std::pow(f - f_hat[d], 2) / k[d];
        expected.velocity_distance += k[d] * std::pow(v[d] - w_hat, 2);
        expected.force_size += 0.5 * (f * f + f_hat[d] * f_hat[d]) / k[d];
        expected.velocity_size += 0.5 * k[d] * (v[d] * v[d] + w_hat * w_hat);
      }
    };
    add(s.k_1, s.q_1, s.v_1, s.r_1(), s.force_1());
    add(s.k_2, s.q_2, s.v_2, s.r_2(), s.force_2());
  }
  EXPECT_NEAR(stage.sums.force_distance, expected.force_distance, 1e-10 * expected.force_distance);
  EXPECT_NEAR(stage.sums.velocity_distance, expected.velocity_distance, 1e-10 * expected.velocity_distance);
  EXPECT_NEAR(stage.sums.force_size, expected.force_size, 1e-10 * expected.force_size);
  EXPECT_NEAR(stage.sums.velocity_size, expected.velocity_size, 1e-10 * expected.velocity_size);
}

// F = F_hat and V = W_hat: nothing is left to iterate, and q is its own image.
TEST(LocalStage, of_its_own_answer_is_that_answer) {
  Stage stage(problem_of(contact(0.2)), 1e3, 20.0);
  const Vec answer = stage.image;
  for (int i = 0; i < stage.n_points(); ++i) {
    const Sides s = stage.sides(i);
    const auto put = [&](int p, const Vec3& w_hat) {
      for (int d = 0; d < 3; ++d)
        stage.velocity[stage.of.model.unknown(stage.of.model.exchange.ports[p], d)] = w_hat[d];
    };
    put(stage.point(i).first_port, s.r_1() + s.force_1().cwiseQuotient(s.k_1));
    put(stage.point(i).first_port_2, s.r_2() + s.force_2().cwiseQuotient(s.k_2));
  }
  stage.q = answer;
  stage.run();
  EXPECT_LT((stage.image - answer).norm(), 1e-12 * answer.norm());
  EXPECT_LT(stage.sums.force_distance, 1e-20 * stage.sums.force_size);
  EXPECT_LT(stage.sums.velocity_distance, 1e-20 * stage.sums.velocity_size);
}

TEST(LocalStage, shows_the_accepted_forces_on_the_surface_and_starts_from_them) {
  Stage stage(problem_of(contact(0.02)), 1e3, 20.0);
  std::vector<IncrementEnergy> energy(stage.of.model.pieces.size());
  stage.local->accept(stage.of.state, energy);
  const SurfaceState& shown = stage.of.state.surfaces[0];
  Vec3 sum = Vec3::Zero(), expected = Vec3::Zero();
  double work = 0.0;  // J, of friction while the rate rises from zero
  for (int i = 0; i < 4; ++i) {
    work += 0.5 * local_dt * stage.sides(i).force_1().tail<2>().dot(stage.sides(i).rate().tail<2>());
    sum += shown.points[i].force;
    expected += stage.point(i).frame * stage.sides(i).force_1();
    EXPECT_GT(shown.residual[i], 0.0);
  }
  expect_near(sum, expected, 1e-9);
  EXPECT_GT(work, 1e-9);  // some of it slides
  EXPECT_NEAR(energy[0].friction, work, 1e-9 * work);
  EXPECT_EQ(energy[1].friction, 0.0);  // booked with one of both
  // q = F_hat + k W_hat of the end, where the state's velocity is W_hat only for what has been solved.
  const LocalStage again(stage.of.model, stage.of.state, stage.k);
  const Vec q = again.initial_q();
  for (int i = 0; i < 4; ++i) {
    const Point& point = stage.point(i);
    for (int d = 0; d < 3; ++d) {
      const Port& port = stage.of.model.exchange.ports[point.first_port];
      EXPECT_NEAR(q[stage.of.model.unknown(port, d)], stage.sides(i).force_1()[d], 1e-9);
    }
  }
}

// A copy is all that windows need to go back.
TEST(LocalStage, copied_gives_the_same_bits_once_more) {
  Stage stage(problem_of(plastic(20e6, 1e13)), 1e3, -20.0);
  const LocalStage before = *stage.local;
  std::vector<Vec> images;
  const auto steps = [&] {
    for (int i = 1; i < 4; ++i) {
      stage.begin(i);
      stage.run();
      stage.local->accept();
      images.push_back(stage.image);
    }
  };
  steps();
  *stage.local = before;
  steps();
  for (int i = 0; i < 3; ++i) EXPECT_EQ(images[i], images[3 + i]);
  EXPECT_NE(images[0], images[1]);
}

// A preload is the shortening that brings its force through all points together.
TEST(LocalStage, of_a_preload_finds_the_shortening_of_its_force) {
  const Stage stage(loaded(bonded(), true, "preload", 8e3));
  const PreloadFigures figures = stage.local->preload_figures();
  ASSERT_EQ(figures.force.size(), 1);
  EXPECT_NEAR(figures.target[0], 4e3, 1e-9);  // half way
  EXPECT_NEAR(figures.force[0], 4e3, 1e-8);
  double stiffness = 0.0;
  for (int i = 0; i < 4; ++i) {
    const Sides s = stage.sides(i);
    EXPECT_NEAR(s.rate()[0], -figures.shortening[0], 1e-12 * std::abs(figures.shortening[0]) + 1e-15);
    stiffness += 1.0 / s.y()[0];
  }
  EXPECT_NEAR(figures.stiffest[0], stiffness, 1e-9 * stiffness);
}

// A wall: side 2 rests, and all the search direction is the block's.
TEST(LocalStage, at_a_wall_stops_the_block) {
  Problem problem;
  problem.solver.integration = IntegrationChoice::implicitly;
  const BlockPtr alone = cube("alone", 0, 0, 0, 1);
  problem.substructures = {alone};
  problem.supports = {support("wall", {face(alone, "zmin")}, {{"friction", 0.0}, {"gap", 0.0}})};
  problem.steps = {dynamic_step("test", 1, local_dt, {})};
  set_progress_enabled(false);
  Modelled of(problem);
  start_step(of.model, of.state);
  const int n = of.model.n_q();
  ASSERT_EQ(n, 4);  // without friction the normals alone
  const Vec k = Vec::Constant(n, 1e3), q = 100.0 * random_vector(n, 1);
  LocalStage local(of.model, of.state, k);
  local.begin(0, {}, true);
  Vec velocity(n), image;
  velocity << 1.0, -1.0, 2.0, -2.0;
  local.run(velocity, q, image);
  for (const Point& point : of.model.exchange.points) {
    const int i = of.model.unknown(of.model.exchange.ports[point.first_port], 0);
    const double r = 2.0 * velocity[i] - q[i] / k[i];  // N points out of the block, into the wall
    const double force = std::min(-r * k[i], 0.0);
    EXPECT_NEAR(image[i], 2.0 * force + k[i] * r, 1e-9);
  }
}

}  // namespace
}  // namespace dygita
