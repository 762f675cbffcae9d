#include "fem/cell_rotation.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>

#include "fem/cell_loop.hpp"
#include "numerics/dense.hpp"

namespace dygita {

namespace {

// Mean of d u_p / d x_q over a cell.
template <class Cell>
Mat3 mean_gradient(const Nodes<Cell::n_nodes>& x, const Nodes<Cell::n_nodes>& u) {
  const auto& shapes = Cell::shapes();
  Mat3 gradient = Mat3::Zero();
  double volume = 0.0;
  for (int i = 0; i < shapes.n_points; ++i) {
    const auto point = point_in_cell(shapes, x, i);
    gradient += point.volume * u.lazyProduct(point.gradient);
    volume += point.volume;
  }
  return gradient / volume;
}

// Angle of 1/2 curl u.
double angle_of(const Mat3& gradient) {
  return std::atan(
      0.5 *
      Vec3(gradient(2, 1) - gradient(1, 2), gradient(0, 2) - gradient(2, 0), gradient(1, 0) - gradient(0, 1)).norm());
}

double principal_strain_of(const Mat3& gradient) {
  Eigen::SelfAdjointEigenSolver<Mat3> of;
  of.computeDirect(0.5 * (gradient + gradient.transpose()), Eigen::EigenvaluesOnly);
  return of.eigenvalues().cwiseAbs().maxCoeff();
}

}  // namespace

namespace {

// The rotation of its points as a whole, by least squares; at their middle.
CellExtreme rotation_of_points(const Mesh& mesh, const Points& displacement) {
  Vec3 middle = Vec3::Zero(), moved = Vec3::Zero();
  const int n = mesh.n_nodes();
  double n_places = 0.0;
  for (int node = 0; node < n; ++node)
    if (mesh.inside->is_place(node)) {
      middle += mesh.nodes.col(node);
      moved += displacement.col(node);
      n_places += 1.0;
    }
  middle /= n_places;
  moved /= n_places;
  Mat3 inertia = Mat3::Zero();
  Vec3 moment = Vec3::Zero();
  for (int node = 0; node < n; ++node) {
    if (!mesh.inside->is_place(node)) continue;
    const Vec3 arm = mesh.nodes.col(node) - middle;
    inertia += arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose();
    moment += arm.cross(displacement.col(node) - moved);
  }
  return {std::atan((pseudo_inverse(inertia) * moment).norm()), middle};
}

}  // namespace

CellDeformation largest_deformation(const Mesh& mesh, const Points& displacement) {
  if (!mesh.has_cells()) return {rotation_of_points(mesh, displacement), {}};
  CellDeformation worst;
  for (const CellBlock& block : mesh.blocks)
    with_cell(block.type, [&](auto cell) {
      using Cell = decltype(cell);
      constexpr int n = Cell::n_nodes;
      Vec angle(block.n_cells()), strain(block.n_cells());
      const auto compute = [&](int i) {
        const int* nodes = block.cell(i);
        const Mat3 gradient = mean_gradient<Cell>(gather<n>(mesh.nodes, nodes), gather<n>(displacement, nodes));
        angle[i] = angle_of(gradient);
        strain[i] = principal_strain_of(gradient);
      };
      parallel_for(block.n_cells(), compute, Schedule::evenly, block.n_cells() > 1000 ? 0 : 1);
      const auto take = [&](const Vec& of_cells, CellExtreme& largest) {
        Eigen::Index at = 0;
        if (const double most = of_cells.maxCoeff(&at); most > largest.value)
          largest = {most, gather<n>(mesh.nodes, block.cell(static_cast<int>(at))).rowwise().mean()};
      };
      take(angle, worst.rotation);
      take(strain, worst.strain);
    });
  return worst;
}

double smallest_cell(const Mesh& mesh) {
  if (!mesh.has_cells()) return 0.0;
  double smallest = std::numeric_limits<double>::infinity();
  for (const CellBlock& block : mesh.blocks)
    for (int i = 0; i < block.n_cells(); ++i) {
      Vec3 low = mesh.nodes.col(block.cell(i)[0]), high = low;
      for (int a = 1; a < nodes_per_cell(block.type); ++a) {
        low = low.cwiseMin(mesh.nodes.col(block.cell(i)[a]));
        high = high.cwiseMax(mesh.nodes.col(block.cell(i)[a]));
      }
      smallest = std::min(smallest, (high - low).minCoeff());
    }
  return smallest;
}

}  // namespace dygita
