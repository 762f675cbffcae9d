// Watches a run for how deep contacts penetrate each other by their laws' own gaps: each rank the points that it keeps.
#pragma once

#include <algorithm>

#include "law/law.hpp"
#include "ranks/ranks.hpp"
#include "solution/observer.hpp"

namespace dygita {

class GapWatch {
 public:
  void accept(const Instant& instant) {
    for (size_t s = 0; s < instant.model.surfaces->size(); ++s)
      if ((*instant.model.surfaces)[s].declared_law().shown().gap)
        instant.for_each_point_here(static_cast<int>(s),
                                    [&](const LawState& point) { deepest_ = std::max(deepest_, -point.gap); });
  }
  // Collective.
  void settle() { deepest_ = ranks::largest(deepest_); }
  double deepest() const { return deepest_; }  // m

 private:
  double deepest_ = 0.0;
};

}  // namespace dygita
