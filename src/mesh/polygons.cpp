#include "mesh/polygons.hpp"

namespace dygita {

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

double mean_diameter(const std::vector<Polygon>& polygons) {
  double sum = 0;
  for (const Polygon& x : polygons) sum += (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).norm();
  return sum / static_cast<double>(polygons.size());
}

PolygonGrid::PolygonGrid(const std::vector<Polygon>& polygons, double cell, double reach) : cell_(cell), grid_(cell) {
  for (size_t i = 0; i < polygons.size(); ++i) grid_.add(around(polygons[i], reach), static_cast<int>(i));
}

Box PolygonGrid::around(const Polygon& x, double reach) const {
  return Box{x.rowwise().minCoeff(), x.rowwise().maxCoeff()}.grown(0.5 * cell_ + reach);
}

}  // namespace dygita
