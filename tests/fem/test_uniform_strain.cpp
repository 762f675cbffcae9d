// Cells of uniform strain with hourglass control.
#include <gtest/gtest.h>

#include <random>

#include "fem/symmetric_blocks.hpp"
#include "fem/uniform_strain.hpp"
#include "meshes.hpp"
#include "numerics/dense.hpp"

namespace dygita::test {
namespace {

const Elastic steel = material_of(200e9, 0.3, 8000.0);

Mesh distorted(CellType type, const std::array<int, 3>& cells = {3, 2, 3}) {
  Mesh mesh = box_of(type, {0.03, 0.02, 0.03}, cells);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-0.0015, 0.0015);
  for (int a = 0; a < mesh.n_nodes(); ++a)
    for (int d = 0; d < 3; ++d) mesh.nodes(d, a) += shift(random);
  return mesh;
}

Points elastic_force(const Mesh& mesh, const Points& u, double hourglass = 0.1) {
  Points force = Points::Zero(3, mesh.n_nodes());
  for (const CellBlock& block : mesh.blocks)
    UniformStrainCells(mesh, block, steel, {true, hourglass, {}}).add_elastic_force(u.data(), force.data());
  return force;
}

Points linear_field(const Mesh& mesh, const Mat3& gradient) {
  return (gradient * mesh.nodes).colwise() + Vec3(1e-4, -2e-4, 3e-4);
}

Mat3 some_gradient() {
  Mat3 g;
  g << 1.0, 0.3, -0.2, 0.5, -0.7, 0.1, 0.4, -0.6, 0.8;
  return 1e-3 * g;
}

Mat full_stiffness(const Mesh& mesh) { return Mat(assemble(mesh, steel).stiffness); }

TEST(UniformStrain, rigid_motion_gives_no_force) {
  for (const CellType type : cell_types) {
    if (cell_shape(type).inertia == Inertia::consistent) continue;  // explicit steps do without them
    const Mesh mesh = distorted(type);
    Mat3 spin;
    spin << 0, -1, 2, 1, 0, -3, -2, 3, 0;
    const double scale = (full_stiffness(mesh) * 1e-3).cwiseAbs().maxCoeff() * 0.03;
    EXPECT_LT(elastic_force(mesh, linear_field(mesh, 1e-3 * spin)).cwiseAbs().maxCoeff(), 1e-12 * scale);
  }
}

TEST(UniformStrain, constant_strain_gives_the_forces_of_the_assembled_stiffness_on_distorted_cells) {
  for (const CellType type : cell_types) {
    if (cell_shape(type).inertia == Inertia::consistent) continue;  // explicit steps do without them
    const Mesh mesh = distorted(type);
    const Points u = linear_field(mesh, some_gradient());
    const Vec full = full_stiffness(mesh) * Eigen::Map<const Vec>(u.data(), u.size());
    const Points force = elastic_force(mesh, u);
    EXPECT_LT((Eigen::Map<const Vec>(force.data(), force.size()) - full).cwiseAbs().maxCoeff(),
              1e-11 * full.cwiseAbs().maxCoeff())
        << cell_shape(type).name;
  }
}

TEST(UniformStrain, tetrahedra_are_those_of_the_assembled_stiffness) {
  const Mesh mesh = distorted(CellType::tet4);
  const Points u = Points::Random(3, mesh.n_nodes());
  const Vec full = full_stiffness(mesh) * Eigen::Map<const Vec>(u.data(), u.size());
  const Points force = elastic_force(mesh, u);
  EXPECT_LT((Eigen::Map<const Vec>(force.data(), force.size()) - full).norm(), 1e-12 * full.norm());
}

Mat matrix_of(const Mesh& mesh, double hourglass) {
  const int n = 3 * mesh.n_nodes();
  Mat k(n, n);
  for (int j = 0; j < n; ++j) {
    Points u = Points::Zero(3, mesh.n_nodes());
    u.data()[j] = 1.0;
    const Points f = elastic_force(mesh, u, hourglass);
    k.col(j) = Eigen::Map<const Vec>(f.data(), n);
  }
  return k;
}

TEST(UniformStrain, one_hexahedron_has_twelve_hourglass_modes_and_the_control_stiffens_each) {
  const Mesh mesh = distorted(CellType::hex8, {1, 1, 1});
  const Mat bare = matrix_of(mesh, 0.0), controlled = matrix_of(mesh, 0.1);
  EXPECT_LT((controlled - controlled.transpose()).norm(), 1e-13 * controlled.norm());
  const Vec without = symmetric_eigen(bare).values;
  const Vec with = symmetric_eigen(controlled).values;
  EXPECT_LT(std::abs(without[17]), 1e-12 * without[23]);  // 6 rigid motions and 12 hourglass modes
  EXPECT_GT(without[18], 1e-3 * without[23]);
  EXPECT_LT(std::abs(with[5]), 1e-12 * with[23]);
  EXPECT_GT(with[6], 1e-2 * with[23]);
  EXPECT_NEAR(with[23], without[23], 1e-3 * with[23]);
}

TEST(UniformStrain, hourglass_energy_is_positive_and_what_the_control_adds_to_the_elastic_energy) {
  const Mesh mesh = distorted(CellType::hex8);
  const Points u = Points::Random(3, mesh.n_nodes());
  Points force = Points::Zero(3, mesh.n_nodes());
  const CellEnergy found =
      UniformStrainCells(mesh, mesh.blocks[0], steel, {true, 0.1, {}}).add_elastic_force(u.data(), force.data());
  const double energy = found.hourglass;
  const double added = 0.5 * (u.array() * (elastic_force(mesh, u, 0.1) - elastic_force(mesh, u, 0.0)).array()).sum();
  EXPECT_GT(energy, 0.0);
  EXPECT_NEAR(energy, added, 1e-11 * energy);
  const double all = 0.5 * (u.array() * force.array()).sum();
  EXPECT_NEAR(found.strain + energy, all, 1e-12 * all);
}

TEST(UniformStrain, equal_cells_share_one_geometry_and_give_the_same_forces) {
  const Mesh box = box_of(CellType::hex8, {0.04, 0.04, 0.04}, {5, 5, 5});
  const Mesh apart = distorted(CellType::hex8, {5, 5, 5});
  const UniformStrainCells shared(box, box.blocks[0], steel, {}), own(apart, apart.blocks[0], steel, {});
  EXPECT_LT(shared.bytes(), 0.3 * own.bytes());
  Mesh shuffled = box;  // no two neighbours in the list are equal: reverse every second cell
  for (size_t i = 0; i < shuffled.blocks[0].nodes.size(); i += 16) {
    int* cell = shuffled.blocks[0].nodes.data() + i;
    const std::array<int, 8> turned = {cell[1], cell[2], cell[3], cell[0], cell[5], cell[6], cell[7], cell[4]};
    std::copy(turned.begin(), turned.end(), cell);
  }
  const Points u = Points::Random(3, box.n_nodes());
  EXPECT_LT((elastic_force(box, u) - elastic_force(shuffled, u)).norm(), 1e-13 * elastic_force(box, u).norm());
}

TEST(UniformStrain, bulk_viscosity_presses_against_a_volume_that_closes_and_dissipates) {
  for (const CellType type : cell_types) {
    if (cell_shape(type).inertia == Inertia::consistent) continue;  // explicit steps do without them
    const Mesh mesh = distorted(type);
    const double rate = 300.0, dt = 1e-8;  // 1/s, s
    for (const double sign : {-1.0, 1.0}) {
      Points u = linear_field(mesh, Mat3::Zero()), force = Points::Zero(3, mesh.n_nodes());
      UniformStrainCells cells(mesh, mesh.blocks[0], steel, {false, 0.0, {0.06, 0.0}});
      UniformStrainCells quadratic(mesh, mesh.blocks[0], steel, {false, 0.0, {0.06, 1.2}});
      cells.start_from(u.data());
      quadratic.start_from(u.data());
      u += linear_field(mesh, sign * rate * dt / 3 * Mat3::Identity());
      const double dissipated = cells.add_force(u.data(), dt, false, force.data()).dissipated;
      // The power of the viscous forces on the motion is the dissipation.
      const Points velocity = linear_field(mesh, sign * rate / 3 * Mat3::Identity());
      EXPECT_NEAR(dt * (force.array() * velocity.array()).sum(), dissipated, 1e-9 * dissipated);
      EXPECT_GT(dissipated, 0.0);
      const double with_quadratic = quadratic.add_force(u.data(), dt, false, force.data()).dissipated;
      if (sign < 0)
        EXPECT_GT(with_quadratic, dissipated);
      else
        EXPECT_DOUBLE_EQ(with_quadratic, dissipated);
      EXPECT_EQ(cells.add_force(u.data(), dt, false, force.data()).dissipated, 0.0);  // at rest since
    }
  }
}

TEST(SymmetricBlocks, multiply_as_the_matrix_does) {
  const Mesh mesh = distorted(CellType::hex8);
  const BodyMatrices body = assemble(mesh, steel);
  const Vec x = Vec::Random(3 * mesh.n_nodes());
  Vec y = Vec::Ones(x.size());
  const SymmetricBlocks blocks(body.stiffness);
  blocks.add_product(x.data(), y.data());
  EXPECT_LT((y - Vec::Ones(x.size()) - body.stiffness * x).norm(), 1e-13 * y.norm());
  EXPECT_LT(blocks.bytes(), 0.6 * 12.0 * static_cast<double>(body.stiffness.nonZeros()));
}

}  // namespace
}  // namespace dygita::test
