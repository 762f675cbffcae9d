// Bolts in one solid and nodes that are held obliquely, as an .inp has them: decks that dygita import writes, run.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "decks/engine.hpp"
#include "foreign/abaqus_deck.hpp"
#include "foreign/imported_deck.hpp"
#include "foreign/written_file.hpp"

namespace dygita::test::written_bolts_tests {
namespace {

// A bar of 1 x 1 x 4 mm in four cells, held at both ends, with a section between the second and the third.
std::string tightened(const std::string& surface, const std::string& normal, const std::string& steps,
                      const std::string& sections = "*SOLID SECTION, ELSET=BOLT, MATERIAL=EL\n") {
  std::string text = "*NODE, NSET=NALL\n";
  int n = 0;
  for (int k = 0; k < 5; ++k)
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < 2; ++i) text += fmt::format("{}, {}., {}., {}.\n", ++n, i, j, k);
  text += "99, 0., 0., 9.\n*ELEMENT, TYPE=C3D8I, ELSET=BOLT\n";
  for (int k = 0; k < 4; ++k) {
    const int b = 4 * k;
    text += fmt::format("{}, {}, {}, {}, {}, {}, {}, {}, {}\n", k + 1, b + 1, b + 2, b + 4, b + 3, b + 5, b + 6, b + 8,
                        b + 7);
  }
  return text + "*MATERIAL, NAME=EL\n*ELASTIC\n210000., 0.\n*DENSITY\n8.E-9\n" + sections +
         "*NSET, NSET=LOW\n1,2,3,4\n*NSET, NSET=TOP\n17,18,19,20\n*NSET, NSET=MIDDLE\n13,14,15,16\n*BOUNDARY\nLOW, 1, "
         "3\n"
         "TOP, 1, 3\n*SURFACE, NAME=CUT\n" +
         surface + "\n*PRE-TENSION SECTION, SURFACE=CUT, NODE=99\n" + normal + "\n" + steps;
}

std::string deck_of(const std::string& text) {
  const WrittenFile inp(text, "bolt.inp");
  return deck_of_abaqus({inp.path(), "mm t s", {}});
}

// The whole text with other outputs, run while the file is there.
DeckRun run_inp(const std::string& text, const std::string& outputs) {
  const WrittenFile inp(text, "bolt.inp");
  std::string deck = deck_of_abaqus({inp.path(), "mm t s", {}});
  const std::string frames = "output.vtk{ frames = 1 }";
  if (deck.find(frames) == std::string::npos) throw std::runtime_error(deck);
  deck.replace(deck.find(frames), frames.size(), outputs);
  return run_text(deck).at(0);
}

std::string force(int upper) {
  return fmt::format(
      "output.resultant{{ name = \"bolt\", on = bolt_bolt }}, output.history{{ name = \"middle\", on = "
      "part_bolt_{}:region "
      "\"MIDDLE\", quantity = \"displacement\" }}",
      upper);
}
constexpr double stiffness = 210000.0 / 4;  // N/mm of the bar

// As ccx has it: a force pulls where the normal points out of the cells that the surface names.
TEST(WrittenBolts, sections_are_cut_and_pulled_by_the_force_of_their_node) {
  for (const auto& [surface, normal, upper] :
       {std::tuple("2, S2", "0., 0., 1.", 2), {"3, S1", "0., 0., -1.", 1}}) {  // the first has the cells of the surface
    SCOPED_TRACE(surface);
    const DeckRun run =
        run_inp(tightened(surface, normal, "*STEP\n*STATIC\n*CLOAD\n99, 1, 10.\n*END STEP\n"), force(upper));
    EXPECT_NEAR(run.column("bolt", "normal").back(), 10.0, 1e-6 * 10);
    EXPECT_NEAR(run.column("middle", "z").back(), -4.761905e-8, 1e-12);
  }
  const std::string pushed =
      deck_of(tightened("2, S2", "0., 0., -1.", "*STEP\n*STATIC\n*CLOAD\n99, 1, 10.\n*END STEP\n"));
  EXPECT_NE(pushed.find("*CLOAD: it pushes the section apart"), std::string::npos) << pushed;
}

TEST(WrittenBolts, sections_are_shortened_and_keep_their_length) {
  const DeckRun run =
      run_inp(tightened("2, S2", "0., 0., 1.", "*STEP\n*STATIC\n*BOUNDARY\n99, 1, 1, 0.001\n*END STEP\n"), force(2));
  EXPECT_NEAR(run.column("bolt", "normal").back(), 0.001 * stiffness, 1e-5 * 0.001 * stiffness);
  // Tightened by 10 N, then frozen while 4 N push three quarters of the bar up: the lower part takes a quarter of them.
  const std::string tighten = "*STEP\n*STATIC\n*CLOAD\n99, 1, 10.\n*END STEP\n*STEP\n*STATIC\n",
                    push = "*CLOAD\nMIDDLE, 3, 1.\n*END STEP\n";
  const DeckRun frozen =
      run_inp(tightened("2, S2", "0., 0., 1.", tighten + "*BOUNDARY, FIXED\n99, 1\n" + push), force(2));
  EXPECT_NEAR(frozen.column("bolt", "normal").back(), 11.0, 1e-5 * 11);
  // Without FIXED the force stays.
  const DeckRun kept = run_inp(tightened("2, S2", "0., 0., 1.", tighten + push), force(2));
  EXPECT_NEAR(kept.column("bolt", "normal").back(), 10.0, 1e-5 * 10);
}

// Cells on both sides of the surface have sections of their own in the file: the weld between them is tightened.
TEST(WrittenBolts, sections_between_two_parts_tighten_their_weld) {
  const DeckRun run =
      run_inp(tightened("2, S2", "0., 0., 1.", "*STEP\n*STATIC\n*CLOAD\n99, 1, 10.\n*END STEP\n",
                        "*ELSET, ELSET=NUT\n1, 2\n*ELSET, ELSET=HEAD\n3, 4\n*SOLID SECTION, ELSET=NUT, MATERIAL=EL\n"
                        "*SOLID SECTION, ELSET=HEAD, MATERIAL=EL\n"),
              "output.resultant{ name = \"bolt\", on = weld_1_2 }");
  EXPECT_NEAR(run.column("bolt", "normal").back(), 10.0, 1e-6 * 10);
}

TEST(WrittenBolts, decks_cut_by_the_surface_and_say_what_does_not_go) {
  const std::string deck = deck_of(tightened("2, S2", "0., 0., 1.", "*STEP\n*STATIC\n*CLOAD\n99, 1, 10.\n*END STEP\n"));
  for (const char* line : {"local halves_bolt = file:part \"BOLT\" :cut \"CUT\"", "mesh = halves_bolt[1]",
                           "mesh = halves_bolt[2]", "between = { part_bolt_1:face \"cut\", part_bolt_2:face \"cut\" }",
                           "load.preload{ on = bolt_bolt, force = 10*force }"})
    EXPECT_NE(deck.find(line), std::string::npos) << line << "\n" << deck;
  const std::string oblique =
      deck_of(tightened("2, S2", "0., 1., 1.", "*STEP\n*STATIC\n*CLOAD\n99, 1, 10.\n*END STEP\n"));
  EXPECT_NE(oblique.find("its surface is not plane and across its normal"), std::string::npos) << oblique;
}

// A wedge of 30 degrees of a ring, inner radius 10 and outer 20 mm, two cells thick: its cut at 30 degrees is held
// around the axis, in axes of a cylinder.
std::string wedge(const std::string& held) {
  std::string text = "*NODE, NSET=NALL\n";
  int n = 0;
  for (int k = 0; k < 2; ++k)
    for (int t = 0; t < 3; ++t)
      for (int r = 0; r < 4; ++r) {
        const double angle = t * std::numbers::pi / 12, radius = 10 + 10 * r / 3.0;
        text +=
            fmt::format("{}, {:.9f}, {:.9f}, {}.\n", ++n, radius * std::cos(angle), radius * std::sin(angle), 2 * k);
      }
  text += "*ELEMENT, TYPE=C3D8I, ELSET=RING\n";
  int e = 0;
  for (int t = 0; t < 2; ++t)
    for (int r = 0; r < 3; ++r) {
      const int a = 4 * t + r + 1, b = a + 4;
      text +=
          fmt::format("{}, {}, {}, {}, {}, {}, {}, {}, {}\n", ++e, a, a + 1, b + 1, b, a + 12, a + 13, b + 13, b + 12);
    }
  return text +
         "*MATERIAL, NAME=EL\n*ELASTIC\n210000., 0.3\n*SOLID SECTION, ELSET=RING, MATERIAL=EL\n"
         "*NSET, NSET=RIGHT\n1,2,3,4,13,14,15,16\n*NSET, NSET=LEFT\n9,10,11,12,21,22,23,24\n*NSET, NSET=FLOOR, "
         "GENERATE\n1,12,1\n"
         "*SURFACE, NAME=BORE\n1, S6\n4, S6\n*TRANSFORM, NSET=NALL, TYPE=C\n0., 0., 0., 0., 0., 1.\n*BOUNDARY\n" +
         held + "*STEP\n*STATIC\n*DSLOAD\nBORE, P, 50.\n*END STEP\n";
}

// As the same wedge with planes of symmetry by hand; by equations where the nodes are no face.
TEST(WrittenBolts, nodes_are_held_along_oblique_axes) {
  const std::string outputs =
      "output.history{ name = \"bore\", on = part_ring:face \"BORE\", quantity = \"displacement\" }, "
      "output.history{ name = \"left\", on = part_ring:region \"LEFT\", quantity = \"displacement\" }";
  const DeckRun plane = run_inp(wedge("RIGHT, 2\nLEFT, 2\nFLOOR, 3\n"), outputs);
  // All of one node apart: 24 is named by itself in another card.
  const DeckRun nodes =
      run_inp(wedge("RIGHT, 2\n9, 2\n10, 2\n11, 2\n12, 2\n21, 2\n22, 2\n23, 2\nFLOOR, 3\n*BOUNDARY\n24, 2\n"), outputs);
  const double x = plane.column("left", "x").back(), y = plane.column("left", "y").back();
  EXPECT_GT(std::hypot(x, y), 1e-7);
  EXPECT_NEAR(y / x, std::tan(std::numbers::pi / 6), 1e-6);  // along the plane at 30 degrees
  for (const char* of : {"bore", "left"})
    for (const char* d : {"x", "y", "z"})
      EXPECT_NEAR(nodes.column(of, d).back(), plane.column(of, d).back(), 1e-6 * std::hypot(x, y)) << of << d;
  // A ring of thick walls (Lame), in plane stress: u = p a^2 / (E (b^2 - a^2)) ((1 - nu) a + (1 + nu) b^2 / a).
  const double lame = 50.0 * 100 / (210000.0 * 300) * (0.7 * 10 + 1.3 * 400 / 10) * 1e-3;
  const double mean = std::hypot(plane.column("bore", "x").back(), plane.column("bore", "y").back());
  EXPECT_NEAR(mean, lame * std::sin(std::numbers::pi / 12) / (std::numbers::pi / 12), 0.02 * lame);
}

}  // namespace
}  // namespace dygita::test::written_bolts_tests
