#include "mesh/overlap.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <unordered_map>

namespace dygita {

namespace {

using Vec2 = Eigen::Vector2d;
using Polygon2 = std::vector<Vec2>;

// Area vector: the sum of the corner triangles' ones.
Vec3 area_vector(const Polygon& x) {
  Vec3 area = Vec3::Zero();
  for (int i = 1; i + 1 < x.cols(); ++i) area += (x.col(i) - x.col(0)).cross(x.col(i + 1) - x.col(0)) / 2;
  return area;
}

double signed_area(const Polygon2& polygon) {
  double twice = 0;
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return twice / 2;
}

// The part of `subject` inside the convex, counter-clockwise `window` (Sutherland and Hodgman 1974).
Polygon2 clip(Polygon2 subject, const Polygon2& window) {
  for (size_t i = 0; i < window.size() && !subject.empty(); ++i) {
    const Vec2 start = window[i], along = window[(i + 1) % window.size()] - start;
    const auto inside = [&](const Vec2& p) { return along[0] * (p[1] - start[1]) - along[1] * (p[0] - start[0]); };
    Polygon2 kept;
    for (size_t j = 0; j < subject.size(); ++j) {
      const Vec2 &a = subject[j], &b = subject[(j + 1) % subject.size()];
      const double at_a = inside(a), at_b = inside(b);
      if (at_a >= 0) kept.push_back(a);
      if ((at_a < 0) != (at_b < 0)) kept.push_back(a + (b - a) * (at_a / (at_a - at_b)));
    }
    subject = std::move(kept);
  }
  return subject;
}

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

struct Bounds {
  Vec3 low, high;
  explicit Bounds(const Polygon& x) : low(x.rowwise().minCoeff()), high(x.rowwise().maxCoeff()) {}
};

// Polygons by the cells of a regular grid that their bounding boxes touch.
class PolygonGrid {
 public:
  PolygonGrid(const std::vector<Polygon>& polygons, double cell) : cell_(cell) {
    for (size_t i = 0; i < polygons.size(); ++i)
      for_each_cell(Bounds(polygons[i]), [&](size_t key) { in_cell_[key].push_back(static_cast<int>(i)); });
  }

  template <typename Visit>
  void for_each_near(const Polygon& polygon, Visit visit) const {
    for_each_cell(Bounds(polygon), [&](size_t key) {
      if (const auto found = in_cell_.find(key); found != in_cell_.end())
        for (const int i : found->second) visit(i);
    });
  }

 private:
  template <typename Visit>
  void for_each_cell(const Bounds& bounds, Visit visit) const {
    // Half a cell of margin, so that faces a sagitta apart share cells.
    const auto first = ((bounds.low.array() / cell_ - 0.5).floor()).cast<long>().eval();
    const auto last = ((bounds.high.array() / cell_ + 0.5).floor()).cast<long>().eval();
    for (long k = first[2]; k <= last[2]; ++k)
      for (long j = first[1]; j <= last[1]; ++j)
        for (long i = first[0]; i <= last[0]; ++i)
          visit(static_cast<size_t>(i) * 73856093u ^ static_cast<size_t>(j) * 19349663u ^
                static_cast<size_t>(k) * 83492791u);
  }

  double cell_;
  std::unordered_map<size_t, std::vector<int>> in_cell_;
};

double mean_diameter(const std::vector<Polygon>& polygons) {
  double sum = 0;
  for (const Polygon& x : polygons) sum += (Bounds(x).high - Bounds(x).low).norm();
  return sum / static_cast<double>(polygons.size());
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
