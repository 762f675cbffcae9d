// Nodes of an explicit piece as laws see them that are solved in closed form, between the beginning and the end of an
// increment: of a piece that is here, or copies of those of a piece on another rank.
#pragma once

#include <algorithm>
#include <vector>

#include "numerics/types.hpp"

namespace dygita {

// Four numbers a node, the fourth being zero. Displacements are counted from the step's start, and held half a step
// ahead of the velocities: D = U - U_start + dt/2 V.
class ExplicitNodes {
 public:
  // Where a node of the piece is among these; what a force (N) on one of these adds to its velocity, zero along held
  // directions.
  virtual int index_of(int node) const = 0;
  virtual Mat3 node_compliance(int node) const = 0;
  // Velocity (m/s) without further forces, and then with them; displacement at the increment's start for its velocity
  // then (m), and at its end.
  Vec3 velocity_of(int node) const { return Eigen::Map<const Vec3>(v_.data() + 4 * static_cast<size_t>(node)); }
  Vec3 start_displacement_of(int node, const Vec3& start_velocity) const {
    const size_t at = 4 * static_cast<size_t>(node);
    return Eigen::Map<const Vec3>(start_.data() + at) + Eigen::Map<const Vec3>(d_.data() + at) -
           dt_ * (0.5 * start_velocity + velocity_of(node));
  }
  Vec3 displacement_of(int node) const {
    const size_t at = 4 * static_cast<size_t>(node);
    return Eigen::Map<const Vec3>(start_.data() + at) + Eigen::Map<const Vec3>(d_.data() + at) -
           0.5 * dt_ * velocity_of(node);
  }
  void set_velocity(int node, const Vec3& velocity) {
    const size_t at = 4 * static_cast<size_t>(node);
    for (size_t c = 0; c < 3; ++c) {
      d_[at + c] += dt_ * (velocity[static_cast<int>(c)] - v_[at + c]);
      v_[at + c] = velocity[static_cast<int>(c)];
    }
  }

  // What another rank needs of a node: in every increment D and V, once a step U_start; three numbers each.
  void pack_motion(int node, double* to) const {
    const size_t at = 4 * static_cast<size_t>(node);
    for (size_t c = 0; c < 3; ++c) to[c] = d_[at + c], to[3 + c] = v_[at + c];
  }
  void unpack_motion(int node, const double* from) {
    const size_t at = 4 * static_cast<size_t>(node);
    for (size_t c = 0; c < 3; ++c) d_[at + c] = from[c], v_[at + c] = from[3 + c];
  }
  // Of the nodes of a piece on another rank: their compliance comes from there.
  virtual void set_compliance(int /*index*/, const Mat3& /*compliance*/) {}
  void pack_start(int node, double* to) const { std::copy_n(start_.data() + 4 * static_cast<size_t>(node), 3, to); }
  void unpack_start(int node, const double* from) {
    std::copy_n(from, 3, start_.data() + 4 * static_cast<size_t>(node));
  }

 protected:
  ~ExplicitNodes() = default;

  std::vector<double> d_, v_, start_;
  double dt_ = 0.0;  // s
};

}  // namespace dygita
