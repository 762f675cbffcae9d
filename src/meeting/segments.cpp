#include "meeting/segments.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "meeting/facet_parts.hpp"
#include "meeting/sagitta.hpp"

namespace dygita {

namespace {

constexpr double least_cosine = 0.5;     // between a normal and the opposite of the other
constexpr double least_segment = 1e-10;  // of the smaller part's area

std::vector<Polygon> polygons_of(const FaceInSpace& face) {
  std::vector<Polygon> polygons;
  for (const FaceInSpace::Part& part : face.parts) polygons.push_back(part.x);
  return polygons;
}

// Cells as large as the parts usually are.
double cell_for(const std::vector<Polygon>& one, const std::vector<Polygon>& other) {
  return std::max(mean_diameter(one), mean_diameter(other));
}

}  // namespace

FaceInSpace::FaceInSpace(const PlacedFace& face) : nodes(nodes_of(face.facets)) {
  x.resize(3, static_cast<Eigen::Index>(nodes.size()));
  for (size_t i = 0; i < nodes.size(); ++i)
    x.col(static_cast<Eigen::Index>(i)) = face.mesh->nodes.col(nodes[i]) + face.place;
  first_part.push_back(0);
  for (const Facet& facet : face.facets) {
    std::vector<int>& local = facets.emplace_back();
    for (const int node : facet.nodes())
      local.push_back(static_cast<int>(std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin()));
    types.push_back(facet.type());
    const std::span<const FacetPart> shapes = facet_parts(facet.type()).parts;
    for (size_t k = 0; k < shapes.size(); ++k) {
      Part part{static_cast<int>(facets.size()) - 1, static_cast<int>(k), Polygon(3, shapes[k].n), {}, {}, 0.0};
      for (int a = 0; a < shapes[k].n; ++a) part.x.col(a) = x.col(local[shapes[k].nodes[a]]);
      const Vec3 area = area_vector(part.x);
      part.area = area.norm();
      part.normal = part.area > 0.0 ? Vec3(area / part.area) : Vec3(Vec3::UnitZ());
      part.centre = part.x.rowwise().mean();
      parts.push_back(std::move(part));
    }
    first_part.push_back(static_cast<int>(parts.size()));
  }
}

double FaceInSpace::smallest_edge() const {
  double smallest = std::numeric_limits<double>::max();
  for (size_t f = 0; f < facets.size(); ++f) {
    const std::span<const int> rim = facet_shape(types[f]).rim;
    for (size_t a = 0; a < rim.size(); ++a)
      smallest = std::min(smallest, (x.col(facets[f][rim[a]]) - x.col(facets[f][rim[(a + 1) % rim.size()]])).norm());
  }
  return smallest;
}

double FaceInSpace::sagitta() const {
  std::map<std::pair<int, int>, int> known;
  double largest = 0.0;
  for (size_t p = 0; p < parts.size(); ++p) {
    const FacetPart& shape = facet_parts(types[parts[p].facet]).parts[parts[p].k];
    for (int a = 0; a < shape.n; ++a) {
      const int i = facets[parts[p].facet][shape.nodes[a]], j = facets[parts[p].facet][shape.nodes[(a + 1) % shape.n]];
      const auto [at, is_new] = known.try_emplace(std::minmax(i, j), static_cast<int>(p));
      if (is_new) continue;
      const Part &one = parts[p], &other = parts[at->second];
      largest = std::max(largest, sagitta_of({one.x, one.centre, one.normal}, {other.x, other.centre, other.normal},
                                             x.col(i), x.col(j)));
    }
  }
  return largest;
}

Eigen::Matrix<double, 3, 2> SegmentFinder::axes(const FaceInSpace::Part& part) {
  Eigen::Matrix<double, 3, 2> axes;
  axes.col(0) = part.normal.unitOrthogonal();
  axes.col(1) = part.normal.cross(axes.col(0));
  return axes;
}

SegmentFinder::SegmentFinder(const FaceInSpace& face, const FaceInSpace& other, double reach)
    : face_(face),
      other_(other),
      reach_(reach),
      polygons_(polygons_of(other)),
      grid_(polygons_, cell_for(polygons_of(face), polygons_), reach) {}

std::vector<Segment> SegmentFinder::segments(int index) const {
  const FaceInSpace::Part& part = face_.parts[index];
  std::vector<int> near;
  grid_.for_each_near(part.x, [&](int i) { near.push_back(i); });
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  const Eigen::Matrix<double, 3, 2> along = axes(part);
  const auto project = [&](const Polygon& x) {
    Polygon2 polygon;
    for (int a = 0; a < x.cols(); ++a) polygon.push_back(along.transpose() * (x.col(a) - part.centre));
    if (signed_area(polygon) < 0) std::reverse(polygon.begin(), polygon.end());
    return polygon;
  };
  const Polygon2 window = project(part.x);
  std::vector<Segment> found;
  for (const int i : near) {
    const FaceInSpace::Part& other = other_.parts[i];
    const double cosine = -part.normal.dot(other.normal);
    if (cosine < least_cosine || part.area == 0.0 || other.area == 0.0) continue;
    Polygon2 region = clip(project(other.x), window);
    if (region.size() < 3) continue;
    const double area = signed_area(region);
    if (area < least_segment * std::min(part.area, other.area)) continue;
    Vec2 middle = Vec2::Zero();
    for (const Vec2& p : region) middle += p / static_cast<double>(region.size());
    // Along the part's normal, to the plane of the other.
    const Vec3 from = part.centre + along * middle;
    const double gap = -other.normal.dot(other.centre - from) / cosine;
    if (std::abs(gap) > reach_) continue;
    found.push_back({i, std::move(region), area, gap});
  }
  return found;
}

}  // namespace dygita
