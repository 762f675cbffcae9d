// Products by edges, with every kind of kernels that this processor has, against the plain matrix.
#include <gtest/gtest.h>

#include <random>

#include "fem/edge_blocks.hpp"
#include "fem/mass_edges.hpp"
#include "fem/meshes.hpp"
#include "numerics/panel_choice.hpp"

namespace dygita::test {
namespace {

class Edges : public ::testing::TestWithParam<std::string> {
 protected:
  Edges() { use_panel_kernels(GetParam()); }
  ~Edges() override { use_panel_kernels(available_panel_kernels().front()); }
};

TEST_P(Edges, multiply_as_the_matrix_does_within_what_single_precision_stores) {
  const BodyMatrices body = assemble(distorted_mixed_box(), material_of(2.1e11, 0.3, 7800.0));
  const EdgeBlocks edges(body.stiffness);
  const int n = edges.n_nodes();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Vec x(3 * n);
  std::vector<double> padded(4 * n, 0.0), y(4 * n, 0.0);
  for (int i = 0; i < 3 * n; ++i) padded[4 * (i / 3) + i % 3] = x[i] = uniform(random);
  edges.add_product(padded.data(), y.data());
  const Vec plain = body.stiffness * x;
  double worst = 0.0;
  for (int i = 0; i < 3 * n; ++i) worst = std::max(worst, std::abs(y[4 * (i / 3) + i % 3] - plain[i]));
  EXPECT_LT(worst, 1e-7 * plain.cwiseAbs().maxCoeff());
  EXPECT_GT(worst, 0.0);
  for (int i = 0; i < n; ++i) EXPECT_EQ(y[4 * i + 3], 0.0);
}

TEST_P(Edges, of_masses_are_what_a_tuned_one_lacks_of_the_lumped) {
  const Mesh mesh = distorted_mixed_box();
  const Elastic material = material_of(2.1e11, 0.3, 7800.0);
  const WaveTuning tuning{material.s_wave_speed(), 1e-5, true};
  const MassEdges edges(mesh, material, tuning, {});
  const SparseMatrix mass = tuned_mass(mesh, material, tuning, {});
  const Vec lumped = assemble(mesh, material).mass;
  const int n = mesh.n_nodes();
  std::vector<double> x(4 * n, 0.0), y(4 * n, 0.0);
  for (int i = 0; i < n; ++i)
    for (int c = 0; c < 3; ++c) x[4 * i + c] = 0.7 + 0.1 * c;
  edges.add_product(x.data(), y.data());
  for (const double f : y) EXPECT_EQ(f, 0.0);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Points of_nodes(3, n);
  for (int i = 0; i < n; ++i)
    for (int c = 0; c < 3; ++c) x[4 * i + c] = of_nodes(c, i) = uniform(random);
  edges.add_product(x.data(), y.data());
  const Points plain = of_nodes * lumped.asDiagonal() - (mass * of_nodes.transpose()).transpose();
  double worst = 0.0;
  for (int i = 0; i < n; ++i)
    for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(y[4 * i + c] - plain(c, i)));
  EXPECT_LT(worst, 1e-7 * plain.cwiseAbs().maxCoeff());
}

TEST_P(Edges, leave_a_translation_without_force_and_the_whole_without_a_resultant) {
  const BodyMatrices body = assemble(distorted_mixed_box(), material_of(2.1e11, 0.3, 7800.0));
  const EdgeBlocks edges(body.stiffness);
  const int n = edges.n_nodes();
  std::vector<double> x(4 * n, 0.0), y(4 * n, 0.0);
  for (int i = 0; i < n; ++i)
    for (int c = 0; c < 3; ++c) x[4 * i + c] = 0.7 + 0.1 * c;
  edges.add_product(x.data(), y.data());
  for (const double f : y) EXPECT_EQ(f, 0.0);
  for (int i = 0; i < n; ++i) x[4 * i] += 1e-3 * i;
  edges.add_product(x.data(), y.data());
  double sum = 0.0, size = 0.0;
  for (int i = 0; i < n; ++i) {
    sum += y[4 * i];
    size += std::abs(y[4 * i]);
  }
  EXPECT_LT(std::abs(sum), 1e-14 * size);
}

INSTANTIATE_TEST_SUITE_P(Available, Edges, ::testing::ValuesIn(available_panel_kernels()),
                         [](const auto& kernels) { return kernels.param; });

}  // namespace
}  // namespace dygita::test
