// The deck that says what an .inp says, and what it leaves to its reader.
#include <gtest/gtest.h>

#include "foreign/abaqus_blocks.hpp"
#include "foreign/abaqus_deck.hpp"
#include "foreign/lua_text.hpp"
#include "foreign/written_file.hpp"

namespace dygita {
namespace {

const std::string steel =
    "*SOLID SECTION, ELSET=E, MATERIAL=STEEL\n*MATERIAL, NAME=STEEL\n*ELASTIC\n200000., 0.3\n*DENSITY\n8.E-9\n";

std::string imported(const std::string& rest, const std::string& units = "mm t s") {
  const WrittenFile written(AbaqusBlock(abaqus_shapes()[0], 2).text() + steel + rest, "block.inp");
  return deck_of_abaqus({written.path(), units, {}});
}

void expect_in(const std::string& text, const std::string& what) {
  EXPECT_NE(text.find(what), std::string::npos) << "no\n" << what << "\nin\n" << text;
}

TEST(AbaqusDeck, has_supports_loads_and_steps_by_the_names_and_lines_of_the_file) {
  const std::string deck = imported(
      "*BOUNDARY\nX0, 1, 3\nY0, 2\n*STEP\n*STATIC\n*CLOAD\n7, 3, -2.5\n10, 3, -2.5\n*DSLOAD\nTOP, P, 3.\n*END STEP\n");
  expect_in(
      deck,
      "local units = \"mm t s\"\nlocal length, force, pressure, acceleration, time = 0.001, 1, 1e+06, 0.001, 1\n");
  expect_in(deck, "local part_e = substructure{ name = \"E\", mesh = file:part \"E\", material = material_steel }");
  expect_in(deck, "support.fixed{ name = \"support_x0\", on = { part_e:region \"X0\" } }");
  expect_in(deck, "support.held{ name = \"support_y0\", on = { part_e:region \"Y0\" }, y = true }");
  expect_in(deck, "load.force{ on = { part_e:region \"cload ");  // both nodes: their sum
  expect_in(deck, "\" }, z = -5*force }");
  expect_in(deck, "load.pressure{ on = { part_e:face \"TOP\" }, history = 3*pressure }");
  expect_in(deck, "step.static{ name = \"step_1\", loads = { load_cload_");
  EXPECT_EQ(deck.find("NOT TRANSLATED"), std::string::npos) << deck;
  EXPECT_EQ(deck.find("error("), std::string::npos) << deck;
}

TEST(AbaqusDeck, stops_where_something_is_not_translated_and_says_the_line) {
  const std::string deck =
      imported("*SPRING, ELSET=E\n3\n10.\n*STEP, NLGEOM\n*STATIC\n*TEMPERATURE\nALL, 300.\n*END STEP\n");
  expect_in(deck, "-- NOT TRANSLATED: ");
  expect_in(deck, ": *SPRING: springs between two nodes (SPRINGA) of one stiffness are read\n");
  expect_in(deck, ": NLGEOM: displacements are small in this program");
  expect_in(deck, ": *TEMPERATURE: ");
  expect_in(deck, "error(\"some lines of ");
}

// Terms of one factor are one place; equal equations along several axes are one.
TEST(AbaqusDeck, has_equations_between_nodes) {
  const std::string step = "*STEP\n*STATIC\n*END STEP\n";
  const std::string deck =
      imported("*EQUATION\n2\n7,1,1.,10,1,-1.\n2\n7,3,1.,10,3,-1.\n4\n7,2,-1.,10,2,.25,13,2,.25,\n16,2,.5\n" + step);
  expect_in(deck, "}, factors = { -1, 1 }, x = true, z = true }");
  expect_in(deck, "}, factors = { -1, 0.5, 0.5 }, y = true }");
  expect_in(deck, "supports = { equation_1, equation_2 }");
  EXPECT_EQ(deck.find("NOT TRANSLATED"), std::string::npos) << deck;
  const std::string oblique = imported("*EQUATION\n5\n7,1,1.,7,2,.5,10,3,-2.\n13,3,-2.,16,1,0.\n" + step);
  expect_in(oblique, "}, terms = { { z = -4 }, { x = 1, y = 0.5 } } }");
  EXPECT_EQ(oblique.find("NOT TRANSLATED"), std::string::npos) << oblique;
  for (const char* card :
       {"1\n7,1,1.\n", "2\n7,4,1.,10,4,-1.\n", "2\n7,1,1.,7,1,-1.\n", "3\n7,1,1.,10,1,-1.\n", "2\n7,1,1.,X0,1,-1.\n"})
    expect_in(imported("*EQUATION\n" + std::string(card) + step), "NOT TRANSLATED");
}

TEST(AbaqusDeck, keeps_nodes_on_a_plane_or_a_line) {
  const std::string step = "*STEP\n*STATIC\n*END STEP\n";
  const std::string deck = imported("*MPC\nPLANE, Z0\n" + step);
  expect_in(deck, "z = true }");
  EXPECT_EQ(deck.find("NOT TRANSLATED"), std::string::npos) << deck;
  expect_in(imported("*MPC\nBEAM, 1, 2\n" + step), "NOT TRANSLATED");
}

// x = y, and the diagonal of the top: each says one equation for a direction across.
TEST(AbaqusDeck, keeps_nodes_on_a_plane_or_a_line_that_is_aslant) {
  const std::string nodes =
      "*NODE\n801,0.,0.,0.\n802,2.,2.,0.\n803,0.,0.,2.\n804,2.,2.,2.\n805,1.,1.,0.\n806,0.,2.,0.\n807,0.,2.,2.\n808,1.,"
      "1.,2.\n";
  const std::string cells = "*ELEMENT, TYPE=C3D6, ELSET=E\n811,801,805,806,803,808,807\n812,805,802,806,808,804,807\n";
  const std::string deck = imported(nodes + cells + "*MPC\nPLANE, 801, 802, 803, 804\nSTRAIGHT, 801, 805, 802\n" +
                                    "*STEP\n*STATIC\n*END STEP\n");
  expect_in(deck, "terms = { { x = 0.707106");
  expect_in(deck, "local equation_3 = ");
  EXPECT_EQ(deck.find("NOT TRANSLATED: "), std::string::npos) << deck;
}

// From the ground at node 901 to node 902, which no cell has and which is the mean of two nodes.
TEST(AbaqusDeck, has_springs_on_the_means_that_their_ends_are) {
  const std::string ends =
                        "*NODE\n901,-5.,0.,0.\n902,-1.,0.,0.\n*ELEMENT, TYPE=SPRINGA, "
                        "ELSET=S\n900,901,902\n*BOUNDARY\n901,1,3\n902,2,3\n",
                    spring = "*SPRING, ELSET=S\n\n10.\n", step = "*STEP\n*FREQUENCY\n1\n*END STEP\n",
                    mean = "*EQUATION\n3\n902,1,1.,7,1,-.5,10,1,-.5\n";
  const std::string deck = imported(ends + mean + spring + step);
  expect_in(deck, "local spring_1 = support.spring{ name = \"spring_1\", on = { part_e:region \"spring from ");
  expect_in(deck, " }, x = 10*force/length }");
  EXPECT_EQ(deck.find("NOT TRANSLATED"), std::string::npos) << deck;
  expect_in(imported(ends + spring + step), "is of no cell, is not held along it, and follows no mean");
  std::string aslant = ends;
  aslant.replace(aslant.find("901,-5.,0.,0."), 13, "901,-5.,3.,0.");
  expect_in(imported(aslant + "*SPRING, ELSET=S\n\n10.\n" + mean + step), "follows no mean");
  const std::string means = mean + "*EQUATION\n3\n902,2,1.,7,2,-.5,10,2,-.5\n";
  aslant.erase(aslant.find("\n902,2,3"));
  expect_in(imported(aslant + "\n" + means + spring + step),
            " }, x = 10*force/length, frame = frame{ x = { 0.8, -0.6, 0 }, axis = ");
  expect_in(imported(ends + "*EQUATION\n3\n902,1,1.,7,1,-.5,10,1,-.4\n" + spring + step), "NOT TRANSLATED");
}

// ccx adds up what a card says twice of one facet.
TEST(AbaqusDeck, adds_what_is_said_twice_of_a_facet) {
  const std::string deck = imported(
      "*BOUNDARY\nX0, 1, 3\n*STEP\n*STATIC\n*DLOAD\n108, P2, 3.\n108, P2, 3.\n110, P2, 3.\n112, P2, 1.\n*END "
      "STEP\n");
  for (const char* sum : {"history = 6*pressure }", "history = 3*pressure }", "history = 1*pressure }"})
    expect_in(deck, sum);
  EXPECT_EQ(deck.find("NOT TRANSLATED"), std::string::npos) << deck;
}

TEST(AbaqusDeck, has_a_sector_of_a_ring) {
  const std::string tie = "*TIE, NAME=T, CYCLIC SYMMETRY\nTOP, BOTTOM\n",
                    low = "*SURFACE, NAME=BOTTOM, TYPE=NODE\nZ0\n",
                    step = "*BOUNDARY\nX0, 1, 3\n*STEP\n*STATIC\n*END STEP\n",
                    ring = "*CYCLIC SYMMETRY MODEL, N=12, NGRAPH=3, TIE=T\n1., 2., 0., 1., 2., 5.\n";
  const std::string deck = imported(low + tie + ring + step);
  expect_in(deck,
            "interface.cyclic{ name = \"tie_top_bottom\", between = { part_e:face \"TOP\", part_e:face \"BOTTOM\" }, "
            "axis = { 0, 0, 5 }, through = { 1*length, 2*length, 0*length }, n = 12 }");
  EXPECT_EQ(deck.find("NOT TRANSLATED"), std::string::npos) << deck;
  expect_in(imported(low + tie + step), "there is no *CYCLIC SYMMETRY MODEL of it");
  const auto modes = [&](const std::string& select) {
    return imported(low + tie + ring + "*STEP\n*FREQUENCY\n5\n" + select + "*END STEP\n");
  };
  EXPECT_EQ(modes("*SELECT CYCLIC SYMMETRY MODES, NMIN=0, NMAX=0\n").find("NOT TRANSLATED"), std::string::npos);
  expect_in(modes("*SELECT CYCLIC SYMMETRY MODES, NMIN=0, NMAX=1\n"), "a deck has those of nodal diameter 0");
  expect_in(modes(""), "modes of all nodal diameters");
}

// 901 is 10 above the middle of the top, 902 turns it; TOP and its nodes T are a face.
TEST(AbaqusDeck, has_rigid_bodies_and_couplings_by_their_reference_nodes) {
  const AbaqusBlock block(abaqus_shapes()[1], 1);
  std::string top = "*NSET, NSET=T\n", corner;
  for (const auto& [node, x] : block.places())
    if (x[2] > 9.9)
      top += std::to_string(node) + "\n";
    else if (x[0] > 9.9)
      corner = std::to_string(node);  // off the facet of X0
  const std::string nodes = "*NODE\n901,5.,5.,20.\n902,0.,0.,0.\n903,5.,5.,10.\n" + top,
                    rigid_top = nodes + "*RIGID BODY, NSET=T, REF NODE=901, ROT NODE=902\n*BOUNDARY\nX0, 1, 3\n",
                    step = "*STEP\n*STATIC\n";
  const auto deck_of = [&](const std::string& rest) {
    const WrittenFile written(block.text() + steel + rest + "*END STEP\n", "block.inp");
    return deck_of_abaqus({written.path(), "mm t s", {}});
  };
  const auto expect_whole = [](const std::string& deck) {
    EXPECT_EQ(deck.find("NOT TRANSLATED"), std::string::npos) << deck;
  };
  std::string deck = deck_of(rigid_top + step + "*CLOAD\n901, 3, 8.\n902, 1, 4.\n");
  expect_whole(deck);
  expect_in(deck, " = mass.point{ name = \"body_rigid_body_");
  expect_in(deck, ", at = { 5*length, 5*length, 20*length }, motion = \"rigid\" }");
  expect_in(deck, "no mass: a microgram takes its place");
  deck = deck_of(rigid_top + step + "*BOUNDARY\n901, 1, 3\n902, 1, 3\n*CLOAD\n901, 1, 3.\n");
  expect_whole(deck);
  expect_in(deck, "support.fixed{ name = \"support_rigid_body_");
  expect_in(deck, "*CLOAD on a node that is held moves nothing");
  EXPECT_EQ(deck.find("mass.point"), std::string::npos) << deck;
  deck = deck_of(rigid_top + step + "*BOUNDARY\n901, 2\n902, 3\n");
  expect_whole(deck);
  expect_in(deck, "supports = { support_x0, equation_1, equation_2 }");
  const std::string coupling = nodes + "*COUPLING, REF NODE=903, SURFACE=TOP, CONSTRAINT NAME=C\n",
                    held = "*BOUNDARY\nX0, 1, 3\n";
  deck = deck_of(coupling + "*KINEMATIC\n3, 3\n" + held + "903, 1, 6\n" + step);
  expect_whole(deck);
  expect_in(deck, "\" }, z = true }");
  deck = deck_of(coupling + "*DISTRIBUTING\n1, 3\n" + held + step + "*CLOAD\n903, 3, 8.\n");
  expect_whole(deck);
  expect_in(deck, "load.force{ on = { part_e:face \"TOP\" }, z = 8*force }");
  const std::string mass = "*ELEMENT, TYPE=MASS, ELSET=M\n990, 903\n*MASS, ELSET=M\n2.\n";
  deck = deck_of(coupling + "*DISTRIBUTING\n1, 3\n" + held + mass + "*STEP\n*FREQUENCY\n3\n");
  expect_whole(deck);
  expect_in(deck, "mass = 2*force/acceleration,");
  expect_in(deck, ", motion = \"mean\", weights = \"area\" }");
  expect_whole(deck_of(nodes + mass + held + step));  // statics depend on no mass
  for (const std::string& doubtful :
       {nodes + mass + held + "*STEP\n*FREQUENCY\n3\n",                         // a mass on a node of no body
        rigid_top + step + "*BOUNDARY\n901, 3, 3, 0.5\n",                       // one direction moved
        rigid_top + step + "*BOUNDARY\n901, 1, 3\n902, 1, 2\n902, 3, 3, .1\n",  // turned
        rigid_top + step + "*CLOAD\n901, 5, 8.\n",                              // a moment beside a ROT NODE
        rigid_top + step + "*END STEP\n" + step + "*BOUNDARY\n901, 1\n",        // held later
        rigid_top + step + "*CLOAD\n901, 1, 8.\n*END STEP\n" + step + "*CLOAD\n901, 2, 8.\n",
        coupling + held + step,  // neither kind
        coupling + "*KINEMATIC\n3, 3\n" + held + step, coupling + "*DISTRIBUTING\n1, 3\n" + held + "903, 1\n" + step,
        coupling + "*DISTRIBUTING\n1, 3\n" + held + step + "*CLOAD\n903, 4, 8.\n",
        nodes + "*COUPLING, REF NODE=901, SURFACE=TOP, CONSTRAINT NAME=C\n*DISTRIBUTING\n" + held + step +
            "*CLOAD\n901, 1, 8.\n",
        nodes + "*NSET, NSET=X0\n" + corner + "\n*RIGID BODY, NSET=X0, REF NODE=901\n" + held + step,
        nodes + "*RIGID BODY, ELSET=NOWHERE, REF NODE=901\n" + held + step}) {
    SCOPED_TRACE(doubtful.substr(nodes.size()));
    expect_in(deck_of(doubtful), "NOT TRANSLATED");
  }
}

TEST(AbaqusDeck, says_what_a_reader_can_do_of_clearances_dashpots_and_tightened_bolts) {
  const std::string step = "*BOUNDARY\nX0, 1, 3\n*STEP\n*STATIC\n*END STEP\n";
  expect_in(imported("*CLEARANCE, MASTER=TOP, SLAVE=TOP, VALUE=0.1\n" + step),
            "there is no contact between its surfaces");
  expect_in(imported("*CLEARANCE, MASTER=TOP, SLAVE=TOP, VALUE=-0.1\n" + step), "an overlap");
  expect_in(imported("*NODE\n901,0.,0.,0.\n*PRE-TENSION SECTION, SURFACE=TOP, NODE=901\n0., 0., 1.\n*BOUNDARY\nX0, 1, "
                     "3\n*STEP\n*STATIC\n*CLOAD\n901, 1, 10.\n*END STEP\n"),
            "surface 'TOP' divides no part, and is no weld of two");
  const std::string ends =
      "*NODE\n901,-5.,0.,0.\n902,-5.,0.,0.\n*ELEMENT, TYPE=DASHPOTA, ELSET=S\n900,901,7\n*BOUNDARY\n901,1,3\n";
  expect_in(imported(ends + "*DASHPOT, ELSET=S\n\n0.5\n" + step), "_damping = 0.5*force*time/length");
  expect_in(imported(ends + "*SPRING, ELSET=S\n\n0.5\n" + step), "springs between two nodes (SPRINGA)");
  expect_in(imported("*DASHPOT, ELSET=E\n3\n10.\n" + step), "dashpots between two nodes (DASHPOTA)");
}

TEST(AbaqusDeck, holds_nodes_where_they_are) {
  const std::string deck = imported(
      "*BOUNDARY\nX0, 1, 3\n*STEP\n*STATIC\n*CLOAD\n7, 3, -2.5\n*END STEP\n*STEP\n*STATIC\n*BOUNDARY, FIXED\n7, 1, "
      "3\n*END STEP\n");
  expect_in(deck, "local support_boundary");
  EXPECT_EQ(deck.find("NOT TRANSLATED"), std::string::npos) << deck;
}

TEST(AbaqusDeck, does_not_guess_what_a_line_means) {
  for (const char* card :
       {"*CLOAD\nE, 4, 1.\n", "*CLOAD\n7, 7, 1.\n", "*DLOAD\nE, P2NU, 1.\n", "*DLOAD\nE, CENTRIF, 1.\n",
        "*BOUNDARY, TYPE=VELOCITY\nX0, 1\n", "*BOUNDARY\nX0, 11, 11, 5.\n", "*CLOAD, AMPLITUDE=A\n7, 1, 1.\n",
        "*CLOAD, FOLLOWER\n7, 1, 1.\n", "*CLOAD, AMPLITUDE=A, TIME DELAY=1.\n7, 1, 1.\n",
        "*EQUATION\n2\n7,1,1.,10,1,-1.\n", "*DLOAD\n100, GRAV, 9810., 0., 0., -1.\n", "*CLOAD\nNOWHERE, 1, 1.\n"}) {
    SCOPED_TRACE(card);
    expect_in(imported("*BOUNDARY\nX0, 1, 3\n*STEP\n*STATIC\n" + std::string(card) + "*END STEP\n"), "NOT TRANSLATED");
  }
  const std::string turned = "*TRANSFORM, NSET=X0, TYPE=R\n1,2,0,-2,1,0\n";
  expect_in(imported(turned + "*STEP\n*STATIC\n*BOUNDARY\nX0, 1\n*END STEP\n"),
            "a node is held in a step along axes of *TRANSFORM that are none of the file's");
  expect_in(imported(turned + "*BOUNDARY\nX0, 1, 1, 0.5\n*STEP\n*STATIC\n*END STEP\n"),
            "a node moves along axes of *TRANSFORM that are none of the file's");
  expect_in(imported("*TRANSFORM, NSET=X0, TYPE=R\n1,2,0,2,4,0\n*STEP\n*STATIC\n*END STEP\n"),
            "its two points are on one line");
  expect_in(imported("*TRANSFORM, NSET=X0, TYPE=S\n0,0,0,0,0,1\n*STEP\n*STATIC\n*END STEP\n"), "TYPE = S");
}

// R: axis 1 is y of the file, axis 2 its -x; aslant: axis 1 is (0.6, 0.8, 0). C: about z through (-10, 0, 0).
TEST(AbaqusDeck, honours_axes_of_transform) {
  const std::string turned = "*TRANSFORM, NSET=X0, TYPE=R\n0,2,0,-1,0,0\n", step = "*STEP\n*STATIC\n*END STEP\n";
  std::string deck = imported(turned + "*BOUNDARY\nX0, 1\nX0, 3\n" + step);
  expect_in(deck, "}, y = true, z = true }");
  deck = imported(turned + "*STEP\n*STATIC\n*BOUNDARY\nX0, 2, 2, 0.5\n*END STEP\n");
  expect_in(deck, "}, x = -0.5*length }");
  const std::string aslant = "*NSET, NSET=ONE\n7, 10\n*TRANSFORM, NSET=ONE, TYPE=R\n3,4,0,-4,3,0\n";
  deck = imported(aslant + "*BOUNDARY\nONE, 1, 2\n*STEP\n*STATIC\n*CLOAD\nONE, 1, 10.\n*END STEP\n");
  expect_in(deck, "}, x = true, y = true }");
  expect_in(deck, "}, x = 12*force, y = 16*force }");
  deck = imported(aslant + "*EQUATION\n2\n7,1,1.,13,3,-2.\n" + step);
  expect_in(deck, "terms = { { z = -2 }, { x = 0.6, y = 0.8 } }");
  deck = imported(turned + "*EQUATION\n2\n7,1,1.,10,2,-1.\n" + step);
  EXPECT_EQ(deck.find("NOT TRANSLATED"), std::string::npos) << deck;
  deck = imported(
      "*NSET, NSET=TWO\n7, 10\n*TRANSFORM, NSET=TWO, TYPE=C\n-10,0,0,-10,0,1\n*STEP\n*STATIC\n*CLOAD\nTWO, 2, "
      "10.\n*END "
      "STEP\n");
  EXPECT_EQ(deck.find("NOT TRANSLATED"), std::string::npos) << deck;
}

TEST(AbaqusDeck, has_steps_of_motion_modes_and_amplitudes) {
  const std::string moves = imported(
      "*AMPLITUDE, NAME=A\n0., 0., 1e-3, 2.\n*BOUNDARY\nX0, 1, 3\n*STEP\n*DYNAMIC, DIRECT\n1.e-5, 1.04e-4\n"
      "*CLOAD, AMPLITUDE=a\n7, 1, 3.\n*END STEP\n");
  expect_in(moves, "history.piecewise{ times = { 0*time, 0.001*time }, values = { 0*force, 6*force } }");
  expect_in(moves, "step.dynamic{ name = \"step_1\", loads = { load_cload_");
  expect_in(moves, "duration = 0.000104*time, dt = 9.454545454545454e-06*time }");
  const std::string modes = imported("*BOUNDARY\nX0, 1, 3\n*STEP\n*FREQUENCY\n7\n*END STEP\n");
  expect_in(modes, "steps = { rest_1 }, outputs = { output.modes{ name = \"modes\", n = 7 } }");
  EXPECT_EQ(modes.find("NOT TRANSLATED"), std::string::npos) << modes;
  const auto of = [](const std::string& numbers) {
    return imported("*BOUNDARY\nX0, 1, 3\n*STEP\n*FREQUENCY\n" + numbers + "\n*END STEP\n");
  };
  expect_in(of("7, 2000., 9000."), "modes below its lowest frequency are here, too");
  expect_in(of("7, , 9000."), "modes above its highest frequency are here, too");
  expect_in(of(", , 9000."), "output.modes{ name = \"modes\", up_to = 9000/time }");
}

TEST(AbaqusDeck, holds_a_place_once_in_all_directions_that_several_lines_hold) {
  const std::string deck =
      imported("*BOUNDARY\nX0, 1\n*BOUNDARY\nX0, 3\n*STEP\n*STATIC\n*BOUNDARY\nX0, 2\n*END STEP\n");
  expect_in(deck, "support.held{ name = \"support_x0\", on = { part_e:region \"X0\" }, x = true, z = true }");
  expect_in(deck, "support.fixed{ name = \"support_x0_2\", on = { part_e:region \"X0\" } }");
  expect_in(deck, "supports = { support_x0_2 } }  -- ");
}

TEST(AbaqusDeck, joins_surfaces_as_their_interaction_says) {
  const std::string two =
      "*NODE\n901,0,0,20\n902,20,0,20\n903,20,20,20\n904,0,20,20\n905,0,0,30\n906,20,0,30\n907,20,20,30\n908,0,20,30\n"
      "*ELEMENT, TYPE=C3D8, ELSET=LID\n900,901,902,903,904,905,906,907,908\n*SURFACE, NAME=UNDER\nLID, S1\n"
      "*SOLID SECTION, ELSET=LID, MATERIAL=STEEL\n*CONTACT PAIR, INTERACTION=I\nunder, top\n*SURFACE INTERACTION, "
      "NAME=i\n";
  const std::string hard = imported(
      two + "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n1e7\n*FRICTION\n0.2, 1e6\n*STEP\n*STATIC\n*END STEP\n");
  expect_in(hard,
            "interface.contact{ name = \"contact_under_top\", between = { part_lid:face \"UNDER\", part_e:face \"TOP\" "
            "}, friction = 0.2, gap = \"geometry\" }");
  expect_in(hard, "LINEAR contact is hard here");
  const std::string tied = imported(
      two + "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=TIED\n1e7\n*FRICTION\n1e30, 1e6\n*STEP\n*STATIC\n*END STEP\n");
  expect_in(tied, "interface.bonded{ name = \"tie_under_top\"");
}

// Surfaces of a part are called by its instances, each with the surface of its own.
TEST(AbaqusDeck, joins_surfaces_of_parts_by_their_instances) {
  const WrittenFile written(
      "*PART, NAME=P\n*NODE\n1,0,0,0\n2,1,0,0\n3,1,1,0\n4,0,1,0\n5,0,0,1\n6,1,0,1\n7,1,1,1\n8,0,1,1\n"
      "*ELEMENT, TYPE=C3D8, ELSET=E\n1,1,2,3,4,5,6,7,8\n*SOLID SECTION, ELSET=E, MATERIAL=STEEL\n"
      "*SURFACE, NAME=LOW\nE, S1\n*SURFACE, NAME=HIGH\nE, S2\n*END PART\n*ASSEMBLY, NAME=A\n"
      "*INSTANCE, NAME=under, PART=P\n*END INSTANCE\n*INSTANCE, NAME=over, PART=P\n0.,0.,1.\n*END INSTANCE\n"
      "*TIE, NAME=T\nUNDER.high, over.LOW\n*END ASSEMBLY\n*MATERIAL, NAME=STEEL\n*ELASTIC\n200000., 0.3\n"
      "*STEP\n*STATIC\n*END STEP\n",
      "stack.inp");
  const std::string deck = deck_of_abaqus({written.path(), "mm t s", {}});
  expect_in(deck, "between = { part_under:face \"HIGH\", part_over:face \"LOW\" } }");
  EXPECT_EQ(deck.find("NOT TRANSLATED"), std::string::npos) << deck;
}

TEST(AbaqusDeck, leaves_perturbations_about_other_steps_to_its_reader) {
  const std::string step = "*STATIC\n*CLOAD\n7, 1, 1.\n*END STEP\n";
  expect_in(imported("*BOUNDARY\nX0, 1, 3\n*STEP\n" + step + "*STEP, PERTURBATION\n" + step),
            "a static perturbation about");
  expect_in(
      imported("*BOUNDARY\nX0, 1, 3\n*STEP\n*FREQUENCY\n3\n*END STEP\n*STEP\n" + step + "*STEP, PERTURBATION\n" + step),
      "it changes what earlier steps have loaded");
  EXPECT_EQ(imported("*BOUNDARY\nX0, 1, 3\n*STEP, PERTURBATION\n" + step).find("NOT TRANSLATED"), std::string::npos);
}

TEST(AbaqusDeck, carries_loads_on_into_later_steps_until_they_are_said_anew) {
  const auto deck_of = [](const std::string& later) {
    return imported(
        "*BOUNDARY\nX0, 1, 3\n*STEP\n*STATIC\n*CLOAD\n7, 1, 1.\n7, 2, 2.\n*DSLOAD\nTOP, P, 3.\n*END "
        "STEP\n*STEP\n*STATIC\n" +
        later + "*END STEP\n");
  };
  const auto loads_of = [](const std::string& deck) {
    const size_t at = deck.find("after = step_1, loads = ");
    return at == std::string::npos ? "" : deck.substr(at, deck.find('}', at) - at);
  };
  const std::string deck = deck_of("*CLOAD\n7, 2, 5.\n");
  expect_in(deck, "y = 5*force }");
  const std::string loads = loads_of(deck);
  EXPECT_EQ(std::count(loads.begin(), loads.end(), ','), 3) << loads;  // 1 of the first, 5 in the place of 2, TOP
  EXPECT_EQ(deck.find("NOT TRANSLATED"), std::string::npos) << deck;
  expect_in(deck_of("*CLOAD\nX0, 2, 5.\nALL, 2, 1.\n"), "it changes a part of what ");
  expect_in(deck_of("*CLOAD, OP=NEW\n7, 2, 5.\n"), "OP = NEW after forces and distributed loads");
}

TEST(AbaqusDeck, drives_what_a_later_step_moves_from_the_start) {
  const std::string held = "*BOUNDARY\nX0, 1, 3\n*STEP\n*STATIC\n*CLOAD\n7, 1, 1.\n*END STEP\n*STEP\n";
  const std::string deck = imported(held + "*STATIC\n*BOUNDARY\nX0, 2, 2, 0.1\n*END STEP\n");
  EXPECT_EQ(deck.find("support.fixed"), std::string::npos) << deck;
  expect_in(deck, "x = true, z = true }");
  expect_in(deck, "y = 0*length }");
  expect_in(deck, "y = 0.1*length }");
  EXPECT_EQ(deck.find("NOT TRANSLATED"), std::string::npos) << deck;
  expect_in(imported(held + "*STATIC\n*BOUNDARY\nALL, 2, 2, 0.1\n*END STEP\n"), "it changes a part of what ");
}

TEST(AbaqusDeck, holds_in_modes_what_is_moved) {
  const std::string deck = imported(
      "*BOUNDARY\nX0, 1, 2\n*STEP\n*STATIC\n*BOUNDARY\nX0, 3, 3, 0.1\n*END STEP\n*STEP\n*FREQUENCY\n3\n*END STEP\n");
  expect_in(deck, "support.fixed{ name = \"support_x0_2\"");
  expect_in(deck, "supports = { support_x0_2 } }  -- without loads");
}

TEST(AbaqusDeck, has_temperatures_of_parts_and_turning_ones) {
  const std::string hot = "*INITIAL CONDITIONS, TYPE=TEMPERATURE\nALL, 293.\n*BOUNDARY\nX0, 1, 3\n*STEP\n*STATIC\n";
  const auto deck_of = [&](const std::string& expansion, const std::string& load) {
    const WrittenFile written(
        AbaqusBlock(abaqus_shapes()[0], 2).text() + steel + expansion + hot + load + "*END STEP\n", "block.inp");
    return deck_of_abaqus({written.path(), "mm t s", {}});
  };
  expect_in(deck_of("*EXPANSION\n1.2E-5\n", "*TEMPERATURE\nALL, 393.\n"),
            "load.temperature{ parts = { part_e }, expansion = 1.2e-05, by = 100 }");
  expect_in(deck_of("", "*TEMPERATURE\nALL, 393.\n"), "has no *EXPANSION that is one number");
  expect_in(deck_of("*EXPANSION\n1.2E-5, 0.\n1.3E-5, 100.\n", "*TEMPERATURE\nALL, 393.\n"),
            "has no *EXPANSION that is one number");
  expect_in(deck_of("*EXPANSION\n1.2E-5\n", "*TEMPERATURE\nX0, 393.\n"), "has several temperatures");
  expect_in(deck_of("", "*DLOAD\nE, CENTRIF, 9., 1., 2., 3., 0., 0., 5.\n"),
            "load.spin{ speed = 3/time, axis = { 0, 0, 1 }, through = { 1*length, 2*length, 3*length } }");
}

TEST(AbaqusDeck, takes_the_end_of_an_amplitude_in_a_static_step) {
  const std::string deck = imported(
      "*AMPLITUDE, NAME=A\n0., 0., 2., 8., 3., 100.\n*BOUNDARY\nX0, 1, 3\n*STEP\n*STATIC\n0.1, 1.5\n"
      "*CLOAD, AMPLITUDE=A\n7, 1, 3.\n*END STEP\n");
  expect_in(deck, "x = 18*force");  // 3 x 6
  expect_in(deck, "the amplitude 'A' is 6 at the end of its step");
  EXPECT_EQ(deck.find("error("), std::string::npos) << deck;
}

TEST(LuaText, is_what_lua_reads_back) {
  EXPECT_EQ(lua_quoted("a \"b\"\\\n"), "\"a \\\"b\\\"\\\\\\010\"");
  EXPECT_EQ(lua_number(0.1), "0.1");
  EXPECT_EQ(std::stod(lua_number(1.0 / 3.0)), 1.0 / 3.0);
  EXPECT_EQ(deck_name_of("..a/b:c."), "a_b_c");
  EXPECT_EQ(deck_name_of(""), "unnamed");
  LuaNames names;
  EXPECT_EQ(names.of("part", "Left Side"), "part_left_side");
  EXPECT_EQ(names.of("part", "left-side"), "part_left_side_2");
}

}  // namespace
}  // namespace dygita
