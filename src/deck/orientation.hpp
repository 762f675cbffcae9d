// How a material with directions lies in a substructure.
#pragma once

#include "deck/arguments.hpp"

namespace dygita {

// The mesh with axes in each cell, by the `orientation` of the arguments, in the mesh's own coordinates; without one
// along x, y, z. Throws InputError where two axes are parallel, or a cell's middle is on the axis of a cylinder.
MeshPtr oriented(const Mesh& mesh, const LuaArguments& arguments);

}  // namespace dygita
