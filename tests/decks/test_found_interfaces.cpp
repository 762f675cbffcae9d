// Interfaces between parts whose touching faces the program finds.
#include <gtest/gtest.h>

#include <cmath>

#include "base/warnings.hpp"
#include "decks/deck_prints.hpp"

namespace dygita::test {

namespace {

// A plate that is held, a block on it and a lid on that, pressed down by 400 N and sideways by 40 N.
std::string tower(const std::string& block_cells, const std::string& order, const std::string& lid_place,
                  const std::string& interfaces) {
  return R"(
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local function part(name, size, cells, place, order)
  return substructure{ name = name, material = steel, place = place, mesh = mesh.box{ size = size, cells = cells, order = order } }
end
local plate = part("plate", { 40*mm, 40*mm, 10*mm }, { 8, 8, 2 }, { 0, 0, 0 })
local block = part("block", { 20*mm, 20*mm, 20*mm }, )" +
         block_cells + ", { 10*mm, 10*mm, 10*mm }, " + order + R"()
local lid = part("lid", { 20*mm, 20*mm, 5*mm }, { 4, 4, 1 }, )" +
         lid_place + R"()
)" + interfaces +
         R"(
local base = support.fixed{ name = "base", on = plate:face "zmin" }
local press = step.static{ name = "press", loads = { load.pressure{ on = lid:face "zmax", history = 1*MPa }, load.traction{ on = lid:face "zmax", x = 0.1*MPa } } }
problem{ name = "tower", substructures = { plate, { block, lid } }, interfaces = all, supports = { base }, steps = { press },
         outputs = { output.resultant{ name = "lower", on = all[1] }, output.resultant{ name = "upper", on = all[2] },
                     output.resultant{ name = "both", on = all }, output.history{ name = "top", on = lid:face "zmax", quantity = "displacement" } } }:run{}
)";
}

const std::string on_top = "{ 10*mm, 10*mm, 30*mm }";
const std::string by_face = R"(
local all = { interface.contact{ name = "a", between = { plate:face "zmax", block:face "zmin" }, friction = 0.3 },
              interface.contact{ name = "b", between = { block:face "zmax", lid:face "zmin" }, friction = 0.3 } })";
const std::string by_part = R"(
local all = { interface.contact{ name = "a", between = { plate, block }, friction = 0.3 },
              interface.contact{ name = "b", between = { block:face "zmax", lid }, friction = 0.3 } })";
const std::string all_at_once = R"(
local all = interface.contact{ between = "all touching", friction = 0.3 }
assert(#all == 2 and all["plate/block"] == all[1] and all["block/lid"] == all[2]))";

// The first side comes first, whatever the order of the deck; pairs of one side are left alone.
const std::string by_names = R"(
local upper = interface.contact{ between = { { lid, "plate" }, "bl*k" }, except = { { "plate", block } }, friction = 0.3 }
assert(#upper == 1 and upper["lid/block"] == upper[1])
local lower = interface.contact{ name = "low", between = { "*", { block } }, friction = 0.3 }
assert(#lower == 1 and lower["plate/block"] == lower[1])
local all = { lower[1], upper[1] })";

TEST(FoundInterfaces, give_what_the_named_faces_give) {
  for (const std::string cells : {"{ 4, 4, 4 }", "{ 7, 7, 5 }"}) {
    const DeckRun named = run_text(tower(cells, "1", on_top, by_face)).at(0);
    for (const std::string& found : {by_part, all_at_once, by_names}) {
      const DeckRun run = run_text(tower(cells, "1", on_top, found)).at(0);
      EXPECT_TRUE(run.result->converged);
      for (const char* column : {"x", "y", "z"})
        EXPECT_NEAR(run.column("top", column).back(), named.column("top", column).back(), 1e-13) << cells;
    }
  }
}

TEST(FoundInterfaces, carry_all_of_a_load_with_cells_of_order_two_and_parts_that_are_turned) {
  const std::string turned = "{ translate = { 20*mm, 6*mm, 30*mm }, rotate = { axis = { 0, 0, 1 }, angle = 45*deg } }";
  for (const std::string& place : {on_top, turned}) {
    const DeckRun run = run_text(tower("{ 5, 5, 3 }", "2", place, all_at_once)).at(0);
    EXPECT_TRUE(run.result->converged);
    EXPECT_NEAR(run.column("lower", "normal").back(), -400.0, 1e-3);
    EXPECT_NEAR(run.column("upper", "normal").back(), -400.0, 1e-3);
    EXPECT_NEAR(run.column("lower", "shear").back(), 40.0, 1e-3);
    EXPECT_NEAR(run.column("both", "normal").back(), -800.0, 2e-3);
  }
}

TEST(FoundInterfaces, leave_alone_pairs_that_have_their_own_or_are_excepted) {
  const std::string own = R"(
local glue = interface.bonded{ name = "glue", between = { lid, block } }
local all = { glue, interface.contact{ between = "all touching", friction = 0.3 }[1] })";
  const DeckRun run = run_text(tower("{ 7, 7, 5 }", "1", on_top, own)).at(0);
  ASSERT_EQ(run.problem.interfaces.size(), 2u);
  EXPECT_EQ(run.problem.interfaces[1]->name, "plate/block");
  for (const std::string except : {"{ { block, lid } }", "{ glue }", "{ lid }"}) {
    const std::string excepted =
        "\nlocal glue = interface.bonded{ name = 'glue', between = { lid, block } }\n"
        "local found = interface.contact{ name = 'c', between = 'all touching', friction = 0.3, except = " +
        except + " }\nassert(#found == 1 and found['plate/block'] == found[1])\nlocal all = { found[1], glue }\n";
    const DeckRun other = run_text(tower("{ 7, 7, 5 }", "1", on_top, excepted)).at(0);
    ASSERT_EQ(other.problem.interfaces.size(), 2u);
    EXPECT_EQ(other.problem.interfaces[0]->name, "c plate/block");
    EXPECT_NEAR(other.column("top", "z").back(), run.column("top", "z").back(), 1e-14);
  }
}

// Two plates and two bolts from CAD with clearance holes: five contacts, no other, of parts turned and copied too.
TEST(FoundInterfaces, of_a_cad_assembly_are_where_its_solids_touch) {
  const std::string text = R"(
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local file = mesh.step{ file = ")" +
                           (std::filesystem::path(DYGITA_SOURCE_DIR) / "meshes" / "joint.step").string() +
                           R"(", size = 6*mm }
local turn = { rotate = { axis = { 1, 2, 3 }, angle = 40*deg } }
local function part(name) return substructure{ name = name, mesh = file:part(name), material = steel, place = turn } end
local lower, upper, bolt1, bolt2 = part "lower", part "upper", part "bolt1", part "bolt2"
local all = interface.contact{ between = "all touching", friction = 0.2 }
for _, contact in ipairs(all) do print(contact.name .. ": 1") end
print(("found: %d"):format(#all))
)";
  testing::internal::CaptureStdout();
  EXPECT_TRUE(run_text(text).empty());
  const std::string said = testing::internal::GetCapturedStdout();
  EXPECT_NE(said.find("found: 5"), std::string::npos) << said;
  for (const std::string pair : {"lower/upper", "lower/bolt1", "lower/bolt2", "upper/bolt1", "upper/bolt2"})
    EXPECT_NE(said.find("'" + pair + "': "), std::string::npos) << said;
  const double pi = std::acos(-1.0), hole = pi * 4.5 * 4.5;
  const auto area = [&](const std::string& pair) {
    return std::strtod(said.c_str() + said.find("'" + pair + "': ") + pair.size() + 4, nullptr);
  };
  EXPECT_NEAR(area("lower/upper"), 80 * 40 - 2 * hole, 0.002 * 80 * 40);
  EXPECT_NEAR(area("upper/bolt1"), pi * 6.5 * 6.5 - hole, 0.01 * pi * 6.5 * 6.5);
}

// Two plates on each other, held by their sides, pressed: cells of any kind give the same way down.
TEST(FoundInterfaces, of_plates_from_cad_are_the_same_with_hexahedra) {
  const auto sinks = [](const std::string& cells) {
    const DeckRun run =
        run_text(R"(
local joint = mesh.step{ file = ")" +
                 std::string(DYGITA_SOURCE_DIR) + R"(/meshes/joint.step", size = 6*mm, cells = ")" + cells + R"(" }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local lower = substructure{ name = "lower", mesh = joint:part "lower", material = steel }
local upper = substructure{ name = "upper", mesh = joint:part "upper", material = steel }
local top = output.history{ name = "top", on = upper:face{ normal = { 0, 0, 1 }, at = 18*mm }, quantity = "displacement", direction = { 0, 0, 1 } }
problem{ name = "plates", substructures = { lower, upper },
  interfaces = { interface.contact{ name = "mating", between = { lower, upper }, friction = 0.2 } },
  supports = { support.fixed{ name = "ends", on = { lower:face{ normal = { 1, 0, 0 }, at = 40*mm }, lower:face{ normal = { -1, 0, 0 }, at = 40*mm } } } },
  steps = { step.static{ name = "press", loads = { load.pressure{ on = upper:face{ normal = { 0, 0, 1 }, at = 18*mm }, history = 10*MPa } } } },
  outputs = { top } }:run{}
)")
            .at(0);
    EXPECT_TRUE(run.result->converged);
    return run.column("top", "displacement").back();
  };
  const double tetrahedra = sinks("tetrahedra"), hexahedra = sinks("hexahedra where possible");
  std::cout << "top goes down by " << 1e6 * tetrahedra << " um (tetrahedra), " << 1e6 * hexahedra
            << " um (hexahedra)\n";
  EXPECT_LT(tetrahedra, 0.0);
  EXPECT_NEAR(hexahedra, tetrahedra, 0.01 * std::abs(tetrahedra));
}

TEST(FoundInterfaces, between_parts_that_are_a_little_apart_say_that_the_gap_is_left_out) {
  const auto said_of = [](const std::string& interfaces, const std::string& place) {
    testing::internal::CaptureStderr();
    run_text(tower("{ 4, 4, 4 }", "1", place, interfaces));
    return testing::internal::GetCapturedStderr();
  };
  for (const std::string& interfaces : {by_part, all_at_once}) {
    const std::string said = said_of(interfaces, "{ 10*mm, 10*mm, 30.02*mm }");
    EXPECT_NE(said.find("are apart by up to 0.02 mm, which is neglected"), std::string::npos) << said;
    EXPECT_NE(said.find("gap = \"geometry\" keeps the actual gap"), std::string::npos) << said;
    EXPECT_EQ(said_of(interfaces, on_top).find("are apart"), std::string::npos);
  }
}

// Each case of a study finds what the one before it has found.
TEST(FoundInterfaces, of_a_second_case_are_those_of_the_first) {
  const std::vector<DeckRun> runs = run_text(R"(
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local cube = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 2, 2, 2 } }
local parts = {}
for i = 1, 3 do parts[i] = substructure{ name = "cube " .. i, mesh = cube, material = steel, place = { 0, 0, 10*mm * i } } end
local glue = interface.bonded{ name = "glue", between = { parts[1], parts[2] } }
local base = support.fixed{ name = "base", on = parts[1]:face "zmin" }
for i, mu in ipairs{ 0.1, 0.3 } do
  local rest = interface.contact{ between = "all touching", friction = mu }
  assert(#rest == 1 and rest["cube 2/cube 3"])
  problem{ name = "tower", substructures = parts, interfaces = { glue, rest }, supports = { base }, outputs = { output.energy{} },
    steps = { step.static{ name = "press", loads = { load.pressure{ on = parts[3]:face "zmax", history = 1*MPa } } } } }:run{ case = "mu " .. i }
end
)");
  ASSERT_EQ(runs.size(), 2u);
  for (const DeckRun& run : runs) EXPECT_EQ(run.problem.interfaces.size(), 2u);
}

// A quarter of a shaft in a hub, 20 um larger than its hole or as large: faces named, nothing said of a gap.
TEST(FoundInterfaces, of_round_faces_that_are_named_say_an_interference_that_is_drawn) {
  const auto said_of = [](const std::string& over, const std::string& gap) {
    const std::string text = R"(
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local file = mesh.gmsh{ file = ")" +
                             std::string(DYGITA_SOURCE_DIR) + R"(/tests/decks/drawn_rings.geo", set = { over = )" +
                             over + R"(, n = 4 }, order = 2 }
local function part(name) return substructure{ name = name, mesh = file:volume(name), material = steel } end
local inner, outer = part "inner", part "outer"
local function round(of) local face = of:face{ cylinder = true, radius = 20*mm } return face end
local fit = interface.contact{ name = "fit", between = { round(inner), round(outer) }, gap = )" +
                             gap + R"( }
)";
    testing::internal::CaptureStderr();
    run_text(text);
    tell_warnings();
    return testing::internal::GetCapturedStderr();
  };
  const std::string said = said_of("20*um", "0");
  EXPECT_NE(said.find("overlap by up to 0.02 mm, which a static step presses apart, as that of the round surfaces"),
            std::string::npos)
      << said;
  EXPECT_NE(said.find("(a gap of -0.02 mm on average over 62.8"), std::string::npos) << said;
  EXPECT_NE(said_of("-20*um", "0").find("are apart by up to 0.02"), std::string::npos);
  for (const auto& [over, gap] : {std::pair{"20*um", "-20*um"}, {"0", "0"}})
    for (const char* told : {"is neglected", "is kept", "presses apart"})
      EXPECT_EQ(said_of(over, gap).find(told), std::string::npos) << over;
}

// Two shafts in their hubs, found: each is told once, and both together.
TEST(FoundInterfaces, of_round_faces_tell_what_is_kept_once) {
  const std::string text = R"(
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local file = mesh.gmsh{ file = ")" +
                           std::string(DYGITA_SOURCE_DIR) +
                           R"(/tests/decks/drawn_rings.geo", set = { over = 8*um, n = 4 }, order = 2 }
for i = 1, 2 do for _, name in ipairs{ "inner", "outer" } do
  substructure{ name = name .. i, mesh = file:volume(name), material = steel, place = { 0, 0, 100*mm * i } }
end end
local fits = interface.contact{ between = "all touching" }
assert(#fits == 2)
)";
  testing::internal::CaptureStderr();
  run_text(text);
  tell_warnings();
  const std::string said = testing::internal::GetCapturedStderr();
  const size_t first = said.find("overlap by up to 0.008 mm, which a static step presses apart");
  EXPECT_NE(first, std::string::npos) << said;
  EXPECT_EQ(said.find("presses apart", first + 70), std::string::npos) << said;
  EXPECT_NE(said.find("\n    the worst of 2 of this kind; the other: 'inner"), std::string::npos) << said;
}

// A pair that is declared by names before a study is the deck's, for all of its cases.
TEST(FoundInterfaces, by_names_hold_for_all_cases_that_follow) {
  const std::string study = R"(
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local cube = mesh.box{ size = { 10*mm, 10*mm, 10*mm }, cells = { 1, 1, 1 } }
local parts = {}
for i, name in ipairs{ "low", "mid", "up" } do parts[i] = substructure{ name = name, mesh = cube, material = steel, place = { 0, 0, i*10*mm } } end
local glue = interface.bonded{ name = "glue", between = { "mid", "up" } }
for i, mu in ipairs{ 0.1, 0.2 } do
  local rest = interface.contact{ between = "all touching", friction = mu }
  assert(#rest == 1)
  problem{ name = "study", substructures = parts, interfaces = { glue, rest }, supports = { support.fixed{ name = "base", on = parts[1]:face "zmin" } },
    steps = { step.static{ name = "press", loads = { load.pressure{ on = parts[3]:face "zmax", history = 1*MPa } } } } }:run{ case = "case" .. i }
end
)";
  EXPECT_EQ(run_text(study).size(), 2u);
}

}  // namespace

}  // namespace dygita::test
