// What a Nastran file becomes: parts, regions, materials, and what is told of the rest.
#include <gtest/gtest.h>

#include <ctime>

#include "base/log.hpp"
#include "foreign/foreign_meshes.hpp"
#include "foreign/nastran_blocks.hpp"
#include "foreign/quietly.hpp"
#include "foreign/written_file.hpp"
#include "mesh/expect_input_error.hpp"
#include "mesh/face_nodes.hpp"

namespace dygita::nastran_tests {
namespace {

std::shared_ptr<const ForeignMeshes> read(const std::string& text, const std::string& units = "mm t s",
                                          const std::vector<std::string>& skip = {}) {
  const WrittenFile written(text, "plate.bdf");
  ForeignOptions options;
  options.file = written.path();
  if (!units.empty()) {
    options.units = file_units(units);
    options.unit = options.units->length;
  }
  options.skip = skip;
  return quietly([&] { return ForeignMeshes::of_nastran(options); });
}

void refuse(const std::string& text, std::initializer_list<const char*> words) {
  expect_input_error([&] { read(text); }, words);
}

// A cube of 10, moved along x, with nodes and an element from `first` on.
std::string cube(int first, double x, int property) {
  std::string text;
  int n = first;
  for (const auto& at :
       {std::array<int, 3>{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}})
    text += fmt::format("GRID,{},,{:.1f},{:.1f},{:.1f}\n", n++, x + 10 * at[0], 10.0 * at[1], 10.0 * at[2]);
  text += fmt::format("CHEXA,{},{}", first, property);
  for (int i = 0; i < 6; ++i) text += fmt::format(",{}", first + i);
  return text + fmt::format("\n,{},{}\n", first + 6, first + 7);
}

double area(const Mesh& mesh, const std::string& face) {
  Vec3 sum = Vec3::Zero();
  for (const Facet& facet : mesh.faces.at(face)) sum += facet_area_vector(mesh.nodes, facet);
  return sum.norm();
}

// Also through a cylinder and a turned box in which nodes are given.
TEST(Nastran, blocks_of_every_shape_have_their_volume_and_the_area_of_their_load) {
  for (const NastranShape& shape : nastran_shapes()) {
    SCOPED_TRACE(fmt::format("{} {}", shape.name, shape.shape.edges.size()));
    const auto file = read(NastranBlock(shape, 3).text());
    const StepPart& part = file->part("PSOLID 1");
    EXPECT_NEAR(volume(*part.mesh), 27e-6, 27e-6 * 1e-8);
    EXPECT_NEAR(part.mesh->nodes.minCoeff(), 0.0, 1e-10);
    EXPECT_NEAR(part.mesh->nodes.maxCoeff(), 0.03, 1e-10);
    bool has_load = false;
    for (const auto& [name, facets] : part.mesh->faces)
      if (name.starts_with("pload4 ")) {
        EXPECT_NEAR(area(*part.mesh, name), 9e-4, 9e-4 * 1e-8);
        has_load = true;
      }
    EXPECT_TRUE(has_load);
  }
}

TEST(Nastran, parts_materials_and_sets_have_the_names_of_the_comments) {
  const auto file = read(
      "SOL 101\nCEND\nSET 3 = 1 THRU 3 EXCEPT 2,\n 4\nSET 4 = 1\nSTRESS = 4\nBEGIN BULK\n"
      "$HMNAME PROP 7\"base\" 5\n$HMNAME MAT 2\"steel\" \"MAT1\"\n$HMSET        3        1 \"foot\"\n"
      "PSOLID,7,2\nPSOLID,8,2\nMAT1,2,210000.,,.3,7.85-9\n" +
      cube(1, 0, 7) + cube(11, 30, 8) + "SET1,5,1,THRU,4\n");
  EXPECT_EQ(file->part("base").mesh->n_cells(), 1);
  EXPECT_NEAR(file->part("PSOLID 8").mesh->nodes.row(0).maxCoeff(), 0.04, 1e-12);
  const auto& regions = *file->regions(file->part("base").mesh);
  EXPECT_EQ(regions.at("foot").size(), 3u);
  EXPECT_EQ(regions.at("SET 5").size(), 4u);
  EXPECT_NEAR(area(*file->part("base").mesh, "SET 5"), 1e-4, 1e-16);
  EXPECT_NE(file->report().find("SET 4 is not used: a set of elements"), std::string::npos) << file->report();
  EXPECT_NEAR(file->material("steel").numbers.at("young"), 210e9, 1);
}

TEST(Nastran, systems_may_be_of_nodes_of_cylinders_and_of_spheres) {
  // System 2: at node 101, axis 3 along x, axis 1 along y; 3: a cylinder in system 2; 4: a sphere at the origin.
  const std::string systems =
      "CORD1R,2,101,102,103\nGRID,101,,1.,2.,3.\nGRID,102,,2.,2.,3.\nGRID,103,,1.,3.,3.\n"
      "CORD2C,3,2,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\nCORD2S,4,,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n";
  const std::string tetrahedron =
      "GRID,1,,0.,0.,0.\nGRID,2,3,2.,90.,5.\nGRID,3,4,2.,90.,90.\nGRID,4,4,2.,0.,0.\nCTETRA,1,1,1,2,3,4\n";
  const auto file = read(systems + tetrahedron, "m kg s");
  const Mesh& mesh = *file->parts()[0].mesh;
  EXPECT_NEAR((mesh.nodes.col(1) - Vec3(6, 2, 5)).norm(), 0, 1e-12);  // axis 2 of system 2 is z
  EXPECT_NEAR((mesh.nodes.col(2) - Vec3(0, 2, 0)).norm(), 0, 1e-12);
  EXPECT_NEAR((mesh.nodes.col(3) - Vec3(0, 0, 2)).norm(), 0, 1e-12);
  refuse(cube(1, 0, 1) + "CORD2R,5,6,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\nCORD2R,6,5,0.,0.,0.,0.,0.,1.\n,1.,0.,0.\n",
         {"CORD2R: coordinate system", "is defined by itself"});
  refuse(cube(1, 0, 1) + "CORD2R,5,,0.,0.,0.,0.,0.,1.\n,0.,0.,2.\n", {"plate.bdf:11", "lie on one line"});
  refuse(cube(1, 0, 1) + "GRID,50,9,0.,0.,0.\n", {"plate.bdf:11: GRID: there is no coordinate system 9"});
}

TEST(Nastran, materials_are_in_si_by_the_units_of_the_file) {
  const std::string bulk =
      cube(1, 0, 1) +
      "PSOLID,1,1\nMAT1,1,210000.,,.3,7.85-9\nMAT1,2,,80000.,.25,7.85-9\nMAT1,3,200000.,80000.,,7.-9\n"
      "MAT11,4,140000.,10000.,9000.,.3,.28,.4,5000.\n,4500.,3000.,1.6-9\n"
      "MAT1,5,210000.\nMAT1,6,210000.,10000.,.3\nMATS1,2,,PLASTIC\nMAT1,7,210000.,,.3,,,,.04\n";
  const auto file = read(bulk);
  EXPECT_NEAR(file->material("MAT1 1").numbers.at("young"), 210e9, 1);
  EXPECT_NEAR(*file->material("MAT1 1").density, 7850, 1e-9);
  EXPECT_NEAR(file->material("MAT1 3").numbers.at("poisson"), 0.25, 1e-12);
  EXPECT_NEAR(file->material("MAT11 4").numbers.at("g13"), 4.5e9, 1e-3);
  EXPECT_EQ(file->material("MAT11 4").numbers.at("nu23"), 0.4);
  expect_input_error([&] { file->material("MAT1 2"); }, {"MATS1 is not read", "plate.bdf:"});
  expect_input_error([&] { file->material("MAT1 5"); }, {"two of E, G and NU are expected"});
  expect_input_error([&] { file->material("MAT1 6"); }, {"G is not E / 2 (1 + NU)"});
  EXPECT_NE(file->report().find("structural damping GE = 0.04 is not used"), std::string::npos);
  const auto weighed = read("PARAM,WTMASS,.00259\n" + cube(1, 0, 1) + "MAT1,1,3.+7,,.3,.283\n", "in lbf s");
  EXPECT_NEAR(*weighed->material("MAT1 1").density, .283 * .00259 * 175.12683525 / 1.6387064e-5, 1);  // 7833 kg/m^3
}

// The stiffnesses of an orthotropic material in the order of MAT9 (xx, yy, zz, xy, yz, zx) are those of its constants.
TEST(Nastran, stiffnesses_of_mat9_become_engineering_constants) {
  const double e = 200e3, nu = 0.25, lambda = e * nu / ((1 + nu) * (1 - 2 * nu)), p = lambda + e / (1 + nu);
  const auto mat9 = [&](const std::string& coupling) {
    return fmt::format(
        "MAT9,1,{0:.6f},{1:.6f},{1:.6f},,,{2},{0:.6f}\n,{1:.6f},,,,{0:.6f},,,\n,10000.,,,20000.,,30000.,8.-9\n", p,
        lambda, coupling);
  };
  const auto file = read(cube(1, 0, 1) + mat9(""));
  const FileMaterial made = file->material("MAT9 1");
  for (const char* name : {"e1", "e2", "e3"}) EXPECT_NEAR(made.numbers.at(name), 200e9, 1e3);
  for (const char* name : {"nu12", "nu13", "nu23"}) EXPECT_NEAR(made.numbers.at(name), 0.25, 1e-7);
  EXPECT_NEAR(made.numbers.at("g12"), 10e9, 1);
  EXPECT_NEAR(made.numbers.at("g23"), 20e9, 1);
  EXPECT_NEAR(made.numbers.at("g13"), 30e9, 1);
  EXPECT_NEAR(*made.density, 8000, 1e-9);
  expect_input_error([&] { read(cube(1, 0, 1) + mat9("500."))->material("MAT9 1"); }, {"G16 couple directions"});
}

TEST(Nastran, what_joins_points_is_left_out_and_other_elements_are_refused) {
  const std::string joints = "RBE2,90,1,123456,2,3\nCONM2,91,1,,2.-3\nCBUSH,92,5,1,2\n";
  const auto file = read(cube(1, 0, 1) + joints);
  EXPECT_NE(file->report().find("1 elements of type RBE2 are no cells here and are left out"), std::string::npos);
  EXPECT_NE(file->report().find("not used: CBUSH: "), std::string::npos) << file->report();
  EXPECT_NE(file->report().find("plate.bdf:13"), std::string::npos);
  const std::string shell = cube(1, 0, 1) + "CQUAD4,90,2,1,2,3,4\n";
  refuse(shell, {"plate.bdf:11: CQUAD4", "no cells here: CTETRA, CPENTA, CHEXA are", "skip = { \"CQUAD4\" }"});
  EXPECT_NE(read(shell, "mm t s", {"cquad4"})->report().find("1 elements of type CQUAD4"), std::string::npos);
}

TEST(Nastran, what_is_wrong_is_refused_by_line_and_card) {
  refuse(cube(1, 0, 1) + "CTETRA,5,1,1,2,3\n", {"plate.bdf:11: CTETRA: the number of a node is expected"});
  refuse(cube(1, 0, 1) + "CTETRA,5,1,1,2,3,99\n", {"plate.bdf:11", "element 5 has node 99"});
  refuse(cube(1, 0, 1) + "CTETRA,5,1,1,2,3,5,6,7\n",
         {"plate.bdf:11", "element 5 has 2 of its 6 nodes between corners"});
  refuse(cube(1, 0, 1) + "CTETRA,1,1,1,2,3,5\n", {"plate.bdf:11", "element 1 is given twice"});
  refuse(cube(1, 0, 1) + "GRID,1,,1.,0.,0.\n", {"plate.bdf:11", "node 1 is given twice"});
  refuse(cube(1, 0, 1) + "GRID,9,,1.,zero,0.\n", {"plate.bdf:11: GRID: a coordinate is expected, not 'zero'"});
  refuse(cube(1, 0, 1) + "CTETRA,5,1,1,2,3,4\n", {"plate.bdf:11: element 5 is inverted or too distorted"});
  refuse(cube(1, 0, 1) + "PSOLID,1,1\nPSOLID,1,2\n", {"plate.bdf:12: PSOLID: there is a property 1 already"});
  refuse("GRID,1,,0.,0.,0.\n", {"has no element that is a cell here"});
}

TEST(Nastran, a_hundred_thousand_cells_are_read_in_under_two_seconds) {
  constexpr int n = 47;  // 103,823 cells
  std::string text = "PSOLID,1,1\n";
  for (int k = 0; k <= n; ++k)
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        text += fmt::format("GRID    {:8}        {:8.3f}{:8.3f}{:8.3f}\n", 1 + i + 48 * (j + 48 * k), 1.1 * i, 1.2 * j,
                            1.3 * k);
  int cell = 1;
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const int a = 1 + i + 48 * (j + 48 * k), b = a + 48 * 48;
        text += fmt::format("CHEXA   {:8}       1{:8}{:8}{:8}{:8}{:8}{:8}\n        {:8}{:8}\n", cell++, a, a + 1,
                            a + 49, a + 48, b, b + 1, b + 49, b + 48);
      }
  const WrittenFile written(text, "large.bdf");
  ForeignOptions options;
  options.file = written.path();
  options.unit = 1e-3;
  const auto begin = std::clock();
  const auto file = ForeignMeshes::of_nastran(options);
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  EXPECT_EQ(file->part("PSOLID 1").mesh->n_cells(), n * n * n);
  RecordProperty("seconds", fmt::format("{:.2f}", seconds));
  std::cout << "read in " << seconds << " s of the processor\n";
#ifndef __SANITIZE_ADDRESS__
  EXPECT_LT(seconds, 2.0);
#endif
}

}  // namespace
}  // namespace dygita::nastran_tests
