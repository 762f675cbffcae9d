// Cantilevers of one cell through the thickness, against beam theory.
#include <gtest/gtest.h>

#include <iostream>

#include "fem/meshes.hpp"

namespace dygita::test {
namespace {

constexpr double height = 1.0, length = 10.0;

// Deflection under an end load, over that of beam theory with shear, W L^3 / 3 E I + W L / (kappa G A). The root keeps
// its plane but may shrink and swell, as beam theory has it.
double tip_ratio(const Mesh& mesh, double poisson) {
  const Elastic material = material_of(1000.0, poisson);
  std::map<int, double> prescribed;
  Points forces = Points::Zero(3, mesh.n_nodes());
  std::vector<int> tip;
  for (int a = 0; a < mesh.n_nodes(); ++a) {
    const Vec3 x = mesh.nodes.col(a);
    if (x[0] < 1e-9) prescribed[3 * a] = 0.0;
    if (x.norm() < 1e-9) prescribed[3 * a + 1] = prescribed[3 * a + 2] = 0.0;
    if (x[0] < 1e-9 && x[1] < 1e-9 && x[2] > height - 1e-9) prescribed[3 * a + 1] = 0.0;
    if (x[0] > length - 1e-9) tip.push_back(a);
  }
  for (const int a : tip) forces(2, a) = 1.0 / static_cast<double>(tip.size());

  const Points found = solve(assemble(mesh, material).stiffness, forces, prescribed);
  double deflection = 0;
  for (const int a : tip) deflection += found(2, a) / static_cast<double>(tip.size());

  const double inertia = std::pow(height, 4) / 12, kappa = 10 * (1 + poisson) / (12 + 11 * poisson);
  const double beam = std::pow(length, 3) / (3 * material.young() * inertia) +
                      length / (kappa * material.shear_modulus() * height * height);
  return deflection / beam;
}

Mesh cantilever(CellType type, int n) { return box_of(type, {length, height, height}, {n, 1, 1}); }

void print(const char* what, double poisson, double ratio) {
  std::cout << "cantilever, " << what << ", nu " << poisson << ": deflection / beam theory = " << ratio << "\n";
}

TEST(Cantilever, of_ten_hexahedra_bends_as_a_beam_at_any_poisson_ratio) {
  for (const double poisson : {0.0, 0.3, 0.49, 0.4999}) {
    const double ratio = tip_ratio(cantilever(CellType::hex8, 10), poisson);
    print("10 hex8", poisson, ratio);
    EXPECT_NEAR(ratio, 1.0, 0.02) << "nu " << poisson;
  }
}

// A curvature constant in each of n cells where it should be linear costs 1 / (4 n^2), here 1.6 %.
TEST(Cantilever, of_four_long_hexahedra_bends_nearly_as_a_beam) {
  const double ratio = tip_ratio(cantilever(CellType::hex8, 4), 0.3);
  print("4 hex8 of aspect 2.5", 0.3, ratio);
  EXPECT_NEAR(ratio, 1.0, 0.03);
}

// Slanted cells keep most of the flexibility; cells of alternating trapezoids do not: no element of 8 nodes that passes
// the patch test can (MacNeal, 1987).
TEST(Cantilever, of_slanted_hexahedra_keeps_most_of_its_flexibility) {
  Mesh slanted = cantilever(CellType::hex8, 10), trapezoids = slanted;
  for (int a = 0; a < slanted.n_nodes(); ++a) {
    const Vec3 x = slanted.nodes.col(a);
    if (x[0] < 1e-9 || x[0] > length - 1e-9) continue;
    const double slope = (x[2] / height - 0.5) * 0.5;
    slanted.nodes(0, a) += slope;
    trapezoids.nodes(0, a) += std::lround(x[0]) % 2 ? slope : -slope;
  }
  const double of_slanted = tip_ratio(slanted, 0.3), of_trapezoids = tip_ratio(trapezoids, 0.3);
  print("10 hex8 slanted by 27 degrees", 0.3, of_slanted);
  print("10 hex8 in trapezoids", 0.3, of_trapezoids);
  EXPECT_NEAR(of_slanted, 1.0, 0.05);
  EXPECT_GT(of_trapezoids, 0.5);
  EXPECT_LT(of_trapezoids, 1.0);
}

// What the manual warns of: without internal modes one layer of cells is far too stiff.
TEST(Cantilever, of_prisms_or_tetrahedra_is_too_stiff_by_far) {
  for (const CellType type : {CellType::prism6, CellType::tet4}) {
    const double coarse = tip_ratio(cantilever(type, 10), 0.3);
    const double fine = tip_ratio(box_of(type, {length, height, height}, {40, 4, 4}), 0.3);
    print(cell_shape(type).name, 0.3, coarse);
    print((std::string(cell_shape(type).name) + ", 4 x 4 cells in the section").c_str(), 0.3, fine);
    EXPECT_LT(coarse, 0.9);
    EXPECT_GT(fine, coarse);
    EXPECT_LT(fine, 1.0);
  }
}

// sigma_xx is linear through the thickness: M z / I at the middle of the length.
TEST(Cantilever, of_hexahedra_has_the_beam_stress_at_its_nodes) {
  const double curvature = 1e-3, poisson = 0.3;
  const Mesh mesh = cantilever(CellType::hex8, 10);
  const Elastic material = material_of(1000.0, poisson);
  Points displacement(3, mesh.n_nodes());
  for (int a = 0; a < mesh.n_nodes(); ++a) {
    const double x = mesh.nodes(0, a), y = mesh.nodes(1, a), z = mesh.nodes(2, a) - height / 2;
    displacement.col(a) << curvature * x * z, -curvature * poisson * y * z,
        -curvature / 2 * (x * x + poisson * (z * z - y * y));
  }
  const Tensors stress = nodal_stress(mesh, material, displacement);
  for (int a = 0; a < mesh.n_nodes(); ++a) {
    EXPECT_NEAR(stress(0, a), material.young() * curvature * (mesh.nodes(2, a) - height / 2), 1e-12);
    EXPECT_LT(stress.col(a).tail<5>().norm(), 1e-12);
  }
}

}  // namespace
}  // namespace dygita::test
