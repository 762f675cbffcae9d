// An assembly from CAD: meshes/joint.step, two plates and two equal bolts, in millimetres.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <filesystem>
#include <fstream>
#include <set>

#include "base/log.hpp"
#include "intake/step_assembly.hpp"
#include "mesh/cell_quality.hpp"
#include "mesh/expect_input_error.hpp"
#include "mesh/face_nodes.hpp"
#include "mesh/pick_facets.hpp"

namespace dygita {
namespace {

StepOptions joint() {
  StepOptions options;
  options.file = std::string(DYGITA_SOURCE_DIR) + "/meshes/joint.step";
  options.size = 8e-3;
  return options;
}

TEST(StepAssembly, has_every_solid_by_the_names_of_the_file_in_metres) {
  const StepAssembly assembly(joint());
  const double hole = M_PI * 4.5 * 4.5, exact = (80.0 * 40.0 - 2.0 * hole) * 10.0 * 1e-9;
  const StepPart& lower = assembly.part("lower");
  EXPECT_EQ(lower.product, "plate 10 mm");
  EXPECT_EQ(lower.mesh->blocks.at(0).type, CellType::tet4);
  EXPECT_NEAR(volume(*lower.mesh), exact, 2e-3 * exact);
  EXPECT_EQ(assembly.part("plate 8 mm").name, "upper");
  const std::vector<const StepPart*> bolts = assembly.parts("M8*");
  ASSERT_EQ(bolts.size(), 2u);
  EXPECT_EQ(bolts[0]->name, "bolt1");
  EXPECT_EQ(bolts[1]->name, "bolt2");
  EXPECT_EQ(assembly.parts("*").size(), 4u);
  for (const StepPart* part : assembly.parts("*")) {
    check_mesh(*part->mesh, part->name);
    EXPECT_GT(worst_shape(*part->mesh), 0.05) << part->name;
  }
  // Solids share no node: what touches is found as an interface.
  const Points &a = lower.mesh->nodes, &b = assembly.part("upper").mesh->nodes;
  EXPECT_NEAR(a.row(2).maxCoeff(), 0.010, 1e-9);
  EXPECT_NEAR(b.row(2).minCoeff(), 0.010, 1e-9);
}

TEST(StepAssembly, has_curved_cells_whose_volume_is_that_of_the_solids) {
  StepOptions options = joint();
  options.order = 2;
  const StepAssembly assembly(options);
  const double bolt = M_PI * (16.0 * (26.0 - 6.8) + 42.25 * (5.3 + 6.8)) * 1e-9;
  for (const StepPart* part : assembly.parts("bolt*")) {
    EXPECT_EQ(part->mesh->blocks.at(0).type, CellType::tet10);
    EXPECT_NEAR(volume(*part->mesh), bolt, 1e-3 * bolt);
  }
}

// As NX writes them: OpenCASCADE calls the two by labels of its own, "=>[0:1:1:3]".
TEST(StepAssembly, has_names_for_several_solids_of_one_product) {
  std::ifstream joint_file(joint().file);
  std::string text{std::istreambuf_iterator<char>(joint_file), {}};
  const std::string one_solid = "(#11,#45),#543", two_solids = "(#11,#45,#562),#543";
  ASSERT_NE(text.find(one_solid), std::string::npos);
  text.replace(text.find(one_solid), one_solid.size(), two_solids);
  StepOptions options = joint();
  options.size = 50e-3;
  options.order = 1;
  options.file = (std::filesystem::temp_directory_path() / "dygita_two_solids.step").string();
  std::ofstream(options.file) << text;
  const StepAssembly assembly(options);
  std::filesystem::remove(options.file);
  std::vector<std::string> names;
  for (const StepPart* part : assembly.parts("*")) names.push_back(part->name);
  EXPECT_EQ(names, (std::vector<std::string>{"SOLID", "plate 8 mm 2", "upper", "bolt1", "bolt2"}));
}

// One face of the first plate is gone: OpenCASCADE leaves the plate out and says nothing.
TEST(StepAssembly, of_a_spoiled_file_says_that_solids_are_missing) {
  std::ifstream whole(joint().file);
  const auto spoiled = std::filesystem::temp_directory_path() / "dygita_spoiled.step";
  std::ofstream cut(spoiled);
  int n = 0;
  for (std::string line; std::getline(whole, line);)
    if (++n < 200 || n > 230) cut << line << '\n';
  cut.close();
  StepOptions options = joint();
  options.file = spoiled.string();
  take_warnings();
  const StepAssembly assembly(options);
  EXPECT_EQ(assembly.parts("*").size(), 3u);
  const std::vector<std::string> warnings = take_warnings();
  ASSERT_FALSE(warnings.empty());
  EXPECT_NE(warnings.front().find("it holds 4 solids, and 3 could be read: is the file complete?"), std::string::npos)
      << warnings.front();
  std::filesystem::remove(spoiled);
}

TEST(StepAssembly, is_finer_where_the_deck_says_so) {
  StepOptions options = joint();
  const auto n_cells = [](const StepOptions& asked, const char* part) {
    return StepAssembly(asked).part(part).mesh->n_cells();
  };
  const int plain_bolt = n_cells(options, "bolt1"), plain_plate = n_cells(options, "upper");
  options.sizes["M8 bolt"] = 1.5e-3;
  const StepAssembly finer(options);
  EXPECT_GT(finer.part("bolt1").mesh->n_cells(), 3 * plain_bolt / 2);
  EXPECT_NEAR(finer.part("upper").mesh->n_cells(), plain_plate, 0.02 * plain_plate);  // gmsh shakes its points
  options.sizes = {{"contacts", 4e-3}};
  EXPECT_GT(n_cells(options, "upper"), 3 * plain_plate / 2);
  options.sizes.clear();
  options.fine = StepOptions::Fine{2e-3, 0.5};
  EXPECT_GT(n_cells(options, "upper"), 3 * plain_plate / 2);
}

Vec3 centre(const Mesh& mesh, const FaceNodes& face) {
  Vec3 sum = Vec3::Zero();
  for (size_t i = 0; i < face.nodes.size(); ++i)
    sum += face.weights[static_cast<Eigen::Index>(i)] * mesh.nodes.col(face.nodes[i]);
  return sum / face.weights.sum();
}

// A plate with round corners that gmsh does not manage with eight millimetres, and a ring a millimetre wide, across
// whose hole it then lays cells.
TEST(StepAssembly, has_tetrahedra_where_hexahedra_fail_or_do_not_fill_the_solid) {
  StepOptions options;
  options.file = std::string(DYGITA_SOURCE_DIR) + "/tests/intake/ring_on_plate.step";
  options.sweep = StepOptions::Sweep::where_possible;
  options.size = 8e-3;
  options.cells_a_turn = 12;
  const double plate = (60 * 40 - (4 - M_PI) * 25) * 5 * 1e-9, ring = M_PI * (19.9 * 19.9 - 18.9 * 18.9) * 4 * 1e-9;
  take_warnings();
  const StepAssembly coarse(options);
  EXPECT_EQ(take_warnings().size(), 2u);
  options.size = 2e-3;
  const StepAssembly fine(options);
  for (const auto& [assembly, type] : {std::pair{&coarse, CellType::tet4}, {&fine, CellType::hex8}}) {
    ASSERT_EQ(assembly->parts().size(), 2u);
    EXPECT_EQ(assembly->parts()[0].mesh->blocks.at(0).type, type);
    EXPECT_EQ(assembly->parts()[1].mesh->blocks.at(0).type, type);
    EXPECT_NEAR(volume(*assembly->parts()[0].mesh), plate, 0.01 * plate);
    EXPECT_NEAR(volume(*assembly->parts()[1].mesh), ring, 0.1 * ring);
  }
  options.size = 8e-3;
  options.sweep = StepOptions::Sweep::all;
  expect_input_error([&] { StepAssembly{options}; }, {"cannot have hexahedra of this size", "smaller size"});
}

// The plate's failure is the plate's alone.
TEST(StepAssembly, has_hexahedra_beside_a_part_for_which_they_fail) {
  StepOptions options;
  options.file = std::string(DYGITA_SOURCE_DIR) + "/tests/intake/ring_on_plate.step";
  const std::string ring = StepAssembly(options).parts()[1].name;
  options.sweep = StepOptions::Sweep::where_possible;
  options.size = 8e-3;
  options.sizes[ring] = 2e-3;
  take_warnings();
  const StepAssembly assembly(options);
  EXPECT_EQ(take_warnings().size(), 1u);
  EXPECT_EQ(assembly.parts()[0].mesh->blocks.at(0).type, CellType::tet4);
  EXPECT_EQ(assembly.parts()[1].mesh->blocks.at(0).type, CellType::hex8);
}

// Faces of neighbours lie on those of the extruded parts: gmsh would extrude them, too, and give up.
TEST(StepAssembly, has_hexahedra_in_all_extruded_parts_of_a_unit_whose_parts_touch) {
  StepOptions options;
  options.file = std::string(DYGITA_SOURCE_DIR) + "/meshes/instrument_unit.step";
  options.sweep = StepOptions::Sweep::where_possible;
  options.size = 12e-3;
  options.sizes = {{"PANEL", 18e-3}, {"STANDOFF*", 6e-3}, {"SCREW*", 4e-3}, {"INSERT*", 8e-3}, {"BOARD*", 10e-3}};
  options.cells_a_turn = 6;
  take_warnings();
  const StepAssembly assembly(options);
  for (const std::string& warning : take_warnings())
    EXPECT_EQ(warning.find("has tetrahedra"), std::string::npos) << warning;
  std::set<std::string> of_tetrahedra;
  for (const auto& part : assembly.parts())
    if (part.mesh->blocks.at(0).type == CellType::tet4) of_tetrahedra.insert(part.name.substr(0, part.name.find(' ')));
  EXPECT_EQ(of_tetrahedra, (std::set<std::string>{"pedestal", "housing", "screw"}));
}

// Surfaces keep their order: surface7 is the same face, whatever the cells.
TEST(StepAssembly, has_hexahedra_where_solids_are_a_face_moved_along_its_normal) {
  StepOptions options = joint();
  options.size = 4e-3;
  const StepAssembly tetrahedra(options);
  options.sweep = StepOptions::Sweep::where_possible;
  for (const int order : {1, 2}) {
    options.order = order;
    const StepAssembly assembly(options);
    for (const char* name : {"lower", "upper"}) {
      const Mesh &swept = *assembly.part(name).mesh, &other = *tetrahedra.part(name).mesh;
      ASSERT_EQ(swept.blocks.size(), 1u);
      EXPECT_EQ(swept.blocks[0].type, order == 1 ? CellType::hex8 : CellType::hex20);
      check_mesh(swept, name);
      EXPECT_GT(worst_shape(swept), 0.2);
      EXPECT_NEAR(volume(swept), volume(other), 2e-3 * volume(other));
      ASSERT_EQ(swept.faces.size(), other.faces.size());
      for (const auto& [face, facets] : other.faces) {
        const FaceNodes exact = face_nodes(other, facets), found = face_nodes(swept, swept.faces.at(face));
        const double area = exact.weights.sum();
        EXPECT_NEAR(found.weights.sum(), area, 0.01 * area) << name << '.' << face;
        EXPECT_LT((centre(swept, found) - centre(other, exact)).norm(), 2e-4) << name << '.' << face;
        EXPECT_LT((found.vectors.rowwise().sum() - exact.vectors.rowwise().sum()).norm(), 2e-3 * area);
      }
    }
    EXPECT_EQ(assembly.part("bolt1").mesh->blocks.at(0).type, order == 1 ? CellType::tet4 : CellType::tet10);
  }
}

TEST(StepAssembly, refuses_hexahedra_in_a_solid_of_several_thicknesses) {
  StepOptions options = joint();
  options.sweep = StepOptions::Sweep::all;
  expect_input_error([&] { StepAssembly{options}; },
                     {"part 'bolt1' cannot have hexahedra", "not an extruded flat face", "where possible"});
}

StepOptions brackets() {
  StepOptions options;
  options.file = std::string(DYGITA_SOURCE_DIR) + "/meshes/brackets.step";
  options.size = 5e-3;
  return options;
}

// Of a vertex of the file: at (0, 0, 28), (40, 20, 0) and (4, 16, 28) mm of the bracket as it was drawn.
double distance_to_nearest(const Mesh& mesh, const Vec3& place) {
  return (mesh.nodes.colwise() - place).colwise().norm().minCoeff();
}

TEST(StepAssembly, meshes_a_solid_once_that_stands_in_several_places_at_any_angle) {
  const StepAssembly assembly(brackets());
  const StepPart &first = assembly.part("first"), &turned = assembly.part("turned"),
                 &quarter = assembly.part("quarter");
  EXPECT_EQ(first.copy_of, "");
  EXPECT_EQ(turned.copy_of, "first");
  EXPECT_EQ(quarter.copy_of, "first");
  const Mat3 turn = Eigen::AngleAxisd(40.0 * M_PI / 180.0, Vec3(1.0, 2.0, 2.0).normalized()).toRotationMatrix();
  const Vec3 shift(0.010, 0.060, -0.015);
  EXPECT_LT((turned.mesh->turn - turn).norm(), 1e-9);
  EXPECT_LT((turned.mesh->shift - shift).norm(), 1e-10);
  EXPECT_EQ(turned.mesh->shape_digest(), first.mesh->shape_digest());
  EXPECT_NE(turned.mesh->digest, first.mesh->digest);
  EXPECT_EQ(turned.mesh->n_cells(), first.mesh->n_cells());
  EXPECT_LT((turned.mesh->nodes - ((turn * first.mesh->nodes).colwise() + shift)).cwiseAbs().maxCoeff(), 1e-10);
  for (const Vec3& corner : {Vec3(0.0, 0.0, 0.028), Vec3(0.040, 0.020, 0.0), Vec3(0.004, 0.016, 0.028)}) {
    EXPECT_LT(distance_to_nearest(*first.mesh, corner), 1e-9);
    EXPECT_LT(distance_to_nearest(*turned.mesh, turn * corner + shift), 1e-9);
    EXPECT_LT(distance_to_nearest(*quarter.mesh, Vec3(-0.030 - corner[1], corner[0], corner[2])), 1e-9);
  }
  check_mesh(*turned.mesh, "turned");
  ASSERT_EQ(turned.mesh->faces.size(), first.mesh->faces.size());
  const FaceNodes one = face_nodes(*first.mesh, first.mesh->faces.at("surface1")),
                  other = face_nodes(*turned.mesh, turned.mesh->faces.at("surface1"));
  EXPECT_EQ(one.nodes, other.nodes);
  EXPECT_LT((turn * one.normals - other.normals).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(StepAssembly, takes_no_mirror_image_and_no_other_hole_for_a_copy) {
  const StepAssembly assembly(brackets());
  EXPECT_EQ(assembly.part("mirrored").copy_of, "");
  EXPECT_EQ(assembly.part("wider").copy_of, "");
}

TEST(StepAssembly, meshes_copies_by_themselves_where_the_deck_wants_other_cells_there) {
  StepOptions options = brackets();
  options.sizes = {{"turned", 3e-3}};
  const StepAssembly assembly(options);
  EXPECT_EQ(assembly.part("turned").copy_of, "");
  EXPECT_GT(assembly.part("turned").mesh->n_cells(), 1.5 * assembly.part("first").mesh->n_cells());
  EXPECT_EQ(assembly.part("quarter").copy_of, "first");
}

// The bolts touch both plates on faces that correspond.
TEST(StepAssembly, meshes_copies_once_where_their_contacts_correspond) {
  StepOptions options = joint();
  options.sizes = {{"contacts", 2e-3}};
  EXPECT_EQ(StepAssembly(options).part("bolt2").copy_of, "bolt1");
  options.sweep = StepOptions::Sweep::where_possible;
  EXPECT_EQ(StepAssembly(options).part("bolt2").copy_of, "bolt1");
}

// A mirrored solid has splines for its flat faces.
TEST(StepAssembly, finds_contacts_of_flat_faces_that_the_file_calls_splines) {
  StepOptions options;
  options.file = std::string(DYGITA_SOURCE_DIR) + "/meshes/mirrored.step";
  options.size = 8e-3;
  const auto cells = [&](const char* part) { return StepAssembly(options).part(part).mesh->n_cells(); };
  const int plate = cells("plate"), bracket = cells("mirrored");
  options.sizes = {{"contacts", 2e-3}};
  EXPECT_GT(cells("plate"), 1.3 * plate);
  EXPECT_GT(cells("mirrored"), 1.3 * bracket);
}

TEST(StepAssembly, meshes_those_alone_that_are_asked_for) {
  StepOptions options = joint();
  options.parts = {"lower", "bolt*"};
  const StepAssembly assembly(options);
  ASSERT_EQ(assembly.parts().size(), 3u);
  const StepAssembly all(joint());
  EXPECT_EQ(assembly.part("lower").mesh->n_cells(), all.part("lower").mesh->n_cells());
  expect_input_error([&] { assembly.part("upper"); }, {"no part 'upper'"});
  options.parts = {"lowr"};
  expect_input_error([&] { StepAssembly{options}; }, {"'parts' names 'lowr'", "lower"});
}

TEST(StepAssembly, refuses_names_that_are_not_there_or_not_one_part_s) {
  const StepAssembly assembly(joint());
  expect_input_error([&] { assembly.part("loewr"); }, {"joint.step", "no part 'loewr'", "lower"});
  expect_input_error([&] { assembly.part("M8 bolt"); }, {"2 parts 'M8 bolt'", "'bolt1' to 'bolt2'", "assembly:parts"});
  expect_input_error([&] { assembly.parts("nut*"); }, {"has no part that matches 'nut*'"});
  StepOptions options = joint();
  options.sizes["M6 bolt"] = 1e-3;
  expect_input_error([&] { StepAssembly{options}; }, {"'sizes' names 'M6 bolt'", "M8 bolt"});
  options.file = std::string(DYGITA_SOURCE_DIR) + "/meshes/bar.geo";
  options.sizes.clear();
  expect_input_error([&] { StepAssembly{options}; }, {"bar.geo", "mesh.step takes .step"});
}

TEST(Patterns, stand_for_any_text_where_they_have_a_star) {
  EXPECT_TRUE(fits_pattern("bolt12", "bolt*"));
  EXPECT_TRUE(fits_pattern("bolt12", "*12"));
  EXPECT_TRUE(fits_pattern("bolt12", "b*l*2"));
  EXPECT_TRUE(fits_pattern("bolt", "bolt*"));
  EXPECT_FALSE(fits_pattern("bolt", "bolt?"));
  EXPECT_FALSE(fits_pattern("a bolt", "bolt*"));
}

double area_of(const Mesh& mesh, const std::vector<Facet>& facets) {
  return facets.empty() ? 0.0 : face_nodes(mesh, facets).weights.sum();
}

TEST(PickedFacets, are_those_of_a_normal_a_plane_a_cylinder_or_a_box) {
  StepOptions options = joint();
  options.order = 2;
  const StepAssembly assembly(options);
  const Mesh &bolt = *assembly.part("bolt1").mesh, &plate = *assembly.part("lower").mesh;
  FacetPick seat;
  seat.normal = -Vec3::UnitZ();
  seat.at = -0.018;  // along the normal
  const double ring = M_PI * (42.25 - 16.0) * 1e-6;
  EXPECT_NEAR(area_of(bolt, pick_facets(bolt, Vec3::Zero(), seat)), ring, 2e-3 * ring);
  // At its place: moved by a metre.
  seat.at = -1.018;
  EXPECT_NEAR(area_of(bolt, pick_facets(bolt, Vec3::UnitZ(), seat)), ring, 2e-3 * ring);
  FacetPick shank;
  shank.is_cylinder = true;
  shank.radius = 4e-3;
  const double around = 2.0 * M_PI * 4.0 * (26.0 - 6.8) * 1e-6;
  EXPECT_NEAR(area_of(bolt, pick_facets(bolt, Vec3::Zero(), shank)), around, 2e-3 * around);
  shank.axis = Vec3::UnitX();
  EXPECT_TRUE(pick_facets(bolt, Vec3::Zero(), shank).empty());
  FacetPick hole;
  hole.is_cylinder = true;
  hole.axis = Vec3::UnitZ();
  const double holes = 2.0 * 2.0 * M_PI * 4.5 * 10.0 * 1e-6;
  EXPECT_NEAR(area_of(plate, pick_facets(plate, Vec3::Zero(), hole)), holes, 2e-3 * holes);
  hole.box = {Vec3(0.0, -0.02, 0.0), Vec3(0.04, 0.02, 0.01)};
  EXPECT_NEAR(area_of(plate, pick_facets(plate, Vec3::Zero(), hole)), 0.5 * holes, 2e-3 * holes);
  FacetPick left;
  left.where = [](const Vec3& x) { return x[0] < -0.0399; };
  EXPECT_NEAR(area_of(plate, pick_facets(plate, Vec3::Zero(), left)), 4e-4, 1e-9);
}

}  // namespace
}  // namespace dygita
