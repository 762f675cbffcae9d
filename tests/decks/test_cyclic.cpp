// One sector of a ring (interface.cyclic) against the whole ring.
#include <gtest/gtest.h>
#include <spdlog/fmt/fmt.h>

#include <cmath>

#include "base/error.hpp"
#include "decks/engine.hpp"
#include "foreign/written_file.hpp"

namespace dygita::test::cyclic_tests {
namespace {

DeckRun ring(Settings settings, const std::string& whole, const std::string& solver = "") {
  settings.emplace_back("whole", whole);
  return run_file(deck("verification/ring_sector.lua"), settings, 0, solver).at(0);
}

double apart(const DeckRun& a, const DeckRun& b, const std::string& name, const std::vector<std::string>& columns) {
  double size = 0.0, most = 0.0;
  for (const std::string& column : columns) {
    const std::vector<double>&of_a = a.column(name, column), &of_b = b.column(name, column);
    EXPECT_EQ(of_a.size(), of_b.size());
    size = std::max(size, largest(of_a));
    for (size_t i = 0; i < of_a.size(); ++i) most = std::max(most, std::abs(of_a[i] - of_b[i]));
  }
  return most / size;
}

const std::vector<std::string> axes = {"x", "y", "z"};

// Base and skin meet the cuts in lines where one of the ties is redundant.
TEST(Cyclic, sector_rests_as_the_ring_does) {
  for (const Settings& settings : {Settings{{"joint", "1"}, {"shock", "0"}}, Settings{{"shock", "0"}},
                                   Settings{{"shock", "0"}, {"order", "2"}}, Settings{{"shock", "0"}, {"free", "1"}}}) {
    const DeckRun sector = ring(settings, "0"), whole = ring(settings, "1");
    for (const char* name : {"tip", "wall"}) EXPECT_LT(apart(whole, sector, name, axes), 1e-6) << settings[1].first;
  }
}

TEST(Cyclic, sector_is_shaken_as_the_ring_is) {
  for (const Settings& settings : {Settings{{"joint", "1"}}, Settings{}}) {
    const DeckRun sector = ring(settings, "0"), whole = ring(settings, "1");
    for (const char* name : {"tip", "wall"}) EXPECT_LT(apart(whole, sector, name, axes), 1e-5);
    EXPECT_LT(apart(whole, sector, "spectrum z", {"maximax"}), 1e-5);
  }
}

// In whatever order a deck names the faces.
TEST(Cyclic, unlike_meshes_of_the_cuts_are_those_of_the_ring) {
  for (const Settings& unlike :
       {Settings{{"fine", "3"}}, Settings{{"fine", "4"}}, Settings{{"fine", "3"}, {"order", "2"}}}) {
    Settings settings = unlike;
    settings.emplace_back("shock", "0");
    const DeckRun whole = ring(settings, "1"), sector = ring(settings, "0");
    settings.emplace_back("swap", "1");
    const DeckRun swapped = ring(settings, "0");
    for (const char* name : {"tip", "wall"}) {
      EXPECT_LT(apart(whole, sector, name, axes), 1e-6);
      EXPECT_LT(apart(whole, swapped, name, axes), 1e-6);
    }
  }
}

// Two rings on each other under pressure: what joins them may open where it reaches the cut, so that both cuts hold
// there. All is the same around the axis, on the cut and in the middle of the sector.
TEST(Cyclic, cuts_hold_where_a_joint_reaches_them) {
  for (const char* joint : {"contact{ friction = 0, ", "contact{ friction = 0.2, ", "bonded{ ",
                            "bushing{ normal = 1e12, tangential = 2e11, "}) {
    const DeckRun run =
        run_text(
            R"(
local alloy = material.elastic{ name = "alloy", young = 70*GPa, poisson = 0.3, density = 2700 }
local function ring(name, low)
  local wedge = mesh.gmsh{ file = ")" +
            std::string(DYGITA_SOURCE_DIR) + "/meshes/wedge.geo" +
            R"(", set = { inner = 30*mm, outer = 50*mm, low = low, high = low + 10*mm, from = 0, to = 45, n_radial = 4, n_around = 6, n_high = 3 } }
  local part = substructure{ name = name, mesh = wedge:volume "wedge", material = alloy }
  return part, interface.cyclic{ name = "cut of " .. name, between = { part:face "left", part:face "right" }, axis = { 0, 0, 1 }, n = 8 }
end
local low, cut_low = ring("low", 0)
local high, cut_high = ring("high", 10*mm)
local foot = interface.)" +
            joint + R"(name = "foot", between = { low:face "top", high:face "bottom" } }
local press = step.static{ name = "press", increments = 4, loads = { load.pressure{ on = high:face "top", history = 40*MPa }, load.pressure{ on = high:face "inner", history = 20*MPa } } }
local function at(degrees)
  local x, y = 50*mm * math.cos(degrees*deg), 50*mm * math.sin(degrees*deg)
  return output.history{ name = tostring(degrees == 0 and "cut" or "middle"), on = high:where(function(X, Y, Z) return near(X, x) and near(Y, y) and near(Z, 10*mm) end),
                         quantity = "displacement" }
end
problem{ name = "rings", substructures = { low, high }, interfaces = { foot, cut_low, cut_high }, supports = { support.fixed{ name = "base", on = low:face "bottom" } },
  steps = { press }, outputs = { at(0), at(22.5) } }:run{}
)")
            .at(0);
    const double cut = run.column("cut", "x").back(),
                 middle = std::hypot(run.column("middle", "x").back(), run.column("middle", "y").back());
    EXPECT_GT(middle, 1e-6) << joint;
    EXPECT_NEAR(cut, middle, 1e-4 * middle) << joint;
  }
}

TEST(Cyclic, other_solvers_have_it_too) {
  const DeckRun latin = ring({}, "0"), monolithic = ring({}, "0", "monolithic"), whole = ring({}, "1", "monolithic");
  for (const char* name : {"tip", "wall"}) {
    EXPECT_LT(apart(whole, monolithic, name, axes), 1e-6);
    EXPECT_LT(apart(monolithic, latin, name, axes), 5e-3);  // which is explicit there, with another error in time
  }
  const DeckRun classic = ring({{"joint", "1"}}, "0", "explicit"), of_ring = ring({{"joint", "1"}}, "1", "explicit");
  for (const char* name : {"tip", "wall"}) EXPECT_LT(apart(of_ring, classic, name, axes), 0.02);  // penalty springs
}

// What the cuts carry across the hoop: 5 MPa in the bore of 30 mm over 10 mm of height, less what goes elsewhere.
TEST(Cyclic, forces_are_those_on_the_first_face) {
  const Settings settings = {{"shock", "0"}, {"free", "1"}, {"joint", "1"}};
  const DeckRun sector = ring(settings, "0"), whole = ring(settings, "1");
  EXPECT_LT(apart(whole, sector, "cut", {"x", "y"}), 1e-6);
  const double x = sector.column("cut", "x").back(), y = sector.column("cut", "y").back();
  EXPECT_GT(std::hypot(x, y), 500.0);
}

// Modes that all sectors have alike are modes of the ring, and the sector has an eighth of their masses.
TEST(Cyclic, modes_are_those_of_the_ring) {
  for (const char* free : {"0", "1"}) {
    const Settings settings = {{"shock", "0"}, {"free", free}, {"joint", "1"}};
    Settings of_ring = settings, of_sector = settings;
    of_sector.emplace_back("modes", "4");
    of_ring.emplace_back("modes", "40");
    const DeckRun sector = ring(of_sector, "0"), whole = ring(of_ring, "1");
    const std::vector<double>&own = sector.column("modes", "frequency"), &all = whole.column("modes", "frequency");
    for (size_t i = 0; i < own.size(); ++i) {
      const double mass = sector.column("modes", "effective_z")[i];
      double nearest = 1e9, of_all = 0.0;
      for (size_t k = 0; k < all.size(); ++k) {
        if (std::abs(all[k] - own[i]) > 1e-6 * own[i] + 1e-6) continue;
        nearest = all[k];
        of_all += whole.column("modes", "effective_z")[k];
      }
      EXPECT_NEAR(nearest, own[i], 1e-6 * own[i] + 1e-6) << free;
      EXPECT_NEAR(of_all, 8 * mass, 1e-6 * 0.0903) << free;
      for (const char* across : {"effective_x", "effective_y"}) EXPECT_EQ(sector.column("modes", across)[i], 0.0);
    }
  }
}

// Places in files are rounded: faces that lie 0.1 um apart after the turn still turn about the axis with nothing to
// resist it.
TEST(Cyclic, sector_turns_freely_where_its_cuts_are_slightly_off) {
  for (const char* order : {"1", "2"}) {
    const DeckRun run = run_text(R"(
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local file = mesh.gmsh{ file = ")" +
                                 std::string(DYGITA_SOURCE_DIR) + R"(/meshes/wedge.geo", order = )" + order +
                                 R"(, set = { to = 45.0001, n_radial = 2, n_around = 4, n_high = 2 } }
local part = substructure{ name = "part", mesh = file:volume "wedge", material = steel }
local cut = interface.cyclic{ name = "cut", between = { part:face "left", part:face "right" }, axis = { 0, 0, 1 }, n = 8 }
problem{ name = "sector", substructures = { part }, interfaces = { cut }, steps = { step.static{ name = "rest" } },
         outputs = { output.modes{ name = "modes", n = 3 } } }:run{}
)")
                            .at(0);
    const std::vector<double>& f = run.column("modes", "frequency");
    ASSERT_EQ(f.size(), 3u);
    EXPECT_EQ(f[0], 0.0);
    EXPECT_EQ(f[1], 0.0) << order;
    EXPECT_GT(f[2], 5e3);
  }
}

// An eighth of a ring of two parts with unlike cells, which a file gives to a few digits.
std::string rounded_ring(int digits) {
  std::string nodes, cells, sets;
  int node = 0, cell = 0;
  for (const char* name : {"inner", "outer"}) {
    const bool is_inner = *name == 'i';
    const int n_around = is_inner ? 4 : 6, n_up = is_inner ? 2 : 3, first = node;
    cells += fmt::format("*ELEMENT, TYPE=C3D8I, ELSET={}\n", name);
    const auto at = [&](int i, int j, int k) { return first + 1 + (i * (n_around + 1) + j) * (n_up + 1) + k; };
    for (int i = 0; i <= 2; ++i)
      for (int j = 0; j <= n_around; ++j)
        for (int k = 0; k <= n_up; ++k) {
          const double r = (is_inner ? 30.0 : 40.0) + 5.0 * i, a = (7.0 + 45.0 * j / n_around) * M_PI / 180.0;
          nodes += fmt::format("{}, {:.{}g}, {:.{}g}, {:.{}g}\n", ++node, r * std::cos(a), digits, r * std::sin(a),
                               digits, 10.0 * k / n_up, digits);
          if (i == 2 || j == n_around || k == n_up) continue;
          cells += fmt::format("{}, {}, {}, {}, {}, {}, {}, {}, {}\n", ++cell, at(i, j, k), at(i + 1, j, k),
                               at(i + 1, j + 1, k), at(i, j + 1, k), at(i, j, k + 1), at(i + 1, j, k + 1),
                               at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1));
        }
    const auto set = [&](const char* face, auto&& is_on) {
      sets += fmt::format("*NSET, NSET={} {}\n", name, face);
      for (int i = 0; i <= 2; ++i)
        for (int j = 0; j <= n_around; ++j)
          for (int k = 0; k <= n_up; ++k)
            if (is_on(i, j)) sets += fmt::format("{},\n", at(i, j, k));
    };
    set("right", [](int, int j) { return j == 0; });
    set("left", [&](int, int j) { return j == n_around; });
    set("inside", [](int i, int) { return i == 0; });
    set("outside", [](int i, int) { return i == 2; });
    sets += fmt::format("*SOLID SECTION, ELSET={}, MATERIAL=steel\n", name);
  }
  return "*NODE\n" + nodes + cells + sets + "*MATERIAL, NAME=steel\n*ELASTIC\n210000, 0.3\n*DENSITY\n7.8e-9\n";
}

TEST(Cyclic, sector_is_free_about_its_axis_to_the_digits_of_a_file) {
  std::vector<double> exact;
  for (const int digits : {14, 8, 7, 6, 5}) {
    const WrittenFile file(rounded_ring(digits));
    const DeckRun run = run_text(fmt::format(R"(
local file = mesh.abaqus{{ file = "{}", unit = mm, units = "mm t s" }}
local function part(name) return substructure{{ name = name, mesh = file:part(name), material = file:material "steel" }} end
local inner, outer = part "inner", part "outer"
local function cut(of) return interface.cyclic{{ name = "cut of " .. of.name, between = {{ of:face(of.name .. " left"), of:face(of.name .. " right") }}, axis = {{ 0, 0, 1 }}, n = 8 }} end
local seam = interface.bonded{{ name = "seam", between = {{ inner:face "inner outside", outer:face "outer inside" }}, within = 0.5*mm }}
problem{{ name = "sector", substructures = {{ inner, outer }}, interfaces = {{ seam, cut(inner), cut(outer) }}, steps = {{ step.static{{ name = "rest" }} }},
         outputs = {{ output.modes{{ name = "modes", n = 4 }} }} }}:run{{}}
)",
                                             file.path()))
                            .at(0);
    const std::vector<double>& f = run.column("modes", "frequency");
    ASSERT_EQ(f.size(), 4u) << digits;
    if (exact.empty()) exact = f;
    EXPECT_EQ(f[0], 0.0) << digits;
    EXPECT_EQ(f[1], 0.0) << digits;
    for (const int m : {2, 3}) EXPECT_NEAR(f[m], exact[m], 5e-3 * exact[m]) << digits;
  }
}

TEST(Cyclic, the_turn_of_a_sector_is_called_a_turn) {
  testing::internal::CaptureStderr();
  ring({{"shock", "0"}, {"free", "1"}, {"joint", "1"}}, "0");
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_NE(said.find("rotation about the axis of the ring of substructure 'skin 1' is unconstrained"),
            std::string::npos)
      << said;
  EXPECT_EQ(said.find("translation along"), std::string::npos) << said;
}

// wedge(name, low): an eighth of a ring of steel, of few cells, from the height `low` on.
const std::string wedges = R"(
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local function wedge(name, low)
  return substructure{ name = name, material = steel, mesh = mesh.gmsh{ file = ")" +
                           std::string(DYGITA_SOURCE_DIR) + R"(/meshes/wedge.geo",
    set = { low = low, high = low + 0.01, n_radial = 1, n_around = 2, n_high = 1 } }:volume "wedge" }
end
)";

TEST(Cyclic, a_part_that_is_cut_and_not_tied_is_named) {
  for (const char* tied : {"0", "1"}) {
    testing::internal::CaptureStderr();
    run_text(wedges + R"(
local p = param{ tied = 0 }
local low, high = wedge("low", 0), wedge("high", 0.01)
local function cut(part) return interface.cyclic{ name = "cut of " .. part.name, between = { part:face "left", part:face "right" }, axis = { 0, 0, 1 }, n = 8 } end
local joints = { interface.bonded{ name = "seam", between = { low:face "top", high:face "bottom" } }, cut(low) }
if p.tied == 1 then joints[3] = cut(high) end
problem{ name = "sector", substructures = { low, high }, interfaces = joints, supports = { support.fixed{ name = "base", on = low:face "bottom" } },
         steps = { step.static{ name = "rest", loads = { load.gravity{ z = -9.81 } } } } }:run{}
)",
             {{"tied", tied}});
    const bool is_told = testing::internal::GetCapturedStderr().find(
                             "substructure 'high' has facets in both planes of the cuts of 'cut of low' and no "
                             "interface.cyclic") != std::string::npos;
    EXPECT_EQ(is_told, *tied == '0') << tied;
  }
}

TEST(Cyclic, faces_that_do_not_meet_are_refused) {
  try {
    run_text(wedges + R"(
local low, high = wedge("low", 0), wedge("high", 0.02)
local cut = interface.cyclic{ name = "cut", between = { low:face "left", high:face "right" }, axis = { 0, 0, 1 }, n = 8 }
local base = support.fixed{ name = "base", on = { low:face "bottom", high:face "bottom" } }
problem{ name = "sector", substructures = { low, high }, interfaces = { cut }, supports = { base },
         steps = { step.static{ name = "rest", loads = { load.gravity{ z = -9.81 } } } } }:run{}
)");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("'low.left' and 'high.right (turned)' do not meet"), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace dygita::test::cyclic_tests
