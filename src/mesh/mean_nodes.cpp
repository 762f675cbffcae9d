#include "mesh/mean_nodes.hpp"

namespace dygita {

namespace {

// moments: 3 x n, sums or integrals of weight times place.
MeanNodes mean_by(const std::vector<int>& nodes, const Vec& weights, const Points& moments, const Points& x) {
  MeanNodes mean{nodes, weights / weights.sum(), moments / weights.sum(), {}};
  mean.centre = mean.arms.rowwise().sum();
  mean.arms -= mean.centre * mean.shares.transpose();
  for (Eigen::Index k = 0; k < weights.size(); ++k) {
    const Vec3 arm = mean.arms.col(k), from_centre = x.col(nodes[static_cast<size_t>(k)]) - mean.centre;
    mean.inertia += arm.dot(from_centre) * Mat3::Identity() - from_centre * arm.transpose();
  }
  mean.inertia = (0.5 * (mean.inertia + mean.inertia.transpose())).eval();
  return mean;
}

}  // namespace

MeanNodes mean_nodes(const FaceNodes& face, const Points& x) {
  return mean_by(face.nodes, face.weights, face.moments, x);
}

MeanNodes mean_nodes(const std::vector<int>& nodes, const Vec& weights, const Points& x) {
  return mean_by(nodes, weights, x(Eigen::all, nodes) * weights.asDiagonal(), x);
}

}  // namespace dygita
