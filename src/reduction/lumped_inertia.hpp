// What lumping does to the rotation of a part's cross sections: masses at the nodes stand farther out than the
// material.
#pragma once

#include "model/model.hpp"

namespace dygita {

struct LumpedInertia {
  double ratio = 1.0;         // moment of inertia of the lumped masses over that of the material, the largest of three
  Vec3 axis = Vec3::UnitZ();  // through the centroid, the principal axis of that ratio
};
// has_twist: about an axis along which the body is slender, too.
LumpedInertia lumped_inertia(const Mesh& mesh, bool has_twist = true);

// Warns of substructures, and of groups of them that are bonded to each other, that turn as a whole, held by springs or
// by nothing, and too slowly by 2 % or more since their masses are lumped in a dynamic step, or in the modes of an
// output: (1 + 2/n^2) times the inertia with n cells across.
void doubt_slow_turning(const Problem& problem);

// The same, and of slender ones that twist much too slowly.
void doubt_lumped_inertia(const Problem& problem);

}  // namespace dygita
