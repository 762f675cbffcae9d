// Anderson's mixing (D. G. Anderson, J. ACM 12, 1965) of the forces of points that take turns: what a round makes of
// forces is corrected by what the rounds before made of theirs.
#pragma once

#include <deque>

#include "numerics/types.hpp"

namespace dygita {

class ForceMixing {
 public:
  // Forgets what another increment has brought.
  void begin() { before_.clear(); }
  // Forces to go on from (N), where a round has made g of f. weight: of the squares of both, positive.
  Vec next(const Vec& f, const Vec& g, const Vec& weight);

 private:
  static constexpr size_t depth = 8;
  static constexpr double too_bad = 4.0;  // times the change of the round before: what it was taken from misleads

  struct Round {
    Vec result, change;
  };
  std::deque<Round> before_;  // the latest first
};

}  // namespace dygita
