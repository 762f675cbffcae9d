// Preloads that no interface could carry, before anything is solved.
#pragma once

#include "interfaces/surfaces.hpp"

namespace dygita {

// Throws InputError where a step asks for more than an interface without hardening can carry, or where the faces turn
// so far that the sum of forces along their normals is no force of a bolt. surfaces: of all interfaces, in their order.
void check_preloads(const Problem& problem, const std::vector<Surface>& surfaces);

}  // namespace dygita
