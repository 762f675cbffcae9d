#include <gtest/gtest.h>

#include <array>
#include <numeric>

#include "fem/mass.hpp"
#include "fem/meshes.hpp"
#include "fem/stress_error.hpp"
#include "mesh/face_nodes.hpp"

namespace dygita::test {
namespace {

TEST(StressError, is_none_where_the_stress_is_constant) {
  const Mesh mesh = distorted_mixed_box();
  Points displacement = mesh.nodes;
  displacement.row(0) = 2e-3 * mesh.nodes.row(1) - 1e-3 * mesh.nodes.row(0);
  const StressError error = stress_error(mesh, material_of(5.0, 0.3), displacement);
  EXPECT_LT(error.energy(), 1e-24);
  EXPECT_LT(error.at_nodes.maxCoeff(), 1e-12);
}

// u_z = z^2 / 2 in slices of height h, nu = 0: the cells have the strain of their middle, the smooth strain is exact
// but in the two outer slices, so an inner slice of volume V has E V h^2 / 24.
TEST(StressError, of_a_growing_strain_is_that_of_its_steps) {
  const int n = 20;
  const double young = 3.0, h = 1.0 / n;
  for (const int cut : {n, 2 * n}) {
    const Mesh mesh = *box_mesh(Vec3::Zero(), Vec3(0.5, 0.5, 1.0), {1, 1, cut});
    Points displacement = Points::Zero(3, mesh.n_nodes());
    displacement.row(2) = 0.5 * mesh.nodes.row(2).cwiseAbs2();
    const StressError error = stress_error(mesh, material_of(young, 0.0), displacement);
    const double all = young * 0.25 * std::pow(h * n / cut, 2) / 24;
    EXPECT_LT(error.energy(), all * (1 + 1e-12));
    EXPECT_GT(error.energy(), all * (1 - 2.0 / cut));
    // Half a step at inner nodes.
    EXPECT_NEAR(error.at_nodes[mesh.n_nodes() / 2], 0.5 * young * h * n / cut, 1e-12);
  }
}

// A column of strain z^2, nu = 0: cells of order two in layers of height h have its best linear fit, and leave h^4 /
// 180 of the strain's square per length.
TEST(StressError, of_cells_of_order_two_is_the_true_one_where_the_stress_is_quadratic) {
  const double young = 3.0;
  for (const CellType type : {CellType::hex20, CellType::hex27, CellType::prism15, CellType::prism18})
    for (const int n : {4, 8}) {
      const Mesh mesh = box_of(type, Vec3(1, 1, 1), {3, 3, n});
      const double h = 1.0 / n;
      Points displacement = Points::Zero(3, mesh.n_nodes());
      for (int i = 0; i < mesh.n_nodes(); ++i) {
        const double z = mesh.nodes(2, i), layer = z / h;
        displacement(2, i) = z * z * z / 3;
        if (std::abs(layer - std::round(layer)) < 0.1) continue;
        const double low = h * std::floor(layer);  // half of a layer: the integral of the linear fit
        displacement(2, i) = low * low * low / 3 + (z * z + h * h / 12) * h / 2 - z * h * h / 4;
      }
      const double exact = 0.5 * young * std::pow(h, 4) / 180;
      EXPECT_NEAR(stress_error(mesh, material_of(young, 0.0), displacement).energy(), exact, 1e-6 * exact)
          << cell_shape(type).name << ", " << n;
    }
}

// Interpolated smooth displacements: the estimate falls as the error of the stress does, h^4 in energy, in all types.
TEST(StressError, of_cells_of_order_two_falls_with_the_fourth_power) {
  for (const CellType type : cell_types) {
    if (nodes_per_cell(type) == cell_shape(type).n_corners) continue;
    std::array<double, 2> energy{};
    for (const int n : {0, 1}) {
      const Mesh mesh = box_of(type, Vec3(1, 1, 1), {6 << n, 6 << n, 6 << n});
      Points displacement(3, mesh.n_nodes());
      displacement.row(0) = (2.0 * mesh.nodes.row(1)).array().sin();
      displacement.row(1) = (2.0 * mesh.nodes.row(2)).array().cos();
      displacement.row(2) = (mesh.nodes.row(0) + mesh.nodes.row(2)).array().sin();
      energy[static_cast<size_t>(n)] = stress_error(mesh, material_of(3.0, 0.3), displacement).energy();
    }
    EXPECT_NEAR(std::log2(energy[0] / energy[1]), 4.0, 0.3) << cell_shape(type).name;
  }
}

// A square bar that twists without warping, one and two cells across: the cells agree with each other, and leave
// traction at its sides. With one across they lack the parabolas of x (1 - y^2), a fifth of the energy; with two, 2/15.
TEST(StressError, of_a_twisted_bar_is_what_is_left_at_its_sides) {
  for (const int n : {1, 2}) {
    const Vec3 size(1, 1, 3);
    const Mesh mesh = *box_mesh(Vec3(-0.5, -0.5, 0), size, {n, n, 3});
    Points displacement = Points::Zero(3, mesh.n_nodes());
    displacement.row(0) = -1e-3 * mesh.nodes.row(2).cwiseProduct(mesh.nodes.row(1));
    displacement.row(1) = 1e-3 * mesh.nodes.row(2).cwiseProduct(mesh.nodes.row(0));
    const Elastic material = material_of(2.6, 0.3);
    EXPECT_LT(stress_error(mesh, material, displacement).energy(), 1e-20);
    FacetKeys sides;
    for (const char* name : {"xmin", "xmax", "ymin", "ymax"})
      for (const Facet& facet : mesh.faces.at(name)) sides.insert(facet_key(facet));
    std::vector<int> nodes(static_cast<size_t>(mesh.n_nodes()));
    std::iota(nodes.begin(), nodes.end(), 0);
    const std::vector<FreeCell> free = free_cells(mesh, sides, nodes);
    EXPECT_EQ(free.size(), static_cast<size_t>(3 * n * n));
    const double shear = 1.0, strain = 0.5 * shear * 1e-6 * 3 / 6;  // 1/2 G (twist)^2 (polar moment) length
    const StressError error = stress_error(mesh, material, displacement, free);
    EXPECT_NEAR(error.energy() / strain, n == 1 ? 1.0 / 5 : 2.0 / 15, 1e-6);
    // At an edge of the bar, where two free sides meet, all of its shear: (G twist)/2 along each, sqrt(3) in von Mises.
    for (int i = 0; i < mesh.n_nodes(); ++i)
      if (mesh.nodes.col(i).head<2>().cwiseAbs().minCoeff() > 0.49) {
        EXPECT_NEAR(error.at_nodes[i], std::sqrt(1.5) * 1e-3, 1e-12) << n;
      }
    EXPECT_LT(stress_error(mesh, material, displacement).at_nodes.maxCoeff(), 1e-12);
  }
}

// Hexahedra of order two have no warping of a square either: one cell across has the polar moment, and the same error.
// With two across a cell lies behind each surface.
TEST(StressError, of_a_twisted_bar_of_one_cell_of_order_two_is_that_of_a_linear_one) {
  for (const CellType type : {CellType::hex20, CellType::hex27})
    for (const int n : {1, 2}) {
      const Mesh mesh = box_of(type, Vec3(1, 1, 3), {n, n, 3});
      Points displacement = Points::Zero(3, mesh.n_nodes());
      displacement.row(0) = -1e-3 * mesh.nodes.row(2).array() * (mesh.nodes.row(1).array() - 0.5);
      displacement.row(1) = 1e-3 * mesh.nodes.row(2).array() * (mesh.nodes.row(0).array() - 0.5);
      FacetKeys sides;
      for (const Facet& facet : boundary_facets(mesh.blocks))
        if (std::abs(facet_area_vector(mesh.nodes, facet).normalized()[2]) < 0.5) sides.insert(facet_key(facet));
      std::vector<int> nodes(static_cast<size_t>(mesh.n_nodes()));
      std::iota(nodes.begin(), nodes.end(), 0);
      const std::vector<FreeCell> free = free_cells(mesh, sides, nodes);
      ASSERT_EQ(free.size(), n == 1 ? 3u : 0u);
      if (n > 1) continue;
      const double strain = 0.5 * 1e-6 * 3 / 6;
      const StressError error = stress_error(mesh, material_of(2.6, 0.3), displacement, free);
      EXPECT_NEAR(error.energy() / strain, 1.0 / 5, 1e-6) << cell_shape(type).name;
      EXPECT_NEAR(error.at_nodes.maxCoeff(), std::sqrt(1.5) * 1e-3, 1e-12);
    }
}

// Whatever the cell, a stress without traction at a surface leaves nothing there, and no constant one leaves a
// resultant.
TEST(StressError, at_a_free_surface_is_none_where_there_is_no_traction) {
  for (const CellType type : cell_types) {
    const Mesh mesh = box_of(type, Vec3(1, 1, 1), {2, 2, 2});
    FacetKeys ends, sides;
    for (const Facet& facet : boundary_facets(mesh.blocks))
      (std::abs(facet_area_vector(mesh.nodes, facet).normalized()[2]) > 0.5 ? ends : sides).insert(facet_key(facet));
    Points displacement = -0.25e-3 * mesh.nodes;
    displacement.row(2) = 1e-3 * mesh.nodes.row(2);  // a pull along z
    std::vector<int> nodes(static_cast<size_t>(mesh.n_nodes()));
    std::iota(nodes.begin(), nodes.end(), 0);
    const Elastic material = material_of(1.0, 0.25);
    const double strain = 0.5e-6;
    EXPECT_LT(stress_error(mesh, material, displacement, free_cells(mesh, sides, nodes)).energy(), 1e-12 * strain)
        << cell_shape(type).name;
    if (nodes_per_cell(type) == cell_shape(type).n_corners) {
      EXPECT_GT(stress_error(mesh, material, displacement, free_cells(mesh, ends, nodes)).energy(), 0.05 * strain)
          << cell_shape(type).name;
    }
  }
}

// The same bar turning at a rate that grows along it: with n cells across lumped masses have 1 + 2/n^2 times its
// inertia; along it, in cells of one length, nothing is added by what is linear.
TEST(LumpedMass, has_more_energy_than_the_material) {
  for (const int n : {1, 2, 4}) {
    const Mesh mesh = *box_mesh(Vec3(-0.5, -0.5, 0), Vec3(1, 1, 3), {n, n, 3});
    Points velocity(3, mesh.n_nodes());
    velocity << -mesh.nodes.row(1), mesh.nodes.row(0), Eigen::RowVectorXd::Constant(mesh.n_nodes(), 100.0);
    double energy = 0.0;
    for (const Vec& of_block : lumping_energies(mesh, 2.0, velocity)) energy += of_block.sum();
    EXPECT_NEAR(energy / (0.5 * 2.0 * 3 / 6), 2.0 / (n * n), 1e-9);
  }
}

TEST(StressError, is_seen_by_every_cell_type) {
  double hex8 = 0.0;
  for (const CellType type : cell_types) {
    const Mesh mesh = box_of(type, Vec3(1, 1, 1), {6, 6, 6});
    Points displacement = Points::Zero(3, mesh.n_nodes());
    displacement.row(2) = 0.5 * mesh.nodes.row(2).cwiseAbs2();
    const double energy = stress_error(mesh, material_of(3.0, 0.0), displacement).energy();
    if (type == CellType::hex8) hex8 = energy;
    if (nodes_per_cell(type) > cell_shape(type).n_corners) {  // a linear strain is theirs
      EXPECT_LT(energy, 1e-12 * hex8) << cell_shape(type).name;
      continue;
    }
    EXPECT_GT(energy, 0.3 * hex8) << cell_shape(type).name;
    EXPECT_LT(energy, 3.0 * hex8) << cell_shape(type).name;
  }
}

}  // namespace
}  // namespace dygita::test
