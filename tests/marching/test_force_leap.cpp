// Newton's method on rounds over points that take turns.
#include <gtest/gtest.h>

#include <algorithm>

#include "marching/force_leap.hpp"

namespace dygita {
namespace {

// Forces that plain rounds need 100,000 rounds for.
TEST(ForceLeap, finds_what_rounds_creep_to) {
  const Vec rate = (Vec(3) << 0.99995, 0.3, 0.9).finished(), limit = (Vec(3) << -7.0, 2.0, 0.5).finished();
  int n = 0;
  const auto round = [&](const Vec& f) -> Vec {
    ++n;
    return limit + rate.cwiseProduct(f - limit);
  };
  Vec forces = Vec::Zero(3);
  for (int i = 0; i < 6; ++i) forces = leap(round(round(forces)), Vec::Ones(3), round);
  EXPECT_LE((forces - limit).norm(), 0.01 * limit.norm());
  EXPECT_LE(n, 100);
}

// A tie that no round closes pulls until a point opens: each round adds as much as the one before.
TEST(ForceLeap, goes_on_as_rounds_do_until_one_does_something_else) {
  constexpr double creep = 1e-5, opens = -0.8;
  int n = 0;
  const auto round = [&](const Vec& f) -> Vec {
    ++n;
    return (Vec(2) << std::max(f[0] - creep, opens), 3.0 + 0.5 * (f[1] - 3.0)).finished();
  };
  const Vec weight = (Vec(2) << 2.0, 1.0).finished();
  Vec forces = (Vec(2) << 0.0, 3.0).finished();
  for (int i = 0; i < 6; ++i) forces = leap(forces, weight, round);
  EXPECT_NEAR(forces[0], opens, creep);
  EXPECT_NEAR(forces[1], 3.0, creep);
  EXPECT_LT(n, 600);
}

TEST(ForceLeap, stays_where_nothing_changes_and_leaves_forces_without_weight) {
  const auto keep = [](const Vec& f) { return f; };
  const Vec forces = (Vec(2) << 1.0, -2.0).finished();
  EXPECT_EQ(leap(forces, Vec::Ones(2), keep), forces);
  const auto halve = [](const Vec& f) -> Vec { return (Vec(2) << 0.5 * f[0], f[1]).finished(); };
  const Vec there = leap(forces, (Vec(2) << 1.0, 0.0).finished(), halve);
  EXPECT_NEAR(there[0], 0.0, 1e-4);
  EXPECT_EQ(there[1], -2.0);
}

}  // namespace
}  // namespace dygita
