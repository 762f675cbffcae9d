#include "fem/shape.hpp"

#include <cmath>

namespace dygita {

namespace {

const double gauss = 1.0 / std::sqrt(3.0);

ShapeTable<8, 8> make_hex8() {
  Eigen::Matrix<double, 3, 8> corners;
  corners << -1, 1, 1, -1, -1, 1, 1, -1,  //
      -1, -1, 1, 1, -1, -1, 1, 1,         //
      -1, -1, -1, -1, 1, 1, 1, 1;

  ShapeTable<8, 8> table;
  table.points = gauss * corners;
  table.weights.setOnes();
  for (int i = 0; i < 8; ++i)
    for (int a = 0; a < 8; ++a) {
      const Vec3 corner = corners.col(a);
      const Vec3 factors = Vec3::Ones() + corner.cwiseProduct(table.points.col(i));
      table.values(a, i) = factors.prod() / 8;
      for (int q = 0; q < 3; ++q) table.slopes[i](a, q) = corner[q] * factors[(q + 1) % 3] * factors[(q + 2) % 3] / 8;
    }
  table.to_nodes = table.values.inverse();
  return table;
}

ShapeTable<6, 6> make_prism6() {
  const double triangle[3][2] = {{1.0 / 6, 1.0 / 6}, {1.0 / 6, 2.0 / 3}, {2.0 / 3, 1.0 / 6}};
  const double slope[3][2] = {{-1, -1}, {0, 1}, {1, 0}};

  ShapeTable<6, 6> table;
  table.weights.setConstant(1.0 / 6);
  for (int i = 0; i < 6; ++i) {
    table.points.col(i) << triangle[i % 3][0], triangle[i % 3][1], i < 3 ? -gauss : gauss;
    const double r = table.points(0, i), s = table.points(1, i), t = table.points(2, i);
    const double in_triangle[3] = {1 - r - s, s, r};
    for (int a = 0; a < 6; ++a) {
      const double side = a < 3 ? -1 : 1, along = (1 + side * t) / 2;
      table.values(a, i) = in_triangle[a % 3] * along;
      table.slopes[i].row(a) << slope[a % 3][0] * along, slope[a % 3][1] * along, in_triangle[a % 3] * side / 2;
    }
  }
  table.to_nodes = table.values.inverse();
  return table;
}

ShapeTable<4, 1> make_tet4() {
  ShapeTable<4, 1> table;
  table.points.setConstant(0.25);
  table.weights.setConstant(1.0 / 6);
  table.values.setConstant(0.25);
  table.slopes[0] << -1, -1, -1, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  table.to_nodes.setOnes();
  return table;
}

}  // namespace

const ShapeTable<8, 8>& hex8_shapes() {
  static const ShapeTable<8, 8> table = make_hex8();
  return table;
}

const ShapeTable<6, 6>& prism6_shapes() {
  static const ShapeTable<6, 6> table = make_prism6();
  return table;
}

const ShapeTable<4, 1>& tet4_shapes() {
  static const ShapeTable<4, 1> table = make_tet4();
  return table;
}

}  // namespace dygita
