// What lumping does to the rotation of a part's cross sections: masses at the nodes stand farther out than the
// material.
#pragma once

#include "model/model.hpp"

namespace dygita {

struct LumpedInertia {
  double ratio = 1.0;         // moment of inertia of the lumped masses over that of the material, the largest of three
  Vec3 axis = Vec3::UnitZ();  // through the centroid, the principal axis of that ratio
};
LumpedInertia lumped_inertia(const Mesh& mesh);

// Warns of substructures whose masses are lumped in a dynamic step, or in the modes of an output, and turn much too
// slowly: (1 + 2/n^2) times the inertia in torsion with n cells across a square bar.
void doubt_lumped_inertia(const Problem& problem);

}  // namespace dygita
