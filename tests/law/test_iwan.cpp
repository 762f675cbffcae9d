// Iwan's sliders against Segalman's closed forms: backbone, loss of small cycles, Masing's rule, in any direction.
#include <cmath>
#include <numbers>
#include <random>

#include "law/law_checks.hpp"

namespace dygita {
namespace {

constexpr double patch = 1e-4;

struct Joint {
  double slip = 1e6, stiffness = 2e11, chi = -0.5, beta = 0.2;

  double shape() const { return beta + (chi + 1) / (chi + 2); }
  double longest() const { return slip * (1 + beta) / (stiffness * shape()); }
  double density() const { return slip * (chi + 1) / (std::pow(longest(), chi + 2) * shape()); }
  // Pa, of a first motion u (m).
  double backbone(double u) const {
    if (u >= longest()) return slip;
    return stiffness * u - density() * std::pow(u, chi + 2) / ((chi + 1) * (chi + 2));
  }
  // J/m^2 a cycle of this amplitude (m), below macroslip.
  double loss(double u) const { return 4 * density() * std::pow(u, chi + 3) / ((chi + 2) * (chi + 3)); }
  LawPtr law(int sliders) const {
    return make_law("iwan", {{"slip", slip},
                             {"stiffness", stiffness},
                             {"chi", chi},
                             {"beta", beta},
                             {"sliders", static_cast<double>(sliders)}});
  }
};

// A point moved along its tangents as it is told.
struct Moved {
  LawPtr law;
  LawState state = law->initial();
  double friction = 0.0, stored = 0.0, given = 0.0;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();

  Eigen::Vector2d to(const Eigen::Vector2d& next) {
    Trial t = trial({0.0, next[0] - place[0], next[1] - place[1]}, {1e-8, 0.0, 0.0});
    t.is_given = {false, true, true};
    const LawState end = law->advance(t, static_step, state, law->force(t, static_step, state));
    const Work work = law->work(state, end, static_step, patch);
    friction += work.friction;
    stored += work.stored;
    given += work.given;
    state = end;
    place = next;
    return end.force.tail<2>();
  }
};

TEST(Iwan, has_segalmans_backbone) {
  for (const double chi : {-0.8, -0.5, -0.1})
    for (const double beta : {0.0, 0.2, 3.0}) {
      const Joint joint{.chi = chi, .beta = beta};
      double before = 1.0;
      for (const int n : {10, 30, 90}) {
        Moved point{joint.law(n)};
        double error = 0.0;
        for (int i = 1; i <= 300; ++i) {
          const double u = 1.2 * joint.longest() * i / 300;
          const double force = point.to({u, 0.0})[0];
          error = std::max(error, std::abs(force / patch - joint.backbone(u)) / joint.slip);
          EXPECT_LE(force, patch * joint.slip * (1 + 1e-12));
        }
        EXPECT_LT(error, 0.3 * before) << chi << " " << beta << " " << n;
        EXPECT_NEAR(point.state.force[1], patch * joint.slip, 1e-12 * patch * joint.slip);
        EXPECT_EQ(point.state.status, PointState::slip);
        before = error;
      }
      EXPECT_LT(before, 2.5e-3);
      const Vec3 tangent = joint.law(10)->tangent(joint.law(10)->initial(), true).stiffness;
      EXPECT_EQ(tangent, Vec3(0.0, joint.stiffness, joint.stiffness));
      Moved small{joint.law(30)};
      const double u = 0.01 * joint.longest();
      EXPECT_NEAR(small.to({u, 0.0})[0], patch * joint.backbone(u), 0.02 * patch * joint.backbone(u));
    }
}

// The loss of a cycle grows with the power 3 + chi of its amplitude, over two decades.
TEST(Iwan, loses_by_segalmans_power_law) {
  for (const double chi : {-0.8, -0.5, -0.1}) {
    const Joint joint{.chi = chi};
    for (const double share : {0.5, 0.05, 0.005}) {
      const double u = share * joint.longest();
      Moved point{joint.law(60)};
      const auto sweep = [&](double from, double to) {
        for (int i = 1; i <= 400; ++i) point.to({from + (to - from) * i / 400, 0.0});
      };
      sweep(0, u);
      const double first = point.friction, first_stored = point.stored;
      sweep(u, -u), sweep(-u, u);
      EXPECT_NEAR(point.friction - first, patch * joint.loss(u), 0.015 * patch * joint.loss(u)) << chi << " " << share;
      EXPECT_NEAR(point.stored, first_stored, 1e-10 * first_stored);
    }
  }
}

TEST(Iwan, turns_round_as_masing_has_it) {
  const Joint joint;
  const double u = 0.6 * joint.longest();
  Moved first{joint.law(24)}, point{joint.law(24)};
  const double top = point.to({u, 0.0})[0];
  for (int i = 1; i <= 50; ++i) {
    const double back = 2 * u * i / 50, force = point.to({u - back, 0.0})[0];
    EXPECT_NEAR(force, top - 2 * first.to({back / 2, 0.0})[0], 1e-12 * top);
  }
}

// What the law answers solves rate + Y F = s, whatever the search directions, and its work is that of the force.
TEST(Iwan, solves_its_problem_and_closes_its_books) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  const Joint joint;
  const LawPtr law = joint.law(24);
  for (const Increment& increment : {dynamic_step, Increment{TimeScheme::weighted(1e-6, 0.4)}, static_step}) {
    LawState state = law->initial();
    const double dt = increment.dt, u = joint.longest();
    for (int i = 0; i < 300; ++i) {
      const double scale = u / dt * std::pow(10.0, 1.5 * any(random));
      Trial t = trial(scale * Vec3(any(random), any(random), any(random)));
      for (int d = 0; d < 3; ++d) t.y[d] = u / dt / (patch * joint.slip) * std::pow(10.0, 2.0 * any(random));
      if (increment.is_static) state.rate.setZero();
      const Vec3 force = law->force(t, increment, state);
      const LawState end = law->advance(t, increment, state, force);
      Vec3 first = Vec3::Zero(), last = Vec3::Zero();
      for (int m = 0; m < end.memory.n_vectors(); ++m) {
        first += patch * state.memory.vector(m);
        last += patch * end.memory.vector(m);
      }
      EXPECT_LT((force - increment.mean(first, last)).tail<2>().norm(), 1e-9 * patch * joint.slip);
      EXPECT_LE(last.norm(), patch * joint.slip * (1 + 1e-12));
      const Work work = law->work(state, end, increment, patch);
      const Vec3 motion = motion_of(state, end, increment);
      const double done = working_force(state, end, increment).tail<2>().dot(motion.tail<2>());
      EXPECT_GE(work.friction, -1e-12 * std::abs(done));
      if (increment.is_static || !increment.dissipates()) {
        EXPECT_NEAR(work.friction + work.stored - work.given, done, 1e-8 * (std::abs(done) + work.friction));
      }
      state = end;
    }
  }
}

TEST(Iwan, is_the_same_in_any_direction) {
  const Joint joint;
  const double u = joint.longest(), angle = 0.7;
  const Eigen::Rotation2Dd turn(angle);
  Moved one{joint.law(12)}, other{joint.law(12)};
  for (const Eigen::Vector2d& to : {Eigen::Vector2d(0.4 * u, 0), Eigen::Vector2d(0.3 * u, 0.5 * u),
                                    Eigen::Vector2d(-0.2 * u, 0.1 * u), Eigen::Vector2d(-2 * u, 2 * u)}) {
    const Eigen::Vector2d force = one.to(to), turned = other.to(turn * to);
    EXPECT_LT((turn * force - turned).norm(), 1e-12 * patch * joint.slip);
  }
  EXPECT_NEAR(one.friction, other.friction, 1e-12 * one.friction);
  EXPECT_NEAR(one.state.force.tail<2>().norm(), patch * joint.slip, 1e-3 * patch * joint.slip);
}

// Springs of explicit steps slide as the law does.
TEST(Iwan, comes_to_the_same_in_explicit_steps) {
  const Joint joint;
  const LawPtr law = joint.law(24);
  const double u = 0.7 * joint.longest();
  SpringPoint point = spring_point(*law, law->initial(), patch, 1e9);
  Moved exact{law};
  for (const double to : {u, -u, 0.3 * u})
    for (int i = 1; i <= 100; ++i) {
      const double from = exact.place[0], step = (to - from) / (101 - i);
      exact.to({from + step, 0.0});
      move_to(*law, {0.0, from + step, 0.0}, point);
    }
  EXPECT_NEAR(point.now.force[1], exact.state.force[1], 1e-10 * patch * joint.slip);
  EXPECT_NEAR(point.friction_work, exact.friction, 0.01 * exact.friction);
  EXPECT_NEAR(law->explicit_form().springs->stored_energy(point.now, patch), exact.stored, 1e-10 * exact.friction);
}

}  // namespace
}  // namespace dygita
