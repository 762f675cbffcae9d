// Orders of convergence of every type of cells: displacement and stress of a smooth field, frequencies of a bar.
#include <gtest/gtest.h>

#include <iostream>
#include <numbers>

#include "fem/mass.hpp"
#include "fem/meshes.hpp"
#include "mesh/jacobian.hpp"
#include "mesh/shape_functions.hpp"
#include "numerics/dense.hpp"

namespace dygita::test {
namespace {

// u = grad phi, phi = cos x cos y cosh(sqrt(2) z): without divergence and harmonic, in equilibrium in any material.
const double root_2 = std::numbers::sqrt2;

Vec3 field(const Vec3& x) {
  const double c = std::cosh(root_2 * x[2]), s = std::sinh(root_2 * x[2]);
  return {-std::sin(x[0]) * std::cos(x[1]) * c, -std::cos(x[0]) * std::sin(x[1]) * c,
          root_2 * std::cos(x[0]) * std::cos(x[1]) * s};
}

Eigen::Matrix<double, 6, 1> stress_of_field(const Vec3& x, const Elastic& material) {
  Mat3 gradient;
  constexpr double h = 1e-5;
  for (int q = 0; q < 3; ++q) gradient.col(q) = (field(x + h * Vec3::Unit(q)) - field(x - h * Vec3::Unit(q))) / (2 * h);
  Eigen::Matrix<double, 6, 1> strain;
  strain << gradient.diagonal(), gradient(0, 1) + gradient(1, 0), gradient(1, 2) + gradient(2, 1),
      gradient(2, 0) + gradient(0, 2);
  return material.hooke() * strain;
}

// Root of the integral of |nodal field, interpolated, - exact|^2.
template <typename Exact>
double distance(const Mesh& mesh, const Mat& nodal, const Exact& exact) {
  double sum = 0.0;
  for (const CellBlock& block : mesh.blocks)
    for (int i = 0; i < block.n_cells(); ++i) {
      const Points x = cell_nodes(mesh.nodes, block, i);
      for (const QuadraturePoint& point : cell_shape(block.type).mass.points) {
        const Vec3 xi = vector_of(point.at);
        const Vec values = shape_functions(block.type).values(xi);
        Vec found = Vec::Zero(nodal.rows());
        for (Eigen::Index a = 0; a < values.size(); ++a) found += values[a] * nodal.col(block.cell(i)[a]);
        sum += point.weight * jacobian(block.type, x, xi) * (found - Vec(exact(Vec3(x * values)))).squaredNorm();
      }
    }
  return std::sqrt(sum);
}

struct Errors {
  double displacement, stress;
};

Errors errors_of(CellType type, int n) {
  const Vec3 size = Vec3::Ones();
  const Mesh mesh = box_of(type, size, {n, n, n});
  const Elastic material = material_of(1.0, 0.3);
  std::map<int, double> prescribed;
  for (int a = 0; a < mesh.n_nodes(); ++a)
    if (is_on_boundary(mesh.nodes.col(a), size))
      for (int d = 0; d < 3; ++d) prescribed[3 * a + d] = field(mesh.nodes.col(a))[d];
  const Points found = solve(assemble(mesh, material).stiffness, Points::Zero(3, mesh.n_nodes()), prescribed);
  return {distance(mesh, found, field), distance(mesh, nodal_stress(mesh, material, found),
                                                 [&](const Vec3& x) { return stress_of_field(x, material); })};
}

TEST(Convergence, is_of_third_order_in_displacement_and_second_in_stress_for_cells_of_order_two) {
  for (const CellType type : cell_types) {
    const bool is_quadratic = cell_shape(type).inertia == Inertia::consistent;
    const Errors coarse = errors_of(type, is_quadratic ? 2 : 4), fine = errors_of(type, is_quadratic ? 4 : 8);
    const double displacement = std::log2(coarse.displacement / fine.displacement);
    const double stress = std::log2(coarse.stress / fine.stress);
    std::cout << "order of convergence, " << cell_shape(type).name << ": displacement " << displacement << " (error "
              << fine.displacement << "), stress " << stress << " (error " << fine.stress << ")\n";
    EXPECT_GT(displacement, is_quadratic ? 2.8 : 1.8) << cell_shape(type).name;
    EXPECT_GT(stress, is_quadratic ? 1.8 : 0.9) << cell_shape(type).name;
  }
}

// First frequency of stretching of a bar that cannot move across: its error relative to pi c / L.
double frequency_error(CellType type, int n) {
  const Mesh mesh = box_of(type, Vec3(0.2, 0.2, 1.0), {1, 1, n});
  const Elastic material = material_of(1.0, 0.0);
  const SparseMatrix stiffness = assemble(mesh, material).stiffness;
  const Mat mass = consistent_mass(mesh, material);
  Mat along(mesh.n_nodes(), mesh.n_nodes());
  for (int a = 0; a < mesh.n_nodes(); ++a)
    for (int b = 0; b < mesh.n_nodes(); ++b) along(a, b) = stiffness.coeff(3 * a + 2, 3 * b + 2);
  const Vec squares = generalized_symmetric_eigen(along, mass).values;
  return std::sqrt(squares[1]) / std::numbers::pi - 1.0;
}

TEST(Convergence, is_of_fourth_order_in_frequency_for_cells_of_order_two) {
  for (const CellType type : cell_types) {
    const bool is_quadratic = cell_shape(type).inertia == Inertia::consistent;
    const double coarse = frequency_error(type, 2), fine = frequency_error(type, 4);
    const double order = std::log2(std::abs(coarse / fine));
    std::cout << "order of convergence, " << cell_shape(type).name << ": frequency " << order << " (error " << fine
              << ")\n";
    EXPECT_GT(order, is_quadratic ? 3.8 : 1.8) << cell_shape(type).name;
  }
}

TEST(ConsistentMass, has_the_integrals_of_the_shape_functions_for_row_sums_and_positive_lumped_masses_beside_it) {
  for (const CellType type : cell_types) {
    Mesh mesh = box_of(type, Vec3(1.0, 1.2, 0.9), {2, 2, 2});
    distort(mesh, Vec3(1.0, 1.2, 0.9), 0.03);
    const Elastic material = material_of(1.0, 0.3, 3.0);
    const Mat mass = consistent_mass(mesh, material);
    const Vec sums = mass.rowwise().sum();
    EXPECT_LT((sums - 3.0 * nodal_integrals(mesh)).norm(), 1e-12) << cell_shape(type).name;
    EXPECT_GT(symmetric_eigen(mass).values.minCoeff(), 0.0) << cell_shape(type).name;
    EXPECT_GT(nodal_volumes(mesh).minCoeff(), 0.0) << cell_shape(type).name;
    EXPECT_NEAR(nodal_volumes(mesh).sum(), volume(mesh), 1e-12) << cell_shape(type).name;
    EXPECT_NEAR(sums.sum(), 3.0 * volume(mesh), 1e-12) << cell_shape(type).name;
  }
}

}  // namespace
}  // namespace dygita::test
