// Openings and slips that laws do not remember, from the displacements of the two sides.
#pragma once

#include "watch/moved_side.hpp"

namespace dygita {

// Slips (m) of contact without friction, which has no tangential unknown, from their first touch on; openings and slips
// (m) for laws of rates, and of what has let go (a released interface, a wall that a step leaves out) from then on.
class FollowedMotion {
 public:
  void begin_step(const Instant& instant);
  void accept(const Instant& instant);
  // Of a surface's point, from its law's state where that has them; the slip is a vector.
  double opening(const Instant& instant, int surface, int point) const;
  // m, by how much the sides have parted since it has let go; 0: it has not.
  double parted(const Instant& instant, int surface, int point) const;
  Vec3 slip(const Instant& instant, int surface, int point) const;

 private:
  struct Motion {
    MovedSides sides;
    Points before;
    Points moved;  // as the law is followed; empty: it is not
    Points loose;  // since it has let go; empty: it has not
    bool is_watched = false;
  };
  std::vector<Motion> motions_;  // of each surface
};

}  // namespace dygita
