// Newton's method on a round over points that take turns: where forces that hardly move the nodes creep for thousands
// of rounds, from one set of sticking, sliding and open points to the next.
#pragma once

#include <functional>

#include "numerics/types.hpp"

namespace dygita {

// Forces (N) to go on from. round: what it makes of forces. weight: of the squares of forces, none negative; those
// without weight move nothing. The Jacobian of a round times a vector is a difference of two rounds. Where rounds
// change forces that move nothing, by as much each time, it goes as far as they go on so: until a point slides or
// opens. Ties in such a loop would go on without bound.
Vec leap(const Vec& forces, const Vec& weight, const std::function<Vec(const Vec&)>& round);

}  // namespace dygita
