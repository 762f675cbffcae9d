#include "meeting/facing.hpp"

#include <spdlog/fmt/fmt.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

#include "base/error.hpp"
#include "meeting/overlap.hpp"
#include "mesh/box_grid.hpp"
#include "mesh/smooth_patches.hpp"

namespace dygita {

namespace {

// Nodes of one face at their place in space; `index` numbers them from 0 in the order of `nodes`.
struct FaceByNode {
  std::vector<int> nodes;
  Points x;
  std::unordered_map<int, int> index;

  explicit FaceByNode(const PlacedFace& face) : nodes(nodes_of(face.facets)), x(3, nodes.size()) {
    for (size_t i = 0; i < nodes.size(); ++i) {
      x.col(static_cast<long>(i)) = face.mesh->nodes.col(nodes[i]) + face.place;
      index[nodes[i]] = static_cast<int>(i);
    }
  }

  Polygon polygon(const Facet& facet) const {
    const std::span<const int> corners = facet.corners();
    Polygon places(3, corners.size());
    for (size_t a = 0; a < corners.size(); ++a) places.col(static_cast<long>(a)) = x.col(index.at(corners[a]));
    return places;
  }
};

double smallest_edge(const FaceByNode& face, const std::vector<Facet>& facets) {
  double smallest = std::numeric_limits<double>::max();
  for (const Facet& facet : facets) {
    const std::span<const int> rim = facet_shape(facet.type()).rim;
    for (size_t a = 0; a < rim.size(); ++a) {
      const int i = face.index.at(facet.nodes()[rim[a]]), j = face.index.at(facet.nodes()[rim[(a + 1) % rim.size()]]);
      smallest = std::min(smallest, (face.x.col(i) - face.x.col(j)).norm());
    }
  }
  return smallest;
}

// Points by the cell of a regular grid they lie in; the cells are as large as the smallest edge, so each holds few.
class PointGrid {
 public:
  PointGrid(const Points& points, double cell) : points_(points), grid_(cell) {
    for (int i = 0; i < points.cols(); ++i) grid_.add({points.col(i), points.col(i)}, i);
  }

  // The nearest point within `tolerance` of x, or -1.
  int nearest(const Vec3& x, double tolerance) const {
    int best = -1;
    double best_distance = tolerance;
    grid_.for_each_near(Box{x, x}.grown(tolerance), [&](int candidate) {
      const double d = (points_.col(candidate) - x).norm();
      if (d > best_distance) return;
      best = candidate;
      best_distance = d;
    });
    return best;
  }

 private:
  const Points& points_;
  CellGrid grid_;
};

std::string at(const Vec3& x) { return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", x[0], x[1], x[2]); }

// Both faces with their nodes in space.
struct Pair {
  const PlacedFace &side_1, &side_2;
  FaceByNode in_space_1, in_space_2;
};

// Node of side 1 at the place of each node of side 2 that has one.
std::unordered_map<int, int> partners_on_side_1(const Pair& pair) {
  const double edge =
      std::min(smallest_edge(pair.in_space_1, pair.side_1.facets), smallest_edge(pair.in_space_2, pair.side_2.facets));
  const PointGrid grid(pair.in_space_1.x, edge);
  std::unordered_map<int, int> partners;
  for (size_t i = 0; i < pair.in_space_2.nodes.size(); ++i) {
    const int found = grid.nearest(pair.in_space_2.x.col(static_cast<long>(i)), 1e-6 * edge);
    if (found >= 0) partners[pair.in_space_2.nodes[i]] = pair.in_space_1.nodes[found];
  }
  return partners;
}

// The facet with each node replaced by its partner, if all have one.
std::optional<Facet> translate(const Facet& facet, const std::unordered_map<int, int>& partners) {
  Facet translated = facet;
  for (int& node : translated.nodes()) {
    const auto found = partners.find(node);
    if (found == partners.end()) return {};
    node = found->second;
  }
  return translated;
}

// Facets of side 1 with the same corners as one of side 2, and what is left over on both sides.
struct Matching {
  std::vector<Facet> matched, left_1, left_2;
  std::unordered_map<int, int> partner;  // node of side 1 -> node of side 2
  std::vector<Facet> same_way;           // matched facets of side 1 whose normal is the partner's
};

void add_partners(const Pair& pair, const Facet& facet_2, const Facet& translated, Matching& matching) {
  for (size_t a = 0; a < facet_2.nodes().size(); ++a) {
    const int node_1 = translated.nodes()[a], node_2 = facet_2.nodes()[a];
    const auto [known, is_new] = matching.partner.emplace(node_1, node_2);
    if (is_new || known->second == node_2) continue;
    const Vec3 place = pair.in_space_1.x.col(pair.in_space_1.index.at(node_1));
    throw InputError(
        fmt::format("faces '{}' and '{}': '{}' has two nodes at {}, so the interface cannot distinguish them",
                    pair.side_1.name, pair.side_2.name, pair.side_2.name, at(place)));
  }
}

Matching match(const Pair& pair) {
  struct Candidate {
    const Facet* facet;
    Facet translated;
    bool is_taken = false;
  };
  const std::unordered_map<int, int> partners = partners_on_side_1(pair);
  std::unordered_map<FacetKey, Candidate, FacetKeyHash> of_side_2;
  Matching result;
  for (const Facet& facet : pair.side_2.facets) {
    if (const std::optional<Facet> translated = translate(facet, partners))
      of_side_2.emplace(facet_key(*translated), Candidate{&facet, *translated});
    else
      result.left_2.push_back(facet);
  }

  for (const Facet& facet : pair.side_1.facets) {
    const auto found = of_side_2.find(facet_key(facet));
    if (found == of_side_2.end() || found->second.facet->type() != facet.type()) {  // as quad8 on quad9
      result.left_1.push_back(facet);
      continue;
    }
    Candidate& other = found->second;
    if (std::exchange(other.is_taken, true)) continue;  // side 1 lists the facet twice
    result.matched.push_back(facet);
    add_partners(pair, *other.facet, other.translated, result);
    const Vec3 area_1 = facet_area_vector(pair.side_1.mesh->nodes, facet);
    if (area_1.dot(facet_area_vector(pair.side_2.mesh->nodes, *other.facet)) > 0) result.same_way.push_back(facet);
  }
  for (const auto& [key, candidate] : of_side_2)
    if (!candidate.is_taken) result.left_2.push_back(*candidate.facet);
  return result;
}

void refuse_same_orientation(const Pair& pair, const Matching& matching) {
  if (matching.same_way.empty()) return;
  const Vec3 place = pair.in_space_1.polygon(matching.same_way.front()).rowwise().mean();
  throw InputError(fmt::format(
      "faces '{}' and '{}' coincide on {} facets, the first at {}, but both have their bodies on the same "
      "side: the bodies overlap\n    check the places of both bodies, or whether the opposite end face was meant",
      pair.side_1.name, pair.side_2.name, matching.same_way.size(), at(place)));
}

bool overlaps(const Pair& pair, const Matching& matching) {
  const auto polygons = [](const FaceByNode& face, const std::vector<Facet>& facets) {
    std::vector<Polygon> corners;
    for (const Facet& facet : facets) corners.push_back(face.polygon(facet));
    return corners;
  };
  return find_overlap(polygons(pair.in_space_1, matching.left_1), polygons(pair.in_space_2, matching.left_2))
      .has_value();
}

std::vector<Facet> renumbered(const std::vector<Facet>& facets, const std::unordered_map<int, int>& number) {
  std::vector<Facet> result = facets;
  for (Facet& facet : result)
    for (int& node : facet.nodes()) node = number.at(node);
  return result;
}

}  // namespace

std::vector<PlacedFace> smooth_parts(const PlacedFace& face) {
  std::vector<Vec3> normals;
  for (const Facet& facet : face.facets) normals.push_back(facet_area_vector(face.mesh->nodes, facet).normalized());
  const std::vector<int> patch = smooth_patches(face.facets, normals);
  std::map<int, PlacedFace> parts;
  for (size_t i = 0; i < patch.size(); ++i)
    parts.try_emplace(patch[i], PlacedFace{face.mesh, {}, face.place, face.name})
        .first->second.facets.push_back(face.facets[i]);
  std::vector<PlacedFace> all;
  for (auto& [root, part] : parts) all.push_back(std::move(part));
  return all;
}

Facing joined(const std::vector<Facing>& parts) {
  Eigen::Index n = 0;
  for (const Facing& part : parts) n += part.n_points();
  Facing all;
  all.places = all.normals = Points(3, n);
  all.areas = all.gaps = Vec(n);
  all.carrier = parts.front().carrier;
  int first = 0;
  for (const Facing& part : parts) {
    const int n_own = part.n_points();
    all.facets_1.insert(all.facets_1.end(), part.facets_1.begin(), part.facets_1.end());
    all.facets_2.insert(all.facets_2.end(), part.facets_2.begin(), part.facets_2.end());
    all.side_1.append(part.side_1);
    all.side_2.append(part.side_2);
    all.places.middleCols(first, n_own) = part.places;
    all.normals.middleCols(first, n_own) = part.normals;
    all.areas.segment(first, n_own) = part.areas;
    all.gaps.segment(first, n_own) = part.gaps;
    for (Facet facet : part.facets) {
      for (int& node : facet.nodes()) node += first;
      all.facets.push_back(facet);
    }
    all.size_ratio = std::max(all.size_ratio, part.size_ratio);
    all.sagitta = std::max(all.sagitta, part.sagitta);
    all.n_merged += part.n_merged;
    first += n_own;
  }
  return all;
}

namespace {

// Areas of points that go (number < 0), to those that stay on the same facets.
Vec handed_on(const Facing& facing, const std::vector<int>& number) {
  Vec areas = facing.areas;
  std::vector<std::set<int>> heirs(number.size());
  for (const Facet& facet : facing.facets)
    for (const int gone : facet.nodes())
      if (number[static_cast<size_t>(gone)] < 0)
        for (const int node : facet.nodes())
          if (number[static_cast<size_t>(node)] >= 0) heirs[static_cast<size_t>(gone)].insert(node);
  for (size_t i = 0; i < heirs.size(); ++i)
    for (const int heir : heirs[i])
      areas[heir] += facing.areas[static_cast<Eigen::Index>(i)] / static_cast<double>(heirs[i].size());
  return areas;
}

}  // namespace

Facing without(const Facing& facing, const std::function<bool(const Vec3&)>& is_taken_away) {
  std::vector<int> kept, number(static_cast<size_t>(facing.n_points()), -1), nodes_1, nodes_2;
  for (int i = 0; i < facing.n_points(); ++i) {
    if (is_taken_away && is_taken_away(facing.places.col(i))) continue;
    number[static_cast<size_t>(i)] = static_cast<int>(kept.size());
    kept.push_back(i);
    nodes_1.push_back(facing.side_1.main_node(i));
    nodes_2.push_back(facing.side_2.main_node(i));
  }
  Facing rest = facing;
  rest.side_1 = SideTrace(nodes_1);
  rest.side_2 = SideTrace(nodes_2);
  rest.places = facing.places(Eigen::all, kept);
  rest.normals = facing.normals(Eigen::all, kept);
  rest.areas = handed_on(facing, number)(kept);
  rest.gaps = facing.gaps(kept);
  std::erase_if(rest.facets, [&](Facet& facet) {
    bool is_whole = true;
    for (int& node : facet.nodes()) is_whole = (node = number[static_cast<size_t>(node)]) >= 0 && is_whole;
    return !is_whole;
  });
  return rest;
}

void refuse_apart(const PlacedFace& side_1, const PlacedFace& side_2) {
  const Points x_1 = FaceByNode(side_1).x, x_2 = FaceByNode(side_2).x;
  const Vec3 low_1 = x_1.rowwise().minCoeff(), high_1 = x_1.rowwise().maxCoeff();
  const Vec3 low_2 = x_2.rowwise().minCoeff(), high_2 = x_2.rowwise().maxCoeff();
  const double distance = (low_2 - high_1).cwiseMax(low_1 - high_2).cwiseMax(0).norm();
  const std::string &name_1 = side_1.name, &name_2 = side_2.name;
  throw InputError(
      fmt::format("faces '{}' and '{}' do not meet: no facet of one lies on a facet of the other; their bounding boxes "
                  "are {:.3g} m apart\n    '{}' spans {} to {}\n    '{}' spans {} to {}",
                  name_1, name_2, distance, name_1, at(low_1), at(high_1), name_2, at(low_2), at(high_2)));
}

namespace {

// All nodes of a point are of one rigid face or of none: a face's facets are.
const Interior::Follower* follower_at(const Interior& body, const SideTrace& trace, int i) {
  const Interior::Follower* first = body.follower(trace.share(i, 0).node);
  for (int k = 0; k < trace.n_shares(i); ++k) {
    const Interior::Follower* own = body.follower(trace.share(i, k).node);
    if ((own ? own->point : -1) != (first ? first->point : -1))
      throw InputError(
          "a point of it would move with two faces that a superelement has as a whole each\n    condense "
          "the body with motion = \"nodes\"");
  }
  return first;
}

bool follow(const Mesh& mesh, const Vec3& place, const Points& places, SideTrace& trace) {
  const Interior& body = *mesh.inside;
  if (body.followers.empty()) return false;
  SideTrace followed;
  bool has_followers = false;
  for (int i = 0; i < trace.n_points(); ++i) {
    const Interior::Follower* own = follower_at(body, trace, i);
    if (!own) {
      std::vector<SideTrace::Share> shares;
      for (int k = 0; k < trace.n_shares(i); ++k) shares.push_back(trace.share(i, k));
      followed.add(shares, trace.turn(i));
      continue;
    }
    has_followers = true;
    // Rotation x arm is -arm x rotation.
    const Vec3 arm = (places.col(i) - place - mesh.nodes.col(own->point)) / own->size;
    if (own->turn < 0)
      followed.add({{own->point, 1.0}});
    else
      followed.add({{own->point, 1.0}, {own->turn, 0.0, arm}}, -Mat3::Identity());
  }
  if (has_followers) trace = std::move(followed);
  return has_followers;
}

}  // namespace

void follow_rigid_faces(const Mesh* mesh_1, const Vec3& place_1, const Mesh* mesh_2, const Vec3& place_2,
                        Facing& facing) {
  const bool first = mesh_1 && follow(*mesh_1, place_1, facing.places, facing.side_1);
  const bool second = mesh_2 && follow(*mesh_2, place_2, facing.places, facing.side_2);
  if (!first && !second) return;
  // Points that were nodes of both sides are those of the side that still has them.
  if (facing.carrier == 0 || (facing.carrier == 1 && first && !second) || (facing.carrier == 2 && second && !first))
    facing.carrier = first && mesh_2 ? 2 : 1;
}

Facing facing_of(const PlacedFace& face) {
  FaceNodes points = face_nodes(*face.mesh, face.facets);
  Facing facing;
  std::unordered_map<int, int> number;
  facing.places.resize(3, static_cast<Eigen::Index>(points.nodes.size()));
  for (size_t i = 0; i < points.nodes.size(); ++i) {
    number[points.nodes[i]] = static_cast<int>(i);
    facing.places.col(static_cast<Eigen::Index>(i)) = face.mesh->nodes.col(points.nodes[i]) + face.place;
  }
  facing.facets_1 = face.facets;
  facing.facets = renumbered(face.facets, number);
  facing.side_1 = SideTrace(points.nodes);
  facing.areas = std::move(points.areas);
  facing.normals = std::move(points.normals);
  facing.gaps = Vec::Zero(facing.areas.size());
  return facing;
}

std::optional<Facing> match_faces(const PlacedFace& side_1, const PlacedFace& side_2) {
  for (const PlacedFace* side : {&side_1, &side_2})
    if (side->facets.empty()) throw InputError(fmt::format("face '{}' has no facet", side->name));
  const Pair pair{side_1, side_2, FaceByNode(side_1), FaceByNode(side_2)};

  Matching matching = match(pair);
  refuse_same_orientation(pair, matching);
  if (matching.matched.empty() || overlaps(pair, matching)) return {};

  PlacedFace common = side_1;
  common.facets = std::move(matching.matched);
  Facing facing = facing_of(common);
  facing.facets_2 = renumbered(facing.facets_1, matching.partner);
  std::vector<int> nodes_2;
  for (int i = 0; i < facing.n_points(); ++i) nodes_2.push_back(matching.partner.at(facing.side_1.main_node(i)));
  facing.side_2 = SideTrace(nodes_2);
  return facing;
}

}  // namespace dygita
