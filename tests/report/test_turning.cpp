// The picture that turns: what merging keeps, what the file holds and how large it may be.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "drawing/turning_file.hpp"
#include "law/law.hpp"
#include "report/check_picture.hpp"
#include "report/view_script.hpp"

namespace dygita {
namespace {

// A box of n^3 hexahedra with its six faces.
SubstructurePtr turning_box(int n, double size, const Vec3& place = Vec3::Zero(), const std::string& name = "box") {
  auto mesh = std::make_shared<Mesh>();
  const int m = n + 1;
  mesh->nodes.resize(3, m * m * m);
  const auto number = [m](int i, int j, int k) { return i + m * (j + m * k); };
  for (int k = 0; k < m; ++k)
    for (int j = 0; j < m; ++j)
      for (int i = 0; i < m; ++i) mesh->nodes.col(number(i, j, k)) = Vec3(i, j, k) * (size / n);
  CellBlock block{CellType::hex8, {}};
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        for (const int node :
             {number(i, j, k), number(i + 1, j, k), number(i + 1, j + 1, k), number(i, j + 1, k), number(i, j, k + 1),
              number(i + 1, j, k + 1), number(i + 1, j + 1, k + 1), number(i, j + 1, k + 1)})
          block.nodes.push_back(node);
  mesh->blocks = {block};
  for (const Facet& facet : boundary_facets(mesh->blocks)) {
    Vec3 low = Vec3::Constant(1e300), high = -low;
    for (const int node : facet.corners()) {
      low = low.cwiseMin(mesh->nodes.col(node));
      high = high.cwiseMax(mesh->nodes.col(node));
    }
    for (int d = 0; d < 3; ++d)
      if (high[d] - low[d] < 1e-9 * size)
        mesh->faces[std::string(1, "xyz"[d]) + (high[d] > 0.5 * size ? "max" : "min")].push_back(facet);
  }
  auto part = std::make_shared<Substructure>();
  part->name = name;
  part->mesh = mesh;
  part->place = place;
  return part;
}

Problem two_boxes(int n, const std::string& face_of_upper = "zmin") {
  Problem problem;
  problem.name = "two";
  problem.substructures = {turning_box(n, 0.01, Vec3::Zero(), "low"),
                           turning_box(n, 0.01, {0, 0, 0.01}, "high </script>")};
  auto grip = std::make_shared<Interface>();
  grip->name = "grip";
  grip->law = make_law("bonded");
  grip->side_1 = {problem.substructures[0], "zmax"};
  grip->side_2 = {problem.substructures[1], face_of_upper};
  problem.interfaces = {grip};
  auto step = std::make_shared<Step>();
  step->name = "shock";
  problem.steps = {step};
  return problem;
}

SkinMotion motion_of(const Problem& problem, int n_frames) {
  SkinMotion motion;
  size_t n = 0;
  for (const SubstructurePtr& part : problem.substructures) {
    std::set<int> nodes;
    for (const Facet& facet : boundary_facets(part->mesh->blocks))
      nodes.insert(facet.corners().begin(), facet.corners().end());
    motion.nodes.emplace_back(nodes.begin(), nodes.end());
    n += nodes.size();
  }
  for (int k = 0; k < n_frames; ++k) {
    SkinFrame frame{"shock", 0, false, 1e-6 * k, std::vector<float>(3 * n, 0.0f), std::vector<float>(n, 0.0f)};
    for (size_t i = 0; i < n; ++i) {
      frame.displacement[3 * i + 2] = static_cast<float>(1e-6 * (k + 1));
      frame.von_mises[i] = static_cast<float>(1e6 * (k == 1 ? 3 : 1));
    }
    motion.frames.push_back(std::move(frame));
  }
  return motion;
}

double volume(const TurningMesh& mesh) {
  double sum = 0.0;
  for (const auto& [a, b, c] : mesh.triangles)
    sum += mesh.nodes.col(a).dot(Vec3(mesh.nodes.col(b)).cross(Vec3(mesh.nodes.col(c)))) / 6.0;
  return sum;
}

TEST(TurningMesh, keeps_a_coarse_boundary_as_it_is) {
  const TurningMesh mesh = make_turning_mesh({turning_box(3, 0.01)}, {}, 1000);
  EXPECT_EQ(mesh.nodes.cols(), 56);
  EXPECT_EQ(mesh.triangles.size(), 108u);
  EXPECT_EQ(mesh.edges.size(), 36u);  // twelve edges of three
  EXPECT_NEAR(volume(mesh), 1e-6, 1e-15);
}

TEST(TurningMesh, keeps_corners_and_volume_of_a_fine_one) {
  const TurningMesh mesh = make_turning_mesh({turning_box(40, 0.01), turning_box(2, 0.002, {0.02, 0, 0})}, {}, 600);
  EXPECT_LE(mesh.nodes.cols(), 600);
  EXPECT_GT(mesh.nodes.cols(), 150);
  EXPECT_EQ(mesh.parts[1].n_nodes, 26);  // the small part is not merged for the large one's sake
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 x(corner & 1 ? 0.01 : 0.0, corner & 2 ? 0.01 : 0.0, corner & 4 ? 0.01 : 0.0);
    EXPECT_LT((mesh.nodes.colwise() - x).colwise().norm().minCoeff(), 1e-12) << x.transpose();
  }
  EXPECT_NEAR(volume(mesh), 1e-6 + 8e-9, 1e-9);
}

TEST(TurningMesh, of_more_parts_than_nodes_ends_with_what_tells_their_sides_apart) {
  const TurningMesh mesh = make_turning_mesh(std::vector<SubstructurePtr>(40, turning_box(4, 0.01)), {}, 80);
  EXPECT_LE(mesh.nodes.cols(), 40 * 26);
  EXPECT_GE(mesh.nodes.cols(), 40 * 8);
}

TEST(MotionFile, stays_small_whatever_the_mesh_and_the_number_of_frames) {
  const Problem problem = two_boxes(40);
  const std::string text = motion_text(problem, motion_of(problem, 20));
  EXPECT_LT(text.size(), 1'000'000u);
  EXPECT_GT(text.size(), 300'000u);
}

TEST(MotionFile, shows_the_frame_of_largest_stress_and_holds_what_is_not_finite_as_zero) {
  const Problem problem = two_boxes(2);
  SkinMotion motion = motion_of(problem, 3);
  motion.frames[2].displacement[4] = std::numeric_limits<float>::quiet_NaN();
  motion.frames[2].von_mises[0] = std::numeric_limits<float>::infinity();
  const auto json = nlohmann::json::parse(motion_text(problem, motion));
  EXPECT_EQ(json["shown"], 1);
  EXPECT_EQ(json["frames"].size(), 3u);
  EXPECT_NEAR(json["frames"][1]["top"].get<double>(), 3e6, 1.0);
  EXPECT_NEAR(json["frames"][2]["unit"].get<double>() * 32767.0, 3e-6, 1e-12);
  EXPECT_EQ(json["parts"][1]["nodes"], 26);
  EXPECT_EQ(motion_text(problem, SkinMotion{}), "");
}

TEST(MotionFile, cannot_be_ended_by_a_name) {
  const Problem problem = two_boxes(1);
  const std::string figure = turning_figure(motion_text(problem, motion_of(problem, 1)), "t", "c");
  EXPECT_EQ(figure.find("</script>"), figure.rfind("</script>"));
}

TEST(CheckPicture, names_parts_faces_and_the_interface_found) {
  const std::string svg = check_picture_svg(two_boxes(2));
  for (const char* name : {">low<", ">high &lt;/script&gt;<", ">interface &#39;grip&#39;<", ">xmin<",
                           ">zmax, interface &#39;grip&#39;<", ">ymax<", ">zmin, interface &#39;grip&#39;<"})
    EXPECT_NE(svg.find(name), std::string::npos) << name;
  EXPECT_EQ(svg.find("NOT FOUND"), std::string::npos);
  EXPECT_NE(check_picture_html(two_boxes(2)).find("class=\"turn\""), std::string::npos);
}

TEST(CheckPicture, marks_an_interface_whose_faces_do_not_meet) {
  EXPECT_NE(check_picture_svg(two_boxes(2, "zmax")).find("interface &#39;grip&#39;: NOT FOUND"), std::string::npos);
}

TEST(ViewScript, shows_the_instant_of_largest_stress_in_the_motion) {
  Problem problem = two_boxes(2);
  auto still = std::make_shared<Step>();
  still->name = "tighten";
  still->is_static = true;
  problem.steps.insert(problem.steps.begin(), still);
  std::vector<FrameSummary> frames(3);
  frames[0] = {-1.0, "tighten", 1e-6, 9e6, 0.0, true};
  frames[1] = {1.0, "shock", 2e-6, 5e6, 2e6, true};
  frames[2] = {2.0, "shock", 3e-6, 4e6, 1e6, true};
  const std::string script = view_script(problem, frames, "out/two/base");
  EXPECT_NE(script.find("\nTIME = 1\n"), std::string::npos);
  EXPECT_NE(script.find("\nTOP = 9000000\n"), std::string::npos);
  EXPECT_NE(script.find("\nPRESSURE = 2000000\n"), std::string::npos);
  EXPECT_NE(script.find("\nWARP = 200\n"), std::string::npos) << script.substr(0, 700);
  EXPECT_NE(script.find("INTERFACES_FILE = \"interfaces.pvd\""), std::string::npos);
  EXPECT_EQ(view_script(problem, {}, "out"), "");
}

}  // namespace
}  // namespace dygita
