#include <gtest/gtest.h>

#include "fem/meshes.hpp"
#include "fem/stress_error.hpp"

namespace dygita::test {
namespace {

TEST(StressError, is_none_where_the_stress_is_constant) {
  const Mesh mesh = distorted_mixed_box();
  Points displacement = mesh.nodes;
  displacement.row(0) = 2e-3 * mesh.nodes.row(1) - 1e-3 * mesh.nodes.row(0);
  const StressError error = stress_error(mesh, material_of(5.0, 0.3), displacement);
  EXPECT_LT(error.energy, 1e-24);
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
    EXPECT_LT(error.energy, all * (1 + 1e-12));
    EXPECT_GT(error.energy, all * (1 - 2.0 / cut));
    // Half a step at inner nodes.
    EXPECT_NEAR(error.at_nodes[mesh.n_nodes() / 2], 0.5 * young * h * n / cut, 1e-12);
  }
}

TEST(StressError, is_seen_by_every_cell_type) {
  double hex8 = 0.0;
  for (const CellType type : cell_types) {
    const Mesh mesh = box_of(type, Vec3(1, 1, 1), {6, 6, 6});
    Points displacement = Points::Zero(3, mesh.n_nodes());
    displacement.row(2) = 0.5 * mesh.nodes.row(2).cwiseAbs2();
    const double energy = stress_error(mesh, material_of(3.0, 0.0), displacement).energy;
    if (type == CellType::hex8) hex8 = energy;
    if (nodes_per_cell(type) > cell_shape(type).n_corners) {  // a linear strain is theirs
      EXPECT_LT(energy, 1e-12 * hex8) << cell_shape(type).name;
      // Of a quadratic strain in equal cells their stresses meet at the nodes; of a cubic one they do not.
      displacement.row(2) = mesh.nodes.row(2).array().pow(4).matrix();
      const double of_quartic = stress_error(mesh, material_of(3.0, 0.0), displacement).energy;
      EXPECT_GT(of_quartic, 1e-5 * hex8) << cell_shape(type).name;
      EXPECT_LT(of_quartic, 0.3 * hex8) << cell_shape(type).name;
      continue;
    }
    EXPECT_GT(energy, 0.3 * hex8) << cell_shape(type).name;
    EXPECT_LT(energy, 3.0 * hex8) << cell_shape(type).name;
  }
}

}  // namespace
}  // namespace dygita::test
