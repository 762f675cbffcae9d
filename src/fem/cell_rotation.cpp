#include "fem/cell_rotation.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "fem/cell_loop.hpp"
#include "fem/rigid_motion.hpp"

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
  std::vector<int> places;
  for (int node = 0; node < mesh.n_nodes(); ++node)
    if (mesh.inside->is_place(node)) places.push_back(node);
  const NearestRigidMotion motion =
      nearest_rigid_motion(mesh.nodes(Eigen::all, places), displacement(Eigen::all, places));
  return {std::atan(motion.rotation.norm()), motion.middle};
}

}  // namespace

CellDeformation largest_deformation(const Mesh& mesh, const Points& displacement, double least) {
  if (!mesh.has_cells()) return {rotation_of_points(mesh, displacement), {}};
  CellDeformation worst;
  for (const CellBlock& block : mesh.blocks)
    with_cell(block.type, [&](auto cell) {
      using Cell = decltype(cell);
      constexpr int n = Cell::n_nodes;
      Vec angle = Vec::Zero(block.n_cells()), strain = angle;
      const auto compute = [&](int i) {
        const int* nodes = block.cell(i);
        const auto moved = gather<n>(displacement, nodes);
        if ((moved.rowwise().maxCoeff() - moved.rowwise().minCoeff()).norm() < least) return;
        const Mat3 gradient = mean_gradient<Cell>(gather<n>(mesh.nodes, nodes), moved);
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

double gradient_length(const Mesh& mesh) {
  if (!mesh.has_cells()) return 0.0;
  double largest = 0.0;
  for (const CellBlock& block : mesh.blocks)
    with_cell(block.type, [&](auto cell) {
      using Cell = decltype(cell);
      constexpr int n = Cell::n_nodes;
      const auto& shapes = Cell::shapes();
      for (int i = 0; i < block.n_cells(); ++i) {
        const Nodes<n> x = gather<n>(mesh.nodes, block.cell(i));
        Eigen::Matrix<double, n, 3> gradients = Eigen::Matrix<double, n, 3>::Zero();  // of the shape functions
        double volume = 0.0;
        for (int k = 0; k < shapes.n_points; ++k) {
          const auto point = point_in_cell(shapes, x, k);
          gradients += point.volume * point.gradient;
          volume += point.volume;
        }
        largest = std::max(largest, gradients.rowwise().norm().sum() / volume);
      }
    });
  return largest > 0.0 ? 1.0 / largest : 0.0;
}

}  // namespace dygita
