// The solution of a run is its interface fields: given q = F_hat + k W_hat, every interior is one linear sweep.
#pragma once

#include <vector>

#include "numerics/types.hpp"

namespace dygita {

// q of every increment of every step (assembled order of the step's exchange; N).
struct InterfaceFields {
  std::vector<std::vector<Vec>> q;  // [step][increment]

  // The kept q of an increment if it has `size` unknowns: another case may have other contacts; null otherwise.
  const Vec* at(size_t i_step, size_t increment, Eigen::Index size) const {
    if (i_step >= q.size() || increment >= q[i_step].size()) return nullptr;
    const Vec& kept = q[i_step][increment];
    return kept.size() == size ? &kept : nullptr;
  }
};

}  // namespace dygita
