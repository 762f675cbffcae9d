#include "exchange/exchange.hpp"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <numeric>

#include "exchange/direct_links.hpp"
#include "exchange/near_points.hpp"
#include "exchange/point_frames.hpp"
#include "exchange/spread_points.hpp"
#include "interfaces/node_groups.hpp"
#include "law/law.hpp"

namespace dygita {

namespace {

struct LawCluster {
  int group_1 = -1, group_2 = -1;  // -1: wall
  const Law* law = nullptr;
  std::vector<Member> members;
  Vec3 normal = Vec3::Zero();  // area-weighted sum
  double area = 0.0;
};

class Builder {
 public:
  Builder(const Problem& problem, const Step& step, const Cut& cut, const std::vector<Surface>& surfaces,
          const Conditions& conditions, const std::vector<char>& explicit_pieces, const Reach& reach)
      : problem_(problem),
        step_(step),
        cut_(cut),
        surfaces_(surfaces),
        conditions_(conditions),
        explicit_pieces_(explicit_pieces),
        reach_(reach),
        axes_(problem) {
    exchange_.n_unknowns.assign(cut.n_pieces(), 0);
  }

  Exchange build() {
    make_groups();
    make_clusters();
    reserve();
    for (LawCluster& cluster : clusters_) add_law_point(cluster);
    clusters_ = {};
    SpreadPoints spread_points(problem_, step_, cut_, conditions_, axes_, exchange_);
    for (size_t s = 0; s < surfaces_.size(); ++s)
      if (is_in_force(surfaces_[s]) && !surfaces_[s].facing.matches())
        spread_points.add(surfaces_[s], static_cast<int>(s), reach_);
    for (const auto& [group, ports] : members_) {
      // A group under one law is tied by that law's point; otherwise it needs a point of its own.
      if (ports.size() < 2 || n_laws_[group] == 1) continue;
      add_point(nullptr, ports, {}, false, Vec3::UnitZ(), 0.0, {});
      point_of_group_[group] = static_cast<int>(exchange_.points.size()) - 1;
    }
    add_ties();
    if (!explicit_pieces_.empty()) find_direct(cut_, explicit_pieces_, exchange_);
    for (Point& point : exchange_.points)
      point.is_everywhere = point.law && reach_.is_everywhere(point.members.front().surface);
    if (!reach_.is_all()) keep_near(cut_, exchange_);
    number_unknowns(cut_, reach_.is_all(), exchange_);
    exchange_.splits = TieSplits(exchange_.points, exchange_.ties, surfaces_);
    return std::move(exchange_);
  }

 private:
  // A wall that is not among this step's supports has let go, a damper carries nothing in a static step.
  bool is_in_force(const Surface& surface) const { return takes_part(problem_, step_, surface); }
  bool matches(const Surface& surface) const { return is_in_force(surface) && surface.facing.matches(); }

  NodeKey side(const Surface& s, int i, int which) const {
    const Copy copy = which == 1 ? cut_.owner(s.part_1, s.facing.side_1.main_node(i))
                                 : cut_.owner(s.part_2, s.facing.side_2.main_node(i));
    return {copy.piece, copy.node};
  }
  int part_of(const NodeKey& key) const { return cut_.piece(key.first).part; }
  int node_of(const NodeKey& key) const { return cut_.piece(key.first).node(key.second); }

  void make_groups() {
    for (size_t s = 0; s < surfaces_.size(); ++s) {
      const Surface& surface = surfaces_[s];
      for (int i = 0; i < surface.n_points() && matches(surface); ++i) {
        if (!reach_.has(static_cast<int>(s), i)) continue;
        if (!surface.law && surface.part_2 >= 0) groups_.tie(side(surface, i, 1), side(surface, i, 2));
        for (int which = 1; which <= (surface.part_2 >= 0 ? 2 : 1); ++which) {
          const NodeKey owner = side(surface, i, which);
          groups_.add(owner);
          for (const Copy& copy : cut_.copies(part_of(owner), node_of(owner)))
            area_[{copy.piece, copy.node}] += copy.share * surface.facing.areas[i];
        }
      }
    }
    tie_copies();
    for (const NodeKey& key : groups_.keys()) members_[groups_.of(key)].push_back(key);
    for (auto& [group, keys] : members_) std::sort(keys.begin(), keys.end());
  }

  // Of points between meshes that match; there is one of each group and law, or less.
  void reserve() {
    size_t n_points = clusters_.size(), n_ports = 0;
    for (const LawCluster& cluster : clusters_)
      for (const int group : {cluster.group_1, cluster.group_2})
        if (group >= 0) n_ports += n_laws_[group] == 1 ? members_[group].size() : 1;
    for (const auto& [group, ports] : members_) {
      if (ports.size() < 2 || n_laws_[group] == 1) continue;
      ++n_points;
      n_ports += ports.size();
    }
    exchange_.points.reserve(n_points);
    exchange_.ports.reserve(n_ports);
  }

  // What a cut has made of one node stays together.
  void tie_copies() {
    for (int part = 0; part < static_cast<int>(problem_.substructures.size()); ++part) {
      if (!cut_.is_cut(part)) continue;
      for (const int node : cut_.on_cuts(part).nodes()) {
        const std::vector<Copy> copies = cut_.copies(part, node);
        if (!reach_.has({copies[0].piece, copies[0].node})) continue;
        for (const Copy& copy : copies) {
          area_[{copy.piece, copy.node}] += cut_.piece(copy.piece).cut_areas[copy.node];
          groups_.tie({copies[0].piece, copies[0].node}, {copy.piece, copy.node});
        }
      }
    }
  }

  // Points between the same two groups that have the same law and nearly the same normal become one law: faces of
  // several substructures that lie side by side are one contact.
  void make_clusters() {
    std::map<std::tuple<const Law*, int, int>, std::vector<int>> known;
    for (size_t s = 0; s < surfaces_.size(); ++s) {
      const Surface& surface = surfaces_[s];
      if (!surface.law || !matches(surface)) continue;
      for (int i = 0; i < surface.n_points(); ++i) {
        if (!reach_.has(static_cast<int>(s), i)) continue;
        const int group_1 = groups_.of(side(surface, i, 1));
        const int group_2 = surface.part_2 >= 0 ? groups_.of(side(surface, i, 2)) : -1;
        if (group_1 == group_2) fail_same_group(surface, i);
        const Vec3 normal = surface.facing.normals.col(i);
        LawCluster& cluster = cluster_of(known[{surface.law.get(), group_1, group_2}], normal);
        if (cluster.members.empty()) {
          cluster.group_1 = group_1;
          cluster.group_2 = group_2;
          cluster.law = surface.law.get();
          ++n_laws_[group_1];
          if (group_2 >= 0) ++n_laws_[group_2];
        }
        cluster.members.push_back({static_cast<int>(s), i, surface.facing.areas[i]});
        cluster.normal += surface.facing.areas[i] * normal;
        cluster.area += surface.facing.areas[i];
      }
    }
    for (LawCluster& cluster : clusters_)
      for (Member& member : cluster.members) member.share /= cluster.area;
  }

  // The cluster among these whose normal is within 25 degrees, or a new one.
  LawCluster& cluster_of(std::vector<int>& known, const Vec3& normal) {
    for (const int c : known)
      if (clusters_[c].normal.normalized().dot(normal) > 0.9) return clusters_[c];
    known.push_back(static_cast<int>(clusters_.size()));
    return clusters_.emplace_back();
  }

  [[noreturn]] void fail_same_group(const Surface& surface, int i) const {
    const Vec3 x = surface.facing.places.col(i);
    std::string path;
    for (const Surface& other : surfaces_)
      if (!other.law && other.part_2 >= 0) path += (path.empty() ? "'" : ", '") + other.name() + "'";
    throw InputError(
        surface.interface->origin,
        fmt::format("interface '{}': its two sides are tied to each other at node {} of '{}' ({:.6g}, {:.6g}, {:.6g}) "
                    "through bonded interfaces ({}), so they cannot separate there",
                    surface.name(), surface.facing.side_1.main_node(i), problem_.substructures[surface.part_1]->name,
                    x[0], x[1], x[2], path));
  }

  // Sides of a law at a group: all of it where this is the group's only law, else the substructures that face each
  // other.
  std::vector<NodeKey> ports_of(const LawCluster& cluster, int group, int which) {
    if (n_laws_[group] == 1) return members_[group];
    std::vector<NodeKey> keys;
    for (const Member& member : cluster.members) {
      const NodeKey key = side(surfaces_[member.surface], member.point, which);
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
    }
    // One representative: the group's own point ties the others to it.
    keys.resize(1);
    return keys;
  }

  void add_law_point(LawCluster& cluster) {
    const bool is_wall = cluster.group_2 < 0;
    const std::vector<NodeKey> ports_1 = ports_of(cluster, cluster.group_1, 1);
    const std::vector<NodeKey> ports_2 = is_wall ? std::vector<NodeKey>{} : ports_of(cluster, cluster.group_2, 2);
    add_point(cluster.law, ports_1, ports_2, is_wall, cluster.normal.normalized(), cluster.area,
              std::move(cluster.members));
    const int index = static_cast<int>(exchange_.points.size()) - 1;
    for (const int group : {cluster.group_1, cluster.group_2})
      if (group >= 0 && n_laws_[group] == 1) point_of_group_[group] = index;
  }

  void add_point(const Law* law, const std::vector<NodeKey>& ports_1, const std::vector<NodeKey>& ports_2, bool is_wall,
                 const Vec3& normal, double area, std::vector<Member> members) {
    Point point;
    point.law = law;
    point.area = area;
    point.is_wall = is_wall;
    std::vector<NodeKey> keys = ports_1;
    keys.insert(keys.end(), ports_2.begin(), ports_2.end());
    point.frame = make_frame(normal, keys, law != nullptr, members);
    point.members = std::move(members);
    point.first_port = static_cast<int>(exchange_.ports.size());
    point.first_port_2 = point.first_port + static_cast<int>(ports_1.size());
    point.end_port = point.first_port + static_cast<int>(keys.size());
    const bool has_group = ports_1.size() > 1 || ports_2.size() > 1;
    for (const NodeKey& key : keys) exchange_.ports.push_back(make_port(key, point.frame));
    for (int d = 0; d < 3; ++d) point.has_law[d] = law && law->acts_on(d, step_.is_static);
    activate(exchange_.ports, has_group, point);
    exchange_.points.push_back(std::move(point));
  }

  Port make_port(const NodeKey& key, const Mat3& frame) const {
    Port port;
    std::tie(port.piece, port.piece_node) = key;
    port.part = part_of(key);
    port.node = node_of(key);
    port.is_owner = cut_.piece(port.piece).owns(port.piece_node);
    port.area = area_.at(key);
    if (const Held* held = conditions_.at(port.part, port.node))
      for (int d = 0; d < 3; ++d) {
        const auto directions = held->directions.leftCols(held->n);
        port.is_held[d] = (directions.transpose() * frame.col(d)).norm() > 0.999;
      }
    return port;
  }

  // A frame whose axes contain the held directions of every side: conditions are then per direction.
  Mat3 make_frame(const Vec3& normal, const std::vector<NodeKey>& keys, bool needs_normal,
                  const std::vector<Member>& members) const {
    std::vector<Vec3> axes;  // single held directions, or the single free one
    for (const NodeKey& key : keys) {
      const Held* held = conditions_.at(part_of(key), node_of(key));
      if (!held || held->n == 0 || held->n == 3) continue;
      axes.push_back(held->n == 1 ? Vec3(held->directions.col(0)) : Vec3(held->free_basis().col(0)));
    }
    const std::optional<Mat3> own_axes = axes_of(keys);
    Vec3 n = needs_normal || !own_axes ? normal : Vec3(own_axes->col(2));
    if (!needs_normal && !axes.empty()) n = axes.front();
    Vec3 t = Vec3::Zero();
    for (const Vec3& axis : axes) {
      const double along = std::abs(axis.dot(n));
      if (along > 0.99) {
        n = axis.dot(n) > 0.0 ? axis : Vec3(-axis);
      } else if (along < 0.2 && (t.isZero() || std::abs(axis.dot(t)) > 0.999 || std::abs(axis.dot(t)) < 1e-3)) {
        n = (n - axis.dot(n) * axis).normalized();
        if (t.isZero()) t = axis;
      } else {
        fail_oblique(members, keys.front(), n, axis);
      }
    }
    return frame_of(n, t, own_axes);
  }

  std::optional<Mat3> axes_of(const std::vector<NodeKey>& keys) const {
    std::vector<int> parts;
    for (const NodeKey& key : keys) parts.push_back(part_of(key));
    const Substructure& part = *problem_.substructures[parts.front()];
    return axes_.at(parts, part.mesh->nodes.col(node_of(keys.front())) + part.place);
  }

  [[noreturn]] void fail_oblique(const std::vector<Member>& members, const NodeKey& key, const Vec3& n,
                                 const Vec3& axis) const {
    const std::string what =
        members.empty() ? "bonded interfaces" : "interface '" + surfaces_[members.front().surface].name() + "'";
    throw InputError(fmt::format(
        "{} at node {} of '{}': the normal ({:.4f}, {:.4f}, {:.4f}) is neither along nor across the held direction "
        "({:.4f}, {:.4f}, {:.4f}) of a support or prescribed motion",
        what, node_of(key), problem_.substructures[part_of(key)]->name, n[0], n[1], n[2], axis[0], axis[1], axis[2]));
  }

  void add_ties() {
    for (size_t s = 0; s < surfaces_.size(); ++s) {
      const Surface& surface = surfaces_[s];
      if (surface.law || surface.part_2 < 0 || !matches(surface)) continue;
      for (int i = 0; i < surface.n_points(); ++i) {
        if (!reach_.has(static_cast<int>(s), i)) continue;
        const int index = point_of_group_.at(groups_.of(side(surface, i, 1)));
        const Point& point = exchange_.points[index];
        const auto port_of = [&](const NodeKey& key) {
          for (int p = point.first_port; p < point.end_port; ++p)
            if (NodeKey{exchange_.ports[p].piece, exchange_.ports[p].piece_node} == key) return p;
          return -1;
        };
        exchange_.ties.push_back(
            {index, port_of(side(surface, i, 1)), port_of(side(surface, i, 2)), static_cast<int>(s), i});
      }
    }
    std::stable_sort(exchange_.ties.begin(), exchange_.ties.end(),
                     [](const Tie& a, const Tie& b) { return a.point < b.point; });
    auto tie = exchange_.ties.begin();
    for (int i = 0; i < static_cast<int>(exchange_.points.size()); ++i) {
      exchange_.points[i].first_tie = static_cast<int>(tie - exchange_.ties.begin());
      tie = std::find_if(tie, exchange_.ties.end(), [i](const Tie& t) { return t.point != i; });
      exchange_.points[i].end_tie = static_cast<int>(tie - exchange_.ties.begin());
    }
  }

  const Problem& problem_;
  const Step& step_;
  const Cut& cut_;
  const std::vector<Surface>& surfaces_;
  const Conditions& conditions_;
  const std::vector<char>& explicit_pieces_;
  const Reach& reach_;
  const FrameAxes axes_;
  Exchange exchange_;
  NodeGroups groups_;
  std::map<NodeKey, double> area_;
  std::map<int, std::vector<NodeKey>> members_;
  std::map<int, int> n_laws_;
  std::map<int, int> point_of_group_;
  std::vector<LawCluster> clusters_;
};

}  // namespace

std::vector<int> piece_nodes(const Cut& cut, const Port& port) {
  if (!port.trace) return {port.piece_node};
  std::vector<int> nodes;
  port.for_each_node([&](int node, const Mat3& /*block*/) { nodes.push_back(cut.owner(port.part, node).node); });
  return nodes;
}

void spread(const Cut& cut, const Port& port, const Vec3& force, Points& on_piece) {
  port.for_each_node(
      [&](int node, const Mat3& block) { on_piece.col(cut.owner(port.part, node).node) += block.transpose() * force; });
}

Exchange make_exchange(const Problem& problem, const Step& step, const Cut& cut, const std::vector<Surface>& surfaces,
                       const Conditions& conditions, const std::vector<char>& explicit_pieces, const Reach& reach) {
  Exchange exchange = Builder(problem, step, cut, surfaces, conditions, explicit_pieces, reach).build();
  exchange.ports.shrink_to_fit();
  exchange.points.shrink_to_fit();
  exchange.ties.shrink_to_fit();
  return exchange;
}

}  // namespace dygita
