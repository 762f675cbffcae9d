// Every row of the table of cells, as the kernels use it.
#include <gtest/gtest.h>

#include "fem/cells.hpp"
#include "fem/every_cell.hpp"
#include "fem/meshes.hpp"
#include "fem/uniform_strain.hpp"
#include "numerics/dense.hpp"

namespace dygita::test {
namespace {

TEST(CellRows, lump_to_positive_masses_of_the_right_total) {
  for_each_cell([](auto cell) {
    using Cell = decltype(cell);
    const auto x = distorted_nodes<Cell>();
    const Vec volumes = node_volumes<Cell>(x);
    double volume = 0.0;
    for (int i = 0; i < Cell::n_mass_points; ++i) volume += point_in_cell(Cell::mass_shapes(), x, i).volume;
    EXPECT_GT(volumes.minCoeff(), 0.0);
    EXPECT_NEAR(volumes.sum(), volume, 1e-12 * volume);
  });
}

TEST(CellRows, tune_masses_that_are_symmetric_and_below_the_lumped_ones) {
  for_each_cell([](auto cell) {
    using Cell = decltype(cell);
    const Elastic material = material_of(3.0, 0.3, 2.0);
    const auto x = distorted_nodes<Cell>();
    const Vec lumped = material.density * Vec(node_volumes<Cell>(x));
    if (Cell::row.inertia == Inertia::consistent) {  // has the consistent one, whatever the step
      const Mat mass = Cell::tuned_mass(x, material.density, {material.p_wave_speed(), 1e-4});
      EXPECT_EQ(mass, Mat(consistent_mass<Cell>(x, material.density)));
      EXPECT_GT(symmetric_eigen(mass).values.minCoeff(), 0.0);
      return;
    }
    for (const double dt : {1e-4, 10.0}) {
      Mat mass = Cell::tuned_mass(x, material.density, {material.p_wave_speed(), dt});
      EXPECT_LT((mass - mass.transpose()).norm(), 1e-14 * mass.norm());
      mass.diagonal().setZero();
      EXPECT_LT((mass.rowwise().sum() - lumped).maxCoeff(), 0.0);
    }
  });
}

// What the points hold comes to the nodes as it is where it is constant, and where it is linear if the row says more
// than constant.
TEST(CellRows, carry_stress_from_the_points_to_the_nodes) {
  for_each_cell([](auto cell) {
    using Cell = decltype(cell);
    const Mat to_nodes = Cell::to_nodes();
    EXPECT_LT((to_nodes.colwise().sum().array() - 1.0).abs().maxCoeff(), 1e-13);
    if (Cell::n_recovery_points < 4) return;
    const Mat found = Mat(Cell::recovery_shapes().points) * to_nodes;
    for (int a = 0; a < Cell::n_nodes; ++a)
      EXPECT_LT((found.col(a) - vector_of(Cell::row.shape.nodes[a])).norm(), 1e-13);
  });
}

TEST(CellRows, have_a_stiffness_that_resists_all_but_six_motions) {
  for_each_cell([](auto cell) {
    using Cell = decltype(cell);
    constexpr int n = Cell::n_nodes;
    const Mat stiffness = Cell::stiffness(distorted_nodes<Cell>(), material_of(1.0, 0.3).tensor());
    const Vec values = symmetric_eigen(stiffness).values;
    EXPECT_LT(values.head(6).cwiseAbs().maxCoeff(), 1e-12 * values[3 * n - 1]);
    // The stiffest of a cell of order two is some ten times stiffer, beside the same softest.
    EXPECT_GT(values[6], (n > Cell::row.n_corners ? 1e-4 : 1e-3) * values[3 * n - 1]);
  });
}

TEST(CellRows, say_of_one_point_what_it_does) {
  for_each_cell([](auto cell) {
    using Cell = decltype(cell);
    constexpr int n = Cell::n_nodes;
    if (Cell::row.one_point == OnePoint::none) return;
    Mesh mesh;
    mesh.nodes = distorted_nodes<Cell>();
    mesh.blocks = {{Cell::type, {}}};
    for (int a = 0; a < n; ++a) mesh.blocks[0].nodes.push_back(a);
    const Elastic material = material_of(2.0, 0.3);
    const UniformStrainCells cells(mesh, mesh.blocks[0], material, {true, 0.1, {}});
    Mat stiffness(3 * n, 3 * n);
    for (int j = 0; j < 3 * n; ++j) {
      Vec force = Vec::Zero(3 * n);
      cells.add_elastic_force(Vec(Vec::Unit(3 * n, j)).data(), force.data());
      stiffness.col(j) = force;
    }
    const Vec values = symmetric_eigen(stiffness).values;
    EXPECT_LT(values.head(6).cwiseAbs().maxCoeff(), 1e-12 * values[3 * n - 1]);
    EXPECT_GT(values[6], 1e-3 * values[3 * n - 1]) << "a motion without resistance";
    if (Cell::row.one_point == OnePoint::exact) {
      const Mat full = Cell::stiffness(mesh.nodes, material.tensor());
      EXPECT_LT((stiffness - full).norm(), 1e-13 * full.norm());
    }
  });
}

}  // namespace
}  // namespace dygita::test
