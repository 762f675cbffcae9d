// A regular box.
#pragma once

#include "mesh/mesh.hpp"

namespace dygita {

// Box from `origin` of extents `size` (m), `cells` hexahedra along x, y, z; faces xmin xmax ymin ymax zmin zmax.
// Throws InputError when a size or a count is not positive.
MeshPtr box_mesh(const Vec3& origin, const Vec3& size, const std::array<int, 3>& cells);

// The same of another type: each hexahedron cut into two prisms (along x and y) or six tetrahedra, and of order two.
MeshPtr box_mesh(const Vec3& origin, const Vec3& size, const std::array<int, 3>& cells, CellType type);

}  // namespace dygita
