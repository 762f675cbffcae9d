#include "mesh/jacobian.hpp"

#include <Eigen/LU>
#include <cmath>

namespace dygita {

namespace {

// d N / d xi (3 x 8) of the trilinear map.
Points hex_gradients(const Vec3& xi) {
  const std::vector<Vec3>& corners = reference_corners(CellType::hex8);
  Points gradients(3, 8);
  for (int a = 0; a < 8; ++a) {
    const Vec3 factors = Vec3::Ones() + corners[a].cwiseProduct(xi);
    for (int d = 0; d < 3; ++d) gradients(d, a) = corners[a][d] * factors[(d + 1) % 3] * factors[(d + 2) % 3] / 8;
  }
  return gradients;
}

// d N / d xi (3 x 6): linear over the triangle, linear along the axis. Node 1 is at (0, 1) and node 2 at (1, 0),
// as in vtkWedge, whose first triangle turns clockwise seen from the second.
Points prism_gradients(const Vec3& xi) {
  const double shape[3] = {1 - xi[0] - xi[1], xi[1], xi[0]};
  const double slope[3][2] = {{-1, -1}, {0, 1}, {1, 0}};
  Points gradients(3, 6);
  for (int a = 0; a < 6; ++a) {
    const double side = a < 3 ? -1 : 1, along = (1 + side * xi[2]) / 2;
    gradients.col(a) << slope[a % 3][0] * along, slope[a % 3][1] * along, shape[a % 3] * side / 2;
  }
  return gradients;
}

Points tet_gradients() {
  Points gradients(3, 4);
  gradients << -1, 1, 0, 0, -1, 0, 1, 0, -1, 0, 0, 1;
  return gradients;
}

std::vector<ReferencePoint> hex_quadrature() {
  std::vector<ReferencePoint> points;
  for (const Vec3& corner : reference_corners(CellType::hex8)) points.push_back({corner / std::sqrt(3.0), 1.0});
  return points;
}

std::vector<ReferencePoint> prism_quadrature() {
  std::vector<ReferencePoint> points;
  for (const double z : {-1 / std::sqrt(3.0), 1 / std::sqrt(3.0)})
    for (const auto& [r, s] : {std::pair{1.0 / 6, 1.0 / 6}, {2.0 / 3, 1.0 / 6}, {1.0 / 6, 2.0 / 3}})
      points.push_back({Vec3(r, s, z), 1.0 / 6});
  return points;
}

}  // namespace

const std::vector<ReferencePoint>& volume_quadrature(CellType type) {
  static const std::vector<ReferencePoint> hex = hex_quadrature(), prism = prism_quadrature(),
                                           tet = {{Vec3::Constant(0.25), 1.0 / 6}};
  return type == CellType::hex8 ? hex : type == CellType::prism6 ? prism : tet;
}

const std::vector<Vec3>& reference_corners(CellType type) {
  static const std::vector<Vec3> hex = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                        {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  static const std::vector<Vec3> prism = {{0, 0, -1}, {0, 1, -1}, {1, 0, -1}, {0, 0, 1}, {0, 1, 1}, {1, 0, 1}};
  static const std::vector<Vec3> tet = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  return type == CellType::hex8 ? hex : type == CellType::prism6 ? prism : tet;
}

double jacobian(CellType type, const Points& x, const Vec3& xi) {
  const Points gradients = type == CellType::hex8     ? hex_gradients(xi)
                           : type == CellType::prism6 ? prism_gradients(xi)
                                                      : tet_gradients();
  const Mat3 jacobian_matrix = x * gradients.transpose();
  return jacobian_matrix.determinant();
}

double cell_volume(CellType type, const Points& x) {
  double volume = 0;
  for (const ReferencePoint& point : volume_quadrature(type))
    volume += point.weight * jacobian(type, x, point.position);
  return volume;
}

Points cell_nodes(const Points& nodes, const CellBlock& block, int i_cell) {
  const int n = nodes_per_cell(block.type);
  Points x(3, n);
  for (int a = 0; a < n; ++a) x.col(a) = nodes.col(block.cell(i_cell)[a]);
  return x;
}

}  // namespace dygita
