#include "mesh/jacobian.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <limits>

#include "mesh/shape_functions.hpp"

namespace dygita {

namespace {

using Slopes = Eigen::Matrix<double, Eigen::Dynamic, 3>;

// d N_a / d xi at the places where a cell is looked at.
struct SampledSlopes {
  std::vector<Slopes> at_nodes, at_points;
  std::vector<double> weights;  // of the points

  explicit SampledSlopes(const CellShape& cell) {
    const ShapeFunctions& functions = shape_functions(cell.type);
    for (const Place& at : cell.shape.nodes) at_nodes.push_back(functions.slopes(vector_of(at)));
    for (const QuadraturePoint& point : cell.stiffness.points) {
      at_points.push_back(functions.slopes(vector_of(point.at)));
      weights.push_back(point.weight);
    }
  }
};

const SampledSlopes& sampled_slopes(CellType type) {
  static const std::vector<SampledSlopes> all(std::begin(cell_shapes), std::end(cell_shapes));
  return all[static_cast<size_t>(type)];
}

double determinant(const Points& x, const Slopes& slopes) {
  const Mat3 jacobian_matrix = x.lazyProduct(slopes);
  return jacobian_matrix.determinant();
}

}  // namespace

double jacobian(CellType type, const Points& x, const Vec3& xi) {
  return determinant(x, shape_functions(type).slopes(xi));
}

double smallest_jacobian(CellType type, const Points& x) {
  double smallest = std::numeric_limits<double>::max();
  const SampledSlopes& sampled = sampled_slopes(type);
  for (const Slopes& slopes : sampled.at_nodes) smallest = std::min(smallest, determinant(x, slopes));
  for (const Slopes& slopes : sampled.at_points) smallest = std::min(smallest, determinant(x, slopes));
  return smallest;
}

std::vector<Mat3> sampled_maps(CellType type, const Points& x) {
  const SampledSlopes& sampled = sampled_slopes(type);
  std::vector<Mat3> all;
  all.reserve(sampled.at_nodes.size() + sampled.at_points.size());
  for (const Slopes& slopes : sampled.at_nodes) all.emplace_back(x.lazyProduct(slopes));
  for (const Slopes& slopes : sampled.at_points) all.emplace_back(x.lazyProduct(slopes));
  return all;
}

Vec sampled_jacobians(CellType type, const Points& x) {
  const std::vector<Mat3> maps = sampled_maps(type, x);
  Vec determinants(static_cast<Eigen::Index>(maps.size()));
  for (size_t i = 0; i < maps.size(); ++i) determinants[static_cast<Eigen::Index>(i)] = maps[i].determinant();
  return determinants;
}

double cell_volume(CellType type, const Points& x) {
  double volume = 0;
  const SampledSlopes& sampled = sampled_slopes(type);
  for (size_t i = 0; i < sampled.weights.size(); ++i)
    volume += sampled.weights[i] * determinant(x, sampled.at_points[i]);
  return volume;
}

Points cell_nodes(const Points& nodes, const CellBlock& block, int i_cell) {
  const int n = nodes_per_cell(block.type);
  Points x(3, n);
  for (int a = 0; a < n; ++a) x.col(a) = nodes.col(block.cell(i_cell)[a]);
  return x;
}

}  // namespace dygita
