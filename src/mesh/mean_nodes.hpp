// What nodes contribute to the mean motion of a place.
#pragma once

#include <vector>

#include "mesh/face_nodes.hpp"

namespace dygita {

// The rigid motion nearest to that of a place in the sense of least squares (manual, eq. J8): its displacement at the
// centre is sum share_k u_k, its rotation inertia^-1 sum arm_k x u_k.
struct MeanNodes {
  std::vector<int> nodes;
  Vec shares;                   // of sum 1
  Points arms;                  // 3 x n, m
  Vec3 centre;                  // m
  Mat3 inertia = Mat3::Zero();  // m^2, of the place about its centre, for a mass of one; singular on a line
};

// Of all points of a face, between the nodes as at them. x: of all nodes of its mesh, m.
MeanNodes mean_nodes(const FaceNodes& face, const Points& x);

// Of the nodes alone. weights: of each, of any positive sum.
MeanNodes mean_nodes(const std::vector<int>& nodes, const Vec& weights, const Points& x);

}  // namespace dygita
