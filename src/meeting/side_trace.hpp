// How the points of an interface move with the nodes of one of its sides (manual, eq. J1).
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <utility>
#include <vector>

#include "numerics/types.hpp"

namespace dygita {

// The motion of point i is the sum over nodes l of R (t_l 1 + turn_i [d_l]x) V_l: that of one node where faces match,
// else a mean over nodes near it, with what makes it exact in rigid motions of nodes that are not quite there. R turns
// all of a side whose points stand elsewhere around an axis (manual, eq. J9); else it is 1.
class SideTrace {
 public:
  // A node's share: t, and the arm d (m), zero where the nodes' mean lies at the point.
  struct Share {
    int node;
    double weight;
    Vec3 arm = Vec3::Zero();
  };

  SideTrace() = default;
  // Point i is node nodes[i].
  explicit SideTrace(const std::vector<int>& nodes);

  // A further point; turn: 3 x 3 (1/m), zero for no arms.
  void add(const std::vector<Share>& shares, const Mat3& turn = Mat3::Zero());

  // All points of another, which are turned alike.
  void append(const SideTrace& other);

  // Turns the motions of all points.
  void turn_by(const Mat3& rotation) { rotation_ = rotation; }

  int n_points() const { return static_cast<int>(turn_of_.size()); }
  int n_shares(int i) const { return first_[i + 1] - first_[i]; }
  const Share& share(int i, int k) const { return shares_[first_[i] + k]; }
  bool is_of_one_node(int i) const { return n_shares(i) == 1; }
  // Of the arms of a point's shares; zero for none.
  Mat3 turn(int i) const { return turn_of_[i] < 0 ? Mat3(Mat3::Zero()) : turns_[turn_of_[i]]; }
  // The node that counts most at a point.
  int main_node(int i) const;
  // What the velocity of the k-th node adds to that of the point (3 x 3).
  Mat3 block(int i, int k) const;

  // The nodes that carry the points, increasing, and the same trace on a field at them alone.
  std::pair<SideTrace, std::vector<int>> on_its_nodes() const;

  // The motion of a point, given a field (3 x n_nodes).
  Vec3 at(int i, const Points& nodal) const {
    return at_nodes(i, [&](int node) { return nodal.col(node); });
  }
  // The same of a field that of_node(node) answers for.
  template <class OfNode>
  Vec3 at_nodes(int i, OfNode&& of_node) const {
    const Vec3 unturned = at_unturned(i, of_node);
    return rotation_ ? Vec3(*rotation_ * unturned) : unturned;
  }
  // Adds a force on a point to those on the nodes: power is the same for any motion.
  void spread(int i, const Vec3& force, Points& nodal) const;

 private:
  template <class OfNode>
  Vec3 at_unturned(int i, OfNode&& of_node) const {
    if (is_of_one_node(i) && share(i, 0).weight == 1.0 && turn_of_[i] < 0) return of_node(share(i, 0).node);
    Vec3 sum = Vec3::Zero(), moment = Vec3::Zero();
    for (int k = 0; k < n_shares(i); ++k) {
      const Share& own = share(i, k);
      sum += own.weight * of_node(own.node);
      moment += own.arm.cross(of_node(own.node));
    }
    return turn_of_[i] < 0 ? sum : Vec3(sum + turns_[turn_of_[i]] * moment);
  }

  std::vector<int> first_{0};
  std::vector<Share> shares_;
  std::vector<int> turn_of_;  // of each point, index in turns_; -1: none
  std::vector<Mat3> turns_;
  std::optional<Mat3> rotation_;
};

}  // namespace dygita
