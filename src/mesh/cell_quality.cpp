#include "mesh/cell_quality.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "mesh/jacobian.hpp"

namespace dygita {

namespace {

// Columns: the ideal cell's edges along the axes of the reference cell, up to a factor.
Mat3 ideal_edges(int n_corners) {
  Mat3 edges = Mat3::Identity();
  const double height = std::sqrt(3.0) / 2.0;
  if (n_corners == 6) edges << 1.0, 0.5, 0.0, 0.0, height, 0.0, 0.0, 0.0, 0.5;
  if (n_corners == 4) edges << 1.0, 0.5, 0.5, 0.0, height, height / 3.0, 0.0, 0.0, std::sqrt(2.0 / 3.0);
  return edges;
}

double mean_ratio(const Mat3& m) {
  const double determinant = m.determinant();
  return std::copysign(3.0 * std::cbrt(determinant * determinant), determinant) / m.squaredNorm();
}

}  // namespace

double shape_of_cell(CellType type, const Points& x) {
  const Mat3 to_ideal = ideal_edges(cell_shape(type).n_corners).inverse();
  double worst = 1.0;
  for (const Mat3& map : sampled_maps(type, x)) worst = std::min(worst, mean_ratio(map * to_ideal));
  return worst;
}

double worst_shape(const Mesh& mesh) {
  double worst = 1.0;
  for (const CellBlock& block : mesh.blocks)
    for (int i = 0; i < block.n_cells(); ++i)
      worst = std::min(worst, shape_of_cell(block.type, cell_nodes(mesh.nodes, block, i)));
  return worst;
}

}  // namespace dygita
