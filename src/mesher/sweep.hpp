// Solids of CAD that are a flat face moved along its normal, as plates and washers are: meshed by hexahedra.
#pragma once

#include <optional>
#include <vector>

namespace dygita {

struct SweptSolid {
  int tag = 0;                // of the volume in gmsh's model that takes the place of the solid
  std::vector<int> surfaces;  // in the order of the solid's
};

// Makes a solid of gmsh's current OpenCASCADE model anew by moving one of its flat faces, in layers of about `size`, so
// that its mesh has hexahedra (prisms where the face cannot be cut into quadrilaterals). None, and nothing changes,
// where it is no such solid: same volume, surface, centre and faces within 1e-6. Lengths are in the model's unit.
std::optional<SweptSolid> sweep_solid(int solid, const std::vector<int>& surfaces, double size);

// Of all other entities of the model, takes back what gmsh has them inherit: faces of other solids that lie on those of
// a swept one it takes for the same, and would mesh them by extrusion, too. solids: the swept ones.
void leave_others_unswept(const std::vector<int>& solids);

}  // namespace dygita
