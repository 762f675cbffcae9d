// Patch tests: a field of constant strain, prescribed on the boundary, must be found inside a distorted mesh.
#include <gtest/gtest.h>

#include <iostream>

#include "fem/meshes.hpp"

namespace dygita::test {
namespace {

const Vec3 patch_size(1.0, 1.2, 0.9);

// Largest errors of displacement and of nodal stress, relative to the largest exact value.
struct PatchErrors {
  double displacement, stress;
};

PatchErrors patch_errors(const Mesh& mesh, double poisson) {
  const Elastic material = material_of(2.1e11, poisson);
  Mat3 gradient;
  gradient << 1.1, -0.4, 0.7, 0.3, -0.9, 0.2, -0.5, 0.8, 0.6;
  gradient *= 1e-3;
  const Points exact = (gradient * mesh.nodes).colwise() + Vec3(1e-3, -2e-3, 3e-3);

  std::map<int, double> prescribed;
  for (int a = 0; a < mesh.n_nodes(); ++a)
    if (is_on_boundary(mesh.nodes.col(a), patch_size))
      for (int i = 0; i < 3; ++i) prescribed[3 * a + i] = exact(i, a);
  EXPECT_LT(prescribed.size(), 3 * static_cast<size_t>(mesh.n_nodes())) << "no inner node: nothing is tested";

  const BodyMatrices body = assemble(mesh, material);
  const Points found = solve(body.stiffness, Points::Zero(3, mesh.n_nodes()), prescribed);

  Eigen::Matrix<double, 6, 1> strain;
  strain << gradient(0, 0), gradient(1, 1), gradient(2, 2), gradient(0, 1) + gradient(1, 0),
      gradient(1, 2) + gradient(2, 1), gradient(2, 0) + gradient(0, 2);
  const Eigen::Matrix<double, 6, 1> stress = material.hooke() * strain;
  const Tensors errors = nodal_stress(mesh, material, found).colwise() - stress;
  return {(found - exact).cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff(),
          errors.cwiseAbs().maxCoeff() / stress.cwiseAbs().maxCoeff()};
}

void expect_passed(const char* what, Mesh mesh, double poisson, double amplitude) {
  distort(mesh, patch_size, amplitude);
  check_mesh(mesh, what);
  const PatchErrors errors = patch_errors(mesh, poisson);
  std::cout << "patch test, " << what << ", nu " << poisson << ": displacement " << errors.displacement << ", stress "
            << errors.stress << "\n";
  EXPECT_LT(errors.displacement, 1e-10);
  EXPECT_LT(errors.stress, 1e-10);
}

TEST(PatchTest, is_passed_by_distorted_hexahedra) {
  expect_passed("hex8", box_of(CellType::hex8, patch_size, {3, 3, 3}), 0.3, 0.09);
}

TEST(PatchTest, is_passed_by_distorted_prisms) {
  expect_passed("prism6", box_of(CellType::prism6, patch_size, {3, 3, 3}), 0.3, 0.06);
}

TEST(PatchTest, is_passed_by_distorted_tetrahedra) {
  expect_passed("tet4", box_of(CellType::tet4, patch_size, {3, 3, 3}), 0.3, 0.06);
}

// Every node is moved on its own: edges and facets are curved.
TEST(PatchTest, is_passed_by_curved_cells_of_order_two) {
  for (const CellType type : {CellType::tet10, CellType::hex20, CellType::hex27, CellType::prism15, CellType::prism18})
    expect_passed(cell_shape(type).name, box_of(type, patch_size, {2, 2, 2}), 0.3, 0.03);
}

TEST(PatchTest, is_passed_by_hexahedra_and_prisms_together) {
  expect_passed("hex8 and prism6", mixed_box(patch_size, {4, 3, 3}), 0.3, 0.05);
}

TEST(PatchTest, is_passed_near_incompressibility) {
  expect_passed("hex8", box_of(CellType::hex8, patch_size, {3, 3, 3}), 0.4999, 0.09);
}

}  // namespace
}  // namespace dygita::test
