// The mesh of the deck bolted_flanges, graded to its edges and with cells of one size.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "intake/gmsh_reader.hpp"
#include "meeting/facing.hpp"
#include "mesh/jacobian.hpp"

namespace dygita {
namespace {

const double pi = std::acos(-1.0);
constexpr double rod_radius = 6e-3, hole_radius = 6.75e-3, head_radius = 9.5e-3, width = 50e-3, thickness = 14e-3;

struct Cells {
  double size;
  bool graded;
  auto operator<=>(const Cells&) const = default;
};
void PrintTo(const Cells& cells, std::ostream* out) { *out << cells.size << (cells.graded ? " graded" : " even"); }

struct BoltedFlanges : testing::TestWithParam<Cells> {
  // Read once for each size: every test looks at the same meshes.
  static const GmshMeshes& meshes() {
    static std::map<Cells, GmshMeshes> read;
    const auto [size, graded] = GetParam();
    const std::map<std::string, double> set = {{"size", size}, {"graded", graded}};
    return read
        .try_emplace(GetParam(), GmshOptions{DYGITA_SOURCE_DIR "/meshes/bolted_flanges.geo", set, std::nullopt, 1.0})
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

  // Area of the regular polygon that stands for a disk: corners on the circle, or the circle's area where graded.
  static double polygon_area(double radius) {
    return GetParam().graded ? pi * radius * radius : share_of_disk() * pi * radius * radius;
  }
  // How far the polygon's corners are from the axis.
  static double corner_radius(double radius) {
    return GetParam().graded ? radius / std::sqrt(share_of_disk()) : radius;
  }
  static double share_of_disk() {
    const int n = 4 * std::max(2, static_cast<int>(std::lround(16e-3 / GetParam().size)));
    return n / (2.0 * pi) * std::sin(2 * pi / n);
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
              1e3 * GetParam().size, 3 * n_nodes, worst_aspect, worst_shape);
  EXPECT_LT(worst_aspect, GetParam().graded ? 50 : 6);
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
  EXPECT_NEAR(rod / (pi * rod_radius * rod_radius), 1, GetParam().graded ? 1e-12 : 0.03);
}

TEST_P(BoltedFlanges, leave_the_rod_clear_of_the_flanges) {
  const MeshPtr rod = body("rod"), lower = body("lower"), upper = body("upper");
  EXPECT_NEAR(std::sqrt(rod->nodes.topRows<2>().colwise().squaredNorm().maxCoeff()), corner_radius(rod_radius), 1e-12);
  for (const MeshPtr& flange : {lower, upper})
    EXPECT_NEAR(std::sqrt(flange->nodes.topRows<2>().colwise().squaredNorm().minCoeff()), corner_radius(hole_radius),
                1e-12);
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

INSTANTIATE_TEST_SUITE_P(AtSize, BoltedFlanges,
                         testing::Values(Cells{4e-3, true}, Cells{8e-3, true}, Cells{4e-3, false}, Cells{2e-3, false}),
                         [](const auto& each) {
                           return (each.param.graded ? "graded" : "even") +
                                  std::to_string(std::lround(1e3 * each.param.size)) + "mm";
                         });

int degrees_of_freedom(const std::map<std::string, double>& set) {
  const GmshMeshes meshes({DYGITA_SOURCE_DIR "/meshes/bolted_flanges.geo", set, std::nullopt, 1.0});
  int n_nodes = 0;
  for (const std::string& name : meshes.volume_names()) n_nodes += meshes.volume(name)->n_nodes();
  return 3 * n_nodes;
}

TEST(BoltedFlangesByDefault, are_graded_and_have_some_37000_degrees_of_freedom_and_6600_of_one_size) {
  EXPECT_EQ(degrees_of_freedom({}), 36891);
  EXPECT_EQ(degrees_of_freedom({{"graded", 0}}), 6618);
}

// Layers of z = 0 and r = 9.5 mm on: the first has the size asked for, each next one is larger.
TEST(BoltedFlangesGraded, have_cells_of_the_size_asked_for_at_the_edges) {
  const GmshMeshes meshes(
      {DYGITA_SOURCE_DIR "/meshes/bolted_flanges.geo", {{"edge", 0.5e-3}, {"growth", 2}}, std::nullopt, 1.0});
  std::set<long> layers;
  const MeshPtr rod = meshes.volume("rod");
  for (int i = 0; i < rod->n_nodes(); ++i) layers.insert(std::lround(rod->nodes(2, i) * 1e7));
  const std::vector<long> z(layers.begin(), layers.end());
  ASSERT_GT(z.size(), 5u);
  EXPECT_NEAR(z[1] - z[0], 5000, 1000);
  EXPECT_NEAR(static_cast<double>(z[2] - z[1]) / static_cast<double>(z[1] - z[0]), 2, 0.01);
  EXPECT_EQ(z[z.size() - 1] - z[z.size() - 2], z[1] - z[0]);
}

}  // namespace
}  // namespace dygita
