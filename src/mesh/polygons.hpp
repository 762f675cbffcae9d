// Convex polygons: clipping in a plane, and a grid in space that finds those near each other.
#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "mesh/box_grid.hpp"
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
    grid_.for_each_near(around(polygon, 0.0), visit);
  }

 private:
  // Half a cell of margin, so that faces a sagitta apart share cells.
  Box around(const Polygon& x, double reach) const;

  double cell_;
  CellGrid grid_;
};

}  // namespace dygita
