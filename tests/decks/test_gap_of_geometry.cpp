// A cylinder above a block, the gap between them that of the places (gap = "geometry"): pressed through a plate, by a
// force or by a bolt beside it, then hit. Every way to compute it sees the same gap.
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace dygita::test::gap_tests
