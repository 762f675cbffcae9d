// Tetrahedra divided by a plane.
#pragma once

#include "mesh/mesh.hpp"

namespace dygita {

struct DividedCell {
  CellType type;
  std::vector<int> nodes;
  int side;          // 0 behind the plane, 1 beyond it
  const Mat3* axes;  // of its material; null: none
};

struct DividedCells {
  Points nodes;  // m: those of the whole, then new ones
  std::vector<DividedCell> cells;
  std::map<int, std::pair<int, int>> new_corners;  // the edge of the whole that each lies on
  int n_divided = 0;                               // cells of the whole

  void add(const CellBlock& block, int i, int side);
};

// Of the cells with corners on both sides of a plane (unit normal), farther than the tolerance (m).
bool crosses_tetrahedra_alone(const Mesh& mesh, const Vec3& normal, double at, double tolerance);

// Each of them in two polyhedra, and these in tetrahedra. Both sides of the plane, and neighbours, have the same
// triangles, since a polygon is divided from its node of lowest number (J. Dompierre et al., How to subdivide pyramids,
// prisms, and hexahedra into tetrahedra, 1999). Cells of order two keep their shape.
DividedCells divided_tetrahedra(const Mesh& mesh, const Vec3& normal, double at, double tolerance);

}  // namespace dygita
