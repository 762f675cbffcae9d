// Motions of an assembly as a whole, and those that nothing resists: of the whole, of bodies that are loose, of
// mechanisms.
#pragma once

#include "reduction/linear_assembly.hpp"

namespace dygita {

// What an assembly is to its translations along x, y, z and its rotations about the axes through its centre of mass; of
// one sector of a ring its share of what the ring is.
struct WholeInertia {
  double mass = 0.0;                                   // kg
  Vec3 centre = Vec3::Zero(), moments = Vec3::Zero();  // m; kg m^2
  Mat momenta;                                         // n x 6: T^T M times the six motions of all nodes (eq. D15)

  // k x k, orthogonal: combinations of k vectors that are orthonormal in the mass, given V^T momenta, the first of
  // which moves along x, if any does, the next of the others along y, and so on.
  Mat sorted(const Mat& of_vectors) const;
};
WholeInertia whole_inertia(const LinearAssembly& assembly, const Problem& problem);

// n x k, orthonormal in the mass: all motions in which every body moves as a rigid one, no condition is broken and
// nothing is stored but rounding. Those of the whole come first, in its order, where they are among them. Throws
// NumericalError, naming `what`, where there are more than 600.
Mat free_motions(const LinearAssembly& assembly, const Problem& problem, const WholeInertia& whole,
                 const std::string& what);

}  // namespace dygita
