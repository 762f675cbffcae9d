// Volumetric locking: nearly incompressible bodies under pressure, against Lame's solutions.
#include <gtest/gtest.h>

#include <iostream>

#include "fem/meshes.hpp"

namespace dygita::test {
namespace {

constexpr double inner = 1.0, outer = 2.0;

// Holds the nodes of the coordinate planes in their plane.
std::map<int, double> symmetry(const Mesh& mesh) {
  std::map<int, double> prescribed;
  for (int a = 0; a < mesh.n_nodes(); ++a)
    for (int i = 0; i < 3; ++i)
      if (std::abs(mesh.nodes(i, a)) < 1e-9) prescribed[3 * a + i] = 0.0;
  return prescribed;
}

struct RadialState {
  double displacement;  // found / exact at the inner wall, mean over its nodes
  double stress_error;  // largest error of a nodal stress of the middle layers, over the inner pressure
};

// Unit inner pressure on the eighth of a sphere; u = p a^3 / (b^3 - a^3) ((1 - 2 nu) r / E + (1 + nu) b^3 / (2 E r^2)).
double sphere_displacement(const Elastic& m, double r) {
  const double a3 = std::pow(inner, 3), b3 = std::pow(outer, 3), nu = *m.constant("poisson");
  return a3 / (b3 - a3) / m.young() * ((1 - 2 * nu) * r + (1 + nu) * b3 / (2 * r * r));
}

// Eighth of a thick sphere: three patches of n x n, each the face of a cube, n layers.
Mesh sphere_mesh(int n) {
  Mesh mesh;
  std::map<std::array<int, 4>, int> number;
  std::vector<Vec3> nodes;
  const auto node = [&](std::array<int, 3> at, int layer) {
    const auto [entry, is_new] = number.try_emplace({at[0], at[1], at[2], layer}, static_cast<int>(nodes.size()));
    if (is_new) {
      const auto place = [&](int i) { return std::tan(M_PI / 4 * at[i] / n); };
      nodes.push_back(Vec3(place(0), place(1), place(2)).normalized() * (inner + (outer - inner) * layer / n));
    }
    return entry->second;
  };
  CellBlock block{CellType::hex8, {}};
  for (int face = 0; face < 3; ++face)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (int layer = 0; layer < n; ++layer)
          for (int k = 0; k < 8; ++k) {
            static const int corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
            std::array<int, 3> at{};
            at[face] = n;
            at[(face + 1) % 3] = i + corner[k % 4][0];
            at[(face + 2) % 3] = j + corner[k % 4][1];
            block.nodes.push_back(node(at, layer + k / 4));
          }
  mesh.blocks.push_back(block);
  mesh.nodes.resize(3, static_cast<int>(nodes.size()));
  for (size_t a = 0; a < nodes.size(); ++a) mesh.nodes.col(static_cast<int>(a)) = nodes[a];
  return mesh;
}

RadialState solve_sphere(int n, double poisson) {
  const Mesh mesh = sphere_mesh(n);
  check_mesh(mesh, "sphere");
  const Elastic material = material_of(1000.0, poisson);
  const Points forces = pressure_forces(mesh, [](const Vec3& x) { return x.norm() < inner; });
  const Points found = solve(assemble(mesh, material).stiffness, forces, symmetry(mesh));
  const Tensors stress = nodal_stress(mesh, material, found);

  RadialState state{0.0, 0.0};
  int n_inner = 0;
  const double a3 = std::pow(inner, 3), b3 = std::pow(outer, 3);
  for (int a = 0; a < mesh.n_nodes(); ++a) {
    const double r = mesh.nodes.col(a).norm();
    const Vec3 direction = mesh.nodes.col(a) / r;
    if (r < inner + 1e-9) {
      state.displacement += found.col(a).dot(direction) / sphere_displacement(material, r);
      ++n_inner;
    } else if (r < outer - 1e-9) {
      const double radial = a3 / (b3 - a3) * (1 - b3 / (r * r * r)), hoop = a3 / (b3 - a3) * (1 + b3 / (2 * r * r * r));
      const Mat3 exact =
          radial * direction * direction.transpose() + hoop * (Mat3::Identity() - direction * direction.transpose());
      Eigen::Matrix<double, 6, 1> column;
      column << exact(0, 0), exact(1, 1), exact(2, 2), exact(0, 1), exact(1, 2), exact(2, 0);
      state.stress_error = std::max(state.stress_error, (stress.col(a) - column).cwiseAbs().maxCoeff());
    }
  }
  state.displacement /= n_inner;
  return state;
}

TEST(Incompressible, thick_sphere_under_pressure_swells_as_lame_says) {
  for (const double poisson : {0.3, 0.49, 0.4999}) {
    const RadialState coarse = solve_sphere(4, poisson), fine = solve_sphere(8, poisson);
    std::cout << "thick sphere, nu " << poisson << ": displacement / exact = " << coarse.displacement << " (4 layers), "
              << fine.displacement << " (8 layers); stress error / pressure = " << coarse.stress_error << ", "
              << fine.stress_error << "\n";
    // Second order, and hardly more error than at nu = 0.3: flat facets and linear layers cost most of it.
    EXPECT_NEAR(fine.displacement, 1.0, 0.015) << "nu " << poisson;
    EXPECT_GT((1 - coarse.displacement) / (1 - fine.displacement), 3.5) << "nu " << poisson;
    EXPECT_LT(fine.stress_error, 0.1) << "nu " << poisson;
  }
}

// A block pressed on a quarter of its top, held below: with bulk modulus 3333 times the shear modulus the imprint must
// be about that at nu = 0.49, less the little volume change: a locked element would stop it.
double imprint(CellType type, int n, double poisson) {
  const Mesh mesh = box_of(type, {1, 1, 1}, {n, n, n});
  const Elastic material = material_of(3 * (1 + poisson) / 1.5, poisson);  // the same shear modulus for all
  std::map<int, double> prescribed = symmetry(mesh);
  Points forces = Points::Zero(3, mesh.n_nodes());
  const Vec areas = [&] {
    Vec shares = Vec::Zero(mesh.n_nodes());
    // By the quadrangles of the grid, whatever it is cut into.
    const MeshPtr grid = box_mesh(Vec3::Zero(), Vec3::Ones(), {n, n, n});
    for (const Facet& facet : grid->faces.at("zmax")) {
      Vec3 centre = Vec3::Zero();
      for (const int node : facet.nodes()) centre += mesh.nodes.col(node) / 4;
      if (centre[0] < 0.5 && centre[1] < 0.5)
        for (const int node : facet.nodes()) shares[node] += 0.25 / (n * n);
    }
    return shares;
  }();
  forces.row(2) = -0.01 * areas.transpose();
  int corner = 0;
  for (int a = 0; a < mesh.n_nodes(); ++a)
    if ((mesh.nodes.col(a) - Vec3(0, 0, 1)).norm() < 1e-9) corner = a;
  return -solve(assemble(mesh, material).stiffness, forces, prescribed)(2, corner);
}

TEST(Incompressible, pressed_block_does_not_lock) {
  const double at_049 = imprint(CellType::hex8, 8, 0.49), at_04999 = imprint(CellType::hex8, 8, 0.4999);
  const double coarse = imprint(CellType::hex8, 4, 0.4999), fine = imprint(CellType::hex8, 12, 0.4999);
  const double tetrahedra = imprint(CellType::tet4, 8, 0.4999), prisms = imprint(CellType::prism6, 8, 0.4999);
  std::cout << "pressed block, imprint at nu 0.4999 / at 0.49 (8 cells): " << at_04999 / at_049
            << "; at nu 0.4999, 4 cells / 12 cells: " << coarse / fine << ", 8 cells / 12: " << at_04999 / fine
            << "; prism6 / hex8: " << prisms / at_04999 << ", tet4 / hex8: " << tetrahedra / at_04999 << "\n";
  EXPECT_NEAR(at_04999 / at_049, 1.0, 0.05);
  EXPECT_NEAR(coarse / fine, 1.0, 0.15);
  EXPECT_LT(tetrahedra / at_04999, 0.8);  // the locking of plain elements: were it gone, this test would see nothing
}

TEST(Incompressible, confined_compression_has_the_wave_modulus) {
  for (const CellType type : cell_types)
    for (const double poisson : {0.3, 0.49, 0.4999}) {
      const Vec3 size(1, 1, 2);
      const Mesh mesh = box_of(type, size, {2, 2, 4});
      const Elastic material = material_of(1000.0, poisson);
      std::map<int, double> prescribed;
      for (int a = 0; a < mesh.n_nodes(); ++a) {
        const Vec3 x = mesh.nodes.col(a);
        for (int i = 0; i < 2; ++i)
          if (x[i] < 1e-9 || x[i] > size[i] - 1e-9) prescribed[3 * a + i] = 0.0;
        if (x[2] < 1e-9) prescribed[3 * a + 2] = 0.0;
        if (x[2] > size[2] - 1e-9) prescribed[3 * a + 2] = -0.002;
      }
      const SparseMatrix stiffness = assemble(mesh, material).stiffness;
      const Points found = solve(stiffness, Points::Zero(3, mesh.n_nodes()), prescribed);
      const Vec reactions = stiffness * flat(found);
      double force = 0;
      for (int a = 0; a < mesh.n_nodes(); ++a)
        if (mesh.nodes(2, a) > size[2] - 1e-9) force -= reactions[3 * a + 2];
      EXPECT_NEAR(force / (0.001 * material.p_wave_modulus()), 1.0, 1e-10) << cell_shape(type).name << ", " << poisson;
    }
}

}  // namespace
}  // namespace dygita::test
