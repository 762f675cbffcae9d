#include <gtest/gtest.h>

#include <cstring>
#include <iostream>

#include "base/team.hpp"
#include "fem/assembly.hpp"
#include "fem/meshes.hpp"
#include "numerics/dense.hpp"

namespace dygita::test {
namespace {

const Vec3 brick(1.0, 1.2, 0.9);

// The plain way: element by element through the public functions and a list of entries.
Eigen::SparseMatrix<double, Eigen::RowMajor> from_triplets(const Mesh& mesh, const Elastic& material) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const CellBlock& block : mesh.blocks)
    for (int i = 0; i < block.n_cells(); ++i) {
      const CellMatrix cell = element_stiffness(block.type, nodes_of_cell(mesh, block, i), material);
      for (int r = 0; r < cell.rows(); ++r)
        for (int c = 0; c < cell.cols(); ++c)
          entries.emplace_back(3 * block.cell(i)[r / 3] + r % 3, 3 * block.cell(i)[c / 3] + c % 3, cell(r, c));
    }
  Eigen::SparseMatrix<double, Eigen::RowMajor> matrix(3 * mesh.n_nodes(), 3 * mesh.n_nodes());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

double difference(const SparseMatrix& a, const SparseMatrix& b) {
  const SparseMatrix rest = a - b;
  return rest.coeffs().abs().maxCoeff() / b.coeffs().abs().maxCoeff();
}

TEST(Assembly, equals_the_sum_of_triplets) {
  const Elastic material = material_of(2.1e11, 0.3, 7800.0);
  Mesh tetrahedra = box_of(CellType::tet4, brick, {3, 3, 3});
  distort(tetrahedra, brick, 0.05);
  for (const Mesh& mesh : {distorted_mixed_box(), tetrahedra, box_of(CellType::hex8, {1, 2, 4}, {4, 4, 4})}) {
    const SparseMatrix assembled = assemble(mesh, material).stiffness, expected = from_triplets(mesh, material);
    EXPECT_TRUE(assembled.isCompressed());
    ASSERT_EQ(assembled.nonZeros(), expected.nonZeros());
    EXPECT_LT(difference(assembled, expected), 1e-14);
  }
}

TEST(Assembly, reuses_the_matrix_of_a_cell_for_its_translations_only) {
  const Elastic material = material_of(1.0, 0.3);
  Mesh regular = *box_mesh({0.1, 0.2, 0.3}, {0.7, 1.1, 1.3}, {7, 3, 3}), graded = regular;
  for (int a = 0; a < graded.n_nodes(); ++a) graded.nodes(0, a) *= graded.nodes(0, a);
  EXPECT_LT(difference(assemble(regular, material).stiffness, from_triplets(regular, material)), 1e-12);
  EXPECT_LT(difference(assemble(graded, material).stiffness, from_triplets(graded, material)), 1e-12);
}

// In lanes too, which many shapes of cells take: the diagonal, not the sums of rows.
TEST(Assembly, has_a_positive_mass_at_every_node_of_any_cells) {
  const Elastic material = material_of(1.0, 0.3, 7800.0);
  for (const CellType type : cell_types) {
    Mesh mesh = *box_mesh(Vec3::Zero(), {1, 2, 4}, {5, 4, 4}, type);
    for (int a = 0; a < mesh.n_nodes(); ++a) mesh.nodes(0, a) *= 1.0 + 0.1 * mesh.nodes(1, a);
    const Vec mass = assemble(mesh, material).mass, expected = material.density * nodal_volumes(mesh);
    EXPECT_GT(mass.minCoeff(), 0.0) << cell_shape(type).name;
    EXPECT_LT((mass - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.maxCoeff()) << cell_shape(type).name;
  }
}

TEST(Assembly, has_sorted_columns_and_both_triangles) {
  const SparseMatrix stiffness = assemble(distorted_mixed_box(), material_of(1.0, 0.3)).stiffness;
  for (int row = 0; row < stiffness.rows(); ++row)
    for (int k = stiffness.outerIndexPtr()[row] + 1; k < stiffness.outerIndexPtr()[row + 1]; ++k)
      ASSERT_LT(stiffness.innerIndexPtr()[k - 1], stiffness.innerIndexPtr()[k]);
  const SparseMatrix transposed = stiffness.transpose();
  EXPECT_LT(difference(transposed, stiffness), 1e-15);
}

TEST(Assembly, is_the_same_to_the_bit_with_any_number_of_threads) {
  Mesh mesh = mixed_box(brick, {16, 12, 12});
  distort(mesh, brick, 0.01);
  const Elastic material = material_of(1.0, 0.3, 2.0);
  const int n_threads = thread_limit();
  set_thread_limit(1);
  const BodyMatrices alone = assemble(mesh, material);
  const Tensors stress_alone = nodal_stress(mesh, material, mesh.nodes);
  for (const int n : {2, 3, 5}) {
    set_thread_limit(n);
    const BodyMatrices together = assemble(mesh, material);
    EXPECT_EQ(std::memcmp(together.stiffness.valuePtr(), alone.stiffness.valuePtr(),
                          alone.stiffness.nonZeros() * sizeof(double)),
              0);
    EXPECT_EQ(together.mass, alone.mass);
    EXPECT_EQ(nodal_stress(mesh, material, mesh.nodes), stress_alone);
  }
  set_thread_limit(n_threads);
}

TEST(Assembly, hands_back_the_error_of_a_thread) {
  Mesh mesh = *box_mesh(Vec3::Zero(), Vec3::Ones(), {12, 12, 12});
  mesh.nodes.row(1) *= -1;
  EXPECT_THROW(assemble(mesh, material_of(1.0, 0.3)), std::logic_error);
}

TEST(Assembly, has_the_mass_of_the_body_and_the_weight_of_gravity) {
  const Mesh mesh = distorted_mixed_box();
  const BodyMatrices body = assemble(mesh, material_of(1.0, 0.3, 7800.0));
  EXPECT_GT(body.mass.minCoeff(), 0.0);
  EXPECT_NEAR(body.mass.sum(), 7800.0 * brick.prod(), 1e-9);
  EXPECT_LT((mesh.nodes * body.mass / body.mass.sum() - brick / 2).norm(), 1e-14);
  EXPECT_LT((nodal_volumes(mesh) * 7800.0 - body.mass).cwiseAbs().maxCoeff(), 1e-12);

  // Held below under its weight: the reactions carry it.
  const double g = 9.81;
  Points weight = Points::Zero(3, mesh.n_nodes());
  weight.row(2) = -g * body.mass.transpose();
  std::map<int, double> prescribed;
  for (int a = 0; a < mesh.n_nodes(); ++a)
    if (mesh.nodes(2, a) < 1e-9)
      for (int i = 0; i < 3; ++i) prescribed[3 * a + i] = 0.0;
  const Vec reactions = body.stiffness * flat(solve(body.stiffness, weight, prescribed)) - flat(weight);
  Vec3 total = Vec3::Zero(), moment = Vec3::Zero();
  for (const auto& [dof, value] : prescribed) {
    total[dof % 3] += reactions[dof];
    moment += mesh.nodes.col(dof / 3).cross(Vec3(Vec3::Unit(dof % 3) * reactions[dof]));
  }
  const double expected = 7800.0 * brick.prod() * g;
  EXPECT_LT((total - Vec3(0, 0, expected)).norm(), 1e-9 * expected);
  EXPECT_LT((moment - (brick / 2).cross(Vec3(0, 0, expected))).norm(), 1e-9 * expected);
}

// Exact frequencies of the element, from the dense eigenvalue problem.
double exact_frequency(CellType type, const CellNodes& x, const Elastic& material) {
  const Vec mass = element_mass(type, x, material.density);
  Mat scaled = element_stiffness(type, x, material);
  for (int r = 0; r < scaled.rows(); ++r)
    for (int c = 0; c < scaled.cols(); ++c) scaled(r, c) /= std::sqrt(mass[r / 3] * mass[c / 3]);
  return std::sqrt(symmetric_eigen(scaled).values.maxCoeff());
}

TEST(MaxFrequency, bounds_the_frequencies_of_the_elements_closely) {
  double worst = 0;
  for (const CellType type : cell_types)
    for (const double poisson : {0.0, 0.3, 0.49})
      for (const Vec3& edges : {Vec3(1, 1, 1), Vec3(1, 1, 0.1), Vec3(1, 0.1, 0.1), Vec3(1, 0.5, 0.01)}) {
        const Elastic material = material_of(3.0, poisson, 2.0);
        Mesh mesh = box_of(type, 2 * edges, {2, 2, 2});
        mesh.nodes.col(13) += 0.1 * edges;
        double exact = 0;
        for (int i = 0; i < mesh.n_cells(); ++i)
          exact = std::max(exact, exact_frequency(type, nodes_of_cell(mesh, mesh.blocks[0], i), material));
        const double ratio = max_frequency(mesh, material) / exact;
        EXPECT_GE(ratio, 1.0 - 1e-12) << cell_shape(type).name << ", nu " << poisson << ", " << edges.transpose();
        EXPECT_LT(ratio, 1.2) << cell_shape(type).name << ", nu " << poisson << ", " << edges.transpose();
        worst = std::max(worst, ratio);
        if (edges == Vec3::Ones())
          std::cout << "bound on the frequency / highest element frequency, " << cell_shape(type).name << " cube, nu "
                    << poisson << ": " << ratio << "\n";
      }
  std::cout << "bound on the frequency / highest element frequency: at worst " << worst << "\n";
}

TEST(MaxFrequency, bounds_the_frequencies_of_the_mesh) {
  const Mesh mesh = distorted_mixed_box();
  const Elastic material = material_of(3.0, 0.3, 2.0);
  const BodyMatrices body = assemble(mesh, material);
  Mat scaled = body.stiffness;
  for (int r = 0; r < scaled.rows(); ++r)
    for (int c = 0; c < scaled.cols(); ++c) scaled(r, c) /= std::sqrt(body.mass[r / 3] * body.mass[c / 3]);
  const double highest = std::sqrt(symmetric_eigen(scaled).values.maxCoeff());
  EXPECT_GE(max_frequency(mesh, material), highest);
  EXPECT_LT(max_frequency(mesh, material), 1.5 * highest);
}

TEST(NodalStress, is_the_mean_of_the_adjacent_cells) {
  const Mesh mesh = distorted_mixed_box();
  const Elastic material = material_of(5.0, 0.3);
  const Points displacement = mesh.nodes.array().sin().matrix();
  Tensors sum = Tensors::Zero(6, mesh.n_nodes());
  Vec n_cells = Vec::Zero(mesh.n_nodes());
  for (const CellBlock& block : mesh.blocks)
    for (int i = 0; i < block.n_cells(); ++i) {
      CellNodes moves(3, nodes_per_cell(block.type));
      for (int a = 0; a < moves.cols(); ++a) moves.col(a) = displacement.col(block.cell(i)[a]);
      const Tensors of_cell = element_stress(block.type, nodes_of_cell(mesh, block, i), material, moves);
      for (int a = 0; a < moves.cols(); ++a) {
        sum.col(block.cell(i)[a]) += of_cell.col(a);
        n_cells[block.cell(i)[a]] += 1;
      }
    }
  ASSERT_GT(n_cells.maxCoeff(), n_cells.minCoeff());
  const Tensors expected = sum * n_cells.cwiseInverse().asDiagonal();
  EXPECT_LT((nodal_stress(mesh, material, displacement) - expected).norm(), 1e-14 * expected.norm());
}

TEST(VonMises, equals_the_hand_values) {
  Tensors stress(6, 5);
  stress.col(0) << 5, 0, 0, 0, 0, 0;      // tension
  stress.col(1) << 0, 0, 0, 0, 2, 0;      // shear: sqrt(3) tau
  stress.col(2) << -7, -7, -7, 0, 0, 0;   // pressure
  stress.col(3) << 3, -1, 2, 1, -2, 0.5;  // sqrt((16 + 9 + 1) / 2 + 3 (1 + 4 + 0.25))
  stress.col(4) << 0, 4, 0, 0, 0, 3;      // sqrt(16 + 27)
  const Vec found = von_mises(stress);
  const double expected[] = {5.0, std::sqrt(12.0), 0.0, std::sqrt(28.75), std::sqrt(43.0)};
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(found[i], expected[i], 1e-15 * 10) << i;
}

}  // namespace
}  // namespace dygita::test
