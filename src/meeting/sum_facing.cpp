#include "meeting/sum_facing.hpp"

#include <spdlog/fmt/fmt.h>

#include <Eigen/LU>
#include <cmath>

#include "base/error.hpp"
#include "mesh/mean_nodes.hpp"
#include "numerics/cross_matrix.hpp"
#include "numerics/dense.hpp"

namespace dygita {

namespace {

// The motion as a whole that is nearest to that of a face, or of its nodes.
class MeanMotion {
 public:
  MeanMotion(const PlacedFace& face, MeanBy by) : nodes_(face_nodes(*face.mesh, face.facets)) {
    mean_ = by == MeanBy::area ? mean_nodes(nodes_, face.mesh->nodes)
                               : mean_nodes(nodes_.nodes, Vec::Ones(nodes_.weights.size()), face.mesh->nodes);
    mean_.centre += face.place;
    const PrincipalAxes principal = principal_axes(mean_.inertia);
    constexpr double least = 1e-9;
    if (!(principal.values[0] > least * principal.values[2]))
      throw InputError(
          fmt::format("the nodes of '{}' lie on a line or at a point, and have no mean rotation", face.name));
    axes_ = principal.vectors;
    radius_ = std::sqrt(0.5 * mean_.inertia.trace());
  }

  const Vec3& centre() const { return mean_.centre; }
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
    for (size_t k = 0; k < mean_.nodes.size(); ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      shares.push_back({mean_.nodes[k], mean_.shares[column], mean_.arms.col(column)});
    }
    trace.add(shares, -cross_matrix(place - mean_.centre) * mean_.inertia.inverse());
  }

 private:
  FaceNodes nodes_;
  MeanNodes mean_;  // its centre at the face's place
  Mat3 axes_;
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
