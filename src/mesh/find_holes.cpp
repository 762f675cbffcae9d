#include "mesh/find_holes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "base/union_find.hpp"
#include "mesh/face_nodes.hpp"
#include "mesh/smooth_patches.hpp"
#include "numerics/dense.hpp"

namespace dygita {

namespace {

const double parallel = std::cos(1.0 * M_PI / 180.0);
// Of a circle of five cells, not of a square. Triangles between rims whose nodes are not above each other lean.
const double least_cosine_around = std::cos(80.0 * M_PI / 180.0), most_leaning = std::sin(25.0 * M_PI / 180.0);
constexpr double of_radius = 0.02;
constexpr int most_axes = 100;

struct Boundary {
  Points x;  // m
  std::vector<Facet> facets;
  std::vector<Vec3> normals;                  // unit, outward
  std::vector<std::pair<int, int>> adjacent;  // facets with a common edge
};

Boundary boundary_of(const Mesh& mesh, const Vec3& place) {
  Boundary b{mesh.nodes.colwise() + place, boundary_facets(mesh), {}, {}};
  std::map<std::pair<int, int>, std::vector<int>> at_edge;
  for (size_t f = 0; f < b.facets.size(); ++f) {
    b.normals.push_back(facet_area_vector(b.x, b.facets[f]).normalized());
    const std::span<const int> corners = b.facets[f].corners();
    for (size_t k = 0; k < corners.size(); ++k)
      at_edge[std::minmax(corners[k], corners[(k + 1) % corners.size()])].push_back(static_cast<int>(f));
  }
  for (const auto& [edge, both] : at_edge)
    if (both.size() == 2) b.adjacent.emplace_back(both[0], both[1]);
  return b;
}

// Normals of the faces that are plane or bent a little, as on a panel; the largest first, each direction once.
std::vector<Vec3> normals_of_faces(const Boundary& b) {
  struct Plane {
    Vec3 area = Vec3::Zero();
    double sum = 0.0;
  };
  const std::vector<int> patch = smooth_patches(b.facets, b.normals);
  std::map<int, Plane> planes;
  for (size_t f = 0; f < patch.size(); ++f) {
    const Vec3 area = facet_area_vector(b.x, b.facets[f]);
    planes[patch[f]].area += area;
    planes[patch[f]].sum += area.norm();
  }
  std::vector<Plane> flat;
  for (const auto& [number, plane] : planes)
    if (plane.area.norm() > 0.98 * plane.sum) flat.push_back(plane);
  std::stable_sort(flat.begin(), flat.end(), [](const Plane& p, const Plane& q) { return p.sum > q.sum; });
  std::vector<Vec3> axes;
  for (const Plane& plane : flat) {
    const Vec3 normal = plane.area.normalized();
    const bool is_new = std::none_of(axes.begin(), axes.end(),
                                     [&](const Vec3& known) { return std::abs(known.dot(normal)) > parallel; });
    if (is_new && static_cast<int>(axes.size()) < most_axes) axes.push_back(normal);
  }
  return axes;
}

// Facets along the axis, by what is connected around it.
std::map<int, std::vector<int>> sleeves_along(const Boundary& b, const Vec3& axis) {
  const auto is_along = [&](int f) { return std::abs(b.normals[f].dot(axis)) < most_leaning; };
  UnionFind together(static_cast<int>(b.facets.size()));
  for (const auto& [f, g] : b.adjacent)
    if (is_along(f) && is_along(g) && b.normals[f].dot(b.normals[g]) > least_cosine_around) together.join(f, g);
  std::map<int, std::vector<int>> sleeves;
  for (int f = 0; f < static_cast<int>(b.facets.size()); ++f)
    if (is_along(f)) sleeves[together.root(f)].push_back(f);
  return sleeves;
}

// A circle in the plane across an axis.
struct Circle {
  double p = 0.0, q = 0.0, radius = 0.0;  // m, along u and v
};

// Through points (u, v), by least squares.
Circle circle_through(const Mat& points) {
  Mat system(points.rows(), 3);
  system << points, Vec::Ones(points.rows());
  const Vec3 x = solve_least_norm(system, points.rowwise().squaredNorm(), 1e-15).x;
  const double p = 0.5 * x[0], q = 0.5 * x[1];
  return {p, q, std::sqrt(std::max(0.0, x[2] + p * p + q * q))};
}

// The corners of facets around an axis: along u, v and the axis.
struct Sleeve {
  Sleeve(const Points& corners, const Vec3& along) : axis(along), u(along.unitOrthogonal()), v(along.cross(u)) {
    Mat3 frame;
    frame << u, v, axis;
    at = corners.transpose() * frame;
    circle = circle_through(at.leftCols(2));
    for (Eigen::Index i = 0; i < at.rows(); ++i)
      off = std::max(off, std::abs(std::hypot(at(i, 0) - circle.p, at(i, 1) - circle.q) - circle.radius));
    off /= circle.radius;
  }
  // From the middle of one rim to that of the other.
  Vec3 better_axis() const {
    const double middle = 0.5 * (at.col(2).minCoeff() + at.col(2).maxCoeff());
    std::array<Vec3, 2> centre;
    for (const bool is_high : {false, true}) {
      std::vector<Eigen::Index> rows;
      double height = 0.0;
      for (Eigen::Index i = 0; i < at.rows(); ++i)
        if ((at(i, 2) > middle) == is_high) rows.push_back(i);
      if (rows.size() < 3) return axis;
      for (const Eigen::Index i : rows) height += at(i, 2) / static_cast<double>(rows.size());
      const Circle rim = circle_through(at(rows, {0, 1}));
      centre[is_high] = rim.p * u + rim.q * v + height * axis;
    }
    return (centre[1] - centre[0]).normalized();
  }

  Vec3 axis, u, v;
  Mat at;
  Circle circle;
  double off = 0.0;  // of the radius
};

// A hole that facets may be, the better the less they are off its circle.
struct Found {
  Hole hole;
  std::vector<int> facets;
  double off;
};

// Nothing: not one circle, not all around, or a pin.
std::optional<Found> hole_of(const Boundary& b, const Vec3& near_by, const std::vector<int>& facets) {
  if (facets.size() < 3) return std::nullopt;
  std::set<int> nodes;  // of corners: those in the middle of edges may be on the chord
  for (const int f : facets) nodes.insert(b.facets[f].corners().begin(), b.facets[f].corners().end());
  const Points corners = b.x(Eigen::all, std::vector<int>(nodes.begin(), nodes.end()));
  Sleeve sleeve(corners, near_by);
  for (int i = 0; i < 5 && sleeve.off < 1.0; ++i) {
    const Sleeve better(corners, sleeve.better_axis());
    if (!(better.off < sleeve.off)) break;
    sleeve = better;
  }
  if (!(sleeve.off < of_radius) || std::abs(sleeve.axis.dot(near_by)) < std::cos(most_leaning)) return std::nullopt;
  const Circle& circle = sleeve.circle;
  std::array<bool, 3> is_there{};  // thirds of the circle
  for (Eigen::Index i = 0; i < sleeve.at.rows(); ++i) {
    const double angle = std::atan2(sleeve.at(i, 1) - circle.q, sleeve.at(i, 0) - circle.p);
    is_there[static_cast<size_t>(std::min(2.0, 1.5 * (1.0 + angle / M_PI)))] = true;
  }
  Vec3 around = Vec3::Zero();  // of a closed sleeve nothing is left across its axis
  double area = 0.0, outwards = 0.0;
  const Vec3 centre = circle.p * sleeve.u + circle.q * sleeve.v;
  for (const int f : facets) {
    const Vec3 of_facet = facet_area_vector(b.x, b.facets[f]);
    const Vec3 across = of_facet - sleeve.axis * sleeve.axis.dot(of_facet);
    around += across;
    area += across.norm();
    outwards += across.dot(b.x.col(b.facets[f].corners()[0]) - centre);
  }
  const bool is_all_around = is_there[0] && is_there[1] && is_there[2] && around.norm() < 0.1 * area;
  if (!is_all_around || outwards > 0.0) return std::nullopt;
  const Hole hole{centre + sleeve.at.col(2).minCoeff() * sleeve.axis,
                  centre + sleeve.at.col(2).maxCoeff() * sleeve.axis, circle.radius};
  return Found{hole, facets, sleeve.off};
}

}  // namespace

std::vector<Hole> find_holes(const Mesh& mesh, const Vec3& place) {
  const Boundary b = boundary_of(mesh, place);
  std::vector<Found> all;
  for (const Vec3& axis : normals_of_faces(b))
    for (const auto& [root, facets] : sleeves_along(b, axis))
      if (auto found = hole_of(b, axis, facets)) all.push_back(std::move(*found));
  std::stable_sort(all.begin(), all.end(), [](const Found& a, const Found& c) { return a.off < c.off; });
  std::vector<Hole> holes;
  std::vector<char> is_taken(b.facets.size(), 0);
  for (const Found& found : all) {
    if (std::any_of(found.facets.begin(), found.facets.end(), [&](int f) { return is_taken[f] != 0; })) continue;
    for (const int f : found.facets) is_taken[f] = 1;
    holes.push_back(found.hole);
  }
  return holes;
}

}  // namespace dygita
