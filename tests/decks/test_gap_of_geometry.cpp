// A cylinder above a block, the gap between them that of the places (gap = "geometry"): pressed through a plate, by a
// force or by a bolt beside it, then hit. Every way to compute it sees the same gap.
#include <gtest/gtest.h>

#include "base/warnings.hpp"
#include "deck/continue_run.hpp"
#include "decks/engine.hpp"
#include "files/csv.hpp"

namespace dygita::test::gap_tests {
namespace {

namespace fs = std::filesystem;

std::string cylinder_on_block() {
  return R"(
local p = param{ geometry = 1, preload = 0, until_ = 3*us }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local R, a, n = 10*mm, 0.5*mm, 3
local thick = a / 5
local function body(i, name, size)
  local file = mesh.gmsh{ file = ")" +
         std::string(DYGITA_SOURCE_DIR) + R"(/meshes/cylinder_on_block.geo",
    set = { body = i, radius = R, contact = a, fine = size, growth = 0.4, wide = 30*mm, thick = thick } }
  return substructure{ name = name, mesh = file:volume(name), material = steel }
end
local cylinder, block = body(1, "cylinder", a / n), body(2, "block", 1.3 * a / n)
local line = cylinder:face{ where = function(x, y, z) return x < 2 * a and z < R / 2 and math.abs(math.sqrt(x^2 + (z - R)^2) - R) < 1e-6 * R end }
local contact = interface.contact{ name = "contact", between = { line, block:face "top" }, gap = p.geometry == 1 and "geometry" or 0,
  closed = p.geometry == 0, within = 0.3 * a, friction = 0.2 }
local lid = substructure{ name = "lid", material = steel, mesh = mesh.box{ size = { 14*mm, thick, 4*mm }, origin = { 0, 0, R }, cells = { 14, 1, 4 } } }
local weld = interface.bonded{ name = "weld", between = { cylinder:face "top", lid:face "zmin" } }
local supports = {
  support.symmetry{ name = "symmetry", on = { cylinder:face "x", cylinder:face "ends", block:face "x", block:face "ends" } },
  support.symmetry{ name = "sides", on = { lid:face "xmin", lid:face "ymin", lid:face "ymax" } },
  support.fixed{ name = "floor", on = block:face "bottom" } }
local P = math.pi * 210*GPa / (1 - 0.09) / 2 * a^2 / (4 * R) * thick / 2
local press = step.static{ name = "press", increments = 2, loads = { load.force{ on = lid:face "zmax", z = -P } } }
local parts, interfaces, steps = { cylinder, block, lid }, { contact, weld }, { press }
if p.preload == 1 then
  local function rod(name, z) return substructure{ name = name, material = steel, mesh = mesh.box{ size = { 2*mm, thick, R / 2 }, origin = { 11*mm, 0, z }, cells = { 2, 1, 5 } } } end
  local low, high = rod("low", 0), rod("high", R / 2)
  local shank = interface.bonded{ name = "shank", between = { low:face "zmax", high:face "zmin" } }
  for _, one in ipairs{ shank, interface.bonded{ name = "foot", between = { block:face "top", low:face "zmin" } },
    interface.bonded{ name = "seat", between = { high:face "zmax", lid:face "zmin" } } } do interfaces[#interfaces + 1] = one end
  parts[4], parts[5] = low, high
  supports[4] = support.symmetry{ name = "rod", on = { low:face "ymin", low:face "ymax", high:face "ymin", high:face "ymax" } }
  steps[1] = step.static{ name = "press", loads = { load.preload{ on = shank, force = P } } }
end
steps[#steps + 1] = step.dynamic{ name = "hit", after = steps[1], duration = p.until_, dt = 0.05*us,
  loads = { load.force{ on = lid:face "zmax", z = function(t) return -P * (1 + 2 * math.sin(math.pi * math.min(t / (2*us), 1))) end } } }
problem{ name = "gap", substructures = parts, interfaces = interfaces, supports = supports, steps = steps,
  outputs = { output.joint{ name = "joint", on = contact }, output.history{ name = "top", on = lid:face "zmax", quantity = "displacement" }, output.energy{} },
  solver = solver.latin{ tolerance = 1e-9, static_tolerance = 1e-10, mass = "lumped" } }:run{}
)";
}

void expect_same(const DeckRun& one, const DeckRun& other, double within) {
  EXPECT_TRUE(other.result->converged);
  for (const char* column : {"normal", "opening", "open_area"})
    EXPECT_LT(difference(one.column("joint", column), other.column("joint", column)), within) << column;
  EXPECT_LT(difference(one.column("top", "z"), other.column("top", "z")), within);
}

TEST(GapOfGeometry, is_the_same_in_windows_pieces_and_every_solver) {
  const std::string close = "tolerance = 1e-9, static_tolerance = 1e-10, mass = 'lumped'";
  const DeckRun usual = run_text(cylinder_on_block()).at(0);
  EXPECT_FALSE(usual.result->steps.at(1).explicit_parts.empty());
  EXPECT_LT(usual.figure("largest difference between the interface gap and the displacements' [m]"), 1e-12);
  {
    SCOPED_TRACE("explicit pieces");
    expect_same(usual, run_text(cylinder_on_block(), {}, 0, "latin{ pieces = 3, " + close + " }").at(0), 2e-5);
  }
  const DeckRun implicit =
      run_text(cylinder_on_block(), {}, 0, "latin{ integration = 'implicit', " + close + " }").at(0);
  expect_same(usual, implicit, 0.01);
  for (const std::string more : {"window = 4", "pieces = 3", "plain = true", "static_steps = 'assembled'", ""}) {
    SCOPED_TRACE(more);
    const std::string latin = "latin{ integration = 'implicit', " + close + ", " + more + " }";
    expect_same(implicit, run_text(cylinder_on_block(), {}, 0, more.empty() ? "monolithic{}" : latin).at(0), 2e-5);
  }
  // The gap matters: declared closed, the whole face carries.
  const DeckRun closed = run_text(cylinder_on_block(), {{"geometry", "0"}}).at(0);
  EXPECT_GT(usual.column("joint", "open_area").front(), 1.5 * closed.column("joint", "open_area").front() + 1e-9);
}

TEST(GapOfGeometry, is_closed_by_a_bolt_as_by_a_force) {
  const DeckRun usual = run_text(cylinder_on_block(), {{"preload", "1"}}, 0,
                                 "latin{ tolerance = 1e-9, static_tolerance = 1e-10, integration = 'implicit' }")
                            .at(0);
  for (const char* solver :
       {"latin{ tolerance = 1e-9, static_tolerance = 1e-10, static_steps = 'assembled', integration = 'implicit' }",
        "monolithic{}"}) {
    SCOPED_TRACE(solver);
    expect_same(usual, run_text(cylinder_on_block(), {{"preload", "1"}}, 0, solver).at(0), 2e-5);
  }
}

TEST(GapOfGeometry, is_known_to_a_run_that_goes_on) {
  const fs::path folder = fs::temp_directory_path() / ("dygita_gap_" + std::to_string(getpid()));
  fs::create_directories(folder);
  std::ofstream(folder / "gap.lua") << cylinder_on_block();
  const auto run = [&](const char* out, const char* until) {
    set_progress_enabled(false);
    DeckOptions options;
    options.path = folder / "gap.lua";
    options.settings = {{"until_", until}};
    options.out = folder / out;
    options.threads = 1;
    run_deck(options, {run_problem, check_report});
    return folder / out / "gap" / "base";
  };
  const fs::path whole = run("whole", "3*us"), part = run("part", "1.5*us");
  ContinueOptions options;
  options.run = part;
  options.threads = 1;
  options.until = 3e-6;
  EXPECT_TRUE(continue_run(options).not_converged.empty());
  const Table a = read_csv(whole / "joint.csv", {"press", "hit"}), b = read_csv(part / "joint.csv", {"press", "hit"});
  for (const char* column : {"normal", "opening"}) EXPECT_LT(difference(a.column(column), b.column(column)), 1e-6);
  fs::remove_all(folder);
}

// A quarter of a shaft in a hub, larger than its hole by `over`, drawn: nothing is said of a gap.
std::string rings(const std::string& interface, const std::string& steps) {
  return R"(
local p = param{ over = 20*um, order = 1, n = 8 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0.3, density = 7800 }
local file = mesh.gmsh{ file = ")" +
         std::string(DYGITA_SOURCE_DIR) +
         R"(/tests/decks/drawn_rings.geo", set = { over = p.over, n = p.n }, order = p.order }
local function part(name) return substructure{ name = name, mesh = file:volume(name), material = steel } end
local inner, outer = part "inner", part "outer"
local function round(of) local face = of:face{ cylinder = true, radius = 20*mm } return face end
local fit = interface.contact{ name = "fit", friction = 0, )" +
         interface + R"( }
local function low(of, n) return of:face{ normal = n, at = 0 } end
local planes = {}
for _, n in ipairs{ { -1, 0, 0 }, { 0, -1, 0 }, { 0, 0, -1 } } do planes[#planes + 1] = low(inner, n); planes[#planes + 1] = low(outer, n) end
problem{ name = "rings", substructures = { inner, outer }, interfaces = { fit }, supports = { support.symmetry{ name = "planes", on = planes } },
  outputs = { output.history{ name = "p", on = fit, quantity = "pressure" } }, steps = )" +
         steps + " }:run{}\n";
}

constexpr const char* named = "between = { round(inner), round(outer) }";
constexpr const char* pressed = R"({ step.static{ name = "s", increments = 2 } })";

// Lame: p = E delta / b (1 - a^2/b^2)(c^2/b^2 - 1) / (2 (c^2/b^2 - a^2/b^2)), of plane stress; a, b, c = 10, 20, 30 mm.
double lame(double over) {
  const double inner = 0.25, outer = 2.25;
  return 210e9 * over / 0.02 * (1 - inner) * (outer - 1) / (2 * (outer - inner));
}

double pressure_of(const Settings& settings, const std::string& interface) {
  return run_text(rings(interface, pressed), settings).at(0).column("p", "pressure").back();
}

TEST(GapOfRoundSurfaces, is_the_interference_that_is_drawn_however_coarse_the_facets) {
  for (const auto& [order, n, within] : {std::tuple{"1", "8", 0.02}, {"1", "16", 0.005}, {"2", "8", 0.002}})
    for (const char* over : {"20*um", "0.5*um"}) {
      const double right = lame(std::string(over) == "20*um" ? 20e-6 : 0.5e-6);
      const double found = pressure_of({{"order", order}, {"n", n}, {"over", over}}, named);
      std::cout << "  order " << order << ", n " << n << ", " << over << ": " << found / right - 1 << "\n";
      EXPECT_NEAR(found, right, within * right);
    }
  EXPECT_NEAR(pressure_of({{"order", "2"}}, std::string(named) + ", gap = 'geometry'"), lame(20e-6),
              0.002 * lame(20e-6));
}

TEST(GapOfRoundSurfaces, is_open_where_a_clearance_is_drawn_and_closed_where_the_deck_says_so) {
  EXPECT_EQ(pressure_of({{"over", "-20*um"}}, named), 0.0);
  EXPECT_NEAR(pressure_of({{"over", "20*um"}}, std::string(named) + ", closed = true"), 0.0, 1e-3 * lame(20e-6));
  // Equal radii: what it was, to the bit.
  EXPECT_EQ(pressure_of({{"over", "0"}, {"order", "2"}}, named),
            pressure_of({{"over", "0"}, {"order", "2"}}, std::string(named) + ", closed = true"));
}

// A pressure q in the bore widens the inner ring by 2 q a^2 b / (E (b^2 - a^2)); what the clearance leaves of it
// presses.
TEST(GapOfRoundSurfaces, is_closed_all_around_by_a_pressure_however_wide_it_is) {
  const std::string press =
      "{ step.static{ name = 's', loads = { load.pressure{ on = inner:face{ cylinder = true, "
      "radius = 10*mm }, history = 1500*MPa } } } }";
  for (const auto& [over, apart] : {std::pair{"-20*um", 20e-6}, {"-60*um", 60e-6}}) {
    const double b = 0.02 - apart, widened = 2 * 1500e6 * 1e-4 * b / (210e9 * (b * b - 1e-4));
    const double right = lame(widened - apart);
    const double found = run_text(rings(named, press), {{"order", "2"}, {"n", "12"}, {"over", over}})
                             .at(0)
                             .column("p", "pressure")
                             .back();
    std::cout << "  " << apart << ": " << found / right - 1 << "\n";
    EXPECT_NEAR(found, right, 0.006 * right);
  }
}

// A round punch on a plane touches along a line: nothing is said of a gap. Hertz's half width is 15 um; `right` is that
// of 96 facets with the gap declared, of both orders.
TEST(GapOfRoundSurfaces, is_that_of_a_line_where_one_lies_on_a_plane) {
  const auto sinks = [](const char* n, const char* order, const char* between) {
    const std::string text =
        R"(
local p = param{ n = 24, order = 1 }
local steel = material.elastic{ name = "steel", young = 210*GPa, poisson = 0, density = 7800 }
local file = mesh.gmsh{ file = ")" +
        std::string(DYGITA_SOURCE_DIR) +
        R"(/tests/decks/round_punch.geo", unit = mm, order = p.order, set = { n = p.n }, size = 1*mm }
local punch = substructure{ name = "punch", material = steel, mesh = file:volume "punch" }
local block = substructure{ name = "block", material = steel, mesh = mesh.box{ size = { 1*mm, 0.38*mm, 1*mm }, cells = { p.n, 3, 3 }, origin = { -0.5*mm, 0, -1*mm }, order = p.order } }
local seat = interface.contact{ name = "seat", between = )" +
        between + R"( }
local press = step.static{ name = "press", loads = { load.pressure{ on = punch:face "top", history = 100*MPa }, load.displacement{ on = punch:face "top", x = 0, y = 0 } } }
problem{ name = "punch", substructures = { punch, block }, interfaces = { seat }, supports = { support.fixed{ name = "ground", on = block:face "zmin" } }, steps = { press },
  outputs = { output.history{ name = "top", on = punch:face "top", quantity = "displacement" } } }:run{}
)";
    return -run_text(text, {{"n", n}, {"order", order}}).at(0).column("top", "z").back();
  };
  const double right = 995e-9;
  const std::string one = "{ punch:face 'round', block:face 'zmax' }",
                    other = "{ block:face 'zmax', punch:face 'round' }";
  // Of an odd number of facets the line is in the middle of one; of three, each is nine times as wide as the contact.
  for (const auto& [n, order, off] : {std::tuple{"24", "1", 0.06},
                                      {"24", "2", 0.06},
                                      {"12", "1", 0.06},
                                      {"13", "1", 0.06},
                                      {"25", "1", 0.06},
                                      {"3", "1", 0.35}})
    for (const std::string& between : {one, other}) {
      const double found = sinks(n, order, between.c_str());
      std::cout << "  " << n << " facets, order " << order << ": " << 1e9 * found << " nm\n";
      EXPECT_NEAR(found, right, off * right) << n << " facets between " << between;
    }
  // Found, with parts named or all that touch, it is the same contact.
  for (const char* between : {"{ punch, block }", "{ block, punch }", "{ punch, block:face 'zmax' }", "'all touching'"})
    for (const char* n : {"12", "24", "25"})
      EXPECT_NEAR(sinks(n, "1", between), sinks(n, "1", one.c_str()), 0.001 * right) << n << " facets " << between;
}

TEST(GapOfRoundSurfaces, is_no_interference_where_the_first_step_is_dynamic) {
  testing::internal::CaptureStderr();
  const DeckRun run =
      run_text(rings(named, R"({ step.dynamic{ name = "d", duration = 1*us, dt = 0.1*us } })"), {}).at(0);
  tell_warnings();
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_NE(said.find("overlap by up to 0.02 mm, which is left out, since the first step is dynamic"),
            std::string::npos)
      << said;
  EXPECT_NEAR(run.column("p", "pressure").back(), 0.0, 1e-6 * lame(20e-6));
}

}  // namespace
}  // namespace dygita::test::gap_tests
