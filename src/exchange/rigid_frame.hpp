// Motions of a body as a whole, seen from its middle.
#pragma once

#include <Eigen/Geometry>

#include "exchange/exchange.hpp"
#include "model/extent.hpp"

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
  // The same of a node of the body: where that is the turn of a rigid face, of its value.
  RigidMotion row(const Substructure& body, int node, const Vec3& d) const {
    if (body.mesh->inside->is_place(node)) return row(place_of_node(body, node), d);
    RigidMotion r = RigidMotion::Zero();
    r.tail<3>() = body.mesh->inside->size_of_turn(node) / size * d;
    return r;
  }
  // The same of a port of the body along a direction of its point's frame.
  RigidMotion row(const Substructure& body, const Port& port, const Vec3& d) const {
    RigidMotion sum = RigidMotion::Zero();
    port.for_each_node([&](int node, const Mat3& block) { sum += row(body, node, block.transpose() * d); });
    return sum;
  }
  Vec3 value(const RigidMotion& motion, const Substructure& body, int node) const {
    if (body.mesh->inside->is_place(node)) return displacement(motion, place_of_node(body, node));
    return Vec3(row(body, node, Vec3::UnitX()).dot(motion), row(body, node, Vec3::UnitY()).dot(motion),
                row(body, node, Vec3::UnitZ()).dot(motion));
  }
  Vec3 displacement(const RigidMotion& motion, const Vec3& x) const {
    return motion.head<3>() + Vec3(motion.tail<3>()).cross(x - centre) / size;
  }

  // The same of what resists motions as a whole from inside the body; 6 x how many.
  ResistedMotions resisted(const Substructure& body) const {
    ResistedMotions rows = body.mesh->inside->resisted_motions(body.mesh->nodes);
    for (Eigen::Index i = 0; i < rows.cols(); ++i) {
      const Vec3 a = rows.col(i).head<3>(), b = rows.col(i).tail<3>();
      rows.col(i) << a, (b + (body.place - centre).cross(a)) / size;
    }
    return rows;
  }
  // Displacements (3 x nodes) of a body's nodes under a rigid motion.
  Points displacements(const RigidMotion& motion, const Substructure& body) const {
    // Of the mesh's own coordinates.
    return body.mesh->inside->rigid_motion(body.mesh->nodes, centre - body.place, motion.head<3>(),
                                           motion.tail<3>() / size);
  }

  static Vec3 place_of_node(const Substructure& body, int node) { return body.mesh->nodes.col(node) + body.place; }
};

}  // namespace dygita
