#include "exchange/spread_points.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.hpp"
#include "law/law.hpp"

namespace dygita {

namespace {

// Share of a row at which it counts as held.
constexpr double least_free = 1e-3;

}  // namespace

void SpreadPoints::add(const Surface& surface, int s, const Reach& reach) {
  for (int i = 0; i < surface.n_points(); ++i)
    if (reach.has(s, i)) add_point(surface, s, i);
}

void SpreadPoints::add_point(const Surface& surface, int s, int i) {
  Point point;
  point.law = surface.law.get();
  point.area = surface.facing.areas[i];
  point.members = {{s, i, 1.0}};
  point.frame = frame(surface, i);
  point.first_port = static_cast<int>(exchange_.ports.size());
  point.is_wall = surface.part_2 < 0;
  point.first_port_2 = point.first_port + 1;
  point.end_port = point.first_port_2 + (point.is_wall ? 0 : 1);
  exchange_.ports.push_back(port(surface, 2 * s, i, point.frame));
  if (!point.is_wall) exchange_.ports.push_back(port(surface, 2 * s + 1, i, point.frame));
  for (int d = 0; d < 3; ++d)
    point.has_law[d] = point.law->acts_on(d, step_.is_static) && surface.facing.acts_along(i, d) &&
                       (point.is_wall || surface.facing.is_of_sums() || !is_tied_to_plane(surface, point, d));
  if (surface.facing.is_of_sums()) refuse_driven(surface, point);
  activate(exchange_.ports, false, point);
  exchange_.points.push_back(std::move(point));
}

// A sum of which supports and loads have every term is theirs: zero where they hold them, else a contradiction.
void SpreadPoints::refuse_driven(const Surface& surface, const Point& point) const {
  for (int d = 0; d < 3; ++d) {
    bool is_free = !point.has_law[d], is_driven = false;
    for (int p = point.first_port; p < point.end_port; ++p) {
      const Port& port = exchange_.ports[p];
      is_free = is_free || !port.is_held[d];
      port.for_each_node([&](int node, const Mat3& block) {
        const Held* held = conditions_.at(port.part, node);
        for (int j = 0; held && j < held->n; ++j)
          is_driven =
              is_driven || (!held->motion[j].empty() &&
                            std::abs(held->directions.col(j).dot(block.transpose() * point.frame.col(d))) > 1e-9);
      });
    }
    if (is_free || !is_driven) continue;
    throw InputError(
        surface.wall ? surface.wall->origin : surface.interface->origin,
        "step '" + step_.name + "': '" + surface.name() +
            "': loads and supports prescribe all of the motions that it joins, and leave it nothing to hold");
  }
}

// Where both sides end on one plane of symmetry, nothing moves along its normal: the side with the points is held
// (quadratic faces: the point's own node; its row has small shares of nodes off the plane), the other one's row has
// what of its nodes is off the plane alone. Both would be tied to the plane once more, by more rows than nodes move.
bool SpreadPoints::is_tied_to_plane(const Surface& surface, const Point& point, int d) const {
  const int carrier = surface.facing.carrier == 1 ? point.first_port : point.first_port_2;
  const Port& own = exchange_.ports[carrier];
  const Port& other = exchange_.ports[carrier == point.first_port ? point.first_port_2 : point.first_port];
  if (own.is_held[d] && other.is_held[d]) return false;  // no rows
  if (!own.is_held[d] && !has_held_node_at(own, surface, point, d)) return false;
  const Vec3 axis = point.frame.col(d);
  bool has_held_nodes = false, is_driven = false;
  other.for_each_node([&](int node, const Mat3& block) {
    const Held* held = conditions_.at(other.part, node);
    const Vec3 along = block.transpose() * axis;
    if (!held || along.isZero() ||
        (held->directions.leftCols(held->n).transpose() * along).norm() <= 0.999 * along.norm())
      return;
    has_held_nodes = true;
    is_driven = is_driven || moves_apart(own, other.part, node, axis);
  });
  return has_held_nodes && !is_driven;
}

// Is a held node moved along an axis otherwise than the one that carries a port?
bool SpreadPoints::moves_apart(const Port& port, int part, int node, const Vec3& axis) const {
  std::map<int, double> difference;  // by motion
  const auto add = [&](const Held* held, double sign) {
    for (int j = 0; held && j < held->n; ++j)
      for (const auto& [motion, factor] : held->motion[j])
        difference[motion] += sign * factor * held->directions.col(j).dot(axis);
  };
  add(conditions_.at(port.part, port.node), 1.0);
  add(conditions_.at(part, node), -1.0);
  return std::any_of(difference.begin(), difference.end(),
                     [](const auto& motion) { return std::abs(motion.second) > 1e-9; });
}

// Is the node that carries the point held along d, and the point there?
bool SpreadPoints::has_held_node_at(const Port& port, const Surface& surface, const Point& point, int d) const {
  const Held* held = conditions_.at(port.part, port.node);
  const Vec3 along = point.frame.col(d);
  if (!held || (held->directions.leftCols(held->n).transpose() * along).norm() < 0.999) return false;
  const Substructure& part = *problem_.substructures[port.part];
  const Vec3 off = surface.facing.places.col(port.point) - part.mesh->nodes.col(port.node) - part.place;
  return std::abs(off.dot(along)) < 0.01 * std::sqrt(point.area);
}

Port SpreadPoints::port(const Surface& surface, int side, int i, const Mat3& frame) const {
  const int which = 1 + side % 2;
  const SideTrace& trace = which == 1 ? surface.facing.side_1 : surface.facing.side_2;
  Port port;
  port.part = which == 1 ? surface.part_1 : surface.part_2;
  port.node = trace.main_node(i);
  const Copy copy = cut_.owner(port.part, port.node);
  port.piece = copy.piece;
  port.piece_node = copy.node;
  port.trace = &trace;
  port.point = i;
  port.side = side;
  port.area = surface.facing.areas[i];
  std::array<double, 3> free{}, all{};
  port.for_each_node([&](int node, const Mat3& block) {
    CHECK(cut_.owner(port.part, node).piece == port.piece, "a row of a face that does not match lies in one piece");
    const Held* held = conditions_.at(port.part, node);
    for (int d = 0; d < 3; ++d) {
      const Vec3 along = block.transpose() * frame.col(d);
      all[d] += along.squaredNorm();
      free[d] += held ? (held->free_basis().transpose() * along).squaredNorm() : along.squaredNorm();
    }
  });
  for (int d = 0; d < 3; ++d) port.is_held[d] = free[d] <= least_free * least_free * all[d];
  return port;
}

// N, and a tangent along what a support holds of the nodes at the point, so that conditions are per direction there.
Mat3 SpreadPoints::frame(const Surface& surface, int i) const {
  if (surface.facing.is_of_sums()) return surface.facing.frames[static_cast<size_t>(i)];
  Vec3 n = surface.facing.normals.col(i), t = surface.facing.tangent;
  const SideTrace& trace = surface.facing.carrier == 1 ? surface.facing.side_1 : surface.facing.side_2;
  const Held* held = conditions_.at(surface.facing.carrier == 1 ? surface.part_1 : surface.part_2, trace.main_node(i));
  if (held && (held->n == 1 || held->n == 2)) {
    const Vec3 axis = held->n == 1 ? Vec3(held->directions.col(0)) : Vec3(held->free_basis().col(0));
    const double along = axis.dot(n);
    if (std::abs(along) > 0.99) {
      n = along > 0.0 ? axis : Vec3(-axis);
    } else if (std::abs(along) < 0.2) {
      n = (n - along * axis).normalized();
      t = axis;
    }
  }
  std::vector<int> parts{surface.part_1};
  if (surface.part_2 >= 0) parts.push_back(surface.part_2);
  return frame_of(n, t, axes_.at(parts, surface.facing.places.col(i)));
}

}  // namespace dygita
