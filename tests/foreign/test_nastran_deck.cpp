// The deck that says what a Nastran file says, and what it leaves to its reader.
#include <gtest/gtest.h>

#include "foreign/imported_deck.hpp"
#include "foreign/nastran_blocks.hpp"
#include "foreign/written_file.hpp"
#include "mesh/expect_input_error.hpp"

namespace dygita::nastran_deck_tests {
namespace {

void expect_in(const std::string& text, const std::string& what) {
  EXPECT_NE(text.find(what), std::string::npos) << "no\n" << what << "\nin\n" << text;
}

// Two cubes of 10 on each other, welded by nodes 5 to 8; nodes 20 and 21 in the middle above and below.
const std::string stack =
    "$HMNAME PROP 1\"low\" 5\n$HMNAME PROP 2\"high\" 5\n$HMNAME MAT 1\"steel\" \"MAT1\"\nPSOLID,1,1\nPSOLID,2,1\n"
    "MAT1,1,210000.,,.3,7.85-9\nGRID,1,,0.,0.,0.\nGRID,2,,10.,0.,0.\nGRID,3,,10.,10.,0.\nGRID,4,,0.,10.,0.\n"
    "GRID,5,,0.,0.,10.\nGRID,6,,10.,0.,10.\nGRID,7,,10.,10.,10.\nGRID,8,,0.,10.,10.\nGRID,9,,0.,0.,20.\n"
    "GRID,10,,10.,0.,20.\nGRID,11,,10.,10.,20.\nGRID,12,,0.,10.,20.\nGRID,20,,5.,5.,30.\nGRID,21,,5.,5.,-10.\n"
    "GRID,22,,5.,5.,20.\nCHEXA,1,1,1,2,3,4,5,6\n,7,8\nCHEXA,2,2,5,6,7,8,9,10\n,11,12\n";  // 25 lines

std::string imported(const std::string& control, const std::string& bulk, const std::string& material = "") {
  std::string all = stack;
  if (!material.empty()) all.replace(all.find("MAT1,1,210000.,,.3,7.85-9"), 25, material);
  const WrittenFile written(control.empty() ? all + bulk : control + "BEGIN BULK\n" + all + bulk, "stack.bdf");
  return imported_deck({written.path(), "mm t s", {}});
}

TEST(NastranDeck, has_a_problem_for_each_subcase_by_the_names_and_lines_of_the_file) {
  const std::string deck =
      imported("SOL 101\nCEND\nSPC = 1\nSUBCASE 1\nLOAD = 10\nSUBCASE 2\nLOAD = 12\n",
               "SPC1,1,123,1,THRU,4\nFORCE,10,9,,2.,0.,0.,-3.\nFORCE,10,10,,2.,0.,0.,-3.\nFORCE,11,9,,1.,1.,0.,0.\n"
               "LOAD,12,2.,3.,11,1.,10\nGRAV,11,,9810.,0.,0.,-1.\nPLOAD4,10,2,3.,,,,9,11\n");
  expect_in(deck, "local file = mesh.nastran{ file = ");
  expect_in(deck,
            "local part_low = substructure{ name = \"low\", mesh = file:part \"low\", material = material_steel }");
  expect_in(deck, "interface.bonded{ name = \"weld_1_2\", between = { part_low, part_high } }  -- they share 4 nodes");
  expect_in(deck, "support.fixed{ name = \"support_spc1_34\", on = { part_low:region \"spc1 34\" } }  -- ");
  expect_in(deck, "load.force{ on = { part_high:region \"force 35\" }, z = -12*force }");  // both nodes: their sum
  expect_in(deck, "load.pressure{ on = { part_high:face \"pload4 40\" }, history = 3*pressure }");
  expect_in(deck, "stack subcase 1\", substructures = { part_low, part_high }, interfaces = { weld_1_2 }");
  // 2 (3 F11 + F10): node 9 has 6 along x and -12 along z, node 10 -12 along z, all 6 x 9810 downward.
  expect_in(deck, "x = 6*force, z = -12*force }");
  expect_in(deck, ", z = -12*force }");
  expect_in(deck, "load.gravity{ z = -58860*acceleration }");
  expect_in(deck, "history = 6*pressure }");
  EXPECT_EQ(deck.find("NOT TRANSLATED"), std::string::npos) << deck;
}

TEST(NastranDeck, sums_what_several_cards_say_of_one_face) {
  const std::string press = "PLOAD4,10,2,5.,,,,9,11\n", held = "SPC1,1,123,1,2,3,4\n";
  expect_in(imported("", held + press + press), "history = 10*pressure }");
  expect_in(imported("", held + press + "PLOAD4,10,2,-3.,,,,9,11\n"), "history = 2*pressure }");
  const std::string both = imported("", held + press + "PLOAD4,10,2,4.,,,,9,11\n,0,1.,0.,0.\n");
  expect_in(both, "history = 5*pressure }");
  expect_in(both, "x = 4*pressure");
  expect_in(imported("SOL 101\nCEND\nSPC = 1\nLOAD = 12\n",
                     held + press + "PLOAD4,11,2,5.,,,,9,11\nLOAD,12,1.,1.,10,1.,11\n"),
            "history = 10*pressure }");
  const std::string summed = "SOL 101\nCEND\nSPC = 1\nLOAD = 12\n";
  expect_in(imported(summed, held + press + "LOAD,12,1.,1.,10,1.,77\n"),
            "LOAD 12 sums load 77, which the file does not have");
  expect_in(imported(summed, held + press + "LOAD,12,1.,1.,10\nLOAD,12,1.,1.,10\n"),
            "LOAD 12 and another load have the same number");
}

TEST(NastranDeck, holds_nodes_in_the_axes_of_the_file) {
  // Axes 1, 2, 3 of system 5 are y, z, x; those of system 6 are turned by 45 degrees about z.
  const std::string deck = imported(
      "",
      "CORD2R,5,,0.,0.,0.,1.,0.,0.\n,0.,1.,0.\nGRID,30,,0.,0.,40.,5\nGRID,31,,1.,0.,40.,5\nGRID,32,,0.,1.,40.,5,1\n"
      "GRID,33,,0.,0.,41.,5\nCTETRA,30,1,30,31,32,33\nSPC,1,30,12,0.,31,3,.5\nGRAV,1,,9810.,0.,0.,-1.\n");
  expect_in(deck, "on = { part_low_2_:region \"spc 33\" }, y = true, z = true }");
  expect_in(deck, "load.displacement{ on = { part_low_2_:region \"spc 33 (2)\" }, x = 0.5*length }");
  expect_in(deck, "on = { part_low_2_:region \"grid 30\" }, y = true }");  // its permanent support
  expect_in(imported("",
                     "CORD2R,6,,0.,0.,0.,0.,0.,1.\n,1.,1.,0.\nGRID,30,,0.,0.,40.,6\nGRID,31,,1.,0.,40.\n"
                     "GRID,32,,0.,1.,40.\nGRID,33,,0.,0.,41.\nCTETRA,30,1,30,31,32,33\nSPC1,1,1,30\n"),
            "node 30 is held in system 6, whose axes are none of the file's");
}

TEST(NastranDeck, passes_supports_and_forces_of_a_centre_on_to_the_nodes_around_it) {
  const std::string deck = imported(
      "",
      "RBE2,90,21,123456,1,2,3,4\nSPC1,1,123456,21\nRBE3,91,,22,123,1.,123,9,10\n,11,12\nFORCE,1,22,,8.,1.,0.,0.\n");
  expect_in(deck, "support.fixed{ name = \"support_spc1_27\", on = { part_low:region \"spc1 27\" } }");
  expect_in(deck, "load.force{ on = { part_high:region \"force 30\" }, x = 8*force }");  // 2 on each
  EXPECT_EQ(deck.find("NOT TRANSLATED"), std::string::npos) << deck;
  // A force beside the middle has a moment; a rigid face is not the mean of its nodes.
  expect_in(imported("", "RBE3,91,,20,123,1.,123,9,10\n,11,12\nFORCE,1,20,,8.,1.,0.,0.\n"), "nor the middle of nodes");
  expect_in(imported("", "RBE2,91,22,123,9,10,11,12\nFORCE,1,22,,8.,1.,0.,0.\n"), "NOT TRANSLATED");
  expect_in(imported("", "RBE3,91,,22,123,1.,123,9,2.\n,123,10\nFORCE,1,22,,8.,1.,0.,0.\n"), "NOT TRANSLATED");
}

// Its system's axes 1, 2, 3 are y, z, x: the offset is along x, moments and products turn with it.
TEST(NastranDeck, has_a_rigid_body_of_a_mass_behind_a_rigid_face) {
  const std::string system = "CORD2R,5,,0.,0.,0.,1.,0.,0.\n,0.,1.,0.\n", rbe2 = "RBE2,91,22,123456,9,10,11,12\n";
  const std::string deck =
      imported("", system + rbe2 + "CONM2,92,22,5,.002,0.,0.,4.\n,7.,1.,8.,2.,3.,9.\nSPC1,1,123,1,2,3,4\n");
  expect_in(deck, "on = part_high:face \"rbe2 28\", mass = 0.002*force/acceleration,");
  // I(1,1) = 7 is of y, I(2,2) = 8 of z, I(3,3) = 9 of x; I(2,1) = 1 of yz, I(3,1) = 2 of yx, I(3,2) = 3 of zx.
  const std::string unit = "*force/acceleration*length^2";
  expect_in(deck, "inertia = { 9" + unit + ", 7" + unit + ", 8" + unit + ", -2" + unit + ", -3" + unit + ", -1" + unit +
                      " }, at = { 9*length, 5*length, 20*length }, motion = \"rigid\" }");
  EXPECT_EQ(deck.find("NOT TRANSLATED"), std::string::npos) << deck;
  expect_in(imported("", rbe2 + "CONM2,92,22,,.002\n"), "CONM2 has no moments of inertia");
  expect_in(imported("", "RBE2,91,22,123456,9,10\nCONM2,92,22,,.002,,,,\n,7.,,8.,,,9.\n"), "are a face of 0 parts");
  expect_in(imported("", "RBE2,91,22,123,9,10,11,12\nCONM2,92,9,,.002\n"), "NOT TRANSLATED");  // on a node of cells
}

TEST(NastranDeck, has_a_mass_on_the_mean_motion_of_nodes) {
  const std::string mass = "CONM2,92,22,,.002,,,,\n,7.,,8.,,,9.\n";
  const std::string deck = imported("", "RBE3,91,,22,123456,1.,123,9,10\n,11,12\n" + mass + "SPC1,1,123,1,2,3,4\n");
  expect_in(deck, "motion = \"mean\", weights = \"nodes\" }");
  EXPECT_EQ(deck.find("NOT TRANSLATED"), std::string::npos) << deck;
  expect_in(imported("", "RBE3,91,,22,123,1.,123,9,10\n,11,12\n" + mass), "follows in some directions alone");
  expect_in(imported("", "RBE3,91,,22,123456,1.,123,9,2.\n,123,10,11,12\n" + mass), "its weights differ");
}

TEST(NastranDeck, has_springs_on_nodes_and_their_means) {
  const std::string deck =
      imported("",
               "PBUSH,5,K,10.,20.,30.\n,,B,.1\nCORD2R,5,,0.,0.,0.,1.,0.,0.\n,0.,1.,0.\nCBUSH,90,5,1,,,,,5\n"
               "CELAS2,91,400.,2,3\nRBE3,92,,22,123456,1.,123,9,10\n,11,12\nGRID,40,,5.,5.,20.\nPELAS,7,50.\nCELAS1,93,"
               "7,22,1\n"
               "SPC1,1,123,4\n");
  // Axes 1, 2, 3 of system 5 are y, z, x.
  expect_in(deck,
            "on = { part_low:region \"cbush 30\" }, x = 30*force/length, y = 10*force/length, y_damping = "
            "0.1*force*time/length, z = 20*force/length }");
  expect_in(deck, "on = { part_low:region \"celas2 31\" }, z = 400*force/length }");
  expect_in(deck, "x = 50*force/length }");
  expect_in(deck, "supports = { support_spc1_37, spring_1, spring_2, spring_3 }");
  expect_in(imported("", "PELAS,7,50.,.2\nCELAS1,93,7,2,1\nSPC1,1,123,4\n"), "structural damping GE of a spring");
  const std::string equal = "PBUSH,5,K,10.,10.,10.\n";
  expect_in(imported("", equal + "CBUSH,90,5,1,2\n"), "its nodes are not at one place");
  expect_in(imported("", "PBUSH,5,K,10.,20.,30.\nCBUSH,90,5,1\n"), "unlike stiffness");
  expect_in(imported("", "PBUSH,5,K,10.,10.,10.,5.\nCBUSH,90,5,1,,,,,0\n"), "a node of a solid does not turn");
  const std::string mean = "RBE3,92,,22,123456,1.,123,9,10\n,11,12\nSPC1,1,123,4\n";
  expect_in(imported("", "PBUSH,5,K,10.,10.,10.,5.,6.,7.\n,,B,,,,.5\nCBUSH,90,5,22,,,,,0\n" + mean),
            "z = 10*force/length, about_x = 5*force*length, about_x_damping = 0.5*force*time*length, about_y = "
            "6*force*length, about_z = 7*force*length }");
  expect_in(imported("", "CORD2R,5,,0.,0.,0.,0.,0.,1.\n,.6,.8,0.\nPBUSH,5,K,10.\nCBUSH,90,5,22,,,,,5\n" + mean),
            "x = 10*force/length, frame = frame{ x = { 0.6, 0.8, 0 }, axis = { 0, 0, 1 } } }");
  expect_in(imported("", "CELAS2,90,10.,22,5\n" + mean), "about_y = 10*force*length }");
  expect_in(imported("", "CELAS2,90,10.,22,5,1,2\n" + mean), "a displacement and a rotation");
  expect_in(imported("", "CELAS2,90,10.,1,5\n"), "a node of a solid does not turn");
  expect_in(imported("", equal + "CBUSH,90,5,20\n"), "node 20 is of no cell");
  expect_in(imported("", "CELAS2,90,10.,1,1,7,1\n"), "not on a line along its direction");
}

TEST(NastranDeck, does_not_guess_what_a_card_means) {
  for (const char* card :
       {"CONM2,90,9,,1.-3\n", "CBUSH,90,5,9,1\n", "MPC,1,9,1,1.,10,1,-1.\nMPCADD,2,1\nSPCD,1,9,1,.1\n",
        "MOMENT,1,9,,1.,1.,0.,0.\n", "RFORCE,1,9,,1.,0.,0.,1.\n", "PLOAD4,1,2,1.,2.,3.,4.,9,11\n",
        "PLOAD4,1,2,1.,,,,9,10\n", "PLOAD2,1,1.,2\n", "FORCE,1,99,,1.,1.,0.,0.\n", "FORCE,1,20,,1.,1.,0.,0.\n",
        "SPC1,1,123,20\n", "SPC1,1,7,9\n", "PARAM,INREL,-1\n", "BOLT,1,1,2\n", "SPC1,1,3,1\nSPC1,2,3,2\n"}) {
    SCOPED_TRACE(card);
    const std::string deck = imported("", card);
    expect_in(deck, "NOT TRANSLATED");
    expect_in(deck, "error(\"");
  }
  for (const char* line : {"TEMP(LOAD) = 3\n", "MPC = 3\n", "STATSUB = 1\n", "SPC = 9\n", "DLOAD = 5\n"})
    expect_in(imported("SOL 101\nCEND\n" + std::string(line), "SPC1,1,123,1\n"), "NOT TRANSLATED");
  expect_in(imported("SOL 112\nCEND\n", ""), "SOL 112: statics (101) and modes (103) are read");
}

// Two cards that move a node by different values have no order: neither is taken in silence.
TEST(NastranDeck, stops_where_cards_hold_one_direction_at_unlike_values) {
  const std::string control = "SOL 101\nCEND\nSPC = 1\n", held = "SPC1,1,123,1,2,3,4\n";
  for (const char* more :
       {"SPC,1,9,3,.1\nSPC,1,9,3,.2\n", "SPC,1,9,3,.1\nSPC1,1,3,9\n", "SPC1,1,3,9\nSPC,1,9,3,.1\n"}) {
    const std::string deck = imported(control, held + more);
    expect_in(deck, "node 9 is moved by ");
    expect_in(deck, "of line 31: which of them holds?");
    expect_in(deck, "error(\"");
  }
  expect_in(imported(control, held + "SPC,1,9,6,.1\n"), "a rotation of 0.1 is enforced, which no deck says");
  expect_in(imported(control, "RBE2,90,21,123,1,2\nSPC1,1,123456,21\nSPC,1,1,3,.1\n"), "and held by a centre");
  const std::string twice = imported(control, held + "SPC,1,9,3,.1\nSPC,1,9,3,.1\nSPC1,1,12,1\n");
  expect_in(twice, "load.displacement{");
  EXPECT_EQ(twice.find("NOT TRANSLATED"), std::string::npos) << twice;
}

TEST(NastranDeck, has_modes_by_number_or_up_to_a_frequency) {
  const std::string control = "SOL 103\nCEND\nSPC = 1\nMETHOD = 4\n", support = "SPC1,1,123,1,2,3,4\n";
  expect_in(imported(control, support + "EIGRL,4,,,12\n"), "outputs = { output.modes{ name = \"modes\", n = 12 } }");
  expect_in(imported(control, support + "EIGRL,4,,2000.\n"), "output.modes{ name = \"modes\", up_to = 2000/time }");
  expect_in(imported(control, support + "EIGRL,4,,12\n" + "PARAM,G,.02\n"),
            "PARAM G = .02: damping of the whole model");
  expect_in(imported(control, support), "METHOD 4: there is no EIGRL or EIGR of that number");
  expect_in(imported(control, support + "EIGRL,4,,,12\n", "MAT1,1,210000.,,.3"), "has no RHO");
}

TEST(NastranDeck, has_the_axes_of_orthotropic_properties) {
  const std::string ply = "MAT11,1,140000.,10000.,9000.,.3,.28,.4,5000.\n,4500.,3000.,1.6-9";
  const auto with = [&](const std::string& property, const std::string& system) {
    std::string all = stack;
    all.replace(all.find("MAT1,1,210000.,,.3,7.85-9"), 25, ply);
    all.replace(all.find("PSOLID,2,1"), 10, property);
    const WrittenFile written(all + system + "GRAV,1,,9810.,0.,0.,-1.\n", "stack.bdf");
    return imported_deck({written.path(), "mm t s", {}});
  };
  expect_in(with("PSOLID,2,1,5", "CORD2R,5,,0.,0.,0.,1.,0.,0.\n,0.,1.,0.\n"),
            ", orientation = { { 0, 1, 0 }, { 0, 0, 1 } } }");
  expect_in(with("PSOLID,2,1,5", "CORD2C,5,,0.,0.,0.,0.,0.,1.\n,0.,1.,0.\n"), ", orientation = axes_high }");
  expect_in(with("PSOLID,2,1,-1", ""), "axes by each element");
}

TEST(ImportedDeck, is_of_a_file_whose_program_its_name_tells) {
  expect_input_error(
      [] {
        imported_deck({"plate.odb", "mm t s", {}});
      },
      {"'plate.odb' is no model that is read", ".bdf"});
}

}  // namespace
}  // namespace dygita::nastran_deck_tests
