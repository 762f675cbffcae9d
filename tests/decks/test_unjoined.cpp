// Parts near each other without an interface: what check and run say of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/log.hpp"
#include "decks/engine.hpp"

namespace dygita::test::unjoined_tests {

namespace {

// A plate of 40 x 40 x 10 mm that is held, and a block of 20 x 20 x 20 mm at `place`.
std::string blocks_at(const std::string& place, const std::string& more) {
  return R"(
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local plate = substructure{ name = "plate", material = steel, mesh = mesh.box{ size = { 40*mm, 40*mm, 10*mm }, cells = { 8, 8, 2 } } }
local block = substructure{ name = "block", material = steel, place = )" +
         place + R"(, velocity = { 0, 0, -1 },
                            mesh = mesh.box{ size = { 20*mm, 20*mm, 20*mm }, cells = { 4, 4, 4 } } }
local base = support.fixed{ name = "base", on = plate:face "zmin" }
local interfaces, supports = {}, { base }
)" + more +
         R"(
local fall = step.dynamic{ name = "fall", duration = 100*us, dt = 1*us }
problem{ name = "drop", substructures = { plate, block }, interfaces = interfaces, supports = supports, steps = { fall } }:run{}
)";
}

// Warnings that name a word, of a run or of a check.
std::vector<std::string> warnings_with(const std::string& word) {
  std::vector<std::string> found;
  for (const std::string& warning : take_warnings())
    if (warning.find(word) != std::string::npos) found.push_back(warning);
  return found;
}

std::vector<std::string> said_of_run(const std::string& text, const std::string& word) {
  take_warnings();
  testing::internal::CaptureStderr();  // a run takes its own warnings
  run_text(text);
  const std::string all = testing::internal::GetCapturedStderr();
  std::vector<std::string> found;
  for (size_t at = 0; at < all.size();) {
    const size_t end = std::min(all.find('\n', at), all.size());
    const std::string line = all.substr(at, end - at);
    if (line.find(word) != std::string::npos) found.push_back(line.substr(line.find("substructures")));
    at = end + 1;
  }
  return found;
}

std::vector<std::string> said_of_check(const std::string& text, const std::string& word) {
  take_warnings();
  const Engine engine{run_problem, check_report};
  DeckOptions options;
  options.path = "drop.lua";
  options.text = text;
  check_deck(options, engine);
  return warnings_with(word);
}

TEST(Unjoined, parts_that_touch_and_pass_through_each_other_are_named) {
  const std::string text = blocks_at("{ 10*mm, 10*mm, 10*mm }", "");
  const std::vector<std::string> touch = said_of_check(text, "touch on");
  ASSERT_EQ(touch.size(), 1u);
  EXPECT_NE(touch[0].find("substructures 'plate' and 'block' touch on 400 mm^2 without an interface, at ("),
            std::string::npos)
      << touch[0];
  EXPECT_NE(touch[0].find("('plate.zmax' on 'block.zmin')"), std::string::npos) << touch[0];
  // 1 m/s for 100 us.
  const std::vector<std::string> through = said_of_run(text, "overlap by");
  ASSERT_EQ(through.size(), 1u);
  EXPECT_EQ(through[0].substr(0, through[0].find(", at (")),
            "substructures 'plate' and 'block' overlap by 0.1 mm without an interface");
  EXPECT_NE(through[0].find("in step 'fall' at 0.1 ms: an interface.contact would prevent this"), std::string::npos);
}

// Half of the block's foot is bonded: facets of the plate reach beyond what is.
TEST(Unjoined, what_a_bond_leaves_of_a_foot_is_named_as_it_is) {
  const auto said = [](const std::string& x) {
    return said_of_check(
        blocks_at(
            "{ " + x + "*mm, 10*mm, 10*mm }",
            "interfaces = { interface.bonded{ name = 'foot', between = { plate:face 'zmax', block:face{ low = { " + x +
                "*mm - 0.01*mm, 9.9*mm, 9.9*mm }, high = { " + x + "*mm + 10.01*mm, 30.1*mm, 10.1*mm } } } } }"),
        "touch on");
  };
  for (const char* x : {"10", "11", "13.5"}) {
    const std::vector<std::string> touch = said(x);
    ASSERT_EQ(touch.size(), 1u) << x;
    EXPECT_NE(touch[0].find("touch on 200 mm^2 without an interface"), std::string::npos) << touch[0];
  }
}

// What is left of the foot presses as it does on fine meshes (32 cells along the plate, 17 along the block): with more
// than its share of the pressure, since the foot's outer edges are its own. Nothing is told.
TEST(Unjoined, what_a_bond_leaves_of_a_foot_can_be_joined_whatever_the_meshes) {
  const auto foot = [](const std::string& x, const std::string& plate, const std::string& block, bool is_of_plate) {
    return run_text("local x, n, m, whole = " + x + "*mm, " + plate + ", " + block + ", " +
                        (is_of_plate ? "true" : "false") +
                        R"(
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local plate = substructure{ name = "plate", material = steel, mesh = mesh.box{ size = { 40*mm, 40*mm, 10*mm }, cells = { n, n, 2 } } }
local block = substructure{ name = "block", material = steel, place = { x, 10*mm, 10*mm }, mesh = mesh.box{ size = { 20*mm, 20*mm, 20*mm }, cells = { m, m, m } } }
local pad = whole and { block:face "zmin", plate:face{ low = { 9.9*mm, 9.9*mm, 9.9*mm }, high = { 20.1*mm, 30.1*mm, 10.1*mm } } }
  or { plate:face "zmax", block:face{ low = { x - 0.01*mm, 9.9*mm, 9.9*mm }, high = { x + 10.01*mm, 30.1*mm, 10.1*mm } } }
local glue = interface.bonded{ name = "glue", between = pad }
local rest = interface.contact{ between = "all touching", friction = 0.3 }
local base = support.fixed{ name = "base", on = plate:face "zmin" }
local press = step.static{ name = "press", loads = { load.pressure{ on = block:face "zmax", history = 10*MPa } } }
problem{ name = "foot", substructures = { plate, block }, interfaces = { glue, rest }, supports = { base }, steps = { press },
  outputs = { output.resultant{ name = "glue", on = glue }, output.resultant{ name = "rest", on = rest } } }:run{}
)",
                    {}, 1)
        .at(0);
  };
  struct Scene {
    const char *x, *plate, *block;
    bool is_of_plate;
    double left, refined;  // mm^2, N
  };
  const Scene scenes[] = {{"11", "8", "4", false, 200, 2105},
                          {"13.5", "8", "4", false, 200, 2107},
                          {"11", "10", "6", false, 200, 2105},
                          {"11", "4", "8", false, 200, 2105},
                          {"11", "8", "5", true, 220, 2183},
                          {"8", "20", "5", true, 200, 2143},
                          // Nodes meet: the bond has those of the common line, and with them half a cell of four.
                          {"10", "8", "4", false, 200, 0.75 * 2107},
                          {"10", "8", "4", true, 200, 0.75 * 1999}};
  for (const Scene& scene : scenes) {
    SCOPED_TRACE(std::string(scene.x) + " " + scene.plate + " " + scene.block);
    testing::internal::CaptureStderr();
    const DeckRun run = foot(scene.x, scene.plate, scene.block, scene.is_of_plate);
    const std::string said = testing::internal::GetCapturedStderr();
    EXPECT_EQ(said.find("touch on"), std::string::npos) << said;
    EXPECT_NEAR(run.result->contacts.at(0).area, 1e-6 * scene.left, 1e-3 * 1e-6 * scene.left);
    const double rest = -run.column("rest", "normal").back(), glue = -run.column("glue", "normal").back();
    EXPECT_NEAR(rest + glue, 4000.0, 1e-3 * 4000.0);
    EXPECT_NEAR(rest, scene.refined, 0.1 * scene.refined);
  }
}

// 40 m/s for 100 us, across more than a twentieth of the block's size.
TEST(Unjoined, parts_that_fly_into_each_other_from_afar_are_named) {
  std::string text = blocks_at("{ 10*mm, 10*mm, 12.4*mm }", "");
  EXPECT_TRUE(said_of_run(text, "overlap by").empty());
  text.replace(text.find("0, 0, -1 }"), 10, "0, 0, -40 }");
  const std::vector<std::string> through = said_of_run(text, "overlap by");
  ASSERT_EQ(through.size(), 1u);
  EXPECT_EQ(through[0].substr(0, through[0].find(" without an")),
            "substructures 'plate' and 'block' overlap by 1.6 mm");
}

TEST(Unjoined, faces_apart_that_meet_as_if_they_touched_are_named) {
  const auto said = [](const std::string& more) {
    return said_of_check(blocks_at("{ 10*mm, 10*mm, 11*mm }",
                                   "interfaces = { interface.contact{ name = \"lid\", between = { block:face \"zmin\", "
                                   "plate:face \"zmax\" }, within = 2*mm" +
                                       more + " } }"),
                         "as if in contact");
  };
  ASSERT_EQ(said("").size(), 1u);
  EXPECT_NE(
      said("")[0].find("'lid' joins faces that are up to 1 mm apart as if in contact: gap = \"geometry\" includes"),
      std::string::npos)
      << said("")[0];
  EXPECT_TRUE(said(", gap = \"geometry\"").empty());
  EXPECT_TRUE(said(", gap = 1*mm").empty());
}

TEST(Unjoined, parts_are_watched_across_a_gap_and_where_cells_differ) {
  const std::vector<std::string> through = said_of_run(blocks_at("{ 9*mm, 8*mm, 10.04*mm }", ""), "overlap by");
  ASSERT_EQ(through.size(), 1u);
  EXPECT_NE(through[0].find("overlap by 0.06 mm"), std::string::npos) << through[0];
  EXPECT_TRUE(said_of_run(blocks_at("{ 9*mm, 8*mm, 10.2*mm }", ""), "overlap by").empty()) << "does not get there";
  EXPECT_TRUE(said_of_run(blocks_at("{ 9*mm, 8*mm, 30*mm }", ""), "overlap by").empty());
}

TEST(Unjoined, parts_that_an_interface_keeps_apart_are_not_named) {
  const std::string text = blocks_at(
      "{ 10*mm, 10*mm, 10*mm }",
      "interfaces = { interface.contact{ name = 'seat', between = { plate:face 'zmax', block:face 'zmin' } } }");
  EXPECT_TRUE(said_of_run(text, "each other").empty());
  EXPECT_TRUE(said_of_check(text, "touch on").empty());
}

// The whole of the block's foot, or half of it, is on a spring, an equation or a mean of motions; 200 mm^2 are left.
TEST(Unjoined, places_that_springs_and_sums_join_are_not_named_and_what_they_leave_is) {
  const auto said = [](const std::string& joint) {
    return said_of_check(blocks_at("{ 10*mm, 10*mm, 10*mm }", R"(
local function half(part) return part:face{ normal = { 0, 0, part == plate and 1 or -1 }, low = { 9.9*mm, 9.9*mm, 9.9*mm }, high = { 20.1*mm, 30.1*mm, 10.1*mm } } end
local function under(part) return part:where(function(x, y, z) return near(z, 10*mm) and x > 9.9*mm and x < 30.1*mm and y > 9.9*mm and y < 30.1*mm end) end
)" + joint),
                         "touch on");
  };
  const std::string spring = ", x = 1e7, y = 1e7, z = 1e7, about_x = 100, about_y = 100, about_z = 100 })";
  for (const std::string on : {"{ plate:face 'zmax', block:face 'zmin' }", "{ under(plate), under(block) }"}) {
    EXPECT_TRUE(said("table.insert(supports, support.spring{ name = 'spring', on = " + on + spring).empty()) << on;
    EXPECT_TRUE(said("table.insert(supports, support.equation{ name = 'sum', on = " + on +
                     ", x = true, y = true, z = true, factors = { 1, -1 } })")
                    .empty())
        << on;
  }
  EXPECT_TRUE(
      said("interfaces = { interface.bonded{ name = 'mean', between = { plate:face 'zmax', block:face 'zmin' }, "
           "motion = 'mean' } }")
          .empty());
  const std::vector<std::string> left =
      said("table.insert(supports, support.spring{ name = 'spring', on = { half(plate), half(block) }" + spring);
  ASSERT_EQ(left.size(), 1u);
  EXPECT_NE(left[0].find("touch on 200 mm^2 without an interface"), std::string::npos) << left[0];
  // A spring to the ground, or to a third part, joins nothing.
  EXPECT_EQ(said("table.insert(supports, support.spring{ name = 'spring', on = block:face 'zmin'" + spring).size(), 1u);
}

// A row of two tied blocks slides along another: across the seam a block is not in the one beside that below it.
TEST(Unjoined, parts_that_slide_over_the_seam_of_tied_ones_are_not_named) {
  EXPECT_TRUE(said_of_run(R"(
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local cube = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 3, 3, 3 } }
local function block(name, x, z, speed)
  return substructure{ name = name, mesh = cube, material = steel, place = { x, 0, z }, velocity = { speed, 0, 0 } }
end
local a, b, c, d = block("a", 0, 0, 0), block("b", 10*mm, 0, 0), block("c", 0, 10*mm, 10), block("d", 10*mm, 10*mm, 10)
local floor = support.fixed{ name = "floor", on = { a:face "zmin", b:face "zmin" } }
problem{ name = "rows", substructures = { a, b, c, d }, supports = { floor },
  interfaces = { interface.bonded{ name = "lower", between = { a:face "xmax", b:face "xmin" } },
                 interface.bonded{ name = "upper", between = { c:face "xmax", d:face "xmin" } },
                 interface.contact{ name = "left", between = { a:face "zmax", c:face "zmin" } },
                 interface.contact{ name = "right", between = { b:face "zmax", d:face "zmin" } } },
  steps = { step.dynamic{ name = "slide", duration = 20*us, dt = 1*us } } }:run{}
)",
                          "pass")
                  .empty());
}

TEST(Unjoined, parts_that_overlap_are_named_with_depth) {
  const std::vector<std::string> overlap = said_of_check(blocks_at("{ 10*mm, 10*mm, 6*mm }", ""), "overlap");
  ASSERT_EQ(overlap.size(), 1u);
  EXPECT_NE(overlap[0].find("substructures 'plate' and 'block' overlap, up to 4 mm deep at ("), std::string::npos)
      << overlap[0];
  EXPECT_NE(overlap[0].find("in about 1.6e+03 mm^3 between (10"), std::string::npos) << overlap[0];  // 20 x 20 x 4
}

// A pattern whose angle brings its last copies back onto the first ones: no face of one is inside the other.
TEST(Unjoined, parts_in_the_same_place_are_named) {
  const auto ring = [](const std::string& angle) {
    return R"(
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local one = substructure{ name = "p", material = steel, place = { 30*mm, 0, 0 }, mesh = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 2, 2, 2 } } }
local all, on = pattern.circle{ n = 5, angle = )" +
           angle + R"(, axis = { 0, 0, 1 }, of = one }, {}
for i = 1, 5 do on[i] = all[i]:face "zmin" end
problem{ name = "ring", substructures = { all }, supports = { support.fixed{ name = "floor", on = on } }, outputs = { output.energy{} },
  steps = { step.static{ name = "s", loads = { load.gravity{ z = -9.81 } } } } }:run{}
)";
  };
  const std::vector<std::string> overlap = said_of_check(ring("90*deg"), "occupy the same place");
  ASSERT_EQ(overlap.size(), 1u);
  EXPECT_NE(overlap[0].find("substructures 'p[1]' and 'p[5]' overlap"), std::string::npos) << overlap[0];
  EXPECT_TRUE(said_of_check(ring("72*deg"), "same place").empty());
}

// A column in one volume: two boxes of 20 mm above each other, `apart` mm between them, joined or not. `mesh` says how.
std::string column_of(const std::string& mesh, double apart) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("dygita_column_" + std::to_string(getpid()) + ".geo");
  std::ofstream(file) << "SetFactory(\"OpenCASCADE\");\nBox(1) = {0,0,0, 10,10,20};\nBox(2) = {0,0," << 20 + apart
                      << ", 10,10,20};\n"
                      << mesh << "\nMesh.CharacteristicLengthMax = 5;\nPhysical Volume(\"column\") = {1,2};\n";
  return R"(
local file = mesh.gmsh{ file = ")" +
         file.string() + R"(", unit = mm, order = 2 }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local a = substructure{ name = "column", mesh = file:volume "column", material = steel }
local base = support.fixed{ name = "base", on = a:face{ normal = { 0, 0, -1 }, at = 0 } }
problem{ name = "column", substructures = { a }, supports = { base }, outputs = { output.energy{} },
  steps = { step.static{ name = "s", loads = { load.gravity{ x = -9.81 } } } } }:run{}
)";
}

TEST(Unjoined, pieces_of_a_part_that_touch_without_sharing_nodes_are_refused) {
  for (const auto& [mesh, said] :
       {std::pair<std::string, std::string>{"", "cells of its mesh meet on 100 mm^2 without sharing nodes and facets"},
        {"Characteristic Length{ PointsOf{ Volume{2}; } } = 3;", "cells of its mesh meet on 100 mm^2"}}) {
    try {
      said_of_check(column_of(mesh, 0.0), "");
      FAIL() << "accepted";
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("substructure 'column': " + said), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("it is in 2 pieces"), std::string::npos) << error.what();
    }
  }
  EXPECT_TRUE(said_of_check(column_of("Coherence;", 0.0), "pieces").empty());
}

// Its upper sides are at two heights.
TEST(Unjoined, a_face_picked_by_its_normal_on_a_stepped_part_is_told) {
  const auto said = [](const std::string& more) {
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("dygita_step_" + std::to_string(getpid()) + ".geo");
    std::ofstream(file)
        << "SetFactory(\"OpenCASCADE\");\nBox(1) = {0,0,0, 40,10,5};\nBox(2) = {0,0,5, 5,10,30};\nCoherence;\n"
           "Mesh.CharacteristicLengthMax = 5;\nPhysical Volume(\"bracket\") = {1,2};\n";
    return said_of_check(R"(
local file = mesh.gmsh{ file = ")" +
                             file.string() +
                             R"(", unit = mm, order = 2 }
local steel = material.elastic{ name = "steel", young = 200*GPa, poisson = 0.3, density = 7800 }
local a = substructure{ name = "bracket", mesh = file:volume "bracket", material = steel }
local base = support.fixed{ name = "base", on = a:face{ normal = { 0, 0, -1 } } }
local top = load.pressure{ on = a:face{ normal = { 0, 0, 1 })" +
                             more + R"( }, history = 1*MPa }
problem{ name = "p", substructures = { a }, supports = { base }, outputs = { output.energy{} }, steps = { step.static{ name = "s", loads = { top } } } }:run{}
)",
                         "heights");
  };
  const std::vector<std::string> told = said("");
  ASSERT_EQ(told.size(), 1u);
  EXPECT_NE(told[0].find("face (normal 0 0 1) is surfaces at 2 heights: "), std::string::npos) << told[0];
  EXPECT_NE(told[0].find("facets, 350 mm^2 around (22.5, 5, 5) mm (at = 0.005); "), std::string::npos) << told[0];
  EXPECT_NE(told[0].find("facets, 50 mm^2 around (2.5, 5, 35) mm (at = 0.035); 'at' selects one"), std::string::npos)
      << told[0];
  EXPECT_TRUE(said(", at = 35*mm").empty());
  EXPECT_TRUE(said(", where = function() return true end").empty());
}

TEST(Unjoined, pieces_of_a_part_that_are_apart_are_named) {
  const std::vector<std::string> said = said_of_check(column_of("", 8.0), "pieces");
  ASSERT_EQ(said.size(), 1u);
  EXPECT_NE(said[0].find("substructure 'column' is in 2 pieces that share no nodes"), std::string::npos) << said[0];
  EXPECT_NE(said[0].find("from (0, 0, 28) to (10, 10, 48) mm; some have no interface and no support"),
            std::string::npos)
      << said[0];
}

TEST(Unjoined, faces_of_one_size_a_cell_apart_are_named) {
  const std::string contact =
      "interfaces = { interface.contact{ name = 'seat', between = { plate:face 'zmax', block:face 'zmin' } } }";
  EXPECT_TRUE(said_of_check(blocks_at("{ 15*mm, 10*mm, 10*mm }", contact), "shifted").empty()) << "faces of two sizes";
  std::string equal = blocks_at("{ 5*mm, 0, 10*mm }", contact);
  equal.replace(equal.find("{ 20*mm, 20*mm, 20*mm }, cells = { 4, 4, 4 }"), 44,
                "{ 40*mm, 40*mm, 20*mm }, cells = { 8, 8, 4 }");
  const std::vector<std::string> shifted = said_of_check(equal, "shifted");
  ASSERT_EQ(shifted.size(), 1u);
  EXPECT_NE(
      shifted[0].find("joins two faces of one size, plate.zmax and block.zmin, of which 87.5 % coincide: the second is "
                      "shifted by (5, 0, 0) mm"),
      std::string::npos)
      << shifted[0];
}

TEST(Unjoined, a_face_in_an_interface_and_under_a_support_is_named) {
  const std::vector<std::string> both = said_of_check(
      blocks_at(
          "{ 10*mm, 10*mm, 10*mm }",
          "interfaces = { interface.contact{ name = 'seat', between = { plate:face 'zmax', block:face 'zmin' } } }\n"
          "supports = { base, support.fixed{ name = 'lid', on = plate:face 'zmax' } }"),
      "under support");
  ASSERT_EQ(both.size(), 1u);
  EXPECT_NE(both[0].find("16 of 16 facets of interface.contact 'seat' are also under support.fixed 'lid' (plate.zmax)"),
            std::string::npos)
      << both[0];
}

TEST(Unjoined, a_pressure_on_a_bonded_face_is_named_and_one_in_a_joint_is_not) {
  const auto said = [](const std::string& kind) {
    std::string text = blocks_at(
        "{ 10*mm, 10*mm, 10*mm }",
        "interfaces = { interface." + kind + "{ name = 'seat', between = { plate:face 'zmax', block:face 'zmin' } } }");
    text.replace(text.find("dt = 1*us"), 9,
                 "dt = 1*us, loads = { load.pressure{ on = plate:face 'zmax', history = 1*MPa } }");
    return said_of_check(text, "load.pressure");
  };
  const std::vector<std::string> bonded = said("bonded");
  ASSERT_EQ(bonded.size(), 1u);
  EXPECT_NE(bonded[0].find("load.pressure acts on plate.zmax, of whose 64 facets 16 are bonded to 'block' by "
                           "interface.bonded 'seat'"),
            std::string::npos)
      << bonded[0];
  EXPECT_TRUE(said("contact").empty());
}

TEST(Unjoined, two_laws_on_one_pair_of_faces_are_refused) {
  const std::string two = R"(interfaces = {
  interface.contact{ name = 'seat', between = { plate:face 'zmax', block:face 'zmin' } },
  interface.bonded{ name = 'glue', between = { block:face 'zmin', plate:face 'zmax' } } }
)";
  try {
    said_of_check(blocks_at("{ 10*mm, 10*mm, 10*mm }", two), "");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "drop.lua:10: 'glue' and 'seat' share facets of substructure 'block': a facet can be in one interface "
                 "or wall only");
  }
}

// A bar whose end is pulled and let go: its free oscillation decays by the ratio asked for.
TEST(Damping, of_a_ratio_is_that_of_a_free_oscillation) {
  const double pi = 3.14159265358979;
  // First mode of a bar held at one end: a quarter of a wave, sqrt(E/rho) / (4 L) = 5 kHz.
  for (const std::string frequency : {"5*kHz", "{ 5*kHz, 10*kHz }"}) {
    const std::vector<DeckRun> runs = run_text(R"(
local steel = material.elastic{ name = "s", young = 200*GPa, poisson = 0, density = 8000, damping_ratio = 0.03, damping_frequency = )" +
                                               frequency + R"( }
local bar = substructure{ name = "bar", material = steel, mesh = mesh.box{ size = { 5*mm, 5*mm, 250*mm }, cells = { 1, 1, 50 } } }
local base = support.fixed{ name = "base", on = bar:face "zmin" }
local pull = load.traction{ on = bar:face "zmax", z = 10*MPa }
local hold = step.static{ name = "hold", loads = { pull } }
local ring = step.dynamic{ name = "ring", after = hold, duration = 2*ms, dt = 2*us }
local u = output.history{ name = "u", on = bar:face "zmax", quantity = "displacement", direction = { 0, 0, 1 } }
problem{ name = "bar", substructures = { bar }, supports = { base }, steps = { hold, ring }, outputs = { u } }:run{}
)");
    const Table& table = runs.at(0).table("u");
    const std::vector<double>&t = table.columns[0], &u = table.columns[1];
    const auto peak_near = [&](double at) {
      double best = 0.0;
      for (size_t i = 0; i < t.size(); ++i)
        if (std::abs(t[i] - at) < 20e-6 && table.step[i] == 1) best = std::max(best, u[i]);
      return best;
    };
    // Peaks of the first mode one period apart; the others have died away by then.
    const double decrement = std::log(peak_near(1600e-6) / peak_near(1800e-6));
    EXPECT_NEAR(decrement / (2.0 * pi), 0.03, 0.0006) << frequency;
  }
}

}  // namespace

}  // namespace dygita::test::unjoined_tests
