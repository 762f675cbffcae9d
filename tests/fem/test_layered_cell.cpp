// Cells with plies in them: what no deck shows.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <memory>

#include "fem/layered_cell.hpp"
#include "fem/meshes.hpp"
#include "fem/own_stress.hpp"
#include "material/material.hpp"
#include "numerics/dense.hpp"

namespace dygita::test::layered_cell_tests {
namespace {

Elastic ply() {
  for (const MaterialEntry& entry : material_table())
    if (entry.word == "orthotropic")
      return entry.make({{"e1", 140e9},
                         {"e2", 10e9},
                         {"e3", 9e9},
                         {"nu12", 0.3},
                         {"nu13", 0.25},
                         {"nu23", 0.45},
                         {"g12", 5e9},
                         {"g13", 4e9},
                         {"g23", 3e9},
                         {"density", 1600}});
  throw std::runtime_error("no orthotropic material");
}

Elastic stack(const std::vector<double>& angles, double thickness) {
  const Elastic one = ply();
  std::vector<PlyOf> plies;
  for (const double angle : angles)
    plies.push_back({one, nullptr, thickness / static_cast<double>(angles.size()), angle});
  return laminate(plies);
}

Mesh oriented_box(CellType type, const Vec3& size, const std::array<int, 3>& cells, const Mat3& axes) {
  Mesh mesh = box_of(type, size, cells);
  std::vector<std::vector<Mat3>> all;
  for (const CellBlock& block : mesh.blocks) all.emplace_back(static_cast<size_t>(block.n_cells()), axes);
  return *oriented_mesh(mesh, std::move(all));
}

// Six motions cost nothing, all others something.
TEST(LayeredCell, resists_all_but_rigid_motions) {
  for (const CellType type : {CellType::hex8, CellType::hex20, CellType::hex27})
    for (const std::vector<double>& angles : {std::vector<double>{0.0}, {0.3, -0.7, 1.5}}) {
      const Vec3 size(3e-3, 2e-3, 1e-3);
      const Mesh mesh = oriented_box(type, size, {1, 1, 1}, Mat3::Identity());
      const Elastic material = stack(angles, 1e-3);
      const CellMatrix k =
          LayeredCell(type, nodes_of_cell(mesh, mesh.blocks[0], 0), Mat3::Identity(), *material.layup).stiffness();
      const Vec values = symmetric_eigen(Mat(k)).values;
      const double largest = values.tail<1>()[0];
      EXPECT_LT(values.head<6>().cwiseAbs().maxCoeff(), 1e-10 * largest) << cell_shape(type).name << angles.size();
      EXPECT_GT(values[6], 1e-5 * largest) << cell_shape(type).name << angles.size();
    }
}

// Plies that are all alike are their material: a uniform strain in cells of any shape has its energy and its stress.
TEST(LayeredCell, of_equal_plies_passes_the_patch_test) {
  const Mat3 axes = Eigen::AngleAxisd(0.4, Vec3::UnitZ()).toRotationMatrix();
  for (const CellType type : {CellType::hex8, CellType::hex20}) {
    Mesh mesh = oriented_box(type, {3e-3, 2e-3, 1e-3}, {3, 3, 1}, axes);
    // Sheared in the plane, from place to place otherwise.
    for (Eigen::Index i = 0; i < mesh.nodes.cols(); ++i) {
      const Vec3 x = mesh.nodes.col(i);
      mesh.nodes(0, i) += 0.1 * x[1] + 30.0 * x[0] * x[1];
    }
    const Elastic material = stack({0.2, 0.2, 0.2}, 1e-3);
    Elastic plain = ply();
    Mat3 gradient;
    gradient << 1e-3, 2e-4, -3e-4, 5e-4, -4e-4, 1e-4, 2e-4, 6e-4, 3e-4;
    const Points u = gradient * mesh.nodes;
    const BodyMatrices body = assemble(mesh, material);
    const Mat3 own = axes * Mat3(Eigen::AngleAxisd(0.2, Vec3::UnitZ()));
    const Vec6 stress = plain.tensor().turned(own).stress(gradient);
    const double energy = stress.dot(strain_of(gradient)) * volume(mesh);
    EXPECT_NEAR(flat(u).dot(body.stiffness * flat(u)), energy, 1e-10 * energy) << cell_shape(type).name;
    const Tensors found = nodal_stress(mesh, material, u);
    for (Eigen::Index i = 0; i < found.cols(); ++i)
      EXPECT_LT((found.col(i) - stress).norm(), 1e-9 * stress.norm()) << cell_shape(type).name;
  }
}

// The layup the other way up, seen from below, is the same body.
TEST(LayeredCell, lies_along_axis_three_of_the_layup) {
  const Vec3 size(3e-3, 2e-3, 1e-3);
  Mat3 turned = Mat3::Identity();
  turned.col(1) *= -1, turned.col(2) *= -1;
  for (const CellType type : {CellType::hex8, CellType::hex20}) {
    const Mesh up = oriented_box(type, size, {2, 1, 1}, Mat3::Identity()),
               down = oriented_box(type, size, {2, 1, 1}, turned);
    const Mat one = assemble(up, stack({0.0, 0.5, 1.2}, 1e-3)).stiffness,
              other = assemble(down, stack({-1.2, -0.5, 0.0}, 1e-3)).stiffness,
              wrong = assemble(down, stack({0.0, 0.5, 1.2}, 1e-3)).stiffness;
    EXPECT_LT((one - other).norm(), 1e-12 * one.norm());
    EXPECT_GT((one - wrong).norm(), 1e-2 * one.norm());
  }
  // Through any direction of the cell: a box that stands on its side.
  Mat3 side;
  side << 0, 0, 1, 1, 0, 0, 0, 1, 0;  // axis 3 along x, 1 along y
  const Mesh lying = oriented_box(CellType::hex8, size, {1, 1, 1}, Mat3::Identity()),
             standing = oriented_box(CellType::hex8, {1e-3, 3e-3, 2e-3}, {1, 1, 1}, side);
  const Elastic material = stack({0.0, 0.5, 1.2}, 1e-3);
  const auto values = [&](const Mesh& mesh) { return symmetric_eigen(Mat(assemble(mesh, material).stiffness)).values; };
  EXPECT_LT((values(lying) - values(standing)).norm(), 1e-10 * values(lying).norm());
}

// Reduced stiffness of a ply at an angle, with the constants above: stresses xx yy xy of strains in the plane.
Mat3 reduced(double angle) {
  const double e1 = 140e9, e2 = 10e9, nu12 = 0.3, k = 1 - nu12 * nu12 * e2 / e1, c = std::cos(angle),
               s = std::sin(angle);
  Mat3 q, to_own;
  q << e1 / k, nu12 * e2 / k, 0, nu12 * e2 / k, e2 / k, 0, 0, 0, 5e9;
  to_own << c * c, s * s, s * c, s * s, c * c, -s * c, -2 * s * c, 2 * s * c, c * c - s * s;
  return to_own.transpose() * q * to_own;
}

// Forces and moments per length of strains of the middle and curvatures, of classical lamination theory.
Eigen::Matrix<double, 6, 6> plate(const std::vector<double>& angles, double h) {
  Eigen::Matrix<double, 6, 6> stiffness = Eigen::Matrix<double, 6, 6>::Zero();
  const double t = h / static_cast<double>(angles.size());
  for (size_t i = 0; i < angles.size(); ++i) {
    const double low = t * static_cast<double>(i) - h / 2, high = low + t;
    const Mat3 q = reduced(angles[i]);
    stiffness.topLeftCorner<3, 3>() += t * q;
    stiffness.topRightCorner<3, 3>() += (high * high - low * low) / 2 * q;
    stiffness.bottomLeftCorner<3, 3>() += (high * high - low * low) / 2 * q;
    stiffness.bottomRightCorner<3, 3>() += (std::pow(high, 3) - std::pow(low, 3)) / 3 * q;
  }
  return stiffness;
}

// Its strains and curvatures under a force and a moment along x.
Eigen::Matrix<double, 6, 1> theory(const std::vector<double>& angles, double h, double force, double moment) {
  Eigen::Matrix<double, 6, 1> load = Eigen::Matrix<double, 6, 1>::Zero();
  load[0] = force, load[3] = moment;
  return plate(angles, h).fullPivLu().solve(load);
}

// Pulled, and bent by a traction that grows with z: coupled layups stretch, bend and twist at once.
TEST(LayeredCell, in_a_strip_is_classical_lamination_theory_to_rounding) {
  const double l = 40e-3, w = 20e-3, h = 2e-3, p = 100e6;
  for (const std::vector<double>& angles :
       {std::vector<double>{0, 1.5707963267948966}, {0.5, -0.5}, {0, 0.8, -0.8, 1.5}, {0.3, 0.3, 1.2}})
    for (const bool is_bent : {false, true}) {
      SCOPED_TRACE(testing::PrintToString(angles) + (is_bent ? " bent" : " pulled"));
      const Mesh mesh = oriented_box(CellType::hex8, {l, w, h}, {4, 2, 1}, Mat3::Identity());
      const Elastic material = stack(angles, h);
      Points force = -p * (pressure_forces(mesh, [&](const Vec3& x) { return x[0] > l - 1e-9; }) +
                           pressure_forces(mesh, [&](const Vec3& x) { return x[0] < 1e-9; }));
      if (is_bent)
        for (Eigen::Index i = 0; i < force.cols(); ++i) force.col(i) *= mesh.nodes(2, i) > h / 2 ? 1.0 / 3 : -1.0 / 3;
      const auto node = [&](double x, double y, double z) {
        Eigen::Index found = 0;
        (mesh.nodes.colwise() - Vec3(x, y, z)).colwise().norm().minCoeff(&found);
        return static_cast<int>(found);
      };
      const int o = 3 * node(0, 0, 0), x = 3 * node(l, 0, 0), y = 3 * node(0, w, 0);
      const Points u = solve(assemble(mesh, material).stiffness, force,
                             {{o, 0}, {o + 1, 0}, {o + 2, 0}, {x + 1, 0}, {x + 2, 0}, {y + 2, 0}});
      const auto strains = theory(angles, h, is_bent ? 0.0 : p * h, is_bent ? p * h * h / 6 : 0.0);
      const Vec3 low = strains.head<3>() - h / 2 * strains.tail<3>(), high = low + h * strains.tail<3>();
      const double close = 1e-9 * (low.cwiseAbs() + high.cwiseAbs()).maxCoeff();
      for (const double z : {0.0, h}) {
        const Vec3 of = z > 0 ? high : low;
        const Vec3 a = u.col(node(0, 0, z)), b = u.col(node(l, 0, z)), c = u.col(node(0, w, z));
        EXPECT_NEAR((b - a)[0] / l, of[0], close);
        EXPECT_NEAR((c - a)[1] / w, of[1], close);
        EXPECT_NEAR((b - a)[1] / l + (c - a)[0] / w, of[2], close);
      }
      EXPECT_NEAR(u(2, node(l / 2, 0, 0)) * 8 / (l * l), strains[3], close / h);  // both ends are held
      EXPECT_NEAR(-u(2, node(l, w, 0)) * 2 / (l * w), strains[5], close / h);
      for (int ply = 0; ply < static_cast<int>(angles.size()); ++ply) {
        const double angle = angles[static_cast<size_t>(ply)], cos = std::cos(angle), sin = std::sin(angle);
        const double at = h * ((ply + 0.5) / static_cast<double>(angles.size()) - 0.5);
        const Vec3 s = reduced(angle) * (strains.head<3>() + at * strains.tail<3>());
        const Tensors own = own_stress(mesh, material, u, ply);
        Vec6 known = Vec6::Zero();
        known[0] = cos * cos * s[0] + sin * sin * s[1] + 2 * sin * cos * s[2];
        known[1] = sin * sin * s[0] + cos * cos * s[1] - 2 * sin * cos * s[2];
        known[3] = sin * cos * (s[1] - s[0]) + (cos * cos - sin * sin) * s[2];
        for (Eigen::Index i = 0; i < own.cols(); ++i) EXPECT_LT((own.col(i) - known).norm(), 1e-7 * p);
      }
    }
}

// Stretched, bent and twisted by a given strain and curvature, thickness as it likes: the energy of lamination theory,
// in cells of order two as well.
TEST(LayeredCell, stores_the_energy_of_classical_lamination_theory) {
  const double l = 4e-3, w = 3e-3, h = 1e-3;
  const std::vector<double> angles = {0.0, 1.5707963267948966, 0.6};
  Eigen::Matrix<double, 6, 1> e;
  e << 1e-3, -4e-4, 6e-4, 1.5, 0.8, -1.1;
  for (const CellType type : {CellType::hex20, CellType::hex27}) {
    const Mesh mesh = oriented_box(type, {l, w, h}, {2, 2, 1}, Mat3::Identity());
    Points given(3, mesh.n_nodes());
    Mat free = Mat::Zero(3 * mesh.n_nodes(), 2);  // thickness that grows evenly, and with z
    for (int i = 0; i < mesh.n_nodes(); ++i) {
      const double x = mesh.nodes(0, i), y = mesh.nodes(1, i), z = mesh.nodes(2, i) - h / 2;
      given.col(i) << (e[0] + z * e[3]) * x + (e[2] + z * e[5]) * y / 2,
          (e[1] + z * e[4]) * y + (e[2] + z * e[5]) * x / 2, -0.5 * (e[3] * x * x + e[4] * y * y + e[5] * x * y);
      free(3 * i + 2, 0) = z, free(3 * i + 2, 1) = z * z;
    }
    const SparseMatrix k = assemble(mesh, stack(angles, h)).stiffness;
    const Mat own = free.transpose() * (k * free);
    const Vec pull = free.transpose() * (k * flat(given));
    const double energy = flat(given).dot(k * flat(given)) - pull.dot(own.ldlt().solve(pull));
    EXPECT_NEAR(energy, e.dot(plate(angles, h) * e) * l * w, 1e-9 * energy) << cell_shape(type).name;
  }
}

// A cell bent about y: the worst of all plies is where its stress is by theory, and each ply alone has its own.
TEST(LayeredCell, knows_which_ply_comes_nearest_to_its_strength) {
  const std::map<std::string, double> bears = {{"xt", 1500e6}, {"xc", 1200e6}, {"yt", 50e6},
                                               {"yc", 200e6},  {"zt", 50e6},   {"zc", 200e6},
                                               {"s12", 70e6},  {"s13", 70e6},  {"s23", 60e6}};
  const auto strength = std::make_shared<const Strength>(bears, Criterion::tsai_wu);
  const Elastic one = ply();
  const double h = 1e-3, right = std::acos(0.0), curvature = 4.0;
  const Elastic material =
      laminate({{one, strength, h / 4, 0.0}, {one, strength, h / 2, right}, {one, strength, h / 4, 0.0}});
  EXPECT_TRUE(material.has_strength());
  const Mesh mesh = oriented_box(CellType::hex8, {4e-3, 4e-3, h}, {2, 2, 1}, Mat3::Identity());
  Points u(3, mesh.n_nodes());
  for (int i = 0; i < mesh.n_nodes(); ++i) {  // bent into a cylinder
    const Vec3 x = mesh.nodes.col(i);
    u.col(i) = Vec3(curvature * (x[2] - h / 2) * x[0], 0, -0.5 * curvature * x[0] * x[0]);
  }
  const Mat3 along = reduced(0.0), across = reduced(right);
  const auto index = [&](double s1, double s2) { return strength->failure({s1, s2, 0, 0, 0, 0}).index; };
  const double outer = index(along(0, 0) * curvature * h / 2, along(1, 0) * curvature * h / 2),
               inner = index(across(1, 0) * curvature * h / 4, across(0, 0) * curvature * h / 4);
  const NodalFailure all = nodal_failure(mesh, material, u);
  for (int i = 0; i < mesh.n_nodes(); ++i) {
    EXPECT_NEAR(all.index[i], std::max(outer, inner), 1e-6);
    EXPECT_EQ(all.ply[static_cast<size_t>(i)], outer > inner ? 2 : 1);
    EXPECT_NEAR(nodal_failure(mesh, material, u, 1).index[i], inner, 1e-6);
    EXPECT_NEAR(nodal_failure(mesh, material, u, 2).index[i], outer, 1e-6);
  }
  // On the faces it is the stress of the outer plies.
  const Tensors stress = nodal_stress(mesh, material, u);
  for (int i = 0; i < mesh.n_nodes(); ++i)
    EXPECT_NEAR(stress(0, i), along(0, 0) * curvature * (mesh.nodes(2, i) - h / 2), 1e3);
}

TEST(Layup, of_many_plies_is_softer_across_than_along) {
  const Elastic material = stack({0.0, std::acos(0.0)}, 1e-3);
  // Alike along 1 and 2, and its waves between those of the ply.
  EXPECT_NEAR(*material.constant("e1") / *material.constant("e2"), 1.0, 1e-12);
  EXPECT_LT(material.p_wave_speed(), ply().p_wave_speed());
  EXPECT_GT(material.s_wave_speed(), 0.99 * ply().s_wave_speed());
  EXPECT_NE(material.key(), stack({std::acos(0.0), 0.0}, 1e-3).key());  // its mean is equal
}

}  // namespace
}  // namespace dygita::test::layered_cell_tests
