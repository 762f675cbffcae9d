// Coulomb's friction at a point (manual, eq. L6).
#pragma once

#include "numerics/types.hpp"

namespace dygita {

// Force on the friction disc: F_d = s_d / (Y_d + lambda), lambda >= 0 so that |F| <= limit. Returns F and lambda.
struct DiscForce {
  Eigen::Vector2d force;
  double lambda;
};
DiscForce project_on_disc(const Eigen::Vector2d& s, const Eigen::Vector2d& y, double limit);

}  // namespace dygita
