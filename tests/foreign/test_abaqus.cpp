// What an .inp becomes: parts, faces, regions, materials, and what is told of the rest.
#include <gtest/gtest.h>

#include <chrono>

#include "base/log.hpp"
#include "foreign/abaqus_blocks.hpp"
#include "foreign/foreign_meshes.hpp"
#include "foreign/quietly.hpp"
#include "foreign/written_file.hpp"
#include "mesh/expect_input_error.hpp"
#include "mesh/face_nodes.hpp"

namespace dygita {
namespace {

std::shared_ptr<const ForeignMeshes> read(const std::string& text, const std::string& units = "mm t s",
                                          const std::vector<std::string>& skip = {}) {
  const WrittenFile written(text, "plate.inp");
  ForeignOptions options;
  options.file = written.path();
  if (!units.empty()) {
    options.units = file_units(units);
    options.unit = options.units->length;
  }
  options.skip = skip;
  return quietly([&] { return ForeignMeshes::of_abaqus(options); });
}

void refuse(const std::string& text, std::initializer_list<const char*> words) {
  expect_input_error([&] { read(text); }, words);
}

// A cube of 10 with nodes 1 to 8, moved along x.
std::string cube(int first, double x, const std::string& set) {
  std::string text = "*NODE\n";
  int n = first;
  for (const auto& at :
       {std::array<int, 3>{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}})
    text += fmt::format("{}, {}, {}, {}\n", n++, x + 10 * at[0], 10 * at[1], 10 * at[2]);
  text += fmt::format("*ELEMENT, TYPE=C3D8, ELSET={}\n{}", set, first);
  for (int i = 0; i < 8; ++i) text += fmt::format(", {}", first + i);
  return text + "\n";
}

double area(const Mesh& mesh, const std::string& face) {
  Vec3 sum = Vec3::Zero();
  for (const Facet& facet : mesh.faces.at(face)) sum += facet_area_vector(mesh.nodes, facet);
  return sum.norm();
}

TEST(Abaqus, blocks_of_every_shape_have_their_volume_and_the_area_of_their_surface) {
  for (const AbaqusShape& shape : abaqus_shapes()) {
    SCOPED_TRACE(shape.type);
    const auto file = read(AbaqusBlock(shape, 3).text() + "*SOLID SECTION, ELSET=E, MATERIAL=STEEL\n");
    const Mesh& mesh = *file->part("E").mesh;
    EXPECT_NEAR(volume(mesh), 27e-6, 27e-6 * 1e-12);
    EXPECT_NEAR(area(mesh, "TOP"), 9e-4, 9e-4 * 1e-12);
    EXPECT_NEAR(area(mesh, "X0"), 9e-4, 9e-4 * 1e-12);
    const auto& regions = *file->regions(file->part("E").mesh);
    EXPECT_EQ(regions.at("X0").size(), nodes_of(mesh.faces.at("X0")).size());
    EXPECT_EQ(static_cast<int>(regions.at("ALL").size()), mesh.n_nodes());
  }
}

TEST(Abaqus, suffixes_are_told_once_with_what_they_mean_here) {
  std::string text = cube(1, 0, "A") + cube(11, 20, "A");
  for (size_t at = text.find("C3D8"); at != std::string::npos; at = text.find("C3D8", at + 5)) text.insert(at + 4, "R");
  const std::string report = read(text)->report();
  EXPECT_NE(report.find("2 elements of type C3D8R: full integration, reduced in the file"), std::string::npos)
      << report;
  refuse("*NODE\n1,0,0,0\n*ELEMENT, TYPE=C3D8T\n1,1\n",
         {"plate.inp:3", "C3D8T", "C3D4, C3D6, C3D8, C3D10, C3D15, C3D20"});
}

TEST(Abaqus, connected_cells_of_a_section_are_parts) {
  const auto file = read(cube(1, 0, "PINS") + cube(11, 20, "PINS") + cube(21, 40, "PLATE") +
                         "*SOLID SECTION, ELSET=PINS, MATERIAL=STEEL\n*SOLID SECTION, ELSET=PLATE, MATERIAL=ALU\n");
  ASSERT_EQ(file->parts().size(), 3u);
  EXPECT_NEAR(file->part("PINS[2]").mesh->nodes.row(0).minCoeff(), 0.02, 1e-12);
  EXPECT_EQ(file->parts("PINS").size(), 2u);
  EXPECT_EQ(file->part("PLATE").mesh->n_cells(), 1);
  EXPECT_NE(file->report().find("'PINS' form 2 unconnected pieces"), std::string::npos);
  expect_input_error([&] { file->part("PINS"); }, {"has 2 parts 'PINS'", "'PINS[1]' to 'PINS[2]'"});
  expect_input_error([&] { file->part("PLATTE"); }, {"did you mean 'PLATE'?"});
}

// By hand: moved by (100, 0, 0), then turned by 90 degrees about the z axis through (100, 0, 0).
TEST(Abaqus, instances_of_a_part_are_moved_and_then_turned) {
  const auto file =
      read("*PART, NAME=P\n" + cube(1, 0, "C") +
           "*NSET, NSET=LOW\n1, 2\n*SURFACE, NAME=SIDE\nC, S4\n*SOLID SECTION, ELSET=C, MATERIAL=M\n*END PART\n"
           "*ASSEMBLY, NAME=A\n*INSTANCE, NAME=one, PART=P\n*END INSTANCE\n*INSTANCE, NAME=two, PART=P\n100, 0, 0\n"
           "100, 0, 0, 100, 0, 1, 90\n*END INSTANCE\n*NSET, NSET=PICK, INSTANCE=two\n2\n"
           "*NSET, NSET=BOTH\none.LOW, two.3\n*END ASSEMBLY\n");
  ASSERT_EQ(file->parts().size(), 2u);
  const Mesh& two = *file->part("two").mesh;
  EXPECT_NEAR(two.nodes.row(0).minCoeff(), 0.09, 1e-12);
  EXPECT_NEAR(two.nodes.row(0).maxCoeff(), 0.10, 1e-12);
  EXPECT_NEAR(two.nodes.row(1).maxCoeff(), 0.01, 1e-12);
  EXPECT_NEAR(area(two, "SIDE"), 1e-4, 1e-16);
  for (const int node : nodes_of(two.faces.at("SIDE"))) EXPECT_NEAR(two.nodes(1, node), 0.01, 1e-12);  // x = 10 turned
  const auto& regions = *file->regions(file->part("two").mesh);
  ASSERT_EQ(regions.at("PICK").size(), 1u);
  EXPECT_NEAR((two.nodes.col(regions.at("PICK")[0]) - Vec3(0.1, 0.01, 0)).norm(), 0, 1e-12);
  EXPECT_EQ(regions.at("BOTH").size(), 1u);
  EXPECT_EQ(file->regions(file->part("one").mesh)->at("BOTH").size(), 2u);
}

TEST(Abaqus, sets_are_generated_nested_and_added_to) {
  const auto file = read(cube(1, 0, "A") +
                         "*NSET, NSET=LOW, GENERATE\n1, 4\n*NSET, NSET=ODD, GENERATE\n1, 7, 2\n"
                         "*NSET, NSET=MANY\nlow, 8\n*NSET, NSET=MANY\n7\n*ELSET, ELSET=AGAIN\nA\n"
                         "*SURFACE, NAME=OUT\nAGAIN\n*SURFACE, NAME=POINTS, TYPE=NODE\nLOW\n");
  const auto& part = file->part("A");
  const auto& regions = *file->regions(part.mesh);
  EXPECT_EQ(regions.at("LOW").size(), 4u);
  EXPECT_EQ(regions.at("ODD").size(), 4u);
  EXPECT_EQ(regions.at("MANY").size(), 6u);
  EXPECT_EQ(part.mesh->faces.at("OUT").size(), 6u);
  EXPECT_NEAR(area(*part.mesh, "POINTS"), 1e-4, 1e-16);
}

TEST(Abaqus, nodes_in_cylinders_spheres_and_systems_are_where_they_say) {
  std::string text = cube(1, 0, "A");
  const auto put = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  put("*NODE\n1, 0, 0, 0\n2, 10, 0, 0\n",
      "*NODE, SYSTEM=C\n1, 0, 30, 0\n2, 10, 0, 0\n3, 14.142135623730951, 45, 0\n*NODE\n");
  put("3, 10, 10, 0\n4", "4");
  EXPECT_NEAR(volume(*read(text)->part("A").mesh), 1e-6, 1e-17);
  const auto turned = read("*SYSTEM\n5, 0, 0, 5, 1, 0\n" + cube(1, 0, "A"));  // x along y, y along -x
  EXPECT_NEAR(turned->part("A").mesh->nodes.row(0).minCoeff(), -0.005, 1e-12);
  EXPECT_NEAR(turned->part("A").mesh->nodes.row(1).maxCoeff(), 0.010, 1e-12);
}

TEST(Abaqus, materials_are_in_si_by_the_units_of_the_file) {
  const std::string text =
      cube(1, 0, "A") +
      "*MATERIAL, NAME=STEEL\n*ELASTIC\n 210000., 0.3\n*DENSITY\n 7.85E-9\n*DAMPING, ALPHA=2., BETA=1e-6\n"
      "*MATERIAL, NAME=PLY\n*ELASTIC, TYPE=ENGINEERING CONSTANTS\n140000,10000,9000,0.3,0.28,0.4,5000,4500\n3000,\n"
      "*DENSITY\n1.6e-9\n*MATERIAL, NAME=HOT\n*ELASTIC\n210000., 0.3, 20.\n200000., 0.3, 300.\n"
      "*MATERIAL, NAME=SOFT\n*ELASTIC\n210000., 0.3\n*PLASTIC\n200., 0.\n*MATERIAL, NAME=EMPTY\n";
  const auto file = read(text);
  const FileMaterial steel = file->material("STEEL"), ply = file->material("PLY");
  EXPECT_NEAR(steel.numbers.at("young"), 210e9, 1);
  EXPECT_EQ(steel.numbers.at("poisson"), 0.3);
  EXPECT_NEAR(*steel.density, 7850, 1e-9);
  EXPECT_EQ(steel.mass_damping, 2.0);
  EXPECT_EQ(steel.stiffness_damping, 1e-6);
  EXPECT_EQ(ply.word, "orthotropic");
  EXPECT_NEAR(ply.numbers.at("e3"), 9e9, 1e-3);
  EXPECT_EQ(ply.numbers.at("nu23"), 0.4);
  EXPECT_NEAR(ply.numbers.at("g23"), 3e9, 1e-3);
  expect_input_error([&] { file->material("STEAL"); }, {"did you mean 'STEEL'?"});
  expect_input_error([&] { file->material("HOT"); }, {"material 'HOT'", "depends on temperature", "plate.inp:"});
  expect_input_error([&] { file->material("SOFT"); }, {"*PLASTIC is not read"});
  expect_input_error([&] { file->material("EMPTY"); }, {"has no *ELASTIC"});
  expect_input_error([&] { read(text, "")->material("STEEL"); }, {"units = \"mm t s\""});
}

// The stiffnesses of an isotropic material are those of its engineering constants.
TEST(Abaqus, stiffnesses_become_engineering_constants) {
  const double e = 200e3, nu = 0.25, lambda = e * nu / ((1 + nu) * (1 - 2 * nu)), mu = e / 2 / (1 + nu),
               p = lambda + 2 * mu;
  const auto file =
      read(cube(1, 0, "A") +
           fmt::format("*MATERIAL, NAME=M\n*ELASTIC, TYPE=ORTHO\n{0},{1},{0},{1},{1},{0},{2},{2}\n{2},20.\n", p, lambda,
                       mu));
  const FileMaterial made = file->material("M");
  for (const char* name : {"e1", "e2", "e3"}) EXPECT_NEAR(made.numbers.at(name), 200e9, 1e3);
  for (const char* name : {"nu12", "nu13", "nu23"}) EXPECT_NEAR(made.numbers.at(name), 0.25, 1e-5);
  EXPECT_NEAR(made.numbers.at("g13"), 80e9, 1e3);
}

TEST(Abaqus, keywords_that_are_not_used_are_listed_with_their_lines) {
  const auto file = read(cube(1, 0, "A") + "*BOUNDARY\n1, 1, 3\n*STEP\n*STATIC\n*BOUNDARY\n2, 1\n*END STEP\n");
  EXPECT_NE(file->report().find("not used: *BOUNDARY: "), std::string::npos) << file->report();
  EXPECT_NE(file->report().find(".inp:12, "), std::string::npos) << file->report();
  EXPECT_NE(file->report().find(".inp:16\n"), std::string::npos) << file->report();
  EXPECT_NE(file->report().find("not used: *STATIC"), std::string::npos);
  EXPECT_EQ(file->report().find("*NODE"), std::string::npos);
}

TEST(Abaqus, elements_between_points_and_those_named_are_left_out_and_told) {
  const std::string spring = "*ELEMENT, TYPE=SPRINGA, ELSET=S\n900, 1, 2\n901, 2, 3\n*ELSET, ELSET=ALL\nA, 900\n";
  const auto file = read(cube(1, 0, "A") + spring + "*SOLID SECTION, ELSET=ALL, MATERIAL=M\n");
  EXPECT_NE(file->report().find("2 elements of type SPRINGA are no cells here and are left out"), std::string::npos);
  const std::string shell = cube(1, 0, "A") + "*ELEMENT, TYPE=S4R\n900, 1, 2, 3, 4\n";
  refuse(shell, {"elements of type 'S4R' are no cells here", "skip = { \"S4R\" } leaves them out"});
  EXPECT_NE(read(shell, "mm t s", {"s4r"})->report().find("1 elements of type S4R"), std::string::npos);
}

TEST(Abaqus, facets_inside_a_part_are_no_face_and_told) {
  const auto file =
      read(cube(1, 0, "A") + "*NODE\n" +
           "21,20,0,0\n22,20,10,0\n23,20,0,10\n24,20,10,10\n*ELEMENT,TYPE=C3D8,ELSET=A\n2,2,21,22,3,6,23,24,7\n"
           "*SURFACE, NAME=CUT\n1, S4\n");
  EXPECT_FALSE(file->part("A").mesh->faces.contains("CUT"));
  EXPECT_NE(file->report().find("1 of 1 facets of surface 'CUT' lie inside part 'A'"), std::string::npos);
}

TEST(Abaqus, what_is_wrong_is_refused_by_line) {
  refuse(cube(1, 0, "A") + "*ELEMENT, TYPE=C3D8\n5, 1, 2, 3\n",
         {"plate.inp:13", "element 5 has 3 nodes, and not the 8 of a C3D8"});
  refuse(cube(1, 0, "A") + "*ELEMENT, TYPE=C3D4\n5, 1, 2, 3, 99\n", {"plate.inp:13", "element 5 has node 99"});
  refuse(cube(1, 0, "A") + "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 5\n", {"plate.inp:13", "element 1 is given twice"});
  refuse(cube(1, 0, "A") + "*NODE\n1, 1, 0, 0\n", {"plate.inp:13", "node 1 is given twice"});
  refuse(cube(1, 0, "A") + "*NODE\n9, 1, zero, 0\n", {"plate.inp:13", "a number is expected, not 'zero'"});
  refuse(cube(1, 0, "A") + "*NSET, NSET=B\nTOPP\n", {"plate.inp:13", "there is no *NSET of nodes 'TOPP'"});
  refuse(cube(1, 0, "A") + "*SURFACE, NAME=B\nA, S7\n",
         {"plate.inp:13", "'S7' is no face of element 1: it has S1 to S6"});
  refuse(cube(1, 0, "A") + "*ELEMENT, TYPE=C3D4\n5, 1, 2, 3, 4\n",
         {"plate.inp:13: element 5 is inverted or too distorted"});
  refuse(cube(1, 0, "A") + "*NGEN\n1, 2\n", {"plate.inp:12", "*NGEN", "write the mesh out"});
  refuse("*NODE\n1,0,0,0\n", {"has no element that is a cell here"});
  refuse("*PART, NAME=P\n" + cube(1, 0, "A") + "*END PART\n", {"has parts and no *INSTANCE"});
  refuse("*PART, NAME=P\n" + cube(1, 0, "A") + "*END PART\n*INSTANCE, NAME=I, PART=Q\n*END INSTANCE\n",
         {"there is no part 'Q'"});
}

TEST(Abaqus, a_hundred_thousand_cells_are_read_in_under_two_seconds) {
  constexpr int n = 47;  // 103,823 cells
  std::string text = "*NODE\n";
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        text += fmt::format("{}, {:.6e}, {:.6e}, {:.6e}\n", 1 + i + 48 * (j + 48 * k), 1.1 * i, 1.2 * j, 1.3 * k);
  text += "*ELEMENT, TYPE=C3D8, ELSET=E\n";
  int cell = 1;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const int a = 1 + i + 48 * (j + 48 * k), b = a + 48 * 48;
        text += fmt::format("{}, {}, {}, {}, {}, {}, {}, {}, {}\n", cell++, a, a + 1, a + 49, a + 48, b, b + 1, b + 49,
                            b + 48);
      }
  const WrittenFile written(text);
  ForeignOptions options;
  options.file = written.path();
  options.unit = 1e-3;
  const auto begin = std::clock();
  const auto file = ForeignMeshes::of_abaqus(options);
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  EXPECT_EQ(file->part("E").mesh->n_cells(), n * n * n);
  RecordProperty("seconds", fmt::format("{:.2f}", seconds));
  std::cout << "read in " << seconds << " s of the processor\n";
#ifndef __SANITIZE_ADDRESS__
  EXPECT_LT(seconds, 2.0);
#endif
}

}  // namespace
}  // namespace dygita
