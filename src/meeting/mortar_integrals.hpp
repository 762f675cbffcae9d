// Integrals of dual multipliers over what a facet has in common with another mesh (manual, eq. J2-J3).
#pragma once

#include "meeting/segments.hpp"

namespace dygita {

// Of one set of multipliers psi, dual to the functions lambda of a facet or of a part of it; nodes as the faces number
// them.
struct Coupling {
  std::vector<int> points;  // node of each multiplier
  Vec areas;                // m^2, integrals of psi over what is covered; of lambda over all
  Vec full_areas;
  Points normals;  // 3 x n, m^2, of psi n
  // Of psi times the shape functions of the facet, and of each facet of the other side: n x its nodes.
  int facet = -1;
  Mat own;
  struct Other {
    int facet;
    Mat values;
  };
  std::vector<Other> others;
  double covered = 0.0;  // m^2
};

// The couplings of facet after facet of `face` to `other`; facets side by side on the threads at hand.
std::vector<Coupling> couple(const FaceInSpace& face, const FaceInSpace& other, double reach);

}  // namespace dygita
