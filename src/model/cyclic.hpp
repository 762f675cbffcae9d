// One sector of a ring: how its second cut face is turned onto the first.
#pragma once

#include "model/model.hpp"

namespace dygita {

// through (m), along (unit): the axis; n: sectors of the ring. Throws InputError where the faces are not one n-th of a
// turn apart.
CyclicSymmetry cyclic_symmetry(const Face& side_1, const Face& side_2, const Vec3& through, const Vec3& along, int n);

}  // namespace dygita
