// A regular box of hex8.
#pragma once

#include "mesh/mesh.hpp"

namespace dygita {

// Box from `origin` of extents `size` (m), `cells` hexahedra along x, y, z; faces xmin xmax ymin ymax zmin zmax.
// Throws InputError when a size or a count is not positive.
MeshPtr box_mesh(const Vec3& origin, const Vec3& size, const std::array<int, 3>& cells);

}  // namespace dygita
