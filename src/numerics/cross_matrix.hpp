// The matrix of a cross product.
#pragma once

#include "numerics/types.hpp"

namespace dygita {

// A of A b = a x b.
inline Mat3 cross_matrix(const Vec3& a) {
  Mat3 m;
  m << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
  return m;
}

}  // namespace dygita
