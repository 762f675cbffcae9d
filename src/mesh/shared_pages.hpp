// Where several ranks run on one machine it has every mesh once: all of them have built it, one writes its nodes and
// cells to a file, and the pages of that file take the place of each rank's own.
#pragma once

#include "mesh/mesh.hpp"

namespace dygita {

// Collective, with equal meshes. The same mesh, whose nodes and cells are pages that the ranks of a machine share: the
// system may drop those that nobody reads, and brings them back from the file. The mesh that was given where a process
// is alone, the mesh small, or no room for the file; the file has no name left and goes with the last who reads it.
MeshPtr on_shared_pages(MeshPtr mesh);

// Takes pages of such meshes out of this rank's memory until they are read again, and gives the system back what set-up
// has freed. Nothing where a process is alone.
void leave_shared_pages();

}  // namespace dygita
