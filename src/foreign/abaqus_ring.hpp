// One sector of a ring, as an input file says it: *CYCLIC SYMMETRY MODEL beside a *TIE of its cut faces.
#pragma once

#include "foreign/cards.hpp"
#include "numerics/types.hpp"

namespace dygita {

// Two points of the axis, in the units of the file, and the sectors of the ring.
struct AbaqusRing {
  long n;
  Vec3 from, to;
};

// That of a tie: of its name, or of none. Throws InputError with the line.
AbaqusRing ring_of(const CardFile& file, const FileCard& tie);

}  // namespace dygita
