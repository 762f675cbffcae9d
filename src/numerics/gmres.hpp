// Generalised minimal residuals, preconditioned from the right (Y. Saad, M. H. Schultz, SIAM J. Sci. Stat. Comput. 7,
// 1986), without restarts: for systems whose preconditioner leaves a few directions to find. Eigen's is unsupported,
// wants a matrix, and measures the preconditioned residual.
#pragma once

#include <functional>
#include <optional>

#include "numerics/types.hpp"

namespace dygita {

struct GmresSystem {
  std::function<Vec(const Vec&)> times;         // A x
  std::function<Vec(const Vec&)> precondition;  // about A^-1 x
};

// x of A x = b with |b - A x| <= tolerance |b|; nothing where `most` products do not come that far.
std::optional<Vec> gmres(const GmresSystem& system, const Vec& b, double tolerance, int most);

}  // namespace dygita
