// What the sides of direct points move with: a node each, a group of them, or nodes of a face that does not match.
#include "base/error.hpp"
#include "marching/direct_points.hpp"

namespace dygita {

DirectPoints::OwnPort DirectPoints::make_port(const StepModel& model, const Point& point, int index) {
  const Port& port = model.exchange.ports[index];
  OwnPort own;
  Piece* const piece = model.pieces[port.piece].get();
  own.piece = piece->as_explicit();
  own.nodes = piece->explicit_nodes();
  CHECK(own.nodes, "a direct point has explicit pieces alone");
  own.node = own.nodes->index_of(port.piece_node);
  own.index = index;
  const Mat3 answer = port.trace ? spread_port(model, point, port, own)
                                 : Mat3(point.frame.transpose() * own.nodes->node_compliance(own.node) * point.frame);
  const double size = answer.diagonal().maxCoeff();
  const Vec3 across = (answer - Mat3(answer.diagonal().asDiagonal())).cwiseAbs().rowwise().sum();
  own.is_plain = across.maxCoeff() <= 1e-9 * size;
  for (int d = 0; d < 3; ++d) {
    if (port.is_held[d]) continue;
    // Where directions answer together, what bounds the answer: any positive value has the same solution.
    own.inverse[d] = answer(d, d) + (own.is_plain ? 0.0 : across[d]);
  }
  // The velocities of nodes have what supports give them: a port that moves with several needs no more.
  own.has_held = !port.trace && (port.is_held[0] || port.is_held[1] || port.is_held[2]);
  own.is_moved = piece->has_motions() && (own.has_held || own.is_spread());
  return own;
}

// The nodes of a port of a face that does not match, and its answer (frame, s/kg).
Mat3 DirectPoints::spread_port(const StepModel& model, const Point& point, const Port& port, OwnPort& own) {
  Mat3 answer = Mat3::Zero();
  own.first_share = static_cast<int>(shares_.size());
  port.for_each_node([&](int node, const Mat3& block) {
    Share share;
    share.node = own.nodes->index_of(model.cut->owner(port.part, node).node);
    const Mat3 compliance = own.nodes->node_compliance(share.node);
    share.has_held = own.piece && own.piece->has_held(share.node);
    share.block = point.frame.transpose() * block;
    share.answer = compliance * share.block.transpose();
    answer += share.block * share.answer;
    shares_.push_back(share);
  });
  own.end_share = static_cast<int>(shares_.size());
  return answer;
}

Vec3 DirectPoints::velocity(const OwnPoint& p, const OwnPort& port) const {
  if (!port.is_spread()) return p.point->frame.transpose() * port.nodes->velocity_of(port.node);
  Vec3 v = Vec3::Zero();
  for (int i = port.first_share; i < port.end_share; ++i)
    v += shares_[i].block * port.nodes->velocity_of(shares_[i].node);
  return v;
}

Vec3 DirectPoints::start_displacement(const OwnPoint& p, const OwnPort& port) const {
  Vec3 u = -0.5 * increment_.dt * port.v_old;
  if (!port.is_spread())
    return u + p.point->frame.transpose() * port.nodes->start_displacement_of(port.node, Vec3::Zero());
  for (int i = port.first_share; i < port.end_share; ++i)
    u += shares_[i].block * port.nodes->start_displacement_of(shares_[i].node, Vec3::Zero());
  return u;
}

// r and 1/k of one side (manual, eq. G1), with k the nodes' own: r is the velocity without this law's force.
void DirectPoints::gather(const OwnPoint& p, Side& side) {
  if (side.end - side.first == 1) {
    OwnPort& port = ports_[side.first];
    port.free = velocity(p, port) - port.inverse.cwiseProduct(port.force);
    side.r = port.free;
    side.inverse_k = port.inverse;
    for (int d = 0; d < 3 && port.has_held; ++d)
      if (port.inverse[d] == 0.0) side.r[d] = port.held_velocity[d];
    return;
  }
  side.r.setZero();
  side.inverse_k.setZero();
  Vec3 k_sum = Vec3::Zero(), kr_sum = Vec3::Zero();
  std::array<bool, 3> is_held{};
  for (int i = side.first; i < side.end; ++i) {
    OwnPort& port = ports_[i];
    port.free = velocity(p, port) - port.inverse.cwiseProduct(port.force);
    for (int d = 0; d < 3; ++d) {
      if (port.inverse[d] == 0.0) {
        is_held[d] = true;
        side.r[d] = port.held_velocity[d];
      } else if (!is_held[d]) {
        k_sum[d] += 1.0 / port.inverse[d];
        kr_sum[d] += (port.free[d] + port.offset[d]) / port.inverse[d];
      }
    }
  }
  for (int d = 0; d < 3; ++d) {
    if (is_held[d] || k_sum[d] == 0.0) continue;
    side.r[d] = kr_sum[d] / k_sum[d];
    side.inverse_k[d] = 1.0 / k_sum[d];
  }
}

// A node's velocity with another force of this law on it.
void DirectPoints::push(const OwnPoint& p, OwnPort& port, const Vec3& force) {
  const Vec3 change = force - port.force;
  port.force = force;
  if (change.isZero(0.0)) return;
  if (port.is_spread()) {
    for (int i = port.first_share; i < port.end_share; ++i)
      port.nodes->set_velocity(shares_[i].node, port.nodes->velocity_of(shares_[i].node) + shares_[i].answer * change);
    return;
  }
  const Vec3 moved = port.is_plain ? Vec3(p.point->frame * port.inverse.cwiseProduct(change))
                                   : Vec3(port.nodes->node_compliance(port.node) * (p.point->frame * change));
  port.nodes->set_velocity(port.node, port.nodes->velocity_of(port.node) + moved);
}

// Velocities and forces of a side's nodes (manual, eq. G2-G3).
void DirectPoints::scatter(const OwnPoint& p, const Side& side, const Vec3& force) {
  if (side.end - side.first == 1) return push(p, ports_[side.first], force);
  Vec3 balance = force;
  std::array<int, 3> held_port{-1, -1, -1};
  for (int i = side.first; i < side.end; ++i) {
    OwnPort& port = ports_[i];
    Vec3 f = Vec3::Zero();
    for (int d = 0; d < 3; ++d) {
      if (port.inverse[d] == 0.0) {
        held_port[d] = i;
        continue;
      }
      const double w = side.r[d] + side.inverse_k[d] * force[d] - port.offset[d];
      f[d] = (w - port.free[d]) / port.inverse[d];
      balance[d] -= f[d];
    }
    push(p, port, f);
  }
  for (int d = 0; d < 3; ++d)
    if (held_port[d] >= 0) ports_[held_port[d]].force[d] = balance[d];
}

}  // namespace dygita
