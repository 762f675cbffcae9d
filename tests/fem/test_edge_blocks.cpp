// Products by edges, with every kind of kernels that this processor has, against the plain matrix.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <random>
#include <tuple>

#include "fem/edge_blocks.hpp"
#include "fem/element.hpp"
#include "fem/mass_edges.hpp"
#include "fem/meshes.hpp"
#include "mesh/box.hpp"
#include "numerics/panel_choice.hpp"

namespace dygita::test {
namespace {

class Edges : public ::testing::TestWithParam<std::string> {
 protected:
  Edges() { use_panel_kernels(GetParam()); }
  ~Edges() override { use_panel_kernels(available_panel_kernels().front()); }
};

TEST_P(Edges, multiply_as_the_matrix_does_within_what_single_precision_stores) {
  const Mesh mesh = distorted_mixed_box();
  const BodyMatrices body = assemble(mesh, material_of(2.1e11, 0.3, 7800.0));
  const EdgeBlocks edges(body.stiffness, mesh.nodes);
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

// The plain way to C: along each edge of a cell a sixth of the mass there, in the share that edge and increment want.
TEST_P(Edges, of_masses_are_what_consistent_mass_takes_along_the_edges_of_hexahedra) {
  const Mesh mesh = distorted_mixed_box();
  const Elastic material = material_of(2.1e11, 0.3, 7800.0);
  constexpr double dt = 1e-5;
  std::vector<char> keeps_lumped(static_cast<size_t>(mesh.n_nodes()), 0);
  keeps_lumped[static_cast<size_t>(mesh.blocks.front().cell(0)[0])] = 1;
  const CellEdges of_cells(mesh, material, keeps_lumped);
  const MassEdges edges(of_cells, material.s_wave_speed(), dt);
  const auto& reference = cell_shape(CellType::hex8).shape.nodes;
  const int n = mesh.n_nodes();
  Mat plain = Mat::Zero(n, n);
  int n_tuned = 0;
  for (const CellBlock& block : mesh.blocks) {
    if (block.type != CellType::hex8) continue;
    for (int i = 0; i < block.n_cells(); ++i) {
      const int* nodes = block.cell(i);
      if (std::any_of(nodes, nodes + 8, [&](int node) { return keeps_lumped[static_cast<size_t>(node)] != 0; }))
        continue;
      ++n_tuned;
      CellNodes x(3, 8);
      for (int a = 0; a < 8; ++a) x.col(a) = mesh.nodes.col(nodes[a]);
      const Eigen::VectorXd corner = element_mass(CellType::hex8, x, material.density);
      for (int a = 0; a < 8; ++a)
        for (int b = 0; b < a; ++b) {
          int n_apart = 0;
          for (size_t d = 0; d < 3; ++d) n_apart += reference[a][d] != reference[b][d];
          if (n_apart != 1) continue;
          const double cfl = material.s_wave_speed() * dt / (x.col(a) - x.col(b)).norm();
          const double mass = (0.5 - 0.5 * cfl * cfl) * (corner[a] + corner[b]) / 6.0;
          for (const auto& [row, column, sign] : {std::tuple{a, a, 1.0}, {b, b, 1.0}, {a, b, -1.0}, {b, a, -1.0}})
            plain(nodes[row], nodes[column]) += sign * mass;
        }
    }
  }
  ASSERT_GT(n_tuned, 0);
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
  const Points expected = of_nodes * plain;
  double worst = 0.0;
  for (int i = 0; i < n; ++i)
    for (int c = 0; c < 3; ++c) worst = std::max(worst, std::abs(y[4 * i + c] - expected(c, i)));
  EXPECT_LT(worst, 1e-7 * expected.cwiseAbs().maxCoeff());
  // Nodes that move by it in one pass.
  std::vector<double> inverse(n), pull(4 * n, 0.0), v(4 * n, 0.0), d(4 * n, 0.0), product(4 * n, 0.0);
  for (double& w : inverse) w = 2.0 + uniform(random);
  for (int i = 0; i < 4 * n; ++i)
    if (i % 4 < 3) pull[i] = y[i] + uniform(random), v[i] = uniform(random), d[i] = uniform(random);
  const std::vector<double> v_old = v, d_old = d;
  edges.move_nodes({0.9, 0.1, inverse.data(), pull.data(), v.data(), d.data()}, x.data(), product.data());
  const double size = expected.cwiseAbs().maxCoeff();
  for (int i = 0; i < 4 * n; ++i) {
    EXPECT_NEAR(product[i], y[i], 1e-14 * size);
    EXPECT_NEAR(v[i], 0.9 * v_old[i] - inverse[i / 4] * (pull[i] + y[i]), 1e-13 * (1.0 + size));
    EXPECT_NEAR(d[i], d_old[i] + 0.1 * v[i], 1e-14);
  }
}

TEST_P(Edges, leave_a_translation_without_force_and_the_whole_without_a_resultant) {
  const Mesh mesh = distorted_mixed_box();
  const BodyMatrices body = assemble(mesh, material_of(2.1e11, 0.3, 7800.0));
  const EdgeBlocks edges(body.stiffness, mesh.nodes);
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

// Beside forces on nodes, which single precision leaves.
TEST_P(Edges, leave_a_turn_without_force_in_sum_and_moment) {
  for (const CellShape& shape : cell_shapes) {
    SCOPED_TRACE(shape.name);
    MeshPtr box = box_mesh(Vec3(0.3, 0, 0), Vec3(0.03, 0.02, 0.01), {3, 2, 2}, shape.type);
    Mesh mesh = *box;
    mesh.nodes = (Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix() * mesh.nodes).eval();
    const BodyMatrices body = assemble(mesh, material_of(2.1e11, 0.3, 7800.0));
    const EdgeBlocks edges(body.stiffness, mesh.nodes);
    const int n = edges.n_nodes();
    const Vec3 centre = mesh.nodes.rowwise().mean();
    const double stiffness = body.stiffness.diagonal().maxCoeff(), length = 0.03;
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<double> x(4 * n, 0.0), y(4 * n, 0.0);
      for (int i = 0; i < n; ++i)
        Eigen::Map<Vec3>(x.data() + 4 * i) = Vec3::Unit(axis).cross(mesh.nodes.col(i) - centre);
      edges.add_product(x.data(), y.data());
      Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
      for (int i = 0; i < n; ++i) {
        const Vec3 own = Eigen::Map<const Vec3>(y.data() + 4 * i);
        force += own;
        moment += (mesh.nodes.col(i) - centre).cross(own);
      }
      EXPECT_LT(force.norm(), 1e-8 * stiffness * length);
      EXPECT_LT(moment.norm(), 1e-8 * stiffness * length * length);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Available, Edges, ::testing::ValuesIn(available_panel_kernels()),
                         [](const auto& kernels) { return kernels.param; });

}  // namespace
}  // namespace dygita::test
