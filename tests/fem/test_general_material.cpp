// Kernels of materials with directions: any symmetric positive stiffness of 21 constants, as it lies in each cell.
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "fem/cell_tensor.hpp"
#include "fem/cells.hpp"
#include "fem/every_cell.hpp"
#include "fem/mass.hpp"
#include "fem/meshes.hpp"
#include "fem/stress_error.hpp"
#include "numerics/dense.hpp"

namespace dygita::test {
namespace {

const Mat3 leaning = Eigen::AngleAxisd(0.9, Vec3(1, -2, 3).normalized()).toRotationMatrix();

Mat6 ply_stiffness() {
  Mat6 d = Mat6::Zero();
  d.topLeftCorner<3, 3>() << 143, 4.5, 4.2, 4.5, 12.6, 5.4, 4.2, 5.4, 11.2;
  d.diagonal().tail<3>() << 5, 3, 4;
  return d;
}

Elastic ply() { return {{}, ply_stiffness(), 1.6}; }

TEST(GeneralMaterial, with_two_constants_is_the_isotropic_one_in_every_cell) {
  for_each_cell([](auto cell) {
    using Cell = decltype(cell);
    const auto x = distorted_nodes<Cell>();
    const ElasticTensor own = ElasticTensor::isotropic(3.0, 0.3), general(own.stiffness());
    const Mat k = Cell::stiffness(x, own);
    EXPECT_LT((Mat(Cell::stiffness(x, general)) - k).cwiseAbs().maxCoeff(), 1e-13 * k.cwiseAbs().maxCoeff());
    Nodes<Cell::n_nodes> u = x;
    u.row(0) = x.row(1).cwiseAbs2();
    u.row(2) = x.row(0).cwiseProduct(x.row(2));
    const Tensors stress = Cell::stress(x, own, u);
    EXPECT_LT((Tensors(Cell::stress(x, general, u)) - stress).cwiseAbs().maxCoeff(),
              1e-12 * stress.cwiseAbs().maxCoeff());
  });
}

// A turned cell of turned material has a turned stiffness, and six motions without force.
TEST(GeneralMaterial, turns_with_its_cell) {
  for_each_cell([](auto cell) {
    using Cell = decltype(cell);
    constexpr int n = Cell::n_nodes;
    const Nodes<n> x = distorted_nodes<Cell>(), turned = leaning * x;
    const ElasticTensor tensor(ply_stiffness());
    const Mat k = Cell::stiffness(x, tensor), k_turned = Cell::stiffness(turned, tensor.turned(leaning));
    EXPECT_TRUE(k == k.transpose());
    Mat turn = Mat::Zero(3 * n, 3 * n);
    for (int a = 0; a < n; ++a) turn.block<3, 3>(3 * a, 3 * a) = leaning;
    EXPECT_LT((k_turned - turn * k * turn.transpose()).cwiseAbs().maxCoeff(), 1e-12 * k.cwiseAbs().maxCoeff());
    Mat rigid(3 * n, 6);
    for (int a = 0; a < n; ++a)
      for (int axis = 0; axis < 3; ++axis) {
        rigid.col(axis).segment<3>(3 * a) = Vec3::Unit(axis);
        rigid.col(3 + axis).segment<3>(3 * a) = Vec3::Unit(axis).cross(Vec3(x.col(a)));
      }
    EXPECT_LT((k * rigid).cwiseAbs().maxCoeff(), 1e-12 * k.cwiseAbs().maxCoeff());
  });
}

Mesh leaning_box(CellType type, const Vec3& size) {
  Mesh mesh = box_of(type, size, {3, 3, 3});
  distort(mesh, size, 0.015);
  for (CellBlock& block : mesh.blocks) block.axes.assign(static_cast<size_t>(block.n_cells()), leaning);
  return mesh;
}

// Constant strain, prescribed on the boundary, is found inside, with its stress, and no error of it is estimated.
TEST(GeneralMaterial, passes_the_patch_test_with_its_axes_across_distorted_cells) {
  const Vec3 size(1.0, 1.2, 0.9);
  Mat3 gradient;
  gradient << 1.1, -0.4, 0.7, 0.3, -0.9, 0.2, -0.5, 0.8, 0.6;
  for (const CellType type : cell_types) {
    SCOPED_TRACE(cell_shape(type).name);
    const Mesh mesh = leaning_box(type, size);
    const Points exact = gradient * mesh.nodes;
    std::map<int, double> prescribed;
    for (int a = 0; a < mesh.n_nodes(); ++a)
      if (is_on_boundary(mesh.nodes.col(a), size))
        for (int i = 0; i < 3; ++i) prescribed[3 * a + i] = exact(i, a);
    const Points found = solve(assemble(mesh, ply()).stiffness, Points::Zero(3, mesh.n_nodes()), prescribed);
    EXPECT_LT((found - exact).cwiseAbs().maxCoeff(), 1e-10);
    const Vec6 stress = ply().tensor().turned(leaning).stress(gradient);
    EXPECT_LT((nodal_stress(mesh, ply(), found).colwise() - stress).cwiseAbs().maxCoeff(), 1e-8 * stress.norm());
    EXPECT_LT(stress_error(mesh, ply(), found, {}).energy(), 1e-16 * stress.squaredNorm());
  }
}

// Each cell its own axes, though all are translations of one.
TEST(GeneralMaterial, lies_in_each_cell_of_a_box_as_the_cell_says) {
  Mesh mesh = *box_mesh(Vec3::Zero(), Vec3(3, 2, 1), {3, 2, 1});
  CellBlock& block = mesh.blocks[0];
  for (int i = 0; i < block.n_cells(); ++i)
    block.axes.push_back(Eigen::AngleAxisd(0.3 * i, Vec3::UnitZ()).toRotationMatrix());
  Mat expected = Mat::Zero(3 * mesh.n_nodes(), 3 * mesh.n_nodes());
  double highest = 0.0;
  for (int i = 0; i < block.n_cells(); ++i) {
    const CellNodes x = nodes_of_cell(mesh, block, i);
    const Stiffness<8> k = Hex8::stiffness(x, ply().tensor().turned(block.axes[static_cast<size_t>(i)]));
    for (int a = 0; a < 8; ++a)
      for (int b = 0; b < 8; ++b)
        expected.block<3, 3>(3 * block.cell(i)[a], 3 * block.cell(i)[b]) += k.block<3, 3>(3 * a, 3 * b);
    highest = std::max(highest, symmetric_eigen(Mat(k)).values.maxCoeff());
  }
  EXPECT_LT((Mat(assemble(mesh, ply()).stiffness) - expected).cwiseAbs().maxCoeff(), 1e-12 * expected.maxCoeff());
  const double bound = std::pow(max_frequency(mesh, ply()), 2), exact = highest / (ply().density / 8);
  EXPECT_GE(bound, exact * (1 - 1e-12));
  EXPECT_LE(bound, 1.45 * exact);
}

TEST(GeneralMaterial, without_axes_in_the_cells_is_a_broken_contract) {
  const Mesh mesh = *box_mesh(Vec3::Zero(), Vec3(1, 1, 1), {1, 1, 1});
  EXPECT_THROW(assemble(mesh, ply()), ContractError);
  EXPECT_THROW(max_frequency(mesh, ply()), ContractError);
  EXPECT_THROW(nodal_stress(mesh, ply(), mesh.nodes), ContractError);
}

// Bodies share matrices by the digest of the mesh and turned copies by its shape: axes belong to both.
TEST(OrientedMesh, is_another_mesh_and_the_same_shape_as_its_turned_copies) {
  const MeshPtr box = box_mesh(Vec3::Zero(), Vec3(1, 2, 3), {1, 2, 3});
  const auto with = [&](const Mesh& mesh, const Mat3& axes) {
    return oriented_mesh(mesh, {std::vector<Mat3>(static_cast<size_t>(mesh.n_cells()), axes)});
  };
  const MeshPtr along = with(*box, Mat3::Identity()), across = with(*box, leaning);
  EXPECT_NE(along->digest, box->digest);
  EXPECT_NE(along->digest, across->digest);
  EXPECT_NE(along->shape_digest(), across->shape_digest());
  EXPECT_EQ(along->digest, with(*box, Mat3::Identity())->digest);
  EXPECT_EQ(along->shape_digest(), with(*box, Mat3::Identity())->shape_digest());
  const MeshPtr turned = turned_mesh(*along, leaning, Vec3(1, 0, 0));
  EXPECT_EQ(turned->shape_digest(), along->shape_digest());
  EXPECT_NE(turned->digest, along->digest);
  EXPECT_LT((turned->blocks[0].axes[0] - leaning).norm(), 1e-15);
  EXPECT_NE(with(*turned_mesh(*box, leaning, Vec3::Zero()), Mat3::Identity())->shape_digest(), along->shape_digest());
}

}  // namespace
}  // namespace dygita::test
