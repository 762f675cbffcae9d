#include "meeting/sum_facing.hpp"

#include <spdlog/fmt/fmt.h>

#include <Eigen/LU>
#include <cmath>

#include "base/error.hpp"
#include "numerics/cross_matrix.hpp"
#include "numerics/dense.hpp"

namespace dygita {

namespace {

// The motion as a whole that is nearest to that of a face's nodes: V = sum w V_k, and omega = J^-1 sum w d_k x V_k.
class MeanMotion {
 public:
  MeanMotion(const PlacedFace& face, MeanBy by) : nodes_(face_nodes(*face.mesh, face.facets)) {
    weights_ = by == MeanBy::area ? nodes_.weights : Vec(Vec::Ones(nodes_.weights.size()));
    weights_ /= weights_.sum();
    arms_.resize(3, weights_.size());
    for (Eigen::Index k = 0; k < weights_.size(); ++k)
      arms_.col(k) = face.mesh->nodes.col(nodes_.nodes[static_cast<size_t>(k)]) + face.place;
    centre_ = arms_ * weights_;
    arms_.colwise() -= centre_;
    for (Eigen::Index k = 0; k < weights_.size(); ++k) {
      const Mat3 cross = cross_matrix(arms_.col(k));
      inertia_ -= weights_[k] * cross * cross;
    }
    const PrincipalAxes principal = principal_axes(inertia_);
    constexpr double least = 1e-9;
    if (!(principal.values[0] > least * principal.values[2]))
      throw InputError(
          fmt::format("the nodes of '{}' lie on a line or at a point, and have no mean rotation", face.name));
    axes_ = principal.vectors;
    radius_ = std::sqrt(0.5 * inertia_.trace());
  }

  const Vec3& centre() const { return centre_; }
  double radius() const { return radius_; }  // m, of gyration
  double area() const { return nodes_.weights.sum(); }
  // N along the largest moment, outwards; T1 along the smallest.
  Mat3 frame() const {
    Mat3 frame;
    const Vec3 outwards = nodes_.vectors.rowwise().sum(), n = axes_.col(2);
    frame.col(0) = n.dot(outwards) < 0 ? Vec3(-n) : n;
    frame.col(1) = axes_.col(0);
    frame.col(2) = frame.col(0).cross(frame.col(1));
    return frame;
  }

  // The motion as a whole at a place, as another point of a trace.
  void add_at(const Vec3& place, SideTrace& trace) const {
    std::vector<SideTrace::Share> shares;
    for (Eigen::Index k = 0; k < weights_.size(); ++k)
      shares.push_back({nodes_.nodes[static_cast<size_t>(k)], weights_[k], weights_[k] * arms_.col(k)});
    trace.add(shares, -cross_matrix(place - centre_) * inertia_.inverse());
  }

 private:
  FaceNodes nodes_;
  Vec weights_;  // sum 1
  Points arms_;  // 3 x n, m, from the centre
  Vec3 centre_;
  Mat3 inertia_ = Mat3::Zero(), axes_;  // m^2
  double radius_;
};

}  // namespace

Facing facing_of_means(const PlacedFace& side_1, const PlacedFace& side_2, MeanBy by) {
  const MeanMotion one(side_1, by), other(side_2, by);
  const Mat3 frame = one.frame();
  Facing facing;
  facing.places.resize(3, 3);
  facing.places << one.centre(), one.centre() + one.radius() * frame.col(1), one.centre() + one.radius() * frame.col(2);
  for (int i = 0; i < 3; ++i) {
    one.add_at(facing.places.col(i), facing.side_1);
    other.add_at(facing.places.col(i), facing.side_2);
  }
  facing.frames.assign(3, frame);
  facing.directions = {{true, true, true}, {true, false, true}, {true, false, false}};
  facing.normals = frame.col(0).replicate(1, 3);
  facing.areas = Vec::Constant(3, one.area() / 3.0);
  facing.gaps = Vec::Zero(3);
  facing.facets_1 = side_1.facets;
  facing.facets_2 = side_2.facets;
  facing.carrier = 1;
  return facing;
}

Facing facing_of_sum(const Vec3& place, double area) {
  Facing facing;
  facing.places = place;
  facing.frames = {Mat3::Identity()};
  facing.directions = {{true, true, true}};
  facing.normals = Vec3::UnitX();
  facing.areas = Vec::Constant(1, area);
  facing.gaps = Vec::Zero(1);
  facing.carrier = 1;
  return facing;
}

}  // namespace dygita
