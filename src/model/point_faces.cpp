#include "model/point_faces.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <limits>

#include "base/error.hpp"
#include "base/log.hpp"

namespace dygita {

namespace {

constexpr double usual_reach = 1e-4;  // of the face's size

struct Nearest {
  int point = -1;
  double distance = std::numeric_limits<double>::infinity();
};

Nearest nearest_point(const Face& face, const Vec3& x) {
  Nearest nearest;
  for (const int point : face.part->mesh->point_groups.at(face.group)) {
    const double distance = (face.part->mesh->nodes.col(point) + face.part->place - x).norm();
    if (distance < nearest.distance) nearest = {point, distance};
  }
  return nearest;
}

// The other way round, as seen from the other side: corners, then the nodes between them.
Facet turned_round(const Facet& facet, const std::vector<int>& points) {
  const std::span<const int> rim = facet_shape(facet.type()).rim;
  const auto n = static_cast<int>(points.size()), n_rim = static_cast<int>(rim.size());
  std::vector<int> nodes = points;
  for (int k = 0; k < n_rim; ++k) nodes[rim[k]] = points[rim[(n_rim - k) % n_rim]];
  CHECK(n >= n_rim, "a rim is of the facet's nodes");
  return {facet.type(), nodes};
}

}  // namespace

bool is_of_points(const Face& face) { return !face.picked && face.part->mesh->point_groups.contains(face.group); }

Region region_of_points(const Face& face) { return {face.part, face.part->mesh->point_groups.at(face.group)}; }

Face with_facets(const Face& face, const Face& other, const std::optional<double>& within) {
  if (!is_of_points(face)) return face;
  if (is_of_points(other))
    throw InputError(fmt::format("'{}' and '{}' are both given by points alone: one of the two faces must have facets",
                                 face.label(), other.label()));
  const Points& x = other.part->mesh->nodes;
  const std::vector<int> nodes = nodes_of(other.facets());
  const Points on_face = x(Eigen::all, nodes);
  const double size = (on_face.rowwise().maxCoeff() - on_face.rowwise().minCoeff()).norm();
  const double reach = within.value_or(usual_reach * size);
  std::vector<int> point_of(static_cast<size_t>(x.cols()), -1);
  int n_found = 0;
  Nearest closest;
  for (const int node : nodes) {
    const Nearest nearest = nearest_point(face, x.col(node) + other.part->place);
    if (nearest.distance < closest.distance) closest = nearest;
    if (nearest.distance > reach) continue;
    if (std::find(point_of.begin(), point_of.end(), nearest.point) != point_of.end())
      throw InputError(fmt::format(
          "'{}' and '{}': two nodes lie within {:.3g} mm of one point\n    a smaller 'within' distinguishes them",
          face.label(), other.label(), 1e3 * reach));
    point_of[static_cast<size_t>(node)] = nearest.point;
    ++n_found;
  }
  auto facets = std::make_shared<std::vector<Facet>>();
  for (const Facet& facet : other.facets()) {
    std::vector<int> points;
    for (const int node : facet.nodes()) points.push_back(point_of[static_cast<size_t>(node)]);
    if (std::find(points.begin(), points.end(), -1) != points.end()) continue;
    facets->push_back(turned_round(facet, points));
  }
  if (facets->empty())
    throw InputError(
        fmt::format("'{}' is given by {} points, and no facet of '{}' has one at each of its nodes: {} of its {} nodes "
                    "have a point "
                    "within {:.3g} mm, the nearest is {:.3g} mm off\n    points must coincide with nodes of the "
                    "attached mesh: check 'place' and units; 'within' sets how far apart they may be",
                    face.label(), face.part->mesh->point_groups.at(face.group).size(), other.label(), n_found,
                    nodes.size(), 1e3 * reach, 1e3 * closest.distance));
  const size_t n_points = face.part->mesh->point_groups.at(face.group).size(), n_joined = nodes_of(*facets).size();
  if (n_joined < n_points || facets->size() < other.facets().size())
    warn(
        fmt::format("'{}' and '{}': {} of {} points lie at nodes of {} of {} facets; facets without a point at each "
                    "node are not joined",
                    face.label(), other.label(), n_joined, n_points, facets->size(), other.facets().size()));
  return {face.part, face.group, facets};
}

}  // namespace dygita
