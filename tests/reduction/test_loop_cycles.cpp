// Condensed joints from loops that are known: Goodman's law, a spring with a dashpot, a spiral.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "reduction/loop_cycles.hpp"

namespace dygita::loop_cycles_tests {
namespace {

Table loop_of(const std::vector<double>& x, const std::vector<double>& f) {
  Table table{{"time", "displacement", "force"},
              {"s", "m", "N"},
              {std::vector<double>(x.size()), x, f},
              std::vector<int>(x.size(), 0)};
  for (size_t i = 0; i < x.size(); ++i) table.columns[0][i] = static_cast<double>(i);
  return table;
}

// Goodman's joint x = c F^2 by Masing's rule: growing cycles between -F and F, n rows a branch.
struct Goodman {
  std::vector<double> x{0.0}, f{0.0};
  void branch(double to, int n) {
    const double x_0 = x.back(), f_0 = f.back(), sign = to > f_0 ? 1.0 : -1.0;
    for (int i = 1; i <= n; ++i) {
      const double force = f_0 + (to - f_0) * i / n;
      // Beyond the largest force so far it is first loading again.
      double largest = 0.0;
      for (const double other : f) largest = std::max(largest, std::abs(other));
      const bool is_first = std::abs(force) >= largest;
      const double way = force - f_0;
      points.emplace_back(is_first ? sign * force * force : x_0 + 0.5 * sign * way * way, force);
    }
    for (const auto& [px, pf] : points) {
      x.push_back(px);
      f.push_back(pf);
    }
    points.clear();
  }
  std::vector<std::pair<double, double>> points;
};

TEST(LoopCycles, of_Goodmans_law_have_its_loss_exponents_and_sliders) {
  Goodman joint;
  for (int a = 1; a <= 5; ++a) {
    joint.branch(a, 200);
    joint.branch(-a, 200);
  }
  joint.branch(5.0, 200);
  const LoopSummary loop = summarise_loop(loop_of(joint.x, joint.f), 0);
  ASSERT_EQ(loop.cycles.n_rows(), 5);
  for (int i = 0; i < 5; ++i) {
    const double a = i + 1, loss = 4.0 / 3.0 * a * a * a;  // 2/3 F^3 / (EAq) with 1 / (2 EAq) = 1
    EXPECT_NEAR(loop.cycles.column("loss")[i], loss, 1e-3 * loss) << a;
    EXPECT_NEAR(loop.cycles.column("amplitude")[i], a * a, 1e-12);
    EXPECT_NEAR(loop.cycles.column("force_amplitude")[i], a, 2e-3 * a);
    EXPECT_NEAR(loop.cycles.column("masing_loss")[i], loss, 2e-3 * loss);
    EXPECT_NEAR(loop.cycles.column("loss_factor")[i], 4.0 / 3.0 / std::numbers::pi, 1e-2);
    EXPECT_NEAR(loop.cycles.column("end")[i], 1 / (2 * a), 0.02 / a);
  }
  EXPECT_TRUE(std::isnan(loop.cycles.column("exponent")[0]));
  EXPECT_NEAR(loop.cycles.column("exponent")[4], 3.0, 0.01);
  EXPECT_NEAR(loop.exponent, 3.0, 0.01);
  EXPECT_NEAR(loop.displacement_exponent, 1.5, 0.005);
  EXPECT_NEAR(loop.secant, 0.2, 1e-9);

  // Springs with sliders side by side have the curve again: each follows until its limit.
  const std::vector<double>&x = loop.backbone.column("displacement"), &f = loop.backbone.column("force");
  const std::vector<double>&k = loop.backbone.column("slider_stiffness"), &limit = loop.backbone.column("slider_force");
  double worst = 0.0;
  for (size_t i = 0; i < x.size(); ++i) {
    double force = 0.0;
    for (size_t j = 0; j < k.size(); ++j) force += std::min(k[j] * x[i], limit[j]);
    worst = std::max(worst, std::abs(force - f[i]));
  }
  EXPECT_EQ(x.front(), 0.0);
  EXPECT_LT(worst, 1e-9);
}

// A spring and a dashpot: loss pi c w a^2.
TEST(LoopCycles, of_a_dashpot_lose_with_the_square_and_count_each_cycle_once) {
  const double k = 3.0, c = 0.1;
  for (const double a : {1.0, 2.0}) {
    std::vector<double> x, f;
    for (int i = 0; i < 3 * 400; ++i) {
      const double phase = 2 * std::numbers::pi * i / 400.0;
      x.push_back(a * std::sin(phase));
      f.push_back(k * x.back() + c * a * std::cos(phase));
    }
    const LoopSummary loop = summarise_loop(loop_of(x, f), 0);
    ASSERT_EQ(loop.cycles.n_rows(), 2);  // the last is not whole
    EXPECT_NEAR(loop.cycles.column("loss")[0], std::numbers::pi * c * a * a, 1e-3);
    EXPECT_NEAR(loop.cycles.column("loss_factor")[1], c / k, 1e-3);
    EXPECT_NEAR(loop.cycles.column("amplitude")[0], a, 1e-12);
    EXPECT_NEAR(loop.cycles.column("mean")[0], 0.0, 1e-12);
    EXPECT_TRUE(std::isnan(loop.exponent));  // one amplitude has no exponent
  }
}

// Free vibration: x decays, cycles do not close. The loss is c times the square of the velocity, and a straight line
// closes.
TEST(LoopCycles, close_a_spiral_by_a_straight_line) {
  std::vector<double> x, f;
  const double decay = 0.01, k = 1.0;
  for (int i = 0; i < 4000; ++i) {
    const double phase = 2 * std::numbers::pi * i / 400.0, a = std::exp(-decay * phase);
    x.push_back(a * std::cos(phase));
    f.push_back(k * x.back() - 2 * decay * a * (std::sin(phase) + decay * std::cos(phase)));
  }
  const LoopSummary loop = summarise_loop(loop_of(x, f), 0);
  ASSERT_GE(loop.cycles.n_rows(), 7);
  for (int i = 0; i < 7; ++i) {
    const double a = loop.cycles.column("amplitude")[i];
    EXPECT_NEAR(loop.cycles.column("loss_factor")[i], 2 * decay, 0.03 * 2 * decay) << a;
  }
}

TEST(LoopCycles, of_one_pull_are_none_but_there_is_a_backbone_from_the_tightened_state_on) {
  const LoopSummary loop = summarise_loop(loop_of({0, 5, 6, 7, 8}, {0, 100, 110, 118, 124}), 1);
  EXPECT_EQ(loop.cycles.n_rows(), 0);
  EXPECT_TRUE(std::isnan(loop.exponent));
  EXPECT_EQ(loop.backbone.column("displacement"), (std::vector<double>{0, 1, 2, 3}));
  EXPECT_EQ(loop.backbone.column("force"), (std::vector<double>{0, 10, 18, 24}));
  EXPECT_EQ(loop.stiffness, 10.0);
  EXPECT_EQ(loop.secant, 8.0);
  EXPECT_EQ(summarise_loop(loop_of({0.0}, {0.0}), 0).cycles.n_rows(), 0);
  EXPECT_EQ(summarise_loop(loop_of({0, 0, 0}, {0, 0, 0}), 0).cycles.n_rows(), 0);
}

TEST(LoopCycles, have_both_sides_of_a_joint_that_opens_and_closes) {
  const LoopSummary loop = summarise_loop(loop_of({0, 1, 2, 0, -3, -6}, {0, 1, 2, 0, -30, -60}), 0);
  EXPECT_EQ(loop.backbone.column("displacement"), (std::vector<double>{-6, -3, 0, 1, 2}));
  EXPECT_EQ(loop.backbone.column("stiffness")[0], 10.0);
  EXPECT_EQ(loop.backbone.column("stiffness")[3], 1.0);
}

TEST(TurningPoints, leave_small_travels_out) {
  const std::vector<double> none(9, 0.0);
  EXPECT_EQ(turning_points({0, 1, 2, 1.9999, 3, 1, 0.5, 0.5001, -1}, none, 0), (std::vector<int>{0, 4, 8}));
  EXPECT_EQ(turning_points({9, 0, 1, 0}, none, 1), (std::vector<int>{1, 2, 3}));
}

// Gross sliding, stop, back: the joint sticks after the force has turned.
TEST(TurningPoints, are_where_the_force_turns_while_the_joint_sticks) {
  EXPECT_EQ(turning_points({0, 0, 1, 2, 2, 2, 2, 1, 0}, {0, 5, 5, 5, 2, 0, -5, -5, -5}, 0),
            (std::vector<int>{0, 3, 8}));
}

TEST(Decreasing, pools_what_rises) {
  EXPECT_EQ(decreasing({5, 3, 4, 1}, {1, 1, 1, 1}), (std::vector<double>{5, 3.5, 3.5, 1}));
  EXPECT_EQ(decreasing({1, 4}, {3, 1}), (std::vector<double>{1.75, 1.75}));
}

TEST(Exponent, is_that_of_a_power_and_nan_of_too_little) {
  EXPECT_NEAR(exponent_of({1, 2, 4}, {3, 3 * std::pow(2, 2.5), 3 * std::pow(4, 2.5)}), 2.5, 1e-12);
  EXPECT_TRUE(std::isnan(exponent_of({1, 1.01}, {1, 2})));
  EXPECT_TRUE(std::isnan(exponent_of({1, 2}, {0, 2})));
}

}  // namespace
}  // namespace dygita::loop_cycles_tests
