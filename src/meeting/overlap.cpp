#include "meeting/overlap.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace dygita {

namespace {

struct Common {
  Vec3 place;
  double area;
};

// The common region of two polygons, if there is one.
std::optional<Common> common_region(const Polygon& x_1, const Polygon& x_2, Facings facings) {
  const Vec3 area_1 = area_vector(x_1), area_2 = area_vector(x_2);
  const double smaller = std::min(area_1.norm(), area_2.norm());
  const Vec3 n_1 = area_1.normalized(), n_2 = area_2.normalized();
  const double cosine = std::abs(n_1.dot(n_2)), sine = n_1.cross(n_2).norm();
  if (cosine < 0.8 || smaller == 0) return {};
  if (facings == Facings::opposed && n_1.dot(n_2) > 0.0) return {};

  // Project on the mean plane.
  const Vec3 normal = (n_1 + std::copysign(1.0, n_1.dot(n_2)) * n_2).normalized();
  const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u), origin = x_1.rowwise().mean();
  const auto project = [&](const Polygon& x) {
    Polygon2 polygon;
    for (int i = 0; i < x.cols(); ++i) polygon.emplace_back(u.dot(x.col(i) - origin), v.dot(x.col(i) - origin));
    if (signed_area(polygon) < 0) std::reverse(polygon.begin(), polygon.end());
    return polygon;
  };
  const Polygon2 common = clip(project(x_1), project(x_2));
  if (common.size() < 3 || signed_area(common) < 1e-3 * smaller) return {};

  // Compare the heights of the two planes in the middle of the common region.
  Vec2 middle = Vec2::Zero();
  for (const Vec2& p : common) middle += p / static_cast<double>(common.size());
  const Vec3 place = origin + u * middle[0] + v * middle[1];
  const auto height = [&](const Polygon& x, const Vec3& n) {
    return n.dot(Vec3(x.rowwise().mean()) - place) / n.dot(normal);
  };
  const double distance = std::abs(height(x_1, n_1) - height(x_2, n_2));
  if (distance > std::sqrt(smaller) * (1e-3 + 0.5 * sine)) return {};
  return Common{place, signed_area(common)};
}

}  // namespace

std::optional<Overlap> find_overlap(const std::vector<Polygon>& side_1, const std::vector<Polygon>& side_2,
                                    Facings facings) {
  if (side_1.empty() || side_2.empty()) return {};
  const PolygonGrid grid(side_1, std::max(mean_diameter(side_1), mean_diameter(side_2)));
  std::vector<bool> overlaps_1(side_1.size(), false);
  std::optional<Overlap> overlap;
  for (size_t j = 0; j < side_2.size(); ++j) {
    bool overlaps_2 = false;
    std::vector<int> met;
    grid.for_each_near(side_2[j], [&](int i) {
      if (facings == Facings::all && overlaps_1[i] && overlaps_2) return;
      if (std::find(met.begin(), met.end(), i) != met.end()) return;  // shares several cells of the grid
      met.push_back(i);
      const std::optional<Common> common = common_region(side_1[i], side_2[j], facings);
      if (!common) return;
      if (!overlap) overlap = Overlap{0, 0, common->place, 0.0, i, static_cast<int>(j)};
      overlap->area += common->area;
      overlap->n_1 += overlaps_1[i] ? 0 : 1;
      overlap->n_2 += overlaps_2 ? 0 : 1;
      overlaps_1[i] = overlaps_2 = true;
    });
  }
  return overlap;
}

}  // namespace dygita
