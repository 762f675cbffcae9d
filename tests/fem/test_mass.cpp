#include <gtest/gtest.h>

#include <numbers>

#include "fem/mass.hpp"
#include "fem/meshes.hpp"
#include "numerics/dense.hpp"

namespace dygita::test {
namespace {

TEST(TunedMass, is_symmetric_positive_and_has_the_lumped_row_sums) {
  const Mesh mesh = distorted_mixed_box();
  const Elastic material = material_of(3.0, 0.3, 2.0);
  const Vec lumped = assemble(mesh, material).mass;
  for (const double dt : {1e-3, 0.1, 10.0}) {
    const SparseMatrix mass = tuned_mass(mesh, material, {material.p_wave_speed(), dt}, {});
    const Mat dense = mass;
    EXPECT_LT((dense - dense.transpose()).norm(), 1e-15 * dense.norm());
    EXPECT_LT((dense.rowwise().sum() - lumped).norm(), 1e-14 * lumped.norm());
    EXPECT_GT(symmetric_eigen(dense).values.minCoeff(), 0.0);
  }
}

TEST(TunedMass, stays_lumped_in_cells_with_a_marked_node) {
  const Mesh mesh = *box_mesh(Vec3::Zero(), Vec3(1, 1, 4), {1, 1, 4});
  std::vector<char> marked(mesh.n_nodes(), 0);
  for (int i = 0; i < mesh.n_nodes(); ++i) marked[i] = mesh.nodes(2, i) < 0.1;
  const Mat mass = tuned_mass(mesh, material_of(1.0, 0.0), {1.0, 0.1}, marked);
  for (int i = 0; i < mesh.n_nodes(); ++i) {
    if (!marked[i]) continue;
    EXPECT_NEAR(mass.row(i).cwiseAbs().sum(), mass(i, i), 1e-15);
  }
  EXPECT_GT(mass.row(mesh.n_nodes() - 1).cwiseAbs().sum(), 1.1 * mass(mesh.n_nodes() - 1, mesh.n_nodes() - 1));
}

// A free bar of 24 slices: its first frequencies of stretching as trapezoidal steps make them, against n pi c / L.
double worst_frequency_error(bool is_tuned, double cfl) {
  const int n = 24;
  const Mesh mesh = *box_mesh(Vec3::Zero(), Vec3(2.0 / n, 2.0 / n, 1.0), {1, 1, n});
  const Elastic material = material_of(1.0, 0.0, 1.0);
  const double dt = cfl / n;
  const BodyMatrices body = assemble(mesh, material);
  const Mat mass =
      is_tuned ? Mat(tuned_mass(mesh, material, {material.p_wave_speed(), dt}, {})) : Mat(body.mass.asDiagonal());
  // Motions along z alone, uniform over each section.
  Mat k = Mat::Zero(n + 1, n + 1), m = Mat::Zero(n + 1, n + 1);
  const auto section = [&](int node) { return static_cast<int>(std::lround(mesh.nodes(2, node) * n)); };
  for (int a = 0; a < mesh.n_nodes(); ++a)
    for (int b = 0; b < mesh.n_nodes(); ++b) {
      k(section(a), section(b)) += body.stiffness.coeff(3 * a + 2, 3 * b + 2);
      m(section(a), section(b)) += mass(a, b);
    }
  const Vec squares = generalized_symmetric_eigen(k, m).values;
  double worst = 0.0;
  for (int mode = 1; mode <= 4; ++mode) {
    const double stepped = 2.0 / dt * std::atan(0.5 * dt * std::sqrt(squares[mode]));
    worst = std::max(worst, std::abs(stepped / (mode * std::numbers::pi) - 1.0));
  }
  return worst;
}

TEST(TunedMass, gives_waves_their_speed_to_the_fourth_order) {
  for (const double cfl : {0.1, 0.5, 0.7}) {
    const double tuned = worst_frequency_error(true, cfl), lumped = worst_frequency_error(false, cfl);
    EXPECT_LT(tuned, 0.1 * lumped) << cfl;
    std::cout << "CFL " << cfl << ": error of the first four frequencies " << tuned << ", lumped " << lumped << "\n";
  }
}

}  // namespace
}  // namespace dygita::test
