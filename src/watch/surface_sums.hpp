// Sums over the points of interfaces and supports.
#pragma once

#include "step/observer.hpp"

namespace dygita {

// Surfaces (indices) of the interfaces and wall supports among the targets.
std::vector<int> surfaces_of(const Instant& instant, const std::vector<Target>& targets);

// Force on side 1 (N): normal (compression negative), modulus of the tangential sum, vector sum. On a support: on the
// part.
struct Resultant {
  double normal = 0.0, shear = 0.0;
  Vec3 force = Vec3::Zero();
};
Resultant resultant(const Instant& instant, const Problem& problem, const std::vector<Target>& targets);

// Area-weighted mean pressure (Pa, compression positive) of the interfaces and walls among the targets.
double mean_pressure(const Instant& instant, const std::vector<Target>& targets);

}  // namespace dygita
