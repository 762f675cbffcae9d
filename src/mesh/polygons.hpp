// Convex polygons: clipping in a plane, and a grid in space that finds those near each other.
#pragma once

#include <Eigen/Geometry>
#include <unordered_map>
#include <vector>

#include "mesh/mesh.hpp"

namespace dygita {

// The corners (3 x n, m) of a facet in space.
using Polygon = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, most_facet_corners>;

using Vec2 = Eigen::Vector2d;
using Polygon2 = std::vector<Vec2>;

// The sum of the corner triangles' area vectors.
Vec3 area_vector(const Polygon& x);
double signed_area(const Polygon2& polygon);

// The part of `subject` inside the convex, counter-clockwise `window` (Sutherland and Hodgman 1974).
Polygon2 clip(Polygon2 subject, const Polygon2& window);

double mean_diameter(const std::vector<Polygon>& polygons);

// Polygons by the cells of a regular grid that their bounding boxes touch, half a cell and `reach` (m) around them.
class PolygonGrid {
 public:
  PolygonGrid(const std::vector<Polygon>& polygons, double cell, double reach = 0.0);

  // Calls back with those that share a cell with this one; with one that shares several, several times.
  template <typename Visit>
  void for_each_near(const Polygon& polygon, Visit visit) const {
    for_each_cell(polygon, 0.0, [&](size_t key) {
      if (const auto found = in_cell_.find(key); found != in_cell_.end())
        for (const int i : found->second) visit(i);
    });
  }

 private:
  template <typename Visit>
  void for_each_cell(const Polygon& x, double reach, Visit visit) const {
    // Half a cell of margin, so that faces a sagitta apart share cells.
    const Vec3 low = x.rowwise().minCoeff(), high = x.rowwise().maxCoeff();
    const double margin = 0.5 + reach / cell_;
    const auto first = ((low.array() / cell_ - margin).floor()).cast<long>().eval();
    const auto last = ((high.array() / cell_ + margin).floor()).cast<long>().eval();
    for (long k = first[2]; k <= last[2]; ++k)
      for (long j = first[1]; j <= last[1]; ++j)
        for (long i = first[0]; i <= last[0]; ++i)
          visit(static_cast<size_t>(i) * 73856093u ^ static_cast<size_t>(j) * 19349663u ^
                static_cast<size_t>(k) * 83492791u);
  }

  double cell_;
  std::unordered_map<size_t, std::vector<int>> in_cell_;
};

}  // namespace dygita
