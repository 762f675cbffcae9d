#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/log.hpp"
#include "intake/gmsh_reader.hpp"
#include "meeting/facing.hpp"
#include "mesh/box.hpp"
#include "mesh/expect_input_error.hpp"
#include "mesh/jacobian.hpp"

namespace dygita {
namespace {

namespace fs = std::filesystem;

// A folder of its own for each test, removed afterwards.
class GmshReader : public testing::Test {
 protected:
  void SetUp() override {
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::temp_directory_path() / (std::string("dygita_") + test->name());
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text << '\n';
    return (folder_ / name).string();
  }

  fs::path folder_;
};

GmshMeshes read(const std::string& file, const std::map<std::string, double>& set = {}) {
  return GmshMeshes({file, set, std::nullopt, 1.0});
}

const std::string block_geo = R"(
// DefineConstant[ commented = 1 ];
DefineConstant[ n = 2, height = {3, Min 1, Name "Block/height, in [m]"} ];
/* DefineConstant[ out = 1 ]; */
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 2, 0}; Point(4) = {0, 2, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve {1:4} = n + 1; Transfinite Surface {1}; Recombine Surface {1};
out[] = Extrude {0, 0, height} { Surface{1}; Layers{n}; Recombine; };
Physical Volume("block") = {out[1]};
Physical Surface("block.bottom") = {1};
Physical Surface("block.top") = {out[0]};
Physical Surface("skin") = {1, out[0], out[2], out[3], out[4], out[5]};
)";

TEST_F(GmshReader, meshes_a_geo_with_its_own_parameters) {
  const GmshMeshes meshes = read(write("block.geo", block_geo));
  EXPECT_EQ(meshes.volume_names(), std::vector<std::string>{"block"});
  const MeshPtr block = meshes.volume("block");
  EXPECT_EQ(block->n_cells(), 8);
  EXPECT_EQ(block->n_nodes(), 27);
  EXPECT_EQ(block->blocks.size(), 1u);
  EXPECT_EQ(block->blocks[0].type, CellType::hex8);
  EXPECT_NEAR(volume(*block), 6.0, 1e-12);
}

TEST_F(GmshReader, lets_set_override_parameters_for_this_reading_only) {
  const std::string file = write("block.geo", block_geo);
  const MeshPtr set = read(file, {{"n", 3}, {"height", 0.1}}).volume("block");
  EXPECT_EQ(set->n_cells(), 27);
  EXPECT_NEAR(volume(*set), 0.2, 1e-13);
  const GmshMeshes again = read(file), first = read(file);
  EXPECT_EQ(again.volume("block")->n_cells(), 8);
  EXPECT_EQ(again.digest(), first.digest());
  EXPECT_NE(again.digest(), read(file, {{"height", 2.5}}).digest());
}

TEST_F(GmshReader, lets_set_reach_a_parameter_of_an_included_file) {
  write("sizes.geo", "DefineConstant[ width = 1 ];");
  const std::string file = write("main.geo", R"(Include "sizes.geo"; SetFactory("OpenCASCADE");
Mesh.MeshSizeMax = 0.5; Box(1) = {0, 0, 0, width, 1, 1}; Physical Volume("box") = {1};)");
  EXPECT_NEAR(volume(*read(file, {{"width", 2}}).volume("box")), 2.0, 1e-12);
}

TEST_F(GmshReader, names_the_faces_and_turns_their_facets_outward) {
  const MeshPtr block = read(write("block.geo", block_geo)).volume("block");
  EXPECT_EQ(block->faces.size(), 3u);
  const FaceNodes bottom = face_nodes(*block, block->faces.at("bottom")),
                  top = face_nodes(*block, block->faces.at("top")), skin = face_nodes(*block, block->faces.at("skin"));
  EXPECT_NEAR(bottom.areas.sum(), 2.0, 1e-13);
  EXPECT_TRUE(bottom.normals.col(0).isApprox(-Vec3::UnitZ()));
  EXPECT_TRUE(top.normals.col(0).isApprox(Vec3::UnitZ()));
  EXPECT_NEAR(skin.areas.sum(), 22.0, 1e-12);
  EXPECT_EQ(block->faces.at("skin").size(), boundary_facets(block->blocks).size());
  for (int i = 0; i < skin.normals.cols(); ++i) {
    const Vec3 outward = block->nodes.col(skin.nodes[i]) - Vec3(0.5, 1, 1.5);
    EXPECT_GT(skin.normals.col(i).dot(outward), 0);
  }
}

TEST_F(GmshReader, scales_by_the_unit_of_the_file) {
  const MeshPtr block = GmshMeshes({write("block.geo", block_geo), {}, std::nullopt, 1e-3}).volume("block");
  EXPECT_NEAR(volume(*block), 6e-9, 1e-21);
}

TEST_F(GmshReader, says_the_known_parameters_when_one_is_unknown) {
  const std::string file = write("block.geo", block_geo);
  expect_input_error(
      [&] {
        read(file, {{"heigth", 1}});
      },
      {"block.geo", "no parameter 'heigth'", "did you mean 'height'?", "known: height, n"});
  expect_input_error([&] { read(file, {{"commented", 1}}); }, {"no parameter 'commented'"});
}

TEST_F(GmshReader, says_the_known_volumes_when_one_is_unknown) {
  const GmshMeshes meshes = read(write("block.geo", block_geo));
  expect_input_error([&] { meshes.volume("blok"); }, {"block.geo", "no volume 'blok'", "did you mean 'block'?"});
}

TEST_F(GmshReader, says_the_path_of_a_missing_file_and_the_kinds_it_knows) {
  expect_input_error([&] { read("nowhere/flange.geo"); }, {"nowhere/flange.geo", "does not exist"});
  expect_input_error([&] { read(write("a.stl", "solid")); }, {"a.stl", ".geo, .msh, .step"});
  expect_input_error([&] { read(write("a.msh", "no mesh at all")); }, {"a.msh"});
}

TEST_F(GmshReader, passes_on_what_gmsh_says_and_can_read_the_next_file) {
  const std::string bad = write("bad.geo", "Point(1) = {0, 0, 0};\nLine(1) = [;\n");
  expect_input_error([&] { read(bad); }, {"bad.geo", "line 2", "syntax error"});
  EXPECT_EQ(read(write("block.geo", block_geo)).volume("block")->n_cells(), 8);
  expect_input_error([&] { read(write("lost.geo", "Include \"part.geo\";")); }, {"lost.geo"});
}

TEST_F(GmshReader, refuses_a_geo_whose_last_line_gmsh_would_leave_out) {
  const std::string file = (folder_ / "cut.geo").string(), main = write("main.geo", "Include \"cut.geo\";");
  std::ofstream(file) << "SetFactory(\"OpenCASCADE\");\nBox(1) = {0, 0, 0, 1, 1, 1};\nPhysical Volume(\"box\") = {1};";
  expect_input_error([&] { read(file); }, {"cut.geo", "newline"});
  expect_input_error([&] { read(main); }, {"cut.geo", "newline"});
}

TEST_F(GmshReader, refuses_a_file_without_volumes) {
  const std::string file = write("flat.geo", "SetFactory(\"OpenCASCADE\"); Rectangle(1) = {0, 0, 0, 1, 1};");
  expect_input_error([&] { read(file); }, {"flat.geo", "no volume"});
}

// A quarter of a tube of one layer, by cells of each kind; recombined where `recombine` says so.
std::string quarter_tube(bool recombine) {
  return std::string(R"(SetFactory("Built-in");
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {2, 0, 0}; Point(4) = {0, 1, 0}; Point(5) = {0, 2, 0};
Line(1) = {2, 3}; Circle(2) = {3, 1, 5}; Line(3) = {5, 4}; Circle(4) = {4, 1, 2};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve {1, 3} = 3; Transfinite Curve {2, 4} = 5; Transfinite Surface {1};)") +
         (recombine ? "Recombine Surface {1};\n" : "\n") + "tube[] = Extrude {0, 0, 1} { Surface{1}; Layers{2};" +
         "Recombine; };\n" +
         R"(Physical Volume("tube") = {tube[1]}; Physical Surface("tube.inside") = {tube[5]};
Physical Surface("tube.bottom") = {1};)";
}

TEST_F(GmshReader, makes_cells_of_order_two_that_follow_round_surfaces) {
  for (const bool is_complete : {false, true})
    for (const bool recombine : {false, true}) {
      GmshOptions options;
      options.file = write("tube.geo", quarter_tube(recombine));
      options.order = 2;
      options.is_complete = is_complete;
      const MeshPtr tube = GmshMeshes(options).volume("tube");
      ASSERT_EQ(tube->blocks.size(), 1u);
      const CellType expected = recombine ? (is_complete ? CellType::hex27 : CellType::hex20)
                                          : (is_complete ? CellType::prism18 : CellType::prism15);
      EXPECT_EQ(tube->blocks[0].type, expected);
      const double exact = 3.0 * M_PI / 4.0;
      EXPECT_NEAR(volume(*tube), exact, 2e-4 * exact);  // 4 facets a quarter; linear ones leave 2.5 %
      const FaceNodes inside = face_nodes(*tube, tube->faces.at("inside"));
      EXPECT_NEAR(inside.weights.sum(), M_PI / 2.0, 2e-4);
      EXPECT_NEAR(inside.areas.sum(), inside.weights.sum(), 1e-6);
      EXPECT_GT(inside.areas.minCoeff(), 0.0);
      for (Eigen::Index i = 0; i < inside.areas.size(); ++i) {
        const Vec3 x = tube->nodes.col(inside.nodes[static_cast<size_t>(i)]);
        EXPECT_NEAR(std::hypot(x[0], x[1]), 1.0, 1e-9) << "a node off the surface";
        EXPECT_GT(inside.normals.col(i).dot(-Vec3(x[0], x[1], 0.0)), 0.98);
      }
    }
}

// Two facets around a full circle on a thin shell: curved cells of that would turn inside out.
TEST_F(GmshReader, straightens_cells_that_curving_would_tangle_and_says_so) {
  const std::string file = write("rod.geo", R"(SetFactory("OpenCASCADE");
Cylinder(1) = {0, 0, 0, 0, 0, 3, 1}; Cylinder(2) = {0, 0, 0, 0, 0, 3, 0.9}; BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Mesh.MeshSizeMin = 0.8; Mesh.MeshSizeMax = 0.8; Physical Volume("shell") = {3};)");
  GmshOptions options;
  options.file = file;
  options.order = 2;
  take_warnings();
  const MeshPtr shell = GmshMeshes(options).volume("shell");
  const std::vector<std::string> warnings = take_warnings();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("curved cells of volume 'shell' were inverted and now have straight edges"),
            std::string::npos)
      << warnings[0];
  for (int i = 0; i < shell->n_cells(); ++i)
    EXPECT_GT(smallest_jacobian(CellType::tet10, cell_nodes(shell->nodes, shell->blocks[0], i)), 0.0);
}

TEST_F(GmshReader, refuses_cells_of_order_three_and_pyramids_by_name) {
  const std::string cubic =
      write("cubic.geo", "Mesh.ElementOrder = 3; SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 1, 1, 1};");
  expect_input_error([&] { read(cubic); }, {"cubic.geo", "volume1", "order 3", "hex8, prism6, tet4, tet10"});
  const std::string pyramid = write("pyramid.msh", R"($MeshFormat
2.2 0 8
$EndMeshFormat
$Nodes
5
1 0 0 0
2 1 0 0
3 1 1 0
4 0 1 0
5 .5 .5 1
$EndNodes
$Elements
1
1 7 2 1 1 1 2 3 4 5
$EndElements
)");
  expect_input_error([&] { read(pyramid); }, {"pyramid.msh", "Pyramid", "hex8, prism6, tet4"});
}

TEST_F(GmshReader, refuses_a_group_named_after_a_volume_that_it_does_not_bound) {
  const std::string file = write("two.geo", R"(SetFactory("OpenCASCADE"); Mesh.MeshSizeMax = 0.5;
Box(1) = {0, 0, 0, 1, 1, 1}; Box(2) = {5, 0, 0, 1, 1, 1};
Physical Volume("left") = {1}; Physical Volume("right") = {2}; Physical Surface("left.end") = {7};)");
  expect_input_error([&] { read(file); }, {"two.geo", "'left.end'", "not on the boundary", "'left'"});
}

TEST_F(GmshReader, gives_each_body_its_part_of_a_group_and_prefers_its_own) {
  const std::string file = write("two.geo", R"(SetFactory("OpenCASCADE"); Mesh.MeshSizeMax = 0.5;
Box(1) = {0, 0, 0, 1, 1, 1}; Box(2) = {1, 0, 0, 1, 1, 1}; Coherence;
Physical Volume("left") = {1}; Physical Volume("right") = {2};
Physical Surface("joint") = {2};
all() = CombinedBoundary{ Volume{1, 2}; };
Physical Surface("outside") = {all()};
Physical Surface("left.outside") = {1};)");
  const GmshMeshes meshes = read(file);
  const MeshPtr left = meshes.volume("left"), right = meshes.volume("right");
  EXPECT_NEAR(face_nodes(*left, left->faces.at("outside")).areas.sum(), 1.0, 1e-12);
  EXPECT_NEAR(face_nodes(*right, right->faces.at("outside")).areas.sum(), 5.0, 1e-12);
  EXPECT_EQ(right->faces.size(), 2u);
  const Facing joint = *match_faces({left.get(), left->faces.at("joint"), Vec3::Zero(), "left.joint"},
                                    {right.get(), right->faces.at("joint"), Vec3::Zero(), "right.joint"});
  EXPECT_NEAR(joint.areas.sum(), 1.0, 1e-12);
  for (int i = 0; i < joint.normals.cols(); ++i) EXPECT_TRUE(joint.normals.col(i).isApprox(Vec3::UnitX(), 1e-9));
}

TEST_F(GmshReader, reads_prisms_and_tetrahedra_with_the_right_volume_and_outward_faces) {
  const std::string prisms = write("prisms.geo", R"(SetFactory("OpenCASCADE"); Mesh.MeshSizeMax = 0.4;
Rectangle(1) = {0, 0, 0, 1, 1}; out[] = Extrude {0, 0, 2} { Surface{1}; Layers{3}; Recombine; };
Physical Volume("bar") = {out[1]}; Physical Surface("top") = {out[0]}; Physical Surface("side") = {out[2]};)");
  const MeshPtr bar = read(prisms).volume("bar");
  ASSERT_EQ(bar->blocks.size(), 1u);
  EXPECT_EQ(bar->blocks[0].type, CellType::prism6);
  EXPECT_NEAR(volume(*bar), 2.0, 1e-12);
  EXPECT_EQ(bar->faces.at("top")[0].type(), FacetType::tri3);
  EXPECT_EQ(bar->faces.at("side")[0].type(), FacetType::quad4);
  EXPECT_TRUE(face_nodes(*bar, bar->faces.at("top")).normals.col(0).isApprox(Vec3::UnitZ()));

  const std::string tetrahedra =
      write("ball.geo", "SetFactory(\"OpenCASCADE\"); Mesh.MeshSizeMax = 0.2; Sphere(1) = {0, 0, 0, 1};");
  const MeshPtr ball = read(tetrahedra).volume("volume1");
  EXPECT_EQ(ball->blocks[0].type, CellType::tet4);
  EXPECT_NEAR(volume(*ball), 4.18879, 0.06);
  const FaceNodes skin = face_nodes(*ball, ball->faces.at("surface1"));
  for (int i = 0; i < skin.normals.cols(); ++i) EXPECT_GT(skin.normals.col(i).dot(ball->nodes.col(skin.nodes[i])), 0.9);
}

TEST_F(GmshReader, turns_cells_right_side_out_whichever_way_the_file_has_them) {
  const std::string file = write("mirrored.msh", R"($MeshFormat
2.2 0 8
$EndMeshFormat
$PhysicalNames
2
2 2 "top"
3 1 "cube"
$EndPhysicalNames
$Nodes
8
11 0 0 0
12 1 0 0
13 1 1 0
14 0 1 0
25 0 0 1
26 1 0 1
27 1 1 1
28 0 1 1
$EndNodes
$Elements
2
1 3 2 2 6 25 28 27 26
2 5 2 1 1 25 26 27 28 11 12 13 14
$EndElements
)");
  const MeshPtr cube = read(file).volume("cube");
  EXPECT_NEAR(volume(*cube), 1.0, 1e-14);
  EXPECT_TRUE(face_nodes(*cube, cube->faces.at("top")).normals.col(0).isApprox(Vec3::UnitZ()));
}

TEST_F(GmshReader, warns_of_a_part_of_implausible_size) {
  take_warnings();
  read(write("block.geo", block_geo), {{"height", 300}});
  const std::vector<std::string> warnings = take_warnings();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("300 m"), std::string::npos) << warnings[0];
}

TEST_F(GmshReader, does_not_take_set_or_size_where_they_do_not_act) {
  const std::string mesh = write("a.msh", "$MeshFormat");
  expect_input_error([&] { read(mesh, {{"n", 1}}); }, {"a.msh", "'set'", ".geo"});
  expect_input_error([&] { GmshMeshes({mesh, {}, 0.1, 1.0}); }, {"a.msh", "'size'", ".msh"});
}

}  // namespace
}  // namespace dygita
