// The mesh of the deck bolted_flanges, at two sizes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "mesh/facing.hpp"
#include "mesh/gmsh_reader.hpp"
#include "mesh/jacobian.hpp"

namespace dygita {
namespace {

const double pi = std::acos(-1.0);
constexpr double rod_radius = 6e-3, hole_radius = 6.75e-3, head_radius = 9.5e-3, width = 50e-3, thickness = 14e-3;

struct BoltedFlanges : testing::TestWithParam<double> {
  // Read once for each size: every test looks at the same meshes.
  static const GmshMeshes& meshes() {
    static std::map<double, GmshMeshes> read;
    const double size = GetParam();
    return read
        .try_emplace(size,
                     GmshOptions{DYGITA_SOURCE_DIR "/meshes/bolted_flanges.geo", {{"size", size}}, std::nullopt, 1.0})
        .first->second;
  }
  static MeshPtr body(const std::string& name) { return meshes().volume(name); }

  static Facing joint(const std::string& body_1, const std::string& face_1, const std::string& body_2,
                      const std::string& face_2) {
    const MeshPtr mesh_1 = body(body_1), mesh_2 = body(body_2);
    const Facing facing = *match_faces({mesh_1.get(), mesh_1->faces.at(face_1), Vec3::Zero(), body_1 + "." + face_1},
                                       {mesh_2.get(), mesh_2->faces.at(face_2), Vec3::Zero(), body_2 + "." + face_2});
    // The interface is the whole of both faces.
    EXPECT_EQ(facing.facets_1.size(), mesh_1->faces.at(face_1).size()) << body_1 << '.' << face_1;
    EXPECT_EQ(facing.facets_2.size(), mesh_2->faces.at(face_2).size()) << body_2 << '.' << face_2;
    for (int i = 0; i < facing.normals.cols(); ++i)
      EXPECT_GT(facing.normals(2, i), 1 - 1e-12) << "the second body lies above the first";
    return facing;
  }

  // Area of the regular polygon whose corners lie on a circle: what the facets cover of the disk.
  static double polygon_area(double radius) {
    const int n = 4 * std::max(2, static_cast<int>(std::lround(16e-3 / GetParam())));
    return n / 2.0 * radius * radius * std::sin(2 * pi / n);
  }
};

TEST_P(BoltedFlanges, have_five_bodies_of_good_hexahedra) {
  EXPECT_EQ(meshes().volume_names(), (std::vector<std::string>{"head", "lower", "nut", "rod", "upper"}));
  int n_nodes = 0;
  double worst_aspect = 0, worst_shape = 1;
  for (const std::string& name : meshes().volume_names()) {
    const MeshPtr mesh = body(name);
    ASSERT_EQ(mesh->blocks.size(), 1u) << name;
    EXPECT_EQ(mesh->blocks[0].type, CellType::hex8) << name;
    EXPECT_NO_THROW(check_mesh(*mesh, name));
    n_nodes += mesh->n_nodes();
    for (int i = 0; i < mesh->n_cells(); ++i) {
      const Points x = cell_nodes(mesh->nodes, mesh->blocks[0], i);
      double shortest = 1, longest = 0, smallest = 1, largest = 0;
      for (const auto& [a, b] : {std::pair{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 5}}) {
        const double length = (x.col(a) - x.col(b)).norm();
        shortest = std::min(shortest, length);
        longest = std::max(longest, length);
      }
      for (const Place& at : cell_shape(CellType::hex8).shape.nodes) {
        const double determinant = jacobian(CellType::hex8, x, Vec3(at[0], at[1], at[2]));
        smallest = std::min(smallest, determinant);
        largest = std::max(largest, determinant);
      }
      worst_aspect = std::max(worst_aspect, longest / shortest);
      worst_shape = std::min(worst_shape, smallest / largest);
    }
  }
  RecordProperty("degrees_of_freedom", 3 * n_nodes);
  RecordProperty("worst_aspect_ratio", std::to_string(worst_aspect));
  RecordProperty("worst_jacobian_ratio", std::to_string(worst_shape));
  std::printf("size %g mm: %d degrees of freedom, worst aspect ratio %.2f, worst corner Jacobian ratio %.2f\n",
              1e3 * GetParam(), 3 * n_nodes, worst_aspect, worst_shape);
  EXPECT_LT(worst_aspect, 6);
  EXPECT_GT(worst_shape, 0.2);
}

TEST_P(BoltedFlanges, have_the_faces_that_the_deck_names) {
  const std::map<std::string, std::vector<std::string>> expected = {{"lower", {"base", "nut", "side", "upper"}},
                                                                    {"upper", {"head", "lower", "top"}},
                                                                    {"rod", {"head_end", "nut_end"}},
                                                                    {"head", {"rod_end", "upper"}},
                                                                    {"nut", {"lower", "rod_end"}}};
  for (const auto& [name, faces] : expected) {
    std::vector<std::string> found;
    for (const auto& [face, facets] : body(name)->faces) found.push_back(face);
    EXPECT_EQ(found, faces) << name;
  }
}

TEST_P(BoltedFlanges, meet_on_faces_of_the_areas_drawn) {
  const double hole = polygon_area(hole_radius), head = polygon_area(head_radius), rod = polygon_area(rod_radius);
  EXPECT_NEAR(joint("lower", "upper", "upper", "lower").areas.sum(), width * width - hole, 1e-13);
  EXPECT_NEAR(joint("upper", "head", "head", "upper").areas.sum(), head - hole, 1e-13);
  EXPECT_NEAR(joint("nut", "lower", "lower", "nut").areas.sum(), head - hole, 1e-13);
  EXPECT_NEAR(joint("rod", "head_end", "head", "rod_end").areas.sum(), rod, 1e-13);
  EXPECT_NEAR(joint("nut", "rod_end", "rod", "nut_end").areas.sum(), rod, 1e-13);
  EXPECT_NEAR(rod / (pi * rod_radius * rod_radius), 1, 0.03);
}

TEST_P(BoltedFlanges, leave_the_rod_clear_of_the_flanges) {
  const MeshPtr rod = body("rod"), lower = body("lower"), upper = body("upper");
  EXPECT_NEAR(std::sqrt(rod->nodes.topRows<2>().colwise().squaredNorm().maxCoeff()), rod_radius, 1e-12);
  for (const MeshPtr& flange : {lower, upper})
    EXPECT_NEAR(std::sqrt(flange->nodes.topRows<2>().colwise().squaredNorm().minCoeff()), hole_radius, 1e-12);
}

TEST_P(BoltedFlanges, have_the_volumes_drawn_and_a_held_bottom_and_pulled_top) {
  const double hole = polygon_area(hole_radius), head = polygon_area(head_radius);
  EXPECT_NEAR(volume(*body("lower")), (width * width - hole) * thickness, 1e-15);
  EXPECT_NEAR(volume(*body("upper")), (width * width - hole) * thickness, 1e-15);
  EXPECT_NEAR(volume(*body("rod")), polygon_area(rod_radius) * 2 * thickness, 1e-15);
  EXPECT_NEAR(volume(*body("head")), head * 8e-3, 1e-15);
  EXPECT_NEAR(volume(*body("nut")), head * 8e-3, 1e-15);
  const FaceNodes top = face_nodes(*body("upper"), body("upper")->faces.at("top"));
  const FaceNodes base = face_nodes(*body("lower"), body("lower")->faces.at("base"));
  const FaceNodes side = face_nodes(*body("lower"), body("lower")->faces.at("side"));
  EXPECT_NEAR(top.areas.sum(), width * width - head, 1e-13);
  EXPECT_NEAR(base.areas.sum(), width * width - head, 1e-13);
  EXPECT_NEAR(side.areas.sum(), 4 * width * thickness, 1e-13);
  EXPECT_GT(top.normals.row(2).minCoeff(), 1 - 1e-12);
  EXPECT_LT(base.normals.row(2).maxCoeff(), -1 + 1e-12);
  EXPECT_LT(side.normals.row(2).cwiseAbs().maxCoeff(), 1e-12);
}

INSTANTIATE_TEST_SUITE_P(AtSize, BoltedFlanges, testing::Values(4e-3, 2e-3),
                         [](const auto& each) { return std::to_string(std::lround(1e3 * each.param)) + "mm"; });

TEST(BoltedFlangesByDefault, are_meshed_at_4_mm_with_about_6500_degrees_of_freedom) {
  const GmshMeshes meshes({DYGITA_SOURCE_DIR "/meshes/bolted_flanges.geo", {}, std::nullopt, 1.0});
  int n_nodes = 0;
  for (const std::string& name : meshes.volume_names()) n_nodes += meshes.volume(name)->n_nodes();
  EXPECT_EQ(3 * n_nodes, 6618);
}

}  // namespace
}  // namespace dygita
