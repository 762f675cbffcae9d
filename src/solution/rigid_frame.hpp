// Motions of a body as a whole, seen from its middle.
#pragma once

#include <Eigen/Geometry>

#include "model/extent.hpp"
#include "solution/exchange.hpp"

namespace dygita {

using RigidMotion = Eigen::Matrix<double, 6, 1>;  // m: translation, then rotation times the size of the body

struct RigidFrame {
  Vec3 centre = Vec3::Zero();
  double size = 1.0;  // m

  explicit RigidFrame(const Box& box) : centre(0.5 * (box.low + box.high)), size(box.size().norm()) {}

  // Displacement along d of a point under a rigid motion, as a row.
  RigidMotion row(const Vec3& x, const Vec3& d) const {
    RigidMotion r;
    r.head<3>() = d;
    r.tail<3>() = (x - centre).cross(d) / size;
    return r;
  }
  // The same of a port of the body along a direction of its point's frame.
  RigidMotion row(const Substructure& body, const Port& port, const Vec3& d) const {
    RigidMotion sum = RigidMotion::Zero();
    port.for_each_node(
        [&](int node, const Mat3& block) { sum += row(place_of_node(body, node), block.transpose() * d); });
    return sum;
  }
  Vec3 displacement(const RigidMotion& motion, const Vec3& x) const {
    return motion.head<3>() + Vec3(motion.tail<3>()).cross(x - centre) / size;
  }

  static Vec3 place_of_node(const Substructure& body, int node) { return body.mesh->nodes.col(node) + body.place; }
};

}  // namespace dygita
