// Coulomb's friction at a point (manual, eq. L6).
#pragma once

#include <array>

#include "numerics/types.hpp"

namespace dygita {

// Tangents along which both sides are held or driven: s is their rate and y zero. Where they slide, friction is against
// that rate; where they rest, it is undetermined and stays what it was, as far as the disc allows.
struct GivenRates {
  std::array<bool, 2> is_given{};
  Eigen::Vector2d before = Eigen::Vector2d::Zero();  // N
};

// Force on the friction disc: F_d = s_d / (Y_d + lambda), lambda >= 0 so that |F| <= limit. Returns F and lambda.
struct DiscForce {
  Eigen::Vector2d force;
  double lambda;
};
DiscForce project_on_disc(const Eigen::Vector2d& s, const Eigen::Vector2d& y, double limit,
                          const GivenRates& given = {});

}  // namespace dygita
