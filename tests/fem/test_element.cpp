#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "base/error.hpp"
#include "fem/element.hpp"
#include "fem/meshes.hpp"
#include "mesh/shape_functions.hpp"
#include "numerics/dense.hpp"

namespace dygita::test {
namespace {

// One distorted cell of each type, of size 1 m; those of order two are curved, too.
CellNodes distorted_cell(CellType type) {
  const CellShape& row = cell_shape(type);
  CellNodes x(3, nodes_per_cell(type));
  if (nodes_per_cell(type) > row.n_corners) {
    const auto linear = std::find_if(std::begin(cell_shapes), std::end(cell_shapes), [&](const CellShape& cell) {
      return cell.n_corners == row.n_corners && nodes_per_cell(cell.type) == cell.n_corners;
    });
    const CellNodes corners = distorted_cell(linear->type);
    for (Eigen::Index a = 0; a < x.cols(); ++a)
      x.col(a) = corners * shape_functions(linear->type).values(vector_of(row.shape.nodes[static_cast<size_t>(a)])) +
                 (a < row.n_corners ? 0.0 : 0.02) * Vec3(std::sin(3.0 * a), std::cos(5.0 * a), std::sin(7.0 * a));
    return x;
  }
  if (type == CellType::hex8)
    x << 0, 1, 1.1, 0.1, 0.2, 0.9, 1.2, -0.1,  //
        0, 0.2, 1, 1.1, -0.1, 0.1, 0.8, 1,     //
        0.1, 0, -0.1, 0.2, 1, 1.2, 0.9, 0.8;
  else if (type == CellType::prism6)
    x << 0, 0.1, 1, 0.2, 0.1, 0.9,  //
        0, 1, 0.2, -0.1, 1.1, 0.1,  //
        0.1, 0, -0.1, 1, 0.8, 1.2;
  else
    x << 0, 1, 0.2, 0.1,   //
        0, 0.1, 1.1, 0.2,  //
        0, -0.1, 0.1, 0.9;
  return x;
}

CellNodes box_cell(const Vec3& size) {
  return nodes_of_cell(box_of(CellType::hex8, size, {1, 1, 1}), {CellType::hex8, {0, 1, 3, 2, 4, 5, 7, 6}}, 0);
}

Points rigid_motion(const CellNodes& x, int i) {
  Points motion = Points::Zero(3, x.cols());
  for (int a = 0; a < x.cols(); ++a)
    motion.col(a) = i < 3 ? Vec3(Vec3::Unit(i)) : Vec3(Vec3::Unit(i - 3).cross(x.col(a)));
  return motion;
}

TEST(Element, is_at_rest_in_the_six_rigid_motions_and_in_no_other) {
  for (const CellType type : cell_types)
    for (const double poisson : {0.0, 0.3, 0.4999}) {
      const CellNodes x = distorted_cell(type);
      const CellMatrix stiffness = element_stiffness(type, x, material_of(1.0, poisson));
      for (int i = 0; i < 6; ++i)
        EXPECT_LT((stiffness * flat(rigid_motion(x, i))).norm(), 1e-13 * stiffness.norm()) << cell_shape(type).name;
      const Vec eigenvalues = symmetric_eigen(stiffness).values;
      EXPECT_LT(eigenvalues.head(6).cwiseAbs().maxCoeff(), 1e-12) << cell_shape(type).name << ", nu " << poisson;
      EXPECT_GT(eigenvalues[6], 1e-2) << cell_shape(type).name << ", nu " << poisson;
    }
}

TEST(Element, has_a_symmetric_stiffness) {
  for (const CellType type : cell_types) {
    const CellMatrix stiffness = element_stiffness(type, distorted_cell(type), material_of(1.0, 0.3));
    EXPECT_EQ((stiffness - stiffness.transpose()).cwiseAbs().maxCoeff(), 0.0) << cell_shape(type).name;
  }
}

TEST(Element, does_not_depend_on_the_frame) {
  const Mat3 rotation = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const Elastic material = material_of(1.0, 0.3);
  for (const CellType type : cell_types) {
    const CellNodes x = distorted_cell(type), turned = rotation * x;
    const CellMatrix stiffness = element_stiffness(type, x, material);
    Mat turn = Mat::Zero(stiffness.rows(), stiffness.cols());
    for (int a = 0; a < x.cols(); ++a) turn.block<3, 3>(3 * a, 3 * a) = rotation;
    const Mat expected = turn * stiffness * turn.transpose();
    EXPECT_LT((element_stiffness(type, turned, material) - expected).norm(), 1e-13 * stiffness.norm())
        << cell_shape(type).name;
  }
}

// The 12 modes condensed plainly, from strain matrices of 6 rows: the kernel's short cuts must change nothing.
TEST(Element, of_hexahedron_equals_its_plain_formula) {
  const Elastic material = material_of(1.0, 0.4);
  const CellNodes x = distorted_cell(CellType::hex8);
  const double signs[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                              {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  const auto slopes = [&](const Vec3& xi) {
    Points table(3, 8);
    for (int a = 0; a < 8; ++a)
      for (int q = 0; q < 3; ++q) {
        const int r = (q + 1) % 3, s = (q + 2) % 3;
        table(q, a) = signs[a][q] * (1 + signs[a][r] * xi[r]) * (1 + signs[a][s] * xi[s]) / 8;
      }
    return table;
  };
  const auto add_strain = [](Mat& b, int column, const Vec3& direction, const Vec3& gradient) {
    const Mat3 strain = direction * gradient.transpose() + gradient * direction.transpose();
    b.col(column) << strain(0, 0) / 2, strain(1, 1) / 2, strain(2, 2) / 2, strain(0, 1), strain(1, 2), strain(2, 0);
  };

  const Mat3 centre = x * slopes(Vec3::Zero()).transpose();
  Mat all = Mat::Zero(36, 36);
  for (const auto& sign : signs) {
    const Vec3 xi = Vec3(sign[0], sign[1], sign[2]) / std::sqrt(3.0);
    const Mat3 jacobian = x * slopes(xi).transpose();
    const Points gradients = jacobian.inverse().transpose() * slopes(xi);
    const double scale = centre.determinant() / jacobian.determinant();
    Mat b = Mat::Zero(6, 36);
    for (int a = 0; a < 8; ++a)
      for (int i = 0; i < 3; ++i) add_strain(b, 3 * a + i, Vec3::Unit(i), gradients.col(a));
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 3; ++i)
        add_strain(b, 24 + 3 * j + i, Vec3::Unit(i), scale * xi[j] * centre.inverse().row(j).transpose());
      b.col(33 + j).head(3).setConstant(scale * xi[(j + 1) % 3] * xi[(j + 2) % 3]);
    }
    all += jacobian.determinant() * b.transpose() * material.hooke() * b;
  }
  const Mat modes = all.bottomRightCorner(12, 12), coupling = all.bottomLeftCorner(12, 24);
  const Mat expected = all.topLeftCorner(24, 24) - coupling.transpose() * solve_dense(modes, coupling);
  EXPECT_LT((element_stiffness(CellType::hex8, x, material) - expected).norm(), 1e-13 * expected.norm());
}

TEST(Element, of_tetrahedron_stores_the_energy_of_its_constant_strain) {
  const Elastic material = material_of(3.0, 0.25);
  const CellNodes x = distorted_cell(CellType::tet4);
  const double volume =
      (x.col(1) - x.col(0)).head<3>().cross((x.col(2) - x.col(0)).head<3>()).dot((x.col(3) - x.col(0)).head<3>()) / 6;
  Mat3 gradient;
  gradient << 1, 2, 3, -1, 0.5, 4, 2, 1, -3;
  const Vec displacement = flat(gradient * x);
  Eigen::Matrix<double, 6, 1> strain;
  strain << 1, 0.5, -3, 1, 5, 5;
  const double energy = displacement.dot(element_stiffness(CellType::tet4, x, material) * displacement);
  EXPECT_NEAR(energy, volume * strain.dot(material.hooke() * strain), 1e-12 * energy);
}

TEST(Element, mass_is_positive_and_has_the_exact_total_and_centre) {
  // Volumes and first moments by a subdivision that shares nothing with the element: here boxes, sheared.
  Mat3 shear;
  shear << 1, 0.3, 0.2, 0, 1, 0.4, 0, 0, 1;
  for (const CellType type : cell_types) {
    const Vec3 size(2, 3, 5);
    Mesh mesh = box_of(type, size, {2, 2, 2});
    mesh.nodes.col(13) += Vec3(0.2, -0.3, 0.4);  // the inner node
    mesh.nodes = shear * mesh.nodes;
    Vec3 moment = Vec3::Zero();
    double total = 0;
    for (int i = 0; i < mesh.n_cells(); ++i) {
      const CellNodes x = nodes_of_cell(mesh, mesh.blocks[0], i);
      const Vec mass = element_mass(type, x, 7.0);
      EXPECT_GT(mass.minCoeff(), 0.0);
      total += mass.sum();
      moment += x * mass;
    }
    EXPECT_NEAR(total, 7.0 * 30.0, 1e-12 * total) << cell_shape(type).name;
    if (cell_shape(type).lumping == Lumping::row_sums) {
      EXPECT_LT((moment / total - shear * size / 2).norm(), 1e-13) << cell_shape(type).name;
    }
  }
}

TEST(Element, mass_is_shared_equally_in_a_box_and_in_a_tetrahedron) {
  const Vec of_box = element_mass(CellType::hex8, box_cell({0.1, 0.2, 0.5}), 8000.0);
  EXPECT_LT((of_box.array() - 10.0).abs().maxCoeff(), 1e-13);  // 80 kg / 8
  CellNodes tetrahedron(3, 4);
  tetrahedron << 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1;
  const Vec of_tetrahedron = element_mass(CellType::tet4, tetrahedron, 24.0);
  EXPECT_LT((of_tetrahedron.array() - 1.0).abs().maxCoeff(), 1e-15);  // 24 / 6 / 4
}

TEST(Element, stress_is_exact_for_constant_strain) {
  Mat3 gradient;
  gradient << 1, 2, 3, -1, 0.5, 4, 2, 1, -3;
  Eigen::Matrix<double, 6, 1> strain;
  strain << 1, 0.5, -3, 1, 5, 5;
  const Elastic material = material_of(2.0, 0.3);
  const Eigen::Matrix<double, 6, 1> expected = material.hooke() * strain;
  for (const CellType type : cell_types) {
    const CellNodes x = distorted_cell(type);
    const Tensors stress = element_stress(type, x, material, gradient * x);
    EXPECT_EQ(stress.cols(), x.cols());
    EXPECT_LT((stress.colwise() - expected).norm(), 1e-12 * expected.norm()) << cell_shape(type).name;
  }
}

// Pure bending about y in the axes of a turned box: sigma_zz = E curvature x.
TEST(Element, stress_of_a_hexahedral_box_is_exact_in_pure_bending) {
  const double poisson = 0.3, curvature = 0.01;
  const Elastic material = material_of(200.0, poisson);
  const Mat3 rotation = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const CellNodes x = box_cell({0.4, 0.7, 1.9});
  CellNodes displacement(3, 8);
  for (int a = 0; a < 8; ++a) {
    const double r = x(0, a), s = x(1, a), t = x(2, a);
    displacement.col(a) << -curvature / 2 * (t * t + poisson * (r * r - s * s)), -curvature * poisson * r * s,
        curvature * r * t;
  }
  const Tensors stress = element_stress(CellType::hex8, rotation * x, material, rotation * displacement);
  for (int a = 0; a < 8; ++a) {
    const Mat3 expected = material.young() * curvature * x(0, a) * rotation.col(2) * rotation.col(2).transpose();
    Eigen::Matrix<double, 6, 1> column;
    column << expected(0, 0), expected(1, 1), expected(2, 2), expected(0, 1), expected(1, 2), expected(2, 0);
    EXPECT_LT((stress.col(a) - column).norm(), 1e-13) << "node " << a;
  }
}

TEST(Element, refuses_an_inverted_cell) {
  for (const CellType type : cell_types) {
    CellNodes x = distorted_cell(type);
    x.row(0) *= -1;
    EXPECT_THROW(element_stiffness(type, x, material_of(1.0, 0.3)), ContractError) << cell_shape(type).name;
  }
}

}  // namespace
}  // namespace dygita::test
