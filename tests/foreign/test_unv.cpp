// What a universal file becomes: parts, faces, regions, and what is told of the rest.
#include <gtest/gtest.h>

#include "foreign/foreign_meshes.hpp"
#include "foreign/quietly.hpp"
#include "foreign/unv_blocks.hpp"
#include "foreign/written_file.hpp"
#include "mesh/expect_input_error.hpp"
#include "mesh/face_nodes.hpp"

namespace dygita::unv_tests {
namespace {

std::shared_ptr<const ForeignMeshes> read(const std::string& text, double unit = 0.0,
                                          const std::vector<std::string>& skip = {}) {
  const WrittenFile written(text, "plate.unv");
  ForeignOptions options;
  options.file = written.path();
  options.has_unit = unit > 0.0;
  if (options.has_unit) options.unit = unit;
  options.skip = skip;
  return quietly([&] { return ForeignMeshes::of_unv(options); });
}

void refuse(const std::string& text, std::initializer_list<const char*> words) {
  expect_input_error([&] { read(text); }, words);
}

double area(const Mesh& mesh, const std::string& face) {
  Vec3 sum = Vec3::Zero();
  for (const Facet& facet : mesh.faces.at(face)) sum += facet_area_vector(mesh.nodes, facet);
  return sum.norm();
}

const std::vector<std::array<double, 3>> corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                                    {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

// A cube of 10, moved along x, with nodes and an element from `first` on.
std::string cube_nodes(int first, double x) {
  std::string text;
  for (int i = 0; i < 8; ++i) {
    const auto& at = corners[static_cast<size_t>(i)];
    text += unv_node(first + i, {x + 10 * at[0], 10 * at[1], 10 * at[2]});
  }
  return text;
}
std::string cube_element(int first) {
  std::vector<int> nodes;
  for (int i = 0; i < 8; ++i) nodes.push_back(first + i);
  return unv_element(first, 115, nodes);
}
std::string cube(const std::string& more = "") {
  return unv_dataset(2411, cube_nodes(1, 0)) + unv_dataset(2412, cube_element(1) + more);
}

TEST(Unv, blocks_of_every_shape_have_their_volume_faces_and_regions) {
  for (const UnvShape& shape : unv_shapes()) {
    SCOPED_TRACE(shape.descriptor);
    const auto file = read(unv_block(shape, 3));
    ASSERT_EQ(file->parts().size(), 1u);
    const StepPart& part = file->part("block");
    EXPECT_NEAR(volume(*part.mesh), 27e-6, 27e-6 * 1e-8);
    EXPECT_NEAR(part.mesh->nodes.maxCoeff(), 0.03, 1e-10);
    EXPECT_NEAR(area(*part.mesh, "TOP"), 9e-4, 9e-4 * 1e-8);
    EXPECT_NEAR(area(*part.mesh, "X0"), 9e-4, 9e-4 * 1e-8);
    const auto& regions = *file->regions(part.mesh);
    for (int axis = 0; axis < 3; ++axis)
      for (const int node : regions.at(std::string(1, "XYZ"[axis]) + "0"))
        EXPECT_NEAR(part.mesh->nodes(axis, node), 0.0, 1e-12);
    EXPECT_NE(file->report().find("not used: dataset 151"), std::string::npos) << file->report();
    EXPECT_NE(file->report().find("(surfaces) name faces where groups have them; as shells they are left out"),
              std::string::npos);
  }
}

TEST(Unv, units_are_those_of_the_file_or_of_the_user) {
  const auto size = [](const ForeignMeshes& file) { return file.parts()[0].mesh->nodes.maxCoeff(); };
  EXPECT_NEAR(size(*read(cube())), 10.0, 1e-12);
  EXPECT_NE(read(cube())->report().find("no dataset 164 (units): lengths are taken as metres"), std::string::npos);
  EXPECT_NEAR(size(*read(unv_units(39.37007874) + cube())), 0.254, 1e-9);  // inches
  EXPECT_NEAR(size(*read(cube(), 1e-3)), 0.01, 1e-12);
  const auto salome = read(unv_units(1.0) + cube(), 1e-3);
  EXPECT_NEAR(size(*salome), 0.01, 1e-12);
  EXPECT_NE(salome->report().find("dataset 164 says that lengths are in units of 1 m: 'unit' = 0.001 m is taken"),
            std::string::npos);
}

TEST(Unv, groups_may_be_mixed_overlap_and_share_names) {
  const std::string nodes = unv_dataset(2411, cube_nodes(1, 0) + cube_nodes(11, 10) + cube_nodes(21, 50));
  const std::string elements =
      unv_dataset(2412, cube_element(1) + cube_element(11) + cube_element(21) + unv_element(31, 94, {5, 6, 7, 8}) +
                            unv_element(32, 44, {11, 12, 13, 14}) + unv_line({40, 21, 1, 1, 7, 2}) +
                            unv_line({0, 1, 1}) + unv_line({1, 2}) + unv_line({41, 11, 1, 1, 7, 2}) + unv_line({1, 2}));
  const auto file =
      read(nodes + elements +
           unv_dataset(2467, unv_group(1, "left", {{8, 1}, {8, 31}, {7, 1}, {7, 2}}) +
                                 unv_group(2, "both", {{8, 1}, {8, 11}}) + unv_group(3, "left", {{8, 32}})) +
           unv_dataset(2477, unv_group(4, "one node", {{7, 24}})));
  EXPECT_EQ(file->parts().size(), 3u);
  const Mesh& left = *file->part("left").mesh;
  EXPECT_NEAR(left.nodes.row(0).maxCoeff(), 10.0, 1e-12);
  EXPECT_NEAR(area(left, "left"), 100.0, 1e-9);
  EXPECT_EQ(file->regions(file->part("left").mesh)->at("left").size(), 2u);
  EXPECT_EQ(file->regions(file->part("left").mesh)->at("both").size(), 8u);
  EXPECT_NEAR(area(*file->part("both").mesh, "left (group 3)"), 100.0, 1e-9);
  EXPECT_EQ(file->regions(file->part("property 1").mesh)->at("one node").size(), 1u);
  EXPECT_NE(file->report().find("1 cells are in more than one group"), std::string::npos) << file->report();
  EXPECT_NE(file->report().find("1 elements of type 21 are no cells here"), std::string::npos);
}

// Two cells that share a facet in one part have no face there; in two parts each has it.
TEST(Unv, a_facet_between_two_parts_is_a_face_of_both) {
  std::string nodes = cube_nodes(1, 0);
  for (const int i : {1, 2, 5, 6}) {
    const auto& at = corners[static_cast<size_t>(i)];
    nodes += unv_node(11 + i, {20 * at[0], 10 * at[1], 10 * at[2]});
  }
  const std::string both =
      unv_dataset(2411, nodes) + unv_dataset(2412, cube_element(1) + unv_element(2, 115, {2, 12, 13, 3, 6, 16, 17, 7}) +
                                                       unv_element(3, 94, {2, 3, 7, 6}));
  const auto parts = read(both + unv_dataset(2467, unv_group(1, "a", {{8, 1}}) + unv_group(2, "b", {{8, 2}}) +
                                                       unv_group(3, "between", {{8, 3}})));
  EXPECT_NEAR(area(*parts->part("a").mesh, "between"), 100.0, 1e-9);
  EXPECT_NEAR(area(*parts->part("b").mesh, "between"), 100.0, 1e-9);
  const auto one =
      read(both + unv_dataset(2467, unv_group(1, "a", {{8, 1}, {8, 2}}) + unv_group(3, "between", {{8, 3}})));
  EXPECT_FALSE(one->part("a").mesh->faces.contains("between"));
  EXPECT_NE(one->report().find("lie inside part 'a'"), std::string::npos) << one->report();
}

TEST(Unv, what_is_wrong_is_refused_by_line) {
  refuse("plain text\n", {"plate.unv:1", "a line of -1 is expected, which opens a dataset, not 'plain text'"});
  refuse(unv_dataset(2411, cube_nodes(1, 0)), {"has no element that is a cell here"});
  refuse("    -1\n  2411\n" + cube_nodes(1, 0), {"the last dataset does not end: the file is cut off"});
  refuse(cube(unv_element(1, 115, {1, 2, 3, 4, 5, 6, 7, 8})), {"plate.unv:25", "element 1 is given twice"});
  refuse(cube(unv_element(9, 115, {1, 2, 3, 4, 5, 6, 7, 99})), {"there is no node 99"});
  refuse(cube(unv_element(9, 115, {1, 2, 3, 4, 5, 6, 7})), {"element 9 of type 115 has 7 nodes, not 8"});
  refuse(cube(unv_element(9, 117, {1, 2, 3, 4})),
         {"solid elements of type 117 are no cells here", "skip = { \"117\" }"});
  refuse(cube() + unv_dataset(2467, unv_group(1, "a", {{8, 7}})), {"there is no element 7"});
  refuse(cube() + unv_dataset(2467, unv_line({1, 0, 0, 0, 0, 0, 0, 5}) + "a\n"), {"entities of a group is expected"});
  const auto system = [](const char* origin) {
    return unv_dataset(2420, unv_line({1}) + "PART\n" + unv_line({1, 0, 0}) + "FIRST\n" +
                                 " 1. 0. 0.\n 0. 1. 0.\n 0. 0. 1.\n" + origin);
  };
  refuse(system(" 0. 2.5 0.\n") + unv_dataset(2411, unv_line({1, 1, 1, 11}) + " 0. 0. 0.\n") + cube(),
         {"node 1 is in coordinate system 1"});
  refuse(system(" 0. x 0.\n") + cube(), {"the origin of a coordinate system is expected, not 'x'"});
  refuse(unv_dataset(2411, unv_line({1, 7, 1, 11}) + " 0. 0. 0.\n") + cube(), {"node 1 is in coordinate system 7"});
  refuse(unv_dataset(2411, unv_line({1, 1, 1, 11}) + " 0. x 0.\n"), {"coordinates is expected, not 'x'"});
  refuse(unv_units(-1.0) + cube(), {"a factor of lengths above 0"});
  EXPECT_EQ(read(cube(unv_element(9, 117, {1, 2, 3, 4})), 0.0, {"117"})->parts().size(), 1u);
}

}  // namespace
}  // namespace dygita::unv_tests
