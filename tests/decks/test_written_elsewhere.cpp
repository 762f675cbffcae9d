// Meshes of other programs from end to end: every shape of cell under a uniform pressure, by the names of the file.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "decks/engine.hpp"
#include "foreign/abaqus_blocks.hpp"
#include "foreign/abaqus_deck.hpp"
#include "foreign/imported_deck.hpp"
#include "foreign/nastran_blocks.hpp"
#include "foreign/written_file.hpp"

namespace dygita::test::written_elsewhere_tests {
namespace {

const std::string steel =
    "*SOLID SECTION, ELSET=E, MATERIAL=STEEL\n*MATERIAL, NAME=STEEL\n*ELASTIC\n200000., 0.3\n*DENSITY\n8.E-9\n";

// On rollers at x = 0, y = 0 and z = 0, pressed with 100 MPa from above: uniformly, whatever the cells look like.
std::string pressed(const std::string& file) {
  return "local file = mesh.abaqus{ file = \"" + file + R"(", units = "mm t s" }
local block = substructure{ name = "block", mesh = file:part "E", material = file:material "STEEL" }
local x0 = support.held{ name = "x0", on = block:region "X0", x = true }
local y0 = support.held{ name = "y0", on = block:region "Y0", y = true }
local z0 = support.symmetry{ name = "z0", on = block:face "Z0" }
local press = step.static{ name = "press", loads = { load.pressure{ on = block:face "TOP", history = 100*MPa } } }
problem{ name = "block", substructures = { block }, supports = { x0, y0, z0 }, steps = { press },
         outputs = { output.history{ name = "top", on = block:face "TOP", quantity = "displacement" },
                     output.history{ name = "corner", on = block:where(function(x, y, z) return near(x, 30*mm) and near(y, 30*mm) and near(z, 30*mm) end), quantity = "displacement" },
                     output.history{ name = "stress", on = block:face "X0", quantity = "von_mises" } } }:run{}
)";
}

TEST(WrittenElsewhere, cells_of_every_shape_are_uniformly_pressed) {
  for (const AbaqusShape& shape : abaqus_shapes()) {
    SCOPED_TRACE(shape.type);
    const WrittenFile inp(AbaqusBlock(shape, 3).text() + steel, "block.inp");
    const DeckRun run = run_text(pressed(inp.path())).at(0);
    EXPECT_NEAR(run.column("top", "z").back(), -1.5e-5, 1.5e-5 * 1e-7);    // p L / E
    EXPECT_NEAR(run.column("corner", "x").back(), 4.5e-6, 4.5e-6 * 1e-7);  // nu p L / E
    EXPECT_NEAR(run.column("corner", "y").back(), 4.5e-6, 4.5e-6 * 1e-7);
    EXPECT_NEAR(run.column("stress", "von_mises").back(), 100e6, 1e2);
  }
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const size_t at = text.find(what);
  if (at == std::string::npos) throw std::runtime_error("no " + what + " in\n" + text);
  return text.replace(at, what.size(), by);
}

// The frames of the modes and those of the problem are files of one folder.
TEST(WrittenElsewhere, imported_modes_run_whatever_the_file_is_called) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::temp_directory_path() / ("dygita_modes_" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "modes.bdf")
      << "SOL 103\nCEND\nSPC = 1\nMETHOD = 4\nBEGIN BULK\nPSOLID,1,1\nMAT1,1,200000.,,.3,7.8-9\n"
         "GRID,1,,0.,0.,0.\nGRID,2,,10.,0.,0.\nGRID,3,,0.,10.,0.\nGRID,4,,0.,0.,10.\n"
         "CTETRA,1,1,1,2,3,4\nSPC1,1,123,1,2,3\nEIGRL,4,,,2\nENDDATA\n";
  const DeckRun run = run_text(imported_deck({(folder / "modes.bdf").string(), "mm t s", {}})).at(0);
  fs::remove_all(folder);
  EXPECT_EQ(run.column("natural modes", "frequency").size(), 2u);
}

// The same block, pressed by what its file says.
TEST(WrittenElsewhere, imported_decks_press_as_their_file_says) {
  const WrittenFile inp(AbaqusBlock(abaqus_shapes()[1], 2).text() + steel +
                            "*BOUNDARY\nX0, 1\nY0, 2\nZ0, 3\n*STEP\n*STATIC\n*DSLOAD\nTOP, P, 100.\n*END STEP\n",
                        "block.inp");
  const std::string deck =
      replaced(deck_of_abaqus({inp.path(), "mm t s", {}}), "output.vtk{ frames = 1 }",
               "output.history{ name = \"top\", on = part_e:face \"TOP\", quantity = \"displacement\" }");
  const DeckRun run = run_text(deck).at(0);
  EXPECT_NEAR(run.column("top", "z").back(), -1e-5, 1e-5 * 1e-7);       // p L / E
  EXPECT_NEAR(run.column("top", "x").back(), 0.3 * 5e-6, 1e-5 * 1e-4);  // nu p L / 2 E, the mean of the face
}

// The same of Nastran, every shape, with nodes in a cylinder and a turned box and supports in the axes of the latter.
TEST(WrittenElsewhere, cells_of_every_shape_of_nastran_are_uniformly_pressed) {
  for (const NastranShape& shape : nastran_shapes()) {
    SCOPED_TRACE(fmt::format("{} {}", shape.name, shape.shape.edges.size()));
    const WrittenFile bdf(NastranBlock(shape, 3).text(), "block.bdf");
    const std::string part = "part_psolid_1";
    const std::string deck = replaced(
        imported_deck({bdf.path(), "mm t s", {}}), "output.vtk{ frames = 1 }",
        "output.history{ name = \"corner\", on = " + part +
            ":where(function(x, y, z) return near(x, 30*mm) and near(y, 30*mm) and near(z, 30*mm) end), quantity = "
            "\"displacement\" }, output.history{ name = \"stress\", on = " +
            part + ":where(function(x, y, z) return z > 29*mm end), quantity = \"von_mises\" }");
    const DeckRun run = run_text(deck).at(0);
    EXPECT_NEAR(run.column("corner", "z").back(), -1.5e-5, 1.5e-5 * 1e-7);  // p L / E
    EXPECT_NEAR(run.column("corner", "x").back(), 4.5e-6, 4.5e-6 * 1e-7);   // nu p L / E
    EXPECT_NEAR(run.column("corner", "y").back(), 4.5e-6, 4.5e-6 * 1e-7);
    EXPECT_NEAR(run.column("stress", "von_mises").back(), 100e6, 1e2);
  }
}

// A cube of a ply's constants whose axes lie in a cylinder about the z axis: pulled along z, which is axis 3, it gives
// way along x as nu31 of the outward direction says. The element is on the x axis, where outward is x.
TEST(WrittenElsewhere, imported_orthotropic_cells_have_the_axes_of_their_cylinder) {
  const WrittenFile bdf(
      "CORD2C,5,,0.,0.,0.,0.,0.,1.\n,0.,1.,0.\nPSOLID,1,1,5\nMAT11,1,140000.,10000.,9000.,.3,.28,.4,5000.\n,4500.,3000."
      ","
      "1.6-9\nGRID,1,,1000.,-.5,0.\nGRID,2,,1001.,-.5,0.\nGRID,3,,1001.,.5,0.\nGRID,4,,1000.,.5,0.\nGRID,5,,1000.,-.5,"
      "1.\n"
      "GRID,6,,1001.,-.5,1.\nGRID,7,,1001.,.5,1.\nGRID,8,,1000.,.5,1.\nCHEXA,1,1,1,2,3,4,5,6\n,7,8\n"
      "SPC1,1,1,1,4,5,8\nSPC1,1,2,1,2,5,6\nSPC1,1,3,1,THRU,4\nPLOAD4,2,1,-9.,,,,5,7\n",
      "ply.bdf");
  const std::string deck =
      replaced(imported_deck({bdf.path(), "mm t s", {}}), "output.vtk{ frames = 1 }",
               "output.history{ name = \"corner\", on = part_psolid_1:where(function(x, y, z) return "
               "x > 1.0005 and y > 0 and z > 0.5*mm end), quantity = \"displacement\" }");
  const DeckRun run = run_text(deck).at(0);
  EXPECT_NEAR(run.column("corner", "z").back(), 1e-6, 1e-6 * 1e-6);                    // 9 / 9000 mm
  EXPECT_NEAR(run.column("corner", "x").back(), -0.28 / 140 * 9 * 1e-6, 1e-6 * 1e-6);  // nu13 / e1
  EXPECT_NEAR(run.column("corner", "y").back(), -0.4 / 10 * 9 * 1e-6, 1e-6 * 1e-6);    // nu23 / e2
}

// Lengthwise a clamped bar of nu = 0 has sqrt(E / rho) / 4 L = 12.5 kHz.
TEST(WrittenElsewhere, imported_decks_have_the_modes_that_their_file_asks_for) {
  std::string text = "*NODE\n";
  const auto node = [](int i, int j, int k) { return 1 + i + 3 * (j + 3 * k); };
  for (int k = 0; k <= 20; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) text += fmt::format("{}, {}, {}, {}\n", node(i, j, k), 5 * i, 5 * j, 5 * k);
  text += "*ELEMENT, TYPE=C3D20R, ELSET=BAR\n";
  constexpr int at[20][3] = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {0, 0, 2}, {2, 0, 2}, {2, 2, 2},
                             {0, 2, 2}, {1, 0, 0}, {2, 1, 0}, {1, 2, 0}, {0, 1, 0}, {1, 0, 2}, {2, 1, 2},
                             {1, 2, 2}, {0, 1, 2}, {0, 0, 1}, {2, 0, 1}, {2, 2, 1}, {0, 2, 1}};
  for (int k = 0; k < 10; ++k) {
    text += std::to_string(k + 1);
    for (const auto& step : at) text += fmt::format(", {}", node(step[0], step[1], 2 * k + step[2]));
    text += "\n";
  }
  const WrittenFile inp(
      text +
          "*SOLID SECTION, ELSET=BAR, MATERIAL=M\n*MATERIAL, NAME=M\n*ELASTIC\n200000., 0.\n*DENSITY\n8.E-9\n"
          "*NSET, NSET=FOOT, GENERATE\n1, 9\n*BOUNDARY\nFOOT, 1, 3\n*STEP\n*FREQUENCY\n8\n*END STEP\n",
      "bar.inp");
  const DeckRun run = run_text(deck_of_abaqus({inp.path(), "mm t s", {}})).at(0);
  double nearest = 1e9;
  for (const double f : run.column("modes", "frequency")) nearest = std::min(nearest, std::abs(f - 12500.0));
  EXPECT_LT(nearest, 12500 * 1e-4);
  EXPECT_EQ(run.column("modes", "frequency").size(), 8u);
}

TEST(WrittenElsewhere, imported_decks_stop_where_something_is_not_translated) {
  const WrittenFile inp(AbaqusBlock(abaqus_shapes()[0], 1).text() + steel +
                            "*BOUNDARY\nZ0, 1, 3\n*STEP\n*STATIC\n*TEMPERATURE\nALL, 300.\n*END STEP\n",
                        "hot.inp");
  const std::string deck = deck_of_abaqus({inp.path(), "mm t s", {}});
  EXPECT_THROW(run_text(deck), InputError);
  const size_t stop = deck.find("error(");
  EXPECT_EQ(run_text(deck.substr(0, stop) + deck.substr(deck.find('\n', stop))).size(), 1u);
}

// Two frequencies (Hz) of a rigid body on springs below: its sway and its rocking. stiffness: of all springs, aside and
// upright (N/m), a: their arm; mass, its first and second moment (kg, kg m, kg m^2) about the plane of the springs.
std::array<double, 2> sway_and_rocking(double aside, double upright, double a, const Vec3& mass) {
  Eigen::Matrix2d k, m;
  k << aside, 0, 0, upright * a * a;
  m << mass[0], -mass[1], -mass[1], mass[2];
  const Eigen::Vector2d squares = Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d>(k, m).eigenvalues();
  return {std::sqrt(squares[0]) / (2 * std::numbers::pi), std::sqrt(squares[1]) / (2 * std::numbers::pi)};
}

// A block of 40 x 40 x 10 mm on four CBUSH at its corners, a mass 35 mm above it on an RBE2 or an RBE3: nodes in a
// turned frame, names of HyperMesh, stiffness along the axes of that frame, the mass off its node.
TEST(WrittenElsewhere, nastran_masses_on_bushings_have_the_frequencies_by_hand) {
  std::string mesh =
      "SOL 103\nCEND\nMETHOD = 4\nBEGIN BULK\n$HMNAME PROP 1\"plate\" 4\n$HMNAME MAT 1\"steel\" \"MAT1\"\n"
      "CORD2R,5,,100.,50.,0.,100.,50.,1.\n,100.,51.,0.\nPSOLID,1,1\nMAT1,1,210000.,,.3,7.85-9\nEIGRL,4,,,6\n";
  const auto node = [](int i, int j, int k) { return std::to_string(1 + i + 3 * j + 9 * k); };
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) mesh += fmt::format("GRID,{},5,{}.,{}.,{}.\n", node(i, j, k), 20 * i, 20 * j, 10 * k);
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i)
      mesh += fmt::format("CHEXA,{},1,{},{},{},{},{},{}\n,{},{}\n", 1 + i + 2 * j, node(i, j, 0), node(i + 1, j, 0),
                          node(i + 1, j + 1, 0), node(i, j + 1, 0), node(i, j, 1), node(i + 1, j, 1),
                          node(i + 1, j + 1, 1), node(i, j + 1, 1));
  mesh += "PBUSH,7,K,500.,600.,1000.\n";
  for (const auto& [i, j] : {std::pair(0, 0), {2, 0}, {0, 2}, {2, 2}})
    mesh += fmt::format("CBUSH,{},7,{},,,,,5\n", 20 + i + 3 * j, node(i, j, 0));
  mesh += "GRID,50,5,20.,20.,40.\nCONM2,51,50,,2.-3,0.,0.,5.\n,2.,,3.,,,4.\n";
  std::string top;
  for (int i = 10; i <= 18; ++i) top += fmt::format(",{}{}", i, i == 13 || i == 16 ? "\n" : "");
  // kg, m: the block's own moments about its middle, and those of the mass.
  const double block = 7.85e3 * 16e-6, mass = 2.0, along = block * (40 * 40 + 10 * 10) * 1e-6 / 12;
  const auto moments = [&](double own) {
    return Vec3(block + mass, block * 5e-3 + mass * 45e-3, block * 25e-6 + along + mass * 2025e-6 + own);
  };
  // System 5 has its axes along y, -x and z.
  const auto [y_low, y_high] = sway_and_rocking(4 * 500e3, 4 * 1000e3, 20e-3, moments(2e-3));
  const auto [x_low, x_high] = sway_and_rocking(4 * 600e3, 4 * 1000e3, 20e-3, moments(3e-3));
  const double twist = std::sqrt(4 * (500e3 + 600e3) * 400e-6 / (4e-3 + block * 3200e-6 / 12)) / (2 * std::numbers::pi);
  std::vector<double> expected = {y_low,  y_high, x_low,
                                  x_high, twist,  std::sqrt(4 * 1000e3 / (block + mass)) / (2 * std::numbers::pi)};
  std::sort(expected.begin(), expected.end());
  for (const std::string& spider :
       {"RBE2,60,50,123456" + top, std::string("RBE3,60,,50,123456,1.,123,10,11\n,12,13,14,15,16,17,18")}) {
    SCOPED_TRACE(spider);
    const WrittenFile bdf(mesh + spider + "\nENDDATA\n", "plate.bdf");
    const DeckRun run = run_text(imported_deck({bdf.path(), "mm t s", {}})).at(0);
    const std::vector<double>& found = run.column("modes", "frequency");
    ASSERT_EQ(found.size(), expected.size());
    for (size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 5e-3 * expected[i]) << i;
  }
}

// A bar of 100 x 10 x 10 mm, clamped at x = 0, without lateral contraction, so that rectangular cells are exact under
// axial force and moment. Its end is the surface END and the set TIP; 901 and 902 are nodes of no cell.
std::string clamped_bar(const std::string& rest, const Vec3& reference) {
  std::string text = "*NODE\n";
  const auto node = [](int i, int j, int k) { return 1 + i + 11 * (j + 3 * k); };
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 11; ++i) text += fmt::format("{},{}.,{}.,{}.\n", node(i, j, k), 10 * i, 5 * j, 5 * k);
  text += fmt::format("901,{},{},{}\n902,{},{},{}\n", reference[0], reference[1], reference[2], 0.0, 0.0, 0.0);
  text += "*ELEMENT, TYPE=C3D8I, ELSET=E\n";
  std::string tip = "*ELSET, ELSET=TIPS\n", low = "*NSET, NSET=ROOT\n", high = "*NSET, NSET=TIP\n";
  for (int k = 0; k < 2; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 10; ++i)
        text += fmt::format("{},{},{},{},{},{},{},{},{}\n", 1 + i + 10 * (j + 2 * k), node(i, j, k), node(i + 1, j, k),
                            node(i + 1, j + 1, k), node(i, j + 1, k), node(i, j, k + 1), node(i + 1, j, k + 1),
                            node(i + 1, j + 1, k + 1), node(i, j + 1, k + 1));
  for (int j = 0; j < 4; ++j) tip += fmt::format("{}\n", 10 * (j + 1));
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 3; ++j) {
      low += fmt::format("{}\n", node(0, j, k));
      high += fmt::format("{}\n", node(10, j, k));
    }
  return text + tip + low + high +
         "*SURFACE, NAME=END\nTIPS, S4\n*SOLID SECTION, ELSET=E, MATERIAL=M\n*MATERIAL, NAME=M\n*ELASTIC\n200000., 0.\n"
         "*DENSITY\n8.E-9\n*BOUNDARY\nROOT, 1, 3\n" +
         rest;
}

DeckRun run_bar(const std::string& rest, const Vec3& reference) {
  const WrittenFile inp(clamped_bar(rest, reference), "bar.inp");
  std::string deck = deck_of_abaqus({inp.path(), "mm t s", {}});
  const std::string frames = "output.vtk{ frames = 1 }";
  if (deck.find(frames) != std::string::npos)
    deck = replaced(deck, frames,
                    "output.history{ name = \"end\", on = part_e:face \"END\", quantity = \"displacement\" }");
  return run_text(deck).at(0);
}

const std::string rigid = "*RIGID BODY, NSET=TIP, REF NODE=901, ROT NODE=902\n",
                  coupled = "*COUPLING, REF NODE=901, SURFACE=END, CONSTRAINT NAME=C\n*KINEMATIC\n1, 3\n",
                  spread = "*COUPLING, REF NODE=901, SURFACE=END, CONSTRAINT NAME=C\n*DISTRIBUTING\n1, 3\n";
constexpr double young = 2e11, area = 1e-4, bending = 1e-8 / 12, length = 0.1;  // SI; the second moment of area

// 40 N along the bar at (110, 3, 12) mm, 7 mm above and 2 mm beside its middle, and 100 N mm about y.
TEST(WrittenElsewhere, imported_rigid_ends_are_loaded_at_their_reference_node) {
  for (const std::string& end : {rigid, coupled}) {
    SCOPED_TRACE(end);
    const std::string about_y = end == rigid ? "902, 2, 100.\n" : "901, 5, 100.\n";
    const DeckRun run =
        run_bar(end + "*STEP\n*STATIC\n*CLOAD\n901, 1, 40.\n" + about_y + "*END STEP\n", {110.0, 3.0, 12.0});
    const double arm = length * length / (2 * young * bending), moment_y = 40 * 7e-3 + 0.1, moment_z = 40 * 2e-3;
    EXPECT_NEAR(run.column("end", "x").back(), 40 * length / (young * area), 1e-5 * 2e-7);
    EXPECT_NEAR(run.column("end", "z").back(), -moment_y * arm, 1e-5 * moment_y * arm);
    EXPECT_NEAR(run.column("end", "y").back(), moment_z * arm, 1e-5 * moment_y * arm);
  }
}

// The reference node, 20 mm above the middle, is held along the bar: a moment bends it against an axial force.
TEST(WrittenElsewhere, imported_rigid_ends_are_held_at_their_reference_node) {
  for (const std::string& end : {rigid, coupled}) {
    SCOPED_TRACE(end);
    const std::string about_y = end == rigid ? "902, 2, 100.\n" : "901, 5, 100.\n";
    const DeckRun run =
        run_bar(end + "*STEP\n*STATIC\n*BOUNDARY\n901, 1\n*CLOAD\n" + about_y + "*END STEP\n", {130.0, 5.0, 25.0});
    const double h = 20e-3, moment = 0.1, force = -h * moment / (bending / area + h * h);
    EXPECT_NEAR(run.column("end", "x").back(), force * length / (young * area),
                -1e-4 * force * length / (young * area));
    const double w = -(moment + force * h) * length * length / (2 * young * bending);
    EXPECT_NEAR(run.column("end", "z").back(), w, -1e-4 * w);
  }
  const DeckRun moved =
      run_bar(coupled + "*STEP\n*STATIC\n*BOUNDARY\n901, 1, 1, 0.02\n901, 2, 6\n*END STEP\n", {110.0, 3.0, 12.0});
  EXPECT_NEAR(moved.column("end", "x").back(), 2e-5, 1e-12);
  EXPECT_NEAR(moved.column("end", "z").back(), 0.0, 1e-12);
}

TEST(WrittenElsewhere, imported_forces_are_spread_over_the_surface_of_their_reference_node) {
  const DeckRun run = run_bar(spread + "*STEP\n*STATIC\n*CLOAD\n901, 1, 40.\n*END STEP\n", {100.0, 5.0, 5.0});
  EXPECT_NEAR(run.column("end", "x").back(), 40 * length / (young * area), 1e-6 * 2e-7);
}

// A mass of 25 times the bar's, on its end: along the bar it swings on k = E A / L with a third of the bar.
TEST(WrittenElsewhere, imported_masses_swing_on_what_their_reference_node_joins) {
  const std::string mass = "*ELEMENT, TYPE=MASS, ELSET=M\n990, 901\n*MASS, ELSET=M\n2.E-3\n";
  for (const std::string& end : {rigid, coupled, spread}) {
    SCOPED_TRACE(end);
    const DeckRun run = run_bar(end + mass + "*STEP\n*FREQUENCY\n6\n*END STEP\n", {100.0, 5.0, 5.0});
    const double expected = std::sqrt(young * area / length / (2.0 + 0.08 / 3)) / (2 * std::numbers::pi);
    double off = expected;
    for (const double found : run.column("modes", "frequency")) off = std::min(off, std::abs(found - expected));
    EXPECT_LT(off, 1e-3 * expected);
  }
}

// A block of 8e-9 x 20^3 t on a dashpot alone, pushed with 2 N from rest: x = F/c (t - m/c (1 - exp(-c t / m))).
TEST(WrittenElsewhere, imported_dashpots_brake_by_the_velocity_of_their_ends) {
  const AbaqusBlock block(abaqus_shapes()[0], 2);
  std::string low = "*EQUATION\n10\n902,1,9.", all = "*NSET, NSET=EVERY\n";
  int n_low = 0;
  for (const auto& [node, x] : block.places()) {
    all += std::to_string(node) + "\n";
    if (x[0] < 0.1 && ++n_low > 0) low += fmt::format("{}{},1,-1.", n_low % 4 == 0 ? ",\n" : ",", node);
  }
  ASSERT_EQ(n_low, 9);
  const WrittenFile inp(
      block.text() + steel + all +
          "*NODE\n901,-9.,0.,0.\n902,-1.,0.,0.\n*ELEMENT, TYPE=DASHPOTA, ELSET=D\n900,901,902\n"
          "*BOUNDARY\n901,1,3\n902,2,3\nEVERY,2,3\n*DASHPOT, ELSET=D\n\n0.5\n" +
          low + "\n*STEP\n*DYNAMIC, DIRECT\n1.E-6,2.E-4\n*DLOAD\nE, GRAV, 31250000., 1., 0., 0.\n*END STEP\n",
      "brake.inp");
  const DeckRun run = run_text(replaced(deck_of_abaqus({inp.path(), "mm t s", {}}), "output.vtk{ frames = 1 }",
                                        "output.history{ name = \"low\", on = part_e:region \"X0\", quantity = "
                                        "\"displacement\" }"))
                          .at(0);
  const double mass = 0.064, force = mass * 31250, c = 500.0, t = 2e-4, rate = c / mass;
  const double expected = force / c * (t - (1 - std::exp(-rate * t)) / rate);
  EXPECT_NEAR(run.column("low", "x").back(), expected, 1e-4 * expected);
}

// Two bars end to end, drawn 2 um apart and said to be 1 um apart: moved by 4 um they are pressed by the rest.
TEST(WrittenElsewhere, imported_clearances_take_the_place_of_the_gap_that_is_drawn) {
  const auto end_of = [](const std::string& clearance) {
    const WrittenFile inp(
        "*NODE\n1,0,0,0\n2,10,0,0\n3,10,10,0\n4,0,10,0\n5,0,0,10\n6,10,0,10\n7,10,10,10\n8,0,10,10\n"
        "11,0,0,10.002\n12,10,0,10.002\n13,10,10,10.002\n14,0,10,10.002\n15,0,0,20.002\n16,10,0,20.002\n17,10,10,20."
        "002\n"
        "18,0,10,20.002\n*ELEMENT, TYPE=C3D8I, ELSET=LOW\n1,1,2,3,4,5,6,7,8\n*ELEMENT, TYPE=C3D8I, ELSET=HIGH\n"
        "2,11,12,13,14,15,16,17,18\n*NSET, NSET=FOOT\n1,2,3,4\n*NSET, NSET=HEAD\n15,16,17,18\n*NSET, "
        "NSET=ALL\n1,2,3,4,5,"
        "6,7,8,11,12,13,14,15,16,17,18\n*SURFACE, NAME=UP\nLOW, S2\n*SURFACE, NAME=DOWN\nHIGH, S1\n*SOLID SECTION, "
        "ELSET=LOW, MATERIAL=M\n*SOLID SECTION, ELSET=HIGH, MATERIAL=M\n*MATERIAL, NAME=M\n*ELASTIC\n200000., 0.\n"
        "*BOUNDARY\nALL, 1, 2\nFOOT, 3\n*SURFACE INTERACTION, NAME=I\n*CONTACT PAIR, INTERACTION=I\nDOWN, UP\n" +
            clearance + "*STEP\n*STATIC\n*BOUNDARY\nHEAD, 3, 3, -0.004\n*END STEP\n",
        "apart.inp");
    const DeckRun run = run_text(replaced(deck_of_abaqus({inp.path(), "mm t s", {}}), "output.vtk{ frames = 1 }",
                                          "output.history{ name = \"up\", on = part_low:face \"UP\", quantity = "
                                          "\"displacement\" }"))
                            .at(0);
    return run.column("up", "z").back();
  };
  EXPECT_NEAR(end_of(""), -1e-6, 1e-10);
  EXPECT_NEAR(end_of("*CLEARANCE, MASTER=UP, SLAVE=DOWN, VALUE=0.001\n"), -1.5e-6, 1e-10);
  EXPECT_NEAR(end_of("*CLEARANCE, MASTER=UP, SLAVE=DOWN, VALUE=0.\n"), -2e-6, 1e-10);
}

}  // namespace
}  // namespace dygita::test::written_elsewhere_tests
