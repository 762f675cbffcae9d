// The local stage as the linear one sees it: how the forces of the laws answer to the velocities (manual, eq. U1-U3).
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "numerics/types.hpp"

namespace dygita {

// Of one point of the exchange: F = F_hat - matrix (V - W_hat) on its unknowns in the assembled q, port by port (N s/m;
// static N/m). Symmetric, positive semidefinite.
// Where tangential forces follow the normal one (eq. U6), they change by another `following` (normal . (V - W_hat)
// less what a preload's shortening takes of it, normal_stiffness a metre); lengths 0: they do not.
struct PointTangent {
  std::vector<int> unknowns;
  Mat matrix;
  Vec normal, following;
  double normal_stiffness = 0.0;
};

// A preload's shortening gives way so that the sum of its normal forces stays: the tangents less
// column column^T / stiffness.
struct PreloadTangent {
  std::vector<std::pair<int, double>> column;  // unknown in the assembled q, N s/m
  double stiffness = 0.0;
  std::vector<int> points;

  // The motion (m) by which it gives way.
  double way(const Vec& velocity) const {
    double amount = 0.0;
    for (const auto& [unknown, value] : column) amount += value * velocity[unknown];
    return amount / stiffness;
  }
};

struct Tangents {
  std::vector<PointTangent> points;  // as in the exchange; of all of them
  std::vector<PreloadTangent> preloads;

  bool follow() const {
    return std::any_of(points.begin(), points.end(),
                       [](const PointTangent& point) { return point.following.size() > 0; });
  }
};

}  // namespace dygita
