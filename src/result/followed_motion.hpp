// Openings and slips that laws do not remember, from the displacements of the two sides.
#pragma once

#include "result/moved_side.hpp"

namespace dygita {

// Slips (m) of contact without friction, which has no tangential unknown, while it is closed; openings and slips (m)
// for laws of rates.
class FollowedMotion {
 public:
  void begin_step(const Instant& instant);
  void accept(const Instant& instant);
  // Of a surface's point, from its law's state where that has them; the slip is a vector.
  double opening(const Instant& instant, int surface, int point) const;
  Vec3 slip(const Instant& instant, int surface, int point) const;

 private:
  std::vector<MovedSides> sides_;       // of each surface; of nothing where nothing is followed
  std::vector<Points> before_, moved_;  // moved_: empty where nothing is followed
};

}  // namespace dygita
