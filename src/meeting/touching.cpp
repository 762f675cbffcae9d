#include "meeting/touching.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "base/parallel.hpp"
#include "meeting/facet_parts.hpp"
#include "meeting/segments.hpp"
#include "mesh/box_grid.hpp"
#include "mesh/smooth_patches.hpp"

namespace dygita {

namespace {

constexpr double of_facet = 0.01;       // the default of `within`, of the usual facet
constexpr double of_bend = 0.3;         // how well the bulge of a facet is known, of the bulge
constexpr double least_opposed = 0.8;   // cosine between a normal and the opposite of the other
constexpr double least_covered = 1e-3;  // of a facet's area, or of a smaller one's on it, to take part
constexpr double largest_bulge = 0.3;   // of a facet's size

// A smooth surface of a outside, as far as it may touch the other body.
struct SmoothPatch {
  std::vector<int> facets;  // of the outside
  FaceInSpace face;
  std::vector<double> bulges;  // m, of each part: mean height of the round surface over it, negative in a hole
  double bend = 0.0;           // m, largest height over an edge
  Box box;

  SmoothPatch(const Outside& outside, std::vector<int> members)
      : facets(std::move(members)), face(placed_face(outside, facets)), bulges(face.parts.size(), 0.0) {
    const Eigen::Index n = face.x.cols();
    Points normals = Points::Zero(3, n), centres = Points::Zero(3, n);  // of the parts around a node, on average
    Vec areas = Vec::Zero(n);
    for_each_corner([&](const FaceInSpace::Part& part, int, int node, int) {
      normals.col(node) += part.area * part.normal;
      centres.col(node) += part.area * part.centre;
      areas[node] += part.area;
    });
    for (Eigen::Index i = 0; i < n; ++i) {
      normals.col(i).normalize();
      centres.col(i) /= areas[i];
    }
    // Over an edge the surface rises by e . (n_end - n_begin) / 8, as over a chord, the normals being those at the two
    // centres, which at the rim of the surface are not the edge's ends. With these heights in the middles of its edges,
    // a triangle or a quadrangle has a third of their sum on average.
    for_each_corner([&](const FaceInSpace::Part& part, int p, int node, int next) {
      const Vec3 edge = face.x.col(next) - face.x.col(node);
      const double apart = edge.dot(centres.col(next) - centres.col(node)) / edge.squaredNorm();
      const double height = edge.dot(normals.col(next) - normals.col(node)) / 8.0 / std::clamp(apart, 0.3, 2.0);
      bulges[static_cast<size_t>(p)] += height / 3.0;
      bend = std::max(bend, std::min(std::abs(height), largest_bulge * std::sqrt(part.area)));
    });
    for (Eigen::Index i = 0; i < face.x.cols(); ++i) box.add(face.x.col(i));
  }

 private:
  static PlacedFace placed_face(const Outside& outside, const std::vector<int>& members) {
    PlacedFace face{outside.mesh, {}, outside.place, ""};
    for (const int f : members) face.facets.push_back(outside.facets[static_cast<size_t>(f)]);
    return face;
  }

  template <typename Visit>
  void for_each_corner(Visit visit) const {
    for (size_t p = 0; p < face.parts.size(); ++p) {
      const FaceInSpace::Part& part = face.parts[p];
      const std::vector<int>& nodes = face.facets[static_cast<size_t>(part.facet)];
      const FacetPart& shape =
          facet_parts(face.types[static_cast<size_t>(part.facet)]).parts[static_cast<size_t>(part.k)];
      for (int a = 0; a < shape.n; ++a)
        visit(part, static_cast<int>(p), nodes[shape.nodes[a]], nodes[shape.nodes[(a + 1) % shape.n]]);
    }
  }
};

// Of some facets, of all where there are none.
double median_size(const Outside& outside, const std::vector<int>& facets) {
  std::vector<double> sizes;
  if (facets.empty()) sizes = outside.sizes;
  for (const int f : facets) sizes.push_back(outside.sizes[static_cast<size_t>(f)]);
  const auto middle = sizes.begin() + static_cast<long>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle;
}

Box box_of(const Outside& outside) {
  Box box;
  for (size_t f = 0; f < outside.facets.size(); ++f) {
    box.add(outside.low[f]);
    box.add(outside.high[f]);
  }
  return box;
}

// Facets near the other's box: no farther than `within` and a bulge.
std::vector<int> near_facets(const Outside& outside, const Box& other, double within, const FacetKeys& taken) {
  std::vector<int> near;
  for (size_t f = 0; f < outside.facets.size(); ++f) {
    const double reach = within + largest_bulge * outside.sizes[f];
    if (Box{outside.low[f], outside.high[f]}.grown(reach).meets(other) && !taken.contains(facet_key(outside.facets[f])))
      near.push_back(static_cast<int>(f));
  }
  return near;
}

std::vector<SmoothPatch> patches_of(const Outside& outside, const std::vector<int>& near) {
  std::map<int, std::vector<int>> members;
  for (const int f : near) members[outside.patch[static_cast<size_t>(f)]].push_back(f);
  std::vector<SmoothPatch> patches;
  for (auto& [number, facets] : members) patches.emplace_back(outside, std::move(facets));
  return patches;
}

// What two smooth surfaces have in common.
struct CommonArea {
  double area = 0.0, apart = 0.0;  // m^2; m, mean distance of the round surfaces
  double least = 1e300, most = -1e300;
  struct Covered {
    double area = 0.0, by = 0.0;  // m^2; that of the largest facet on it
    void add(double common, double other) {
      area += common;
      by = std::max(by, other);
    }
  };
  std::map<int, Covered> covered_1, covered_2;  // by facet of the outside
};

CommonArea common_of(const SmoothPatch& one, const SmoothPatch& other, double reach) {
  const SegmentFinder finder(one.face, other.face, reach);
  std::vector<std::vector<Segment>> segments(one.face.parts.size());
  parallel_for(static_cast<int>(segments.size()),
               [&](int p) { segments[static_cast<size_t>(p)] = finder.segments(p); });
  CommonArea common;
  for (size_t p = 0; p < segments.size(); ++p)
    for (const Segment& segment : segments[p]) {
      const FaceInSpace::Part &part_1 = one.face.parts[p],
                              &part_2 = other.face.parts[static_cast<size_t>(segment.other)];
      if (-part_1.normal.dot(part_2.normal) < least_opposed) continue;
      common.area += segment.area;
      common.apart += segment.area * (segment.gap - one.bulges[p] - other.bulges[static_cast<size_t>(segment.other)]);
      common.least = std::min(common.least, segment.gap);
      common.most = std::max(common.most, segment.gap);
      common.covered_1[one.facets[static_cast<size_t>(part_1.facet)]].add(segment.area, part_2.area);
      common.covered_2[other.facets[static_cast<size_t>(part_2.facet)]].add(segment.area, part_1.area);
    }
  if (common.area > 0.0) common.apart /= common.area;
  return common;
}

// Facets of which enough is covered.
std::vector<int> well_covered(const Outside& outside, const std::map<int, CommonArea::Covered>& covered) {
  std::vector<int> facets;
  for (const auto& [f, by] : covered)
    if (by.area > least_covered * std::min(std::pow(outside.sizes[static_cast<size_t>(f)], 2), by.by))
      facets.push_back(f);
  return facets;
}

std::vector<Facet> marked_facets(const Outside& outside, const std::vector<char>& marked) {
  std::vector<Facet> facets;
  for (size_t f = 0; f < marked.size(); ++f)
    if (marked[f]) facets.push_back(outside.facets[f]);
  return facets;
}

// Marked facets of which something is left.
std::vector<Facet> partly_covered(const Outside& outside, const std::vector<char>& marked,
                                  const std::vector<double>& covered) {
  constexpr double whole = 0.98;
  std::vector<Facet> facets;
  for (size_t f = 0; f < marked.size(); ++f)
    if (marked[f] && covered[f] < whole * std::pow(outside.sizes[f], 2)) facets.push_back(outside.facets[f]);
  return facets;
}

std::vector<Polygon> polygons_of(const Outside& outside, const std::vector<int>& facets) {
  std::vector<Polygon> polygons;
  for (const int f : facets) {
    const std::span<const int> corners = outside.facets[static_cast<size_t>(f)].corners();
    Polygon x(3, corners.size());
    for (size_t a = 0; a < corners.size(); ++a)
      x.col(static_cast<long>(a)) = outside.mesh->nodes.col(corners[a]) + outside.place;
    polygons.push_back(std::move(x));
  }
  return polygons;
}

// Facets that share a node with a marked one on its smooth surface, and may be used.
std::vector<Facet> facets_beside(const Outside& outside, const std::vector<char>& marked, const FacetKeys& taken) {
  std::set<std::pair<int, int>> rim;  // patch, node
  for (size_t f = 0; f < marked.size(); ++f)
    if (marked[f])
      for (const int node : outside.facets[f].corners()) rim.emplace(outside.patch[f], node);
  std::vector<Facet> beside;
  for (size_t f = 0; f < marked.size(); ++f) {
    const std::span<const int> corners = outside.facets[f].corners();
    if (!marked[f] && !taken.contains(facet_key(outside.facets[f])) &&
        std::any_of(corners.begin(), corners.end(), [&](int node) {
          return rim.contains({outside.patch[f], node});
        }))
      beside.push_back(outside.facets[f]);
  }
  return beside;
}

double distance(const Vec3& x, const Box& box) { return (x - box.low.cwiseMax(x.cwiseMin(box.high))).norm(); }

// The place of a polygon's fan of triangles nearest to x, by projection on the planes and on the edges.
Vec3 nearest_on(const Polygon& polygon, const Vec3& x) {
  Vec3 best = polygon.col(0);
  const auto offer = [&](const Vec3& place) {
    if ((x - place).squaredNorm() < (x - best).squaredNorm()) best = place;
  };
  for (int a = 0; a < polygon.cols(); ++a) {
    const Vec3 from = polygon.col(a), along = polygon.col((a + 1) % polygon.cols()) - from;
    const double length = along.squaredNorm();
    offer(from + (length > 0.0 ? std::clamp(along.dot(x - from) / length, 0.0, 1.0) : 0.0) * along);
  }
  const Vec3 normal = area_vector(polygon).normalized(), foot = x - normal.dot(x - polygon.col(0)) * normal;
  for (int a = 0; a < polygon.cols(); ++a)
    if ((polygon.col((a + 1) % polygon.cols()) - polygon.col(a)).cross(foot - polygon.col(a)).dot(normal) < 0.0)
      return best;
  offer(foot);
  return best;
}

// From nodes of one to facets of the other; better than `best`.
void find_nearer(const Outside& of_nodes, const Outside& of_facets, bool swapped, Separation& best) {
  const Box all = box_of(of_facets);
  std::vector<std::pair<double, int>> nodes;  // nearest to the other's box first
  for (const int node : nodes_of(of_nodes.facets))
    nodes.emplace_back(distance(of_nodes.mesh->nodes.col(node) + of_nodes.place, all), node);
  std::sort(nodes.begin(), nodes.end());
  std::vector<int> every(of_facets.facets.size());
  for (size_t f = 0; f < every.size(); ++f) every[f] = static_cast<int>(f);
  const std::vector<Polygon> polygons = polygons_of(of_facets, every);
  for (const auto& [at_least, node] : nodes) {
    if (at_least >= best.distance) return;
    const Vec3 x = of_nodes.mesh->nodes.col(node) + of_nodes.place;
    for (size_t f = 0; f < polygons.size(); ++f) {
      if (distance(x, Box{of_facets.low[f], of_facets.high[f]}) >= best.distance) continue;
      const Vec3 place = nearest_on(polygons[f], x);
      if ((x - place).norm() < best.distance) best = {(x - place).norm(), swapped ? place : x, swapped ? x : place};
    }
  }
}

}  // namespace

Outside::Outside(const Mesh& body, const Vec3& at) : Outside(body, at, boundary_facets(body)) {}

Outside::Outside(const Mesh& body, const Vec3& at, std::vector<Facet> of)
    : mesh(&body), place(at), facets(std::move(of)), low(facets.size()), high(facets.size()), sizes(facets.size()) {
  std::vector<Vec3> normals(facets.size());
  for (size_t f = 0; f < facets.size(); ++f) {
    Box box;
    for (const int node : facets[f].nodes()) box.add(mesh->nodes.col(node) + place);
    low[f] = box.low;
    high[f] = box.high;
    const Vec3 area = facet_area_vector(mesh->nodes, facets[f]);
    sizes[f] = std::sqrt(area.norm());
    normals[f] = area.normalized();
  }
  patch = smooth_patches(facets, normals);
}

Touching find_touching(const Outside& one, const Outside& other, std::optional<double> within, const FacetKeys& taken_1,
                       const FacetKeys& taken_2) {
  Touching found;
  const Box box_1 = box_of(one), box_2 = box_of(other);
  const std::vector<int> near_1 = near_facets(one, box_2, within.value_or(0.0), taken_1),
                         near_2 = near_facets(other, box_1, within.value_or(0.0), taken_2);
  found.within = within.value_or(of_facet * std::min(median_size(one, near_1), median_size(other, near_2)));
  if (near_1.empty() || near_2.empty()) return found;
  const std::vector<SmoothPatch> patches_1 = patches_of(one, near_1), patches_2 = patches_of(other, near_2);
  std::vector<char> marked_1(one.facets.size(), 0), marked_2(other.facets.size(), 0);
  std::vector<double> area_1(marked_1.size(), 0.0), area_2(marked_2.size(), 0.0);  // m^2, covered
  found.least_gap = 1e300;
  found.most_gap = -1e300;
  for (const SmoothPatch& patch_1 : patches_1)
    for (const SmoothPatch& patch_2 : patches_2) {
      const double bend = patch_1.bend + patch_2.bend, reach = found.within + bend;
      if (!patch_1.box.grown(reach).meets(patch_2.box)) continue;
      const CommonArea common = common_of(patch_1, patch_2, reach);
      if (common.area == 0.0 || std::abs(common.apart) > found.within + of_bend * bend) continue;
      const std::vector<int> covered_1 = well_covered(one, common.covered_1),
                             covered_2 = well_covered(other, common.covered_2);
      if (covered_1.empty() || covered_2.empty()) continue;
      for (const int f : covered_1) marked_1[static_cast<size_t>(f)] = 1;
      for (const int f : covered_2) marked_2[static_cast<size_t>(f)] = 1;
      for (const auto& [f, by] : common.covered_1) area_1[static_cast<size_t>(f)] += by.area;
      for (const auto& [f, by] : common.covered_2) area_2[static_cast<size_t>(f)] += by.area;
      ++found.n_surfaces;
      found.area += common.area;
      found.bend = std::max(found.bend, bend);
      found.least_gap = std::min(found.least_gap, common.least);
      found.most_gap = std::max(found.most_gap, common.most);
    }
  found.facets_1 = marked_facets(one, marked_1);
  found.facets_2 = marked_facets(other, marked_2);
  found.partly_1 = partly_covered(one, marked_1, area_1);
  found.partly_2 = partly_covered(other, marked_2, area_2);
  found.beside_1 = facets_beside(one, marked_1, taken_1);
  found.beside_2 = facets_beside(other, marked_2, taken_2);
  return found;
}

Separation separation(const Outside& one, const Outside& other) {
  Separation best{std::numeric_limits<double>::max(), Vec3::Zero(), Vec3::Zero()};
  find_nearer(one, other, false, best);
  find_nearer(other, one, true, best);
  return best;
}

}  // namespace dygita
